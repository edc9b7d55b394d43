// SPDX-License-Identifier: MIT
#include "tools/bench/accuracy/exact_bounce.h"

#include <cmath>

namespace throng::bench {

Height exact_bounce(double height, double gravity, double restitution, double t) {
  const double fall = std::sqrt(2.0 * height / gravity);
  if (t < fall) return {height - 0.5 * gravity * t * t, -gravity * t};
  if (t >= exact_rest(height, gravity, restitution)) return {0.0, 0.0};
  double up = restitution * gravity * fall;
  for (t -= fall; up > 0.0 && t >= 2.0 * up / gravity; up *= restitution) t -= 2.0 * up / gravity;
  return {up * t - 0.5 * gravity * t * t, up - gravity * t};
}

double exact_rest(double height, double gravity, double restitution) {
  return std::sqrt(2.0 * height / gravity) * (1.0 + restitution) / (1.0 - restitution);
}

}  // namespace throng::bench
