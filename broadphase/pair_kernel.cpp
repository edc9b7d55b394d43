// SPDX-License-Identifier: MIT
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "broadphase/pair_kernel.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "broadphase/pair_kernel.h"
#include "broadphase/pair_search-inl.h"

HWY_BEFORE_NAMESPACE();
namespace throng::broadphase::HWY_NAMESPACE {

/// Where the candidates of a cell's points stand behind its own stretch.
struct Stretch {
  std::uint32_t first, end, shift;
};

struct Stretches {
  std::array<Stretch, 4> all;
  std::size_t count = 0;
  std::size_t candidates = 0;
  void add(const std::uint32_t* start, std::uint32_t bucket, std::uint32_t end, std::uint32_t shift) {
    if (start[bucket] == start[end]) return;
    all[count++] = {start[bucket], start[end], shift};
    candidates += start[end] - start[bucket];
  }
};

void add_borders(const Strips::Around& around, const FixedGrid& grid, std::uint32_t x, Stretches& to) {
  const std::uint32_t* start = grid.start();
  const std::uint32_t south = around.wraps_south ? grid.wrap_y() : 0;
  if (x + 1 == around.cells) {
    const std::uint32_t east = around.wraps_east ? grid.wrap_x() : 0;
    if (around.east != Strips::kNone) to.add(start, around.east, around.east + 1, east);
    if (around.south_east != Strips::kNone)
      to.add(start, around.south_east, around.south_east + 1, east | south);
  }
  if (x == 0 && around.south_west != Strips::kNone) {
    const std::uint32_t west = around.wraps_west ? (0x10000 - grid.wrap_x()) & 0xffff : 0;
    to.add(start, around.south_west, around.south_west + 1, west | south);
  }
}

template <Kind kKind>
HWY_INLINE void gather_strip(const FixedGrid& grid, std::size_t strip, const Search<kKind> search,
                             PairBuffer& found) {
  const Strips::Around around = grid.strips().around(strip);
  const std::uint32_t* start = grid.start();
  const std::uint32_t* own = start + around.first;
  const std::uint32_t south_shift = around.wraps_south ? grid.wrap_y() : 0;
  for (std::uint32_t x = 0; x < around.cells; ++x) {
    if (own[x] == own[x + 1]) continue;
    const bool first = x == 0, last = x + 1 == around.cells;
    const std::uint32_t right = own[last ? x + 1 : x + 2];
    Stretches rest;
    if (around.south != Strips::kNone)
      rest.add(start, around.south + x - (first ? 0 : 1), around.south + x + (last ? 1 : 2), south_shift);
    if (first || last) add_borders(around, grid, x, rest);
    for (std::uint32_t i = own[x]; i < own[x + 1]; ++i) {
      const Query query{grid.at()[i], kKind == Kind::points ? 0 : grid.sizes()[i], grid.rows()[i]};
      Pair* out = found.room(search.room(right - i + rest.candidates, 1 + rest.count));
      out = search.meet(query, i + 1, right, 0, out);
      for (std::size_t k = 0; k < rest.count; ++k)
        out = search.meet(query, rest.all[k].first, rest.all[k].end, rest.all[k].shift, out);
      found.keep(out);
    }
  }
}

template <Kind kKind>
void gather_strips(const FixedGrid& grid, const Items& items, std::size_t first, std::size_t end,
                   PairBuffer& found) {
  const Search<kKind> search(grid, items);
  for (std::size_t strip = first; strip < end; ++strip) gather_strip(grid, strip, search, found);
}

void gather_pairs(const FixedGrid& grid, const Items& items, std::size_t first, std::size_t end,
                  PairBuffer& found) {
  if (!items.boxes.empty()) return gather_strips<Kind::boxes>(grid, items, first, end, found);
  if (!items.reach.empty()) return gather_strips<Kind::discs>(grid, items, first, end, found);
  gather_strips<Kind::points>(grid, items, first, end, found);
}

}  // namespace throng::broadphase::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace throng::broadphase {

HWY_EXPORT(gather_pairs);

void gather_pairs(const FixedGrid& grid, const Items& items, std::size_t first, std::size_t end,
                  PairBuffer& found) {
  HWY_DYNAMIC_DISPATCH(gather_pairs)(grid, items, first, end, found);
}

}  // namespace throng::broadphase
#endif
