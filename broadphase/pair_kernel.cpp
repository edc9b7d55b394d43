// SPDX-License-Identifier: MIT
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "broadphase/pair_kernel.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <cassert>
#include <limits>

#include "broadphase/pair_kernel.h"
#include "broadphase/pair_search-inl.h"

HWY_BEFORE_NAMESPACE();
namespace throng::broadphase::HWY_NAMESPACE {

/// Where the candidates of a cell's points stand, and from where they are seen.
struct Stretch {
  std::uint32_t first, end, shift;
};

struct Stretches {
  std::array<Stretch, 9> all;
  std::size_t count = 0;
  std::size_t candidates = 0;
  void add(const std::uint32_t* start, std::uint32_t bucket, std::uint32_t end, std::uint32_t shift) {
    if (start[bucket] == start[end]) return;
    all[count++] = {start[bucket], start[end], shift};
    candidates += start[end] - start[bucket];
  }
};

/// The cells that a strip's points meet in one row of them.
class Meetings {
 public:
  Meetings(const FixedGrid& grid, std::size_t strip, int southward)
      : start_(grid.start()),
        strip_(grid.strips().strip(strip)),
        beside_(grid.strips().beside(strip, southward)) {
    if (beside_.is_beyond) shift_ = southward < 0 ? 0 - grid.wrap_y() : grid.wrap_y();
    if (strip_.is_west_end) west_ = (0x10000 - grid.wrap_x()) & 0xffff;
    if (strip_.is_east_end) east_ = grid.wrap_x();
  }

  void add(std::uint32_t x, Stretches& to) const {
    const bool first = x == 0, last = x + 1 == strip_.cells;
    if (beside_.middle != Strips::kNone)
      to.add(start_, beside_.middle + x - (first ? 0 : 1), beside_.middle + x + (last ? 1 : 2), shift_);
    if (first && beside_.west != Strips::kNone)
      to.add(start_, beside_.west, beside_.west + 1, west_ | shift_);
    if (last) add_east(to);
  }
  void add_east(Stretches& to) const {
    if (beside_.east != Strips::kNone) to.add(start_, beside_.east, beside_.east + 1, east_ | shift_);
  }

 private:
  const std::uint32_t* start_;
  const Strips::Strip strip_;
  const Strips::Beside beside_;
  std::uint32_t shift_ = 0, west_ = 0, east_ = 0;
};

template <Kind kKind>
HWY_INLINE Query query_at(const FixedGrid& grid, std::uint32_t i) {
  return {grid.at()[i], kKind == Kind::points ? 0 : grid.sizes()[i], grid.rows()[i]};
}

template <Kind kKind>
HWY_INLINE void gather_strip(const FixedGrid& grid, std::size_t i_strip, const Search<kKind> search,
                             PairBuffer& found) {
  const Strips::Strip strip = grid.strips().strip(i_strip);
  const Meetings own_row(grid, i_strip, 0), south(grid, i_strip, 1);
  const std::uint32_t* own = grid.start() + strip.first;
  for (std::uint32_t x = 0; x < strip.cells; ++x) {
    if (own[x] == own[x + 1]) continue;
    const bool last = x + 1 == strip.cells;
    const std::uint32_t right = own[last ? x + 1 : x + 2];
    Stretches rest;
    south.add(x, rest);
    if (last) own_row.add_east(rest);
    for (std::uint32_t i = own[x]; i < own[x + 1]; ++i) {
      const Query query = query_at<kKind>(grid, i);
      Pair* out = found.room(search.room(right - i + rest.candidates, 1 + rest.count));
      out = search.meet(query, i + 1, right, 0, out);
      for (std::size_t k = 0; k < rest.count; ++k)
        out = search.meet(query, rest.all[k].first, rest.all[k].end, rest.all[k].shift, out);
      found.keep(out);
    }
  }
}

template <Kind kKind>
HWY_INLINE void gather_strip(const FixedGrid& grid, std::size_t i_strip, const Search<kKind> search,
                             HigherRows& found) {
  const Strips::Strip strip = grid.strips().strip(i_strip);
  const Meetings north(grid, i_strip, -1), own_row(grid, i_strip, 0), south(grid, i_strip, 1);
  const std::uint32_t* own = grid.start() + strip.first;
  for (std::uint32_t x = 0; x < strip.cells; ++x) {
    if (own[x] == own[x + 1]) continue;
    Stretches around;
    for (const Meetings* row : {&north, &own_row, &south}) row->add(x, around);
    for (std::uint32_t i = own[x]; i < own[x + 1]; ++i) {
      const Query query = query_at<kKind>(grid, i);
      std::uint32_t* const begin = found.rows.room(search.room(around.candidates, around.count));
      std::uint32_t* out = begin;
      for (std::size_t k = 0; k < around.count; ++k)
        out = search.meet(query, around.all[k].first, around.all[k].end, around.all[k].shift, out);
      found.of[query.row] = {static_cast<std::uint32_t>(found.rows.size()),
                             static_cast<std::uint32_t>(out - begin)};
      found.rows.keep(out);
    }
  }
}

template <Kind kKind, class Found>
void gather_strips(const FixedGrid& grid, const Items& items, std::size_t first, std::size_t end,
                   Found& found) {
  const Search<kKind> search(grid, items);
  for (std::size_t strip = first; strip < end; ++strip) gather_strip(grid, strip, search, found);
}

void gather_pairs(const FixedGrid& grid, const Items& items, std::size_t first, std::size_t end,
                  PairBuffer& found) {
  if (!items.boxes.empty()) return gather_strips<Kind::boxes>(grid, items, first, end, found);
  if (!items.reach.empty()) return gather_strips<Kind::discs>(grid, items, first, end, found);
  gather_strips<Kind::points>(grid, items, first, end, found);
}

void gather_higher(const FixedGrid& grid, const Items& items, HigherRows& found) {
  found.of.resize(items.size());
  found.rows.clear();
  gather_strips<Kind::discs>(grid, items, 0, grid.strips().size(), found);
  assert(found.rows.size() <= std::numeric_limits<std::uint32_t>::max());
}

}  // namespace throng::broadphase::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace throng::broadphase {

HWY_EXPORT(gather_pairs);
HWY_EXPORT(gather_higher);

void gather_pairs(const FixedGrid& grid, const Items& items, std::size_t first, std::size_t end,
                  PairBuffer& found) {
  HWY_DYNAMIC_DISPATCH(gather_pairs)(grid, items, first, end, found);
}

void gather_higher(const FixedGrid& grid, const Items& items, HigherRows& found) {
  HWY_DYNAMIC_DISPATCH(gather_higher)(grid, items, found);
}

}  // namespace throng::broadphase
#endif
