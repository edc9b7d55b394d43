// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <span>

#include "sim/collisions.h"
#include "sim/contact_row.h"
#include "sim/state.h"

/// What a gas of discs is, as a whole.
namespace throng {

/// k T (J): the kinetic energy of dynamic bodies' centres over their number, as each has two directions.
/// Where nothing stands in their way and nothing pulls, so that all together keep their momentum, that motion
/// is left out, and so is one body: (n - 1). NaN where that leaves nobody. O(n).
double temperature(const Scene& scene, const State& state);

/// Z = P A / (n k T), n less one where the motion of all together is left out, by the virial of the
/// collisions until `state`: 1 + virial / (2 E t), E the kinetic energy as in temperature(). Nothing before
/// the first step, nor where E isn't what it was at the beginning: where something pulls, rubs or takes
/// energy. O(n).
std::optional<double> compressibility_factor(const Scene& scene, const State& state,
                                             const Collisions& collisions);

/// The same by how often pairs collided, whatever their impulses were: 1 + v sqrt(k T) / (2 E t), v the
/// virial that as many collisions have in equilibrium, over sqrt(k T). Of discs of one size and mass 1 + f d
/// sqrt(pi m / (k T)) / 4, f the rate of a disc's collisions and d its diameter.
std::optional<double> compressibility_by_rate(const Scene& scene, const State& state,
                                              const Collisions& collisions);

/// The same of soft discs at this instant: 1 + (sum of their distances times their forces) / (2 E), forces as
/// impulses of `contacts` over a substep: of those that press, without what dashpots hold back of those that
/// part. Nothing where nothing moves, nor before the first step, which finds contacts. O(n + contacts).
std::optional<double> compressibility_now(const Scene& scene, const State& state,
                                          std::span<const ContactRow> contacts);

}  // namespace throng
