// SPDX-License-Identifier: MIT
#include "sim/contact/learning.h"

#include <algorithm>

namespace throng {

namespace {

constexpr double kSoonest = 300.0;  // substeps: learnt faster, tall pyramids swing
constexpr double kLeft = 0.2;       // of a load
constexpr double kMost = 1000.0;    // own weights, of few layers

}  // namespace

double Learning::operator()(double preload, double normal_impulse, double normal_mass,
                            double speed_squared) const {
  const bool learns = normal_impulse < most * (normal_mass * weight) && speed_squared < slow * slow;
  const double missing = learns ? std::max((1.0 - left) * normal_impulse - preload, 0.0) : 0.0;
  return std::min(preload + share * missing, normal_impulse);
}

Learning learning_in(double layers, double weight, double h, int substeps, double radius) {
  const double later = std::max(layers * layers / (kFewLayers * kFewLayers), 1.0);
  const double share = std::min(substeps / (kSoonest * later), 1.0);
  return {share, weight, radius / (kSoonest * h), kLeft, kMost * later};
}

}  // namespace throng
