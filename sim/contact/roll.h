// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "narrowphase/convex.h"
#include "sim/contact/body_rows.h"
#include "sim/contact/contact.h"

/// Rolling resistance: at a contact of a disc a torque holds the two bodies' spins together, up to the
/// coefficient times the effective radius times the normal force (Ai, Chen, Rotter and Ooi 2011), as
/// Coulomb's law stops the slip.
namespace throng {

/// What one contact adds where its surfaces resist rolling.
struct RollContact {
  std::uint32_t a, b;     ///< rows of the bodies
  std::uint32_t contact;  ///< among those of its kind
  double lever;           ///< m, coefficient times radius
  double mass;            ///< kg m², what the two show to a torque between them
  double impulse = 0.0;   ///< N m s, on b; a feels the opposite
};

/// The radius that counts between two (m), of which 0 stands for what is no disc: that of the only disc, and
/// half the harmonic mean of two.
double effective_radius(double a, double b);

/// Of a disc (m); 0 for what is none.
double rolling_radius(const narrowphase::Convex& shape);

/// Applies the impulses that the last sweep left.
void warm_start(std::span<const RollContact> rolls, BodyRows<SolverBody> bodies);

/// One sweep of Gauss and Seidel. `contacts`: those that `rolls` tell of, after their own sweep.
template <class Blocks>
void resist(std::span<RollContact> rolls, const Blocks& contacts, BodyRows<SolverBody> bodies);

}  // namespace throng
