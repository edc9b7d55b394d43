// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>

#include "sim/scene.h"

/// Places and ways in a domain that repeats.
namespace throng {

/// The place in [domain.min, domain.max) that `p` is an image of.
inline Vec wrapped(const Vec& p, const Domain& domain) {
  Vec result = p;
  for (int axis : {0, 1}) {
    if (p[axis] >= domain.min[axis] && p[axis] < domain.max[axis]) continue;  // nearly all: no division
    const double size = domain.max[axis] - domain.min[axis];
    result[axis] -= size * std::floor((p[axis] - domain.min[axis]) / size);
    if (!(result[axis] >= domain.min[axis] && result[axis] < domain.max[axis]))
      result[axis] = domain.min[axis];
  }
  return result;
}

/// `d` less the whole periods that make it shortest.
inline Vec nearest_image(const Vec& d, const Vec& period) {
  return {d.x() - period.x() * std::floor(d.x() / period.x() + 0.5),
          d.y() - period.y() * std::floor(d.y() / period.y() + 0.5)};
}

}  // namespace throng
