// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "sim/contact/contact.h"

namespace throng {

/// An impact at two points of two bodies along one normal, as of a box that lands flat: impulses on b (N s).
struct FlatImpact {
  double normal_i, normal_j;  ///< at either point, at least 0
  double across_i, across_j;  ///< along the normal turned left: what they share, by what each may rub
};

/// m/s, at each of the two points.
struct AtPoints {
  double i, j;

  AtPoints operator-(const AtPoints& other) const { return {i - other.i, j - other.j}; }
  AtPoints operator*(double factor) const { return {factor * i, factor * j}; }
  double dot(const AtPoints& other) const { return i * other.i + j * other.j; }
};

/// The impact that adds `added` (above 0) to the normal velocity at each point, or more at one of which it
/// has no impulse, as the body tips; and stops the slip at the same time, or rubs against it as hard as
/// Coulomb's law has it. Friction takes no energy in: where that would be so, it acts after the other
/// impulses, and turns the bodies. `whole`: of an impact that comes in several strikes what all of them will
/// have added, else `added`; each has its share of what friction does in all. Nothing where the two are as
/// good as one point, or one would pull. O(1).
///
/// Newton's law of restitution with Coulomb's of friction, in one linear system of impulses: Glocker and
/// Pfeiffer, Nonlinear Dynamics 7, 471 (1995).
std::optional<FlatImpact> flat_impact(const PointContact& i, const PointContact& j, const SolverBody& a,
                                      const SolverBody& b, const AtPoints& added, const AtPoints& whole);

/// Applies it.
void apply(const FlatImpact& impact, const PointContact& i, const PointContact& j, SolverBody& a,
           SolverBody& b);

}  // namespace throng
