// SPDX-License-Identifier: MIT
#pragma once

#include "narrowphase/motion/first_contact.h"

/// Conservative advancement as published (Mirtich 1996): the plain definition of the first contact, and what
/// `first_contact` is measured against. Not for use: it crawls where paths graze.
namespace throng::narrowphase {

/// By how fast the distance may shrink: by all that moves, or by what moves along the normal.
enum class Closing { scalar, directional };

/// Goes on by distance over rate until the two are `question.width` of their size apart, and calls that a hit
/// at t_lo = t_hi: also where they only pass each other so near. Never late: nothing touches before t_lo.
/// `question.evaluations` distances without coming to an end are undecided, from t_lo to the duration.
/// Allocates nothing.
FirstContact advance_scalar(const Convex& a, const Motion& motion_a, const Convex& b, const Motion& motion_b,
                            double duration, Closing closing = Closing::scalar,
                            const ContactQuestion& question = {});

}  // namespace throng::narrowphase
