// SPDX-License-Identifier: MIT
#pragma once

#include "sim/scene.h"

namespace throng::tools {

/// Calls draw(at) wherever a body of `radius` at `position` is seen in `domain`: once, in a periodic domain
/// also where it reaches over a border from the other side.
template <class Draw>
void at_images(const Domain& domain, const Vec& position, double radius, Draw draw) {
  if (domain.kind != DomainKind::periodic) return draw(position);
  const Vec size = domain.max - domain.min;
  const Vec turns = ((position - domain.min).array() / size.array()).floor();
  const Vec home = position - size.cwiseProduct(turns);
  for (int i = -1; i <= 1; ++i)
    for (int j = -1; j <= 1; ++j) {
      const Vec at = home + Vec(i * size.x(), j * size.y());
      const bool seen = (at.array() + radius > domain.min.array()).all() &&
                        (at.array() - radius < domain.max.array()).all();
      if (seen) draw(at);
    }
}

}  // namespace throng::tools
