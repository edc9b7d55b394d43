// SPDX-License-Identifier: MIT
#include "broadphase/disc_pairs.h"

#include <cassert>

namespace throng::broadphase {

namespace {

void drop_unmovable(std::span<const std::uint8_t> movable, PairBuffer& found) {
  Pair* out = found.pairs().data();
  for (const Pair& pair : found.pairs()) {
    *out = pair;
    out += (movable[pair.a] | movable[pair.b]) != 0;
  }
  found.keep(out);
}

}  // namespace

void DiscPairs::find(std::span<const Point> centres, std::span<const double> reach, const Period* period,
                     std::vector<Pair>& pairs, std::span<const std::uint8_t> movable) {
  assert(movable.empty() || movable.size() == reach.size());
  search_.find_discs(centres, reach, period, found_);
  if (!movable.empty())
    for (std::size_t i = 0; i < found_.buffers(); ++i) drop_unmovable(movable, found_.buffer(i));
  sorter_.sort(found_, centres.size(), pairs);
}

}  // namespace throng::broadphase
