// SPDX-License-Identifier: MIT
#include "tools/bench/accuracy/exact_spring.h"

#include <cmath>
#include <numbers>

namespace throng::bench {

using std::numbers::pi;

SpringImpact exact_spring_impact(double stiffness, double mass, double damping) {
  const double frequency = std::sqrt(stiffness / mass);
  const double ratio = damping / (2.0 * mass * frequency), slower = std::sqrt(1.0 - ratio * ratio);
  return {std::exp(-pi * ratio / slower), pi / (frequency * slower)};
}

double exact_damping(double stiffness, double mass, double restitution) {
  const double lost = std::abs(std::log(restitution));
  return 2.0 * lost / std::hypot(pi, lost) * std::sqrt(stiffness * mass);
}

}  // namespace throng::bench
