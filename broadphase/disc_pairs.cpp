// SPDX-License-Identifier: MIT
#include "broadphase/disc_pairs.h"

#include <cassert>

namespace throng::broadphase {

void DiscPairs::find(std::span<const Point> centres, std::span<const double> reach, const Period* period,
                     std::vector<Pair>& pairs, std::span<const std::uint8_t> movable) {
  assert(movable.empty() || movable.size() == reach.size());
  search_.find_discs(centres, reach, period, found_);
  if (!movable.empty()) found_.keep_movable(movable);
  found_.write(pairs);
}

}  // namespace throng::broadphase
