// SPDX-License-Identifier: MIT
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "broadphase/pair_kernel.cpp"
#include <hwy/cache_control.h>
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <algorithm>
#include <array>
#include <bit>

#include "broadphase/pair_kernel.h"

HWY_BEFORE_NAMESPACE();
namespace throng::broadphase::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

constexpr std::size_t kAhead = 12;  // items, from when one is fetched from memory until it is looked at

enum class Kind { points, discs, boxes };

/// What is asked about: an item in the grid's fixed point.
struct Query {
  std::uint32_t at, size, row;
};

/// The difference of two places in fixed point.
HWY_INLINE std::uint32_t shifted(std::uint32_t at, std::uint32_t by) {
  return ((at - by) & 0xffff) | ((at & 0xffff0000) - (by & 0xffff0000));
}

#if HWY_TARGET == HWY_SCALAR || HWY_TARGET == HWY_EMU128

/// Tests one item after another against stretches of a grid's order, without vectors.
template <Kind kKind>
class Search {
 public:
  Search(const FixedGrid& grid, const Items& items, PairBuffer& found)
      : grid_(grid), items_(items), limits_(grid.limits(items.same_reach)), found_(found) {}

  void begin(const Query& query, std::size_t candidates, std::size_t) {
    query_ = query;
    out_ = found_.room(candidates);
  }
  void end() { found_.keep(out_); }

  void meet(std::uint32_t first, std::uint32_t end, std::uint32_t shift) {
    const std::uint32_t own = shifted(query_.at, shift), row = query_.row;
    for (std::uint32_t j = first; j < end; ++j) {
      const std::uint32_t other = grid_.rows()[j];
      const Answer answer = ask(shifted(grid_.at()[j], own), kKind == Kind::points ? 0 : grid_.sizes()[j]);
      if (answer == Answer::far || (answer == Answer::open && !items_.near(row, other))) continue;
      *out_++ = {std::min(row, other), std::max(row, other)};
    }
  }

 private:
  enum class Answer { near, far, open };
  static Answer answer(bool near, bool far) { return near ? Answer::near : far ? Answer::far : Answer::open; }

  Answer ask(std::uint32_t apart, std::uint32_t size) const {
    if (grid_.slack() < 0) return Answer::open;
    const auto dx = static_cast<std::int16_t>(apart), dy = static_cast<std::int16_t>(apart >> 16);
    if constexpr (kKind == Kind::boxes) return ask_box(dx, dy, size);
    const std::int32_t squared = dx * dx + dy * dy;
    if constexpr (kKind == Kind::points) return answer(squared < limits_.sure, squared >= limits_.far);
    const auto both = static_cast<std::int32_t>(query_.size + size);
    const std::int32_t inner = std::max(both - grid_.slack(), 0), outer = both + grid_.slack() + 1;
    return answer(squared < inner * inner, squared >= outer * outer);
  }

  /// The other begins within this one's side, or this one within the other's, along both axes.
  Answer ask_box(std::int32_t dx, std::int32_t dy, std::uint32_t size) const {
    const auto width = [](std::uint32_t s) { return static_cast<std::int32_t>(s & 0xffff); };
    const auto height = [](std::uint32_t s) { return static_cast<std::int32_t>(s >> 16); };
    const std::int32_t room =
        std::min({width(query_.size) - dx, width(size) + dx, height(query_.size) - dy, height(size) + dy});
    return answer(room > grid_.slack(), room < -grid_.slack());
  }

  const FixedGrid& grid_;
  const Items& items_;
  const Limits limits_;
  PairBuffer& found_;
  Query query_{};
  Pair* out_ = nullptr;
};

#else

using Rows = hn::CappedTag<std::uint32_t, 16>;  // lanes, and words of fixed point
using Units = hn::Repartition<std::int32_t, Rows>;
using Halves = hn::Repartition<std::int16_t, Rows>;
using UnitsV = hn::Vec<Units>;
using Mask = hn::Mask<Units>;

HWY_INLINE std::size_t lanes() {
  return hn::Lanes(Rows());
}

/// x^2 + y^2 of words that hold x and y.
HWY_INLINE UnitsV squared(hn::Vec<Halves> v) {
  const Units units;
  UnitsV other = hn::Zero(units);
  const UnitsV sum = hn::ReorderWidenMulAccumulate(units, v, v, hn::Zero(units), other);
  return hn::RearrangeToOddPlusEven(sum, other);
}

/// Tests one item after another against stretches of a grid's order.
template <Kind kKind>
class Search {
 public:
  Search(const FixedGrid& grid, const Items& items, PairBuffer& found)
      : at_(grid.at()),
        sizes_(grid.sizes()),
        rows_(grid.rows()),
        slack_(grid.slack()),
        items_(items),
        found_(found) {
    const Limits limits = grid.limits(items.same_reach);
    sure_ = hn::Set(Units(), limits.sure);
    far_ = hn::Set(Units(), limits.far);
  }

