// SPDX-License-Identifier: MIT
// Answers as a search meets them, and how each list is brought into order; see proximity_search-inl.h.
#if defined(THRONG_PROXIMITY_KEEP_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef THRONG_PROXIMITY_KEEP_INL
#undef THRONG_PROXIMITY_KEEP_INL
#else
#define THRONG_PROXIMITY_KEEP_INL
#endif

#include <algorithm>
#include <array>
#include <bit>
#include <limits>

#include "broadphase/best_few.h"
#include "broadphase/lanes_of_mask.h"
#include "broadphase/proximity_search.h"
#include "broadphase/proximity_space-inl.h"

HWY_BEFORE_NAMESPACE();
namespace throng::broadphase::HWY_NAMESPACE {

constexpr std::size_t kFewToRank = 128;  // counting is quadratic

/// Writes what `mask` says to `key` and `who`, and rubbish up to a vector behind it; returns how many.
HWY_INLINE std::size_t keep(Mask mask, Reals keys, Rows rows, double* key, std::uint64_t* who) {
  std::uint8_t bits[8] = {};
  hn::StoreMaskBits(D(), mask, bits);
  const hn::Rebind<std::uint32_t, U> narrow;
  const Rows lanes = hn::PromoteTo(U(), hn::LoadU(narrow, kLanesOfMask[bits[0]].data()));
  hn::StoreU(hn::TableLookupLanes(keys, hn::IndicesFromVec(D(), lanes)), D(), key);
  hn::StoreU(hn::TableLookupLanes(rows, hn::IndicesFromVec(U(), lanes)), U(), who);
  return static_cast<std::size_t>(std::popcount(bits[0]));
}

/// Makes room for `count` answers before they are in order, and a vector behind them.
inline void make_room(std::size_t count, Answers& answers) {
  if (count + 2 * kLanes <= answers.key.size()) return;
  answers.key.resize(2 * count + 64);
  answers.who.resize(2 * count + 64);
}

/// Keeps all, as met, until they are `most` or more: then it looks for no others.
struct KeepAll {
  static constexpr std::size_t kAny = std::numeric_limits<std::size_t>::max();

  bool full() const { return count >= most; }
  double limit() const { return full() ? -std::numeric_limits<double>::infinity() : limit_; }
  HWY_INLINE void take(Mask mask, Reals key, Rows rows) {
    make_room(count, answers);
    count += keep(mask, key, rows, answers.key.data() + count, answers.who.data() + count);
  }
  double limit_;
  Answers& answers;
  std::size_t most = kAny;
  std::size_t count = 0;
};

/// Writes at most kFewToRank answers in order of their distances, by counting for each how many come before
/// it: no branch depends on them. They are compared as floats: where two are equal as such, returns false,
/// and what was written is to be written again. Reads up to a vector behind `distance`.
HWY_INLINE bool write_ranked(std::size_t count, const double* distance, const std::uint64_t* who,
                             std::uint32_t* row_out, double* distance_out) {
  using F = hn::ScalableTag<float>;
  using I = hn::RebindToSigned<F>;
  const std::size_t lanes = hn::Lanes(F());
  alignas(64) float key[kFewToRank + hn::MaxLanes(F())];
  alignas(64) std::int32_t rank[kFewToRank + hn::MaxLanes(F())];
  for (std::size_t i = 0; i < count; i += kLanes) {
    const hn::Rebind<float, D> narrow;
    hn::StoreU(hn::DemoteTo(narrow, hn::LoadU(D(), distance + i)), narrow, key + i);
  }
  for (std::size_t i = 0; i < count; i += lanes) {
    const auto own = hn::Load(F(), key + i);
    auto before = hn::Zero(I());
    for (std::size_t j = 0; j < count; ++j)
      before = hn::Sub(before, hn::VecFromMask(I(), hn::RebindMask(I(), hn::Lt(hn::Set(F(), key[j]), own))));
    hn::Store(before, I(), rank + i);
  }
  std::size_t sum = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const auto place = static_cast<std::size_t>(rank[i]);
    row_out[place] = static_cast<std::uint32_t>(who[i]);
    distance_out[place] = distance[i];
    sum += place;
  }
  return sum == count * (count - 1) / 2;  // less where ranks are shared
}

inline void reserve(Answers& answers, std::size_t more) {
  if (answers.size + more <= answers.row.size()) return;
  answers.row.resize(2 * (answers.size + more));
  answers.distance.resize(2 * (answers.size + more));
}

inline void append(const Neighbour* list, std::size_t count, Answers& answers) {
  reserve(answers, count);
  for (std::size_t i = 0; i < count; ++i) {
    answers.row[answers.size + i] = list[i].row;
    answers.distance[answers.size + i] = list[i].distance;
  }
  answers.size += count;
}

/// Writes the first `count` kept answers in order of (distance, row). Their keys are squares of distances, or
/// distances.
template <bool kSquares>
HWY_INLINE void write_sorted(std::size_t count, Answers& answers, std::uint32_t* row, double* distance) {
  double* const keys = answers.key.data();
  if constexpr (kSquares)
    for (std::size_t i = 0; i < count; i += kLanes)
      hn::StoreU(hn::Sqrt(hn::LoadU(D(), keys + i)), D(), keys + i);
  if (count <= kFewToRank && write_ranked(count, keys, answers.who.data(), row, distance)) return;
  std::vector<Neighbour>& list = answers.best;
  list.resize(std::max(list.size(), count));
  for (std::size_t i = 0; i < count; ++i) list[i] = {static_cast<std::uint32_t>(answers.who[i]), keys[i]};
  std::sort(list.begin(), list.begin() + static_cast<std::ptrdiff_t>(count), nearer);
  for (std::size_t i = 0; i < count; ++i) {
    row[i] = list[i].row;
    distance[i] = list[i].distance;
  }
}

/// Appends them.
template <bool kSquares>
HWY_INLINE void append_sorted(std::size_t count, Answers& answers) {
  reserve(answers, count);
  write_sorted<kSquares>(count, answers, answers.row.data() + answers.size,
                         answers.distance.data() + answers.size);
  answers.size += count;
}

}  // namespace throng::broadphase::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
