// SPDX-License-Identifier: MIT
#pragma once

#include "narrowphase/linkage/check_linkage.h"

namespace throng::narrowphase {

/// The baseline that planners use: contact at configurations so close to each other that no origin and no end
/// of a shape goes farther than `step` (m) from one to the next, as far as their way at 64 instants tells.
/// Not exact: what it calls free may hit. `verdict` is never undecided, evaluations are configurations. Asked
/// of the same hierarchies as `check_motion`, the first contact of all pairs ends it. Allocates its scratch.
LinkageAnswer sample_motion(LinkageChecker& checker, std::span<const double> from, std::span<const double> to,
                            double step);

}  // namespace throng::narrowphase
