// SPDX-License-Identifier: MIT
#include "sim/contact/learning.h"

#include <algorithm>

namespace throng {

namespace {

constexpr double kSoonest = 300.0;  // substeps: learnt faster, tall pyramids swing
constexpr double kPerLayer = 12.0;  // substeps, for each layer beyond
constexpr double kCalm = 75.0;      // layers: fewer than a hundred come to rest all the same
constexpr double kLeft = 0.2;       // of a load, among
constexpr double kFewLayers = 120.0;
constexpr double kMost = 1000.0;  // own weights, for what learns soonest

}  // namespace

double Learning::operator()(double preload, double normal_impulse, double normal_mass,
                            double speed_squared) const {
  const bool learns = normal_impulse < most * (normal_mass * weight) && speed_squared < slow * slow;
  const double missing = learns ? std::max((1.0 - left) * normal_impulse - preload, 0.0) : 0.0;
  return std::min(preload + share * missing, normal_impulse);
}

Learning learning_in(double layers, double weight, double h, int substeps, double radius) {
  const double patience = std::max(kSoonest, kPerLayer * (layers - kCalm)), later = patience / kSoonest;
  return {std::min(substeps / patience, 1.0), weight, radius / (kSoonest * h),
          kLeft * std::min(kFewLayers / layers, 1.0), kMost * later * later};
}

}  // namespace throng
