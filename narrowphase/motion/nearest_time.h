// SPDX-License-Identifier: MIT
#pragma once

#include "narrowphase/motion/motion.h"

/// When are two moving shapes nearest that don't meet? For whether they do, see first_contact.h.
namespace throng::narrowphase {

/// An instant from 0 to `duration` (s) at which the line between the two parts them all the while, were they
/// not to turn: along its normal no point of one gets half the way to the other. Expects that they are apart
/// all the time, and finite motions. Of shapes that turn it is an instant at which they are about nearest. By
/// the sign of the gap's rate, bracketed, and the instant at which the two nearest points would be nearest.
/// O(k (n + m)), k = 2 to 6 distances mostly, at most 40. Allocates nothing.
double nearest_time(const Convex& a, const Motion& motion_a, const Convex& b, const Motion& motion_b,
                    double duration);

}  // namespace throng::narrowphase