  /// Begins with an item that meets at most `candidates` others in `stretches` stretches.
  HWY_INLINE void begin(const Query& query, std::size_t candidates, std::size_t stretches) {
    query_ = query;
    out_ = found_.room(candidates + stretches * lanes());
  }
  HWY_INLINE void end() { found_.keep(out_); }

  HWY_INLINE void meet(std::uint32_t first, std::uint32_t end, std::uint32_t shift) {
    const Rows rows;
    const Halves halves;
    const auto own = hn::BitCast(halves, hn::Set(rows, shifted(query_.at, shift)));
    for (std::uint32_t j = first; j < end; j += static_cast<std::uint32_t>(lanes())) {
      const auto apart = hn::Sub(hn::BitCast(halves, hn::LoadU(rows, at_ + j)), own);
      Mask sure, near;
      compare(apart, j, sure, near);
      near = hn::And(near, hn::FirstN(Units(), std::min<std::size_t>(end - j, lanes())));
      const Mask open = hn::AndNot(sure, near);
      if (HWY_UNLIKELY(!hn::AllFalse(Units(), open))) near = settle(near, open, j);
      append(hn::LoadU(rows, rows_ + j), near, query_.row);
    }
  }

 private:
  /// Which of the items at `j` are surely near, and which may be.
  HWY_INLINE void compare(hn::Vec<Halves> apart, std::uint32_t j, Mask& sure, Mask& near) const {
    if constexpr (kKind == Kind::points) {
      const UnitsV distance = squared(apart);
      sure = hn::Lt(distance, sure_);
      near = hn::Lt(distance, far_);
    } else {
      const auto sizes = hn::LoadU(Rows(), sizes_ + j);
      if (HWY_UNLIKELY(slack_ < 0)) {
        sure = hn::Lt(sure_, sure_);
        near = hn::Not(sure);
      } else if constexpr (kKind == Kind::discs) {
        compare_discs(squared(apart), hn::BitCast(Units(), sizes), sure, near);
      } else {
        compare_boxes(apart, hn::BitCast(Halves(), sizes), sure, near);
      }
    }
  }

  HWY_INLINE void compare_discs(UnitsV distance, UnitsV sizes, Mask& sure, Mask& near) const {
    const Units units;
    const UnitsV both = hn::Add(sizes, hn::Set(units, static_cast<std::int32_t>(query_.size)));
    const UnitsV inner = hn::Max(hn::Sub(both, hn::Set(units, slack_)), hn::Zero(units));
    const UnitsV outer = hn::Add(both, hn::Set(units, slack_ + 1));
    sure = hn::Lt(distance, squared(hn::BitCast(Halves(), inner)));
    near = hn::Lt(distance, squared(hn::BitCast(Halves(), outer)));
  }

  /// The other begins within this one's side, or this one within the other's, along both axes.
  HWY_INLINE void compare_boxes(hn::Vec<Halves> apart, hn::Vec<Halves> sizes, Mask& sure, Mask& near) const {
    const Halves halves;
    const auto own = hn::BitCast(halves, hn::Set(Rows(), query_.size));
    const auto room = hn::Min(hn::SaturatedSub(own, apart), hn::SaturatedAdd(sizes, apart));
    const auto slack = hn::Set(halves, static_cast<std::int16_t>(slack_));
    sure = both_halves(hn::Lt(slack, room));
    near = both_halves(hn::Lt(hn::Neg(slack), hn::SaturatedAdd(room, hn::Set(halves, 1))));
  }

  HWY_INLINE static Mask both_halves(hn::Mask<Halves> mask) {
    const Units units;
    return hn::Eq(hn::BitCast(units, hn::VecFromMask(Halves(), mask)), hn::Set(units, -1));
  }

  /// The mask `near` with the open questions answered in double.
  HWY_NOINLINE Mask settle(Mask near, Mask open, std::uint32_t j) const {
    const Units units;
    std::array<std::uint8_t, 8> bits{}, questions{};
    hn::StoreMaskBits(units, near, bits.data());
    hn::StoreMaskBits(units, open, questions.data());
    for (std::size_t lane = 0; lane < lanes(); ++lane) {
      const auto bit = static_cast<std::uint8_t>(1u << (lane % 8));
      if ((questions[lane / 8] & bit) && !items_.near(query_.row, rows_[j + lane]))
        bits[lane / 8] = static_cast<std::uint8_t>(bits[lane / 8] & ~bit);
    }
    return hn::LoadMaskBits(units, bits.data());
  }

  /// Writes a pair for every lane of `near`, and rubbish behind it.
  HWY_INLINE void append(hn::Vec<Rows> other, Mask near, std::uint32_t row) {
    const Rows rows;
    const auto own = hn::Set(rows, row);
    const auto kept = hn::Compress(other, hn::RebindMask(rows, near));
    const auto low = hn::Min(kept, own), high = hn::Max(kept, own);
    const std::size_t count = hn::CountTrue(Units(), near);
    write(hn::LowerHalf(low), hn::LowerHalf(high), out_);
    if (count > lanes() / 2)
      write(hn::UpperHalf(hn::Half<Rows>(), low), hn::UpperHalf(hn::Half<Rows>(), high), out_ + lanes() / 2);
    out_ += count;
  }

