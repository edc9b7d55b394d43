// SPDX-License-Identifier: MIT
#include "tools/bench/accuracy/exact_throw.h"

namespace throng::bench {

BodyState exact_throw(const BodyState& start, const Vec& gravity, double t) {
  return {start.position + t * start.velocity + 0.5 * t * t * gravity, start.angle + t * start.spin,
          start.velocity + t * gravity, start.spin};
}

}  // namespace throng::bench
