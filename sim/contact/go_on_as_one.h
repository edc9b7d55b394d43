// SPDX-License-Identifier: MIT
#pragma once

#include "sim/contact/contact.h"

namespace throng {

/// Lets both go on as one rigid body, with the momentum and the spin (angular momentum about their common
/// centre) that they have together; what they lose is energy. `between` (m): from a's centre to b's. Expects
/// that both are dynamic, and that both can turn or neither can. O(1).
void go_on_as_one(SolverBody& a, SolverBody& b, const Vec& between);

}  // namespace throng
