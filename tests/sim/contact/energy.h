// SPDX-License-Identifier: MIT
#pragma once

#include "sim/contact/contact.h"

namespace throng {

/// J, of motion; of a body that can move, and turn where it spins.
inline double energy(const SolverBody& body) {
  const double turning = body.inverse_inertia > 0.0 ? body.spin * body.spin / body.inverse_inertia : 0.0;
  return 0.5 * body.velocity.squaredNorm() / body.inverse_mass + 0.5 * turning;
}

}  // namespace throng
