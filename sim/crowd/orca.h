// SPDX-License-Identifier: MIT
#pragma once

#include "sim/crowd/model.h"

namespace throng {

/// Everyone takes, of the velocities that keep him clear of all others for a while if each does half of what
/// that takes, the one nearest to what he wants; where there is none, the one that comes nearest to it. van
/// den Berg, Guy, Lin and Manocha, "Reciprocal n-body collision avoidance" (Robotics Research 2011), with its
/// static obstacles, which agents keep clear of all by themselves.
///
/// What agents want is off by up to kOrcaDoubt of their desired speed, at random in each step: where all is
/// symmetric, somebody must begin.
ModelKind orca();

inline constexpr double kOrcaDoubt = 1e-3;

}  // namespace throng
