// SPDX-License-Identifier: MIT
// The innermost loop of all pairs: one item against a stretch of a grid's order, many at a time. Compiled for
// each width of vectors by the sources that include it.
#if defined(THRONG_PAIR_SEARCH_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef THRONG_PAIR_SEARCH_INL
#undef THRONG_PAIR_SEARCH_INL
#else
#define THRONG_PAIR_SEARCH_INL
#endif

#include <hwy/highway.h>

#include <algorithm>
#include <array>
#include <bit>

#include "broadphase/lanes_of_mask.h"
#include "broadphase/pair_kernel.h"

HWY_BEFORE_NAMESPACE();
namespace throng::broadphase::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

enum class Kind { points, discs, boxes };

/// What is asked about: an item in the grid's fixed point.
struct Query {
  std::uint32_t at, size, row;
};

/// The difference of two places in fixed point.
HWY_INLINE std::uint32_t shifted(std::uint32_t at, std::uint32_t by) {
  return ((at - by) & 0xffff) | ((at & 0xffff0000) - (by & 0xffff0000));
}

#if HWY_TARGET == HWY_SCALAR

/// Tests one item after another against stretches of a grid's order, without vectors.
template <Kind kKind>
class Search {
 public:
  Search(const FixedGrid& grid, const Items& items)
      : grid_(grid), items_(items), limits_(grid.limits(items.same_reach)) {}

  static std::size_t room(std::size_t candidates, std::size_t) { return candidates + 1; }

  template <class Out>
  Out* meet(const Query& query, std::uint32_t first, std::uint32_t end, std::uint32_t shift, Out* out) const {
    const std::uint32_t own = shifted(query.at, shift);
    for (std::uint32_t j = first; j < end; ++j) {
      const std::uint32_t size = kKind == Kind::points ? 0 : grid_.sizes()[j];
      const Answer answer = ask(query.size, shifted(grid_.at()[j], own), size);
      out = keep(query.row, grid_.rows()[j], answer, out);
    }
    return out;
  }

 private:
  enum class Answer { near, far, open };
  static Answer answer(bool near, bool far) { return near ? Answer::near : far ? Answer::far : Answer::open; }

  bool near(std::uint32_t row, std::uint32_t other, Answer answer) const {
    return answer == Answer::near || (answer == Answer::open && items_.near(row, other));
  }
  Pair* keep(std::uint32_t row, std::uint32_t other, Answer answer, Pair* out) const {
    *out = {std::min(row, other), std::max(row, other)};
    return out + near(row, other, answer);
  }
  std::uint32_t* keep(std::uint32_t row, std::uint32_t other, Answer answer, std::uint32_t* out) const {
    *out = other;
    return out + (row < other && near(row, other, answer));
  }

  Answer ask(std::uint32_t own, std::uint32_t apart, std::uint32_t size) const {
    if (grid_.slack() < 0) return Answer::open;
    const auto dx = static_cast<std::int16_t>(apart), dy = static_cast<std::int16_t>(apart >> 16);
    if constexpr (kKind == Kind::boxes) return ask_box(own, dx, dy, size);
    const std::int32_t squared = dx * dx + dy * dy;
    if constexpr (kKind == Kind::points) return answer(squared < limits_.sure, squared >= limits_.far);
    const auto both = static_cast<std::int32_t>(own + size);
    const std::int32_t inner = std::max(both - grid_.slack(), 0), outer = both + grid_.slack();
    return answer(squared < inner * inner, squared >= outer * outer);
  }

  /// The other begins within this one's side, or this one within the other's, along both axes.
  Answer ask_box(std::uint32_t own, std::int32_t dx, std::int32_t dy, std::uint32_t size) const {
    const auto width = [](std::uint32_t s) { return static_cast<std::int32_t>(s & 0xffff); };
    const auto height = [](std::uint32_t s) { return static_cast<std::int32_t>(s >> 16); };
    const std::int32_t room =
        std::min({width(own) - dx, width(size) + dx, height(own) - dy, height(size) + dy});
    return answer(room > grid_.slack(), room <= -grid_.slack());
  }

