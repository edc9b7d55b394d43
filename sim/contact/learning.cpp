// SPDX-License-Identifier: MIT
#include "sim/contact/learning.h"

#include <algorithm>

namespace throng {

namespace {

constexpr double kLayers = 110.0;
constexpr double kWhile = 300.0;   // substeps, of kLayers: learnt faster, tall pyramids swing
constexpr double kSoonest = 60.0;  // substeps: learnt at once, blows throw back
constexpr double kLeft = 0.2;      // of a load
constexpr double kMost = 1000.0;   // own weights, of kLayers and fewer

static_assert(kWhile * kFewLayers * kFewLayers <= kSoonest * kLayers * kLayers);

}  // namespace

double Learning::operator()(double preload, double normal_impulse, double normal_mass,
                            double speed_squared) const {
  const bool learns = normal_impulse < most * (normal_mass * weight) && speed_squared < slow * slow;
  const double missing = learns ? std::max((1.0 - left) * normal_impulse - preload, 0.0) : 0.0;
  return std::min(preload + share * missing, normal_impulse);
}

Learning learning_in(double layers, double weight, double h, int substeps, double radius) {
  const double later = layers * layers / (kLayers * kLayers);
  const double share = std::min(substeps / std::max(kWhile * later, kSoonest), 1.0);
  return {share, weight, radius / (kWhile * h), kLeft, kMost * std::max(later, 1.0)};
}

}  // namespace throng
