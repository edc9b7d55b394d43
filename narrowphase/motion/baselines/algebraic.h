// SPDX-License-Identifier: MIT
#pragma once

#include "narrowphase/motion/first_contact.h"

namespace throng::narrowphase {

/// The first contact by its definition: the earliest time at which a vertex of one shape lies on an edge of
/// the other, or as far from it as both are rounded, or, of rounded shapes, that far from a vertex. Of every
/// such pair the first root is isolated by interval Newton, certainly; where nothing turns that is one step,
/// and exact up to rounding (Redon, Kheddar and Coquillart 2002 do so in space). Answers as `first_contact`,
/// with which it shares no step but the start: a second opinion, and a baseline. `evaluations` are those of
/// roots' functions, at most `question.evaluations` a root: beyond them the rest is in doubt; `features`
/// isn't read. A point that meets a point, both without radius, is no contact. O(n m) roots, each of some ten
/// evaluations of 30 ns. Allocates nothing.
FirstContact algebraic_contact(const Convex& a, const Motion& motion_a, const Convex& b,
                               const Motion& motion_b, double duration, const ContactQuestion& question = {});

}  // namespace throng::narrowphase