  const FixedGrid& grid_;
  const Items& items_;
  const Limits limits_;
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

/// The mask `near` of items at `rows` with the open questions answered in double.
HWY_NOINLINE Mask settle(const Items& items, std::uint32_t row, const std::uint32_t* rows, Mask near,
                         Mask open) {
  const Units units;
  std::array<std::uint8_t, 8> bits{}, questions{};
  hn::StoreMaskBits(units, near, bits.data());
  hn::StoreMaskBits(units, open, questions.data());
  for (std::size_t lane = 0; lane < lanes(); ++lane) {
    const auto bit = static_cast<std::uint8_t>(1u << (lane % 8));
    if ((questions[lane / 8] & bit) && !items.near(row, rows[lane]))
      bits[lane / 8] = static_cast<std::uint8_t>(bits[lane / 8] & ~bit);
  }
  return hn::LoadMaskBits(units, bits.data());
}

/// Where lanes go so that interleaving two such vectors gives their first halves, then their second.
HWY_INLINE auto halves_by_blocks() {
  HWY_ALIGN std::array<std::uint32_t, 16> to{};
  for (std::uint32_t i = 0; i < lanes(); ++i)
    to[i] = i / 4 * 2 + i % 2 + (i % 4 < 2 ? 0 : static_cast<std::uint32_t>(lanes()) / 2);
  return hn::SetTableIndices(Rows(), to.data());
}
using Lanes = decltype(halves_by_blocks());

/// The lanes of the mask at the front.
HWY_INLINE hn::Vec<Rows> compress(hn::Vec<Rows> v, Mask mask) {
#if HWY_TARGET == HWY_AVX2 || HWY_TARGET == HWY_SSE4 || HWY_TARGET == HWY_SSSE3
  std::uint8_t bits[8] = {};
  hn::StoreMaskBits(Units(), mask, bits);
  return hn::TableLookupLanes(v, hn::IndicesFromVec(Rows(), hn::LoadU(Rows(), kLanesOfMask[bits[0]].data())));
#else
  return hn::Compress(v, hn::RebindMask(Rows(), mask));
#endif
}

/// Writes a pair for every lane of `near`, and rubbish behind it; the second half only from `spill` pairs on.
HWY_INLINE Pair* append(hn::Vec<Rows> other, Mask near, hn::Vec<Rows> own, Lanes halves, std::size_t spill,
                        Pair* out) {
  const Rows rows;
  static_assert(sizeof(Pair) == 2 * sizeof(std::uint32_t));
  const auto kept = hn::TableLookupLanes(compress(other, near), halves);
  const auto low = hn::Min(kept, own), high = hn::Max(kept, own);
  const std::size_t count = hn::CountTrue(Units(), near);
  auto* const to = reinterpret_cast<std::uint32_t*>(out);
  hn::StoreU(hn::InterleaveLower(rows, low, high), rows, to);
  if (count >= spill) hn::StoreU(hn::InterleaveUpper(rows, low, high), rows, to + lanes());
  return out + count;
}

/// Above this crowd vectors are so full that a branch on whether there is a second half costs more than to
/// write it.
constexpr double kCrowd = 6.0;

/// Tests items against stretches of a grid's order. Lives in the registers of a loop that copies it.
template <Kind kKind>
class Search {
 public:
  Search(const FixedGrid& grid, const Items& items)
      : at_(grid.at()),
        sizes_(grid.sizes()),
        rows_(grid.rows()),
        slack_(grid.slack()),
        spill_(grid.crowd() > kCrowd ? 0 : lanes() / 2 + 1),
        items_(items) {
    const Limits limits = grid.limits(items.same_reach);
    sure_ = hn::Set(Units(), limits.sure);
    far_ = hn::Set(Units(), limits.far);
  }

  /// What may be written for an item that meets at most `candidates` others in `stretches` stretches.
  static std::size_t room(std::size_t candidates, std::size_t stretches) {
    return candidates + stretches * lanes();
  }

