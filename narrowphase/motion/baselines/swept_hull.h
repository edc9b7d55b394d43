// SPDX-License-Identifier: MIT
#pragma once

#include "narrowphase/motion/motion.h"

namespace throng::narrowphase {

/// Whether what two shapes sweep stays apart: true is certain, false says nothing. The baseline of the
/// lectures and of Tesseract's and Bullet's casts, which leave the padding out and are wrong where bodies
/// turn.
///
/// A sweep is the hull of the first and the last pose, padded: a point r from the origin that turns by theta
/// in all is never farther from where it would be on the chord, at the same time, than r theta² / 8, the
/// error of linear interpolation; the sagitta r (1 - cos(theta / 2)) is as much but for theta's fourth power.
/// Seen from a's origin, which moves along: a only turns, b goes straight and turns. Two sweeps that meet may
/// well be there at different times, so it decides only what is short or far. O(n log n) to build the hulls,
/// which allocate.
bool swept_hulls_are_apart(const Convex& a, const Motion& motion_a, const Convex& b, const Motion& motion_b,
                           double duration);

}  // namespace throng::narrowphase
