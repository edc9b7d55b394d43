// SPDX-License-Identifier: MIT
#include "sim/collisions.h"

#include <cmath>
#include <numbers>

namespace throng {

Collisions& Collisions::operator+=(const Collisions& more) {
  pairs += more.pairs, walls += more.walls, pushed += more.pushed;
  virial += more.virial, equilibrium += more.equilibrium;
  return *this;
}

/// The faster of two meet the more often: the mean impulse of collisions is sqrt(2 pi m k T), m the reduced
/// mass.
void Collisions::add_pair(double distance, double impulse, double inverse_mass) {
  ++pairs;
  virial += distance * impulse;
  equilibrium += distance * std::sqrt(2.0 * std::numbers::pi / inverse_mass);
}

}  // namespace throng