  /// Writes the pairs of an item with those of a stretch; or their rows, where higher than its own. Returns
  /// behind the last.
  template <class Out>
  HWY_INLINE Out* meet(const Query& query, std::uint32_t first, std::uint32_t end, std::uint32_t shift,
                       Out* out) const {
    const auto at = hn::BitCast(Halves(), hn::Set(Rows(), shifted(query.at, shift)));
    const auto row = hn::Set(Rows(), query.row);
    const auto step = static_cast<std::uint32_t>(lanes());
    std::uint32_t j = first;
    for (; j + step <= end; j += step) {
      Mask sure, near;
      compare(query.size, at, j, sure, near);
      out = keep(query.row, row, j, sure, near, out);
    }
    if (j >= end) return out;
    Mask sure, near;
    compare(query.size, at, j, sure, near);
    return keep(query.row, row, j, sure, hn::And(near, hn::FirstN(Units(), end - j)), out);
  }

 private:
  HWY_INLINE Pair* keep(std::uint32_t row, hn::Vec<Rows> rows, std::uint32_t j, Mask sure, Mask near,
                        Pair* out) const {
    return append(hn::LoadU(Rows(), rows_ + j), settled(row, j, sure, near), rows, halves_, spill_, out);
  }

  HWY_INLINE std::uint32_t* keep(std::uint32_t row, hn::Vec<Rows> rows, std::uint32_t j, Mask sure, Mask near,
                                 std::uint32_t* out) const {
    const Units units;  // rows are below 2^31
    const auto others = hn::LoadU(Rows(), rows_ + j);
    near = hn::And(near, hn::Gt(hn::BitCast(units, others), hn::BitCast(units, rows)));
    near = settled(row, j, sure, near);
    hn::StoreU(compress(others, near), Rows(), out);
    return out + hn::CountTrue(units, near);
  }

  HWY_INLINE Mask settled(std::uint32_t row, std::uint32_t j, Mask sure, Mask near) const {
    const Mask open = hn::AndNot(sure, near);
    return HWY_UNLIKELY(!hn::AllFalse(Units(), open)) ? settle(items_, row, rows_ + j, near, open) : near;
  }

  /// Which of the items at `j` are surely near, and which may be.
  HWY_INLINE void compare(std::uint32_t own_size, hn::Vec<Halves> own, std::uint32_t j, Mask& sure,
                          Mask& near) const {
    const auto apart = hn::Sub(hn::BitCast(Halves(), hn::LoadU(Rows(), at_ + j)), own);
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
        compare_discs(own_size, squared(apart), hn::BitCast(Units(), sizes), sure, near);
      } else {
        compare_boxes(own_size, apart, hn::BitCast(Halves(), sizes), sure, near);
      }
    }
  }

  HWY_INLINE void compare_discs(std::uint32_t own_size, UnitsV distance, UnitsV sizes, Mask& sure,
                                Mask& near) const {
    const Units units;
    const UnitsV both = hn::Add(sizes, hn::Set(units, static_cast<std::int32_t>(own_size)));
    const UnitsV inner = hn::Max(hn::Sub(both, hn::Set(units, slack_)), hn::Zero(units));
    const UnitsV outer = hn::Add(both, hn::Set(units, slack_));
    sure = hn::Lt(distance, squared(hn::BitCast(Halves(), inner)));
    near = hn::Lt(distance, squared(hn::BitCast(Halves(), outer)));
  }

  /// The other begins within this one's side, or this one within the other's, along both axes.
  HWY_INLINE void compare_boxes(std::uint32_t own_size, hn::Vec<Halves> apart, hn::Vec<Halves> sizes,
                                Mask& sure, Mask& near) const {
    const Halves halves;
    const auto own = hn::BitCast(halves, hn::Set(Rows(), own_size));
    const auto room = hn::Min(hn::SaturatedSub(own, apart), hn::SaturatedAdd(sizes, apart));
    const auto slack = hn::Set(halves, static_cast<std::int16_t>(slack_));
    sure = both_halves(hn::Lt(slack, room));
    near = both_halves(hn::Lt(hn::Neg(slack), room));
  }

  HWY_INLINE static Mask both_halves(hn::Mask<Halves> mask) {
    const Units units;
    return hn::Eq(hn::BitCast(units, hn::VecFromMask(Halves(), mask)), hn::Set(units, -1));
  }

  const std::uint32_t *at_, *sizes_, *rows_;
  const std::int32_t slack_;
  const std::size_t spill_;
  const Items& items_;
  UnitsV sure_, far_;
  const Lanes halves_ = halves_by_blocks();
};

#endif

}  // namespace
}  // namespace throng::broadphase::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
