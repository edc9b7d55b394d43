// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

namespace throng::bench {

using Vec = Eigen::Vector2d;

/// Where a body is, and how it moves.
struct BodyState {
  Vec position{0.0, 0.0};  ///< m, of the centre of mass
  double angle = 0.0;      ///< rad
  Vec velocity{0.0, 0.0};  ///< m/s
  double spin = 0.0;       ///< rad/s
};

}  // namespace throng::bench
