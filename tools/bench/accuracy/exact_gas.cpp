// SPDX-License-Identifier: MIT
#include "tools/bench/accuracy/exact_gas.h"

#include <cmath>
#include <numbers>

namespace throng::bench {

double exact_compressibility(double fraction) {
  const double x = fraction;
  return (1.0 + x * x / 8.0 + x * x * x / 18.0 - 4.0 * x * x * x * x / 21.0) / ((1.0 - x) * (1.0 - x));
}

double exact_collision_rate(double fraction, double diameter, double mean_square_speed) {
  const double thermal = std::sqrt(0.5 * mean_square_speed);
  return 4.0 * (exact_compressibility(fraction) - 1.0) * thermal / (std::sqrt(std::numbers::pi) * diameter);
}

}  // namespace throng::bench
