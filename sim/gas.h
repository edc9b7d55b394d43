// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "sim/collisions.h"
#include "sim/state.h"

/// What a gas of discs is, as a whole.
namespace throng {

/// k T (J): the kinetic energy of dynamic bodies' centres over their number, as each has two directions. In a
/// domain that repeats, the motion of all together is left out, and so is one body: (n - 1). NaN where that
/// leaves nobody. O(n).
double temperature(const Scene& scene, const State& state);

/// Z = P A / (n k T) by the virial of the collisions until `state`: 1 + virial / (2 E t), E the kinetic
/// energy as in temperature(). Nothing before the first step, nor where E isn't what it was at the beginning:
/// where something pulls, rubs or takes energy. O(n).
std::optional<double> compressibility_factor(const Scene& scene, const State& state,
                                             const Collisions& collisions);

}  // namespace throng
