// SPDX-License-Identifier: MIT
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "broadphase/pair_across.cpp"
#include <hwy/cache_control.h>
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "broadphase/pair_kernel.h"
#include "broadphase/pair_search-inl.h"

HWY_BEFORE_NAMESPACE();
namespace throng::broadphase::HWY_NAMESPACE {

constexpr std::size_t kAhead = 12;  // items, from when one is fetched from memory until it is looked at

/// The cells in which an item's partners of a coarser grid lie.
HWY_INLINE bool range_of_partners(const Items& items, std::size_t row, const FixedGrid& coarse,
                                  Range& range) {
  if (items.boxes.empty())
    return coarse.cells().range(items.points[row], items.reach[row] + 0.5 * coarse.cell_size(), range);
  const double size = coarse.cell_size();
  const Eigen::AlignedBox2d& box = items.boxes[row];
  return coarse.cells().range(0.5 * (box.min() + box.max() - Point(size, size)),
                              0.5 * (size + box.sizes().maxCoeff()), range);
}

/// The partners in one array of cells that doesn't repeat.
template <Kind kKind>
HWY_INLINE void meet_dense(const FixedGrid& coarse, const Range& range, const Query& query,
                           const Search<kKind> search, PairBuffer& found) {
  const std::uint32_t* row = coarse.start() + range.first.y * coarse.cells().columns();
  const auto stretches = static_cast<std::size_t>(range.last.y - range.first.y + 1);
  std::size_t candidates = 0;
  for (std::size_t y = 0; y < stretches; ++y, row += coarse.cells().columns())
    candidates += row[range.last.x + 1] - row[range.first.x];
  if (candidates == 0) return;
  Pair* out = found.room(search.room(candidates, stretches));
  row -= static_cast<std::int64_t>(stretches) * coarse.cells().columns();
  for (std::size_t y = 0; y < stretches; ++y, row += coarse.cells().columns())
    out = search.meet(query, row[range.first.x], row[range.last.x + 1], 0, out);
  found.keep(out);
}

/// The partners where cells are hashed or lie across a seam.
template <Kind kKind>
void meet_strips(const FixedGrid& coarse, const Range& range, const Query& query, const Search<kKind>& search,
                 PairBuffer& found) {
  const std::uint32_t* start = coarse.start();
  const std::int64_t columns = coarse.cells().columns(), rows = coarse.cells().rows();
  coarse.strips().for_each_stretch(
      range, [&](std::uint32_t bucket, std::uint32_t end_bucket, std::int64_t x, std::int64_t y) {
        if (start[bucket] == start[end_bucket]) return;
        const std::uint32_t wrap_x = x < 0 ? 0x10000 - coarse.wrap_x() : x >= columns ? coarse.wrap_x() : 0;
        const std::uint32_t wrap_y = y < 0 ? 0 - coarse.wrap_y() : y >= rows ? coarse.wrap_y() : 0;
        Pair* const out = found.room(search.room(start[end_bucket] - start[bucket], 1));
        found.keep(search.meet(query, start[bucket], start[end_bucket], (wrap_x & 0xffff) | wrap_y, out));
      });
}

template <Kind kKind>
void gather_across_kind(const FixedGrid& fine, const FixedGrid& coarse, const Items& items, std::size_t first,
                        std::size_t end, PairBuffer& found) {
  const Search<kKind> search(coarse, items);
  const bool dense = coarse.strips().dense() && !items.period;
  for (std::size_t i = first; i < end; ++i) {
    const std::uint32_t row = fine.rows()[i];
    const std::uint32_t soon = fine.rows()[std::min(i + kAhead, end - 1)];
    hwy::Prefetch(&items.place(soon));
    if (kKind == Kind::discs) hwy::Prefetch(&items.reach[soon]);
    Range range;
    if (!range_of_partners(items, row, coarse, range)) continue;
    const Query query{coarse.fixed(items.place(row)), coarse.fixed_size(items, row), row};
    if (dense)
      meet_dense(coarse, range, query, search, found);
    else
      meet_strips(coarse, range, query, search, found);
  }
}

void gather_across(const FixedGrid& fine, const FixedGrid& coarse, const Items& items, std::size_t first,
                   std::size_t end, PairBuffer& found) {
  if (items.boxes.empty())
    gather_across_kind<Kind::discs>(fine, coarse, items, first, end, found);
  else
    gather_across_kind<Kind::boxes>(fine, coarse, items, first, end, found);
}

}  // namespace throng::broadphase::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace throng::broadphase {

HWY_EXPORT(gather_across);

void gather_across(const FixedGrid& fine, const FixedGrid& coarse, const Items& items, std::size_t first,
                   std::size_t end, PairBuffer& found) {
  HWY_DYNAMIC_DISPATCH(gather_across)(fine, coarse, items, first, end, found);
}

}  // namespace throng::broadphase
#endif