  HWY_INLINE static void write(hn::Vec<hn::Half<Rows> > low, hn::Vec<hn::Half<Rows> > high, Pair* out) {
    const hn::Repartition<std::uint64_t, Rows> wide;
    static_assert(sizeof(Pair) == 8 && std::endian::native == std::endian::little);
    const auto pairs = hn::Or(hn::PromoteTo(wide, low), hn::ShiftLeft<32>(hn::PromoteTo(wide, high)));
    hn::StoreU(pairs, wide, reinterpret_cast<std::uint64_t*>(out));
  }

  const std::uint32_t *at_, *sizes_, *rows_;
  const std::int32_t slack_;
  const Items& items_;
  UnitsV sure_, far_;
  PairBuffer& found_;
  Query query_{};
  Pair* out_ = nullptr;
};

#endif

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
void gather_strip(const FixedGrid& grid, std::size_t strip, Search<kKind>& search) {
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
      search.begin({grid.at()[i], kKind == Kind::points ? 0 : grid.sizes()[i], grid.rows()[i]},
                   right - i + rest.candidates, 1 + rest.count);
      search.meet(i + 1, right, 0);
      for (std::size_t k = 0; k < rest.count; ++k)
        search.meet(rest.all[k].first, rest.all[k].end, rest.all[k].shift);
      search.end();
    }
  }
}

template <Kind kKind>
void gather_strips(const FixedGrid& grid, const Items& items, std::size_t first, std::size_t end,
                   PairBuffer& found) {
  Search<kKind> search(grid, items, found);
  for (std::size_t strip = first; strip < end; ++strip) gather_strip(grid, strip, search);
}

void gather_pairs(const FixedGrid& grid, const Items& items, std::size_t first, std::size_t end,
                  PairBuffer& found) {
  if (!items.boxes.empty()) return gather_strips<Kind::boxes>(grid, items, first, end, found);
  if (!items.reach.empty()) return gather_strips<Kind::discs>(grid, items, first, end, found);
  gather_strips<Kind::points>(grid, items, first, end, found);
}

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
                           Search<kKind>& search) {
  const std::uint32_t* row = coarse.start() + range.first.y * coarse.cells().columns();
  const auto stretches = static_cast<std::size_t>(range.last.y - range.first.y + 1);
  std::size_t candidates = 0;
  for (std::size_t y = 0; y < stretches; ++y, row += coarse.cells().columns())
    candidates += row[range.last.x + 1] - row[range.first.x];
  if (candidates == 0) return;
  search.begin(query, candidates, stretches);
  row -= static_cast<std::int64_t>(stretches) * coarse.cells().columns();
  for (std::size_t y = 0; y < stretches; ++y, row += coarse.cells().columns())
    search.meet(row[range.first.x], row[range.last.x + 1], 0);
  search.end();
}

/// The partners where cells are hashed or lie across a seam.
template <Kind kKind>
void meet_strips(const FixedGrid& coarse, const Range& range, const Query& query, Search<kKind>& search) {
  const std::uint32_t* start = coarse.start();
  const std::int64_t columns = coarse.cells().columns(), rows = coarse.cells().rows();
  coarse.strips().for_each_stretch(
      range, [&](std::uint32_t bucket, std::uint32_t end_bucket, std::int64_t x, std::int64_t y) {
        if (start[bucket] == start[end_bucket]) return;
        const std::uint32_t wrap_x = x < 0 ? 0x10000 - coarse.wrap_x() : x >= columns ? coarse.wrap_x() : 0;
        const std::uint32_t wrap_y = y < 0 ? 0 - coarse.wrap_y() : y >= rows ? coarse.wrap_y() : 0;
        search.begin(query, start[end_bucket] - start[bucket], 1);
        search.meet(start[bucket], start[end_bucket], (wrap_x & 0xffff) | wrap_y);
        search.end();
      });
}

template <Kind kKind>
void gather_across_kind(const FixedGrid& fine, const FixedGrid& coarse, const Items& items, std::size_t first,
                        std::size_t end, PairBuffer& found) {
  Search<kKind> search(coarse, items, found);
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
      meet_dense(coarse, range, query, search);
    else
      meet_strips(coarse, range, query, search);
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

HWY_EXPORT(gather_pairs);
HWY_EXPORT(gather_across);

void gather_pairs(const FixedGrid& grid, const Items& items, std::size_t first, std::size_t end,
                  PairBuffer& found) {
  HWY_DYNAMIC_DISPATCH(gather_pairs)(grid, items, first, end, found);
}

void gather_across(const FixedGrid& fine, const FixedGrid& coarse, const Items& items, std::size_t first,
                   std::size_t end, PairBuffer& found) {
  HWY_DYNAMIC_DISPATCH(gather_across)(fine, coarse, items, first, end, found);
}

}  // namespace throng::broadphase
#endif
