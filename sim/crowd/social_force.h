// SPDX-License-Identifier: MIT
#pragma once

#include "sim/crowd/model.h"

namespace throng {

/// Agents accelerate towards their desired velocity, keep away from others and from barriers, and where they
/// touch are pressed apart and rub: Helbing, Farkas and Vicsek, "Simulating dynamical features of escape
/// panic" (Nature 407, 2000), with its constants. Integrated by semi-implicit Euler; friction is that at the
/// step's end, as a sliding ends in less than a step. It slows down, at barriers too. Barriers' forces act on
/// all of the radius, and half of it never gets into them.
ModelKind social_force();

}  // namespace throng
