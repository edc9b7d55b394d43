// SPDX-License-Identifier: MIT
// Sorts short lists of rows in vectors: the bitonic network (Batcher, "Sorting networks and their
// applications", 1968), each step of which is a minimum and a maximum of vectors and no branch.
#if defined(THRONG_ROW_NETWORK_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef THRONG_ROW_NETWORK_INL
#undef THRONG_ROW_NETWORK_INL
#else
#define THRONG_ROW_NETWORK_INL
#endif

#include <hwy/highway.h>

#include <algorithm>
#include <array>
#include <bit>
#include <utility>

#include "broadphase/higher_rows.h"

HWY_BEFORE_NAMESPACE();
namespace throng::broadphase::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

constexpr std::size_t kTogether = 4;  // rows: one's steps fill the time that another's take

#if HWY_TARGET != HWY_SCALAR

class RowNetwork {
  using D = hn::CappedTag<std::uint32_t, 16>;
  using V = hn::Vec<D>;
  using Mask = hn::Mask<D>;
  using Indices = decltype(hn::SetTableIndices(D(), static_cast<const std::uint32_t*>(nullptr)));

 public:
  static constexpr std::uint32_t kLanes = hn::MaxLanes(D());
  static constexpr std::size_t kVectors = 8;
  static constexpr std::uint32_t kMost = kVectors * kLanes;  ///< rows of a list

  RowNetwork() {
    const V lane = hn::Iota(D(), 0);
    for (int bit = 0; bit < kBits; ++bit) {
      near_[bit] = indices([bit](std::uint32_t i) { return i ^ (1u << bit); });
      mirror_[bit] = indices([bit](std::uint32_t i) { return i ^ ((2u << bit) - 1); });
      low_[bit] = hn::Eq(hn::And(lane, hn::Set(D(), 1u << bit)), hn::Zero(D()));
    }
    halves_ = indices([](std::uint32_t i) { return i / 4 * 2 + i % 2 + (i % 4 < 2 ? 0 : kLanes / 2); });
  }

  /// Writes the pairs of kTogether rows from `row` on, ascending, and rubbish behind: up to kMost pairs may
  /// be written, and as many rows read. Returns behind the last; expects lists of at most kLanes.
  HWY_INLINE Pair* write_short(std::size_t row, const HigherRows::List* lists, std::uint32_t longest,
                               const std::uint32_t* rows, Pair* out) const {
    if (longest <= 4) return write_short<2>(row, lists, rows, out);
    if constexpr (kBits > 3)
      if (longest <= 8) return write_short<3>(row, lists, rows, out);
    return write_short<kBits>(row, lists, rows, out);
  }

  /// The same for one row of at most kMost.
  HWY_INLINE void write(std::uint32_t row, const std::uint32_t* list, std::uint32_t count, Pair* out) const {
    write_vectors<1>(row, list, count, out);
  }

 private:
  static constexpr int kBits = std::countr_zero(kLanes);

  template <class F>
  static HWY_INLINE Indices indices(F to_lane) {
    HWY_ALIGN std::array<std::uint32_t, kLanes> to;
    for (std::uint32_t i = 0; i < kLanes; ++i) to[i] = to_lane(i);
    return hn::SetTableIndices(D(), to.data());
  }

  /// The first `count` rows, and behind them what is higher than any.
  static HWY_INLINE V load(const std::uint32_t* list, std::size_t count) {
    return hn::IfThenElse(hn::FirstN(D(), count), hn::LoadU(D(), list), hn::Set(D(), 0xffffffff));
  }

  /// Lists of at most 2^kSorted, of one vector.
  template <int kSorted>
  HWY_INLINE Pair* write_short(std::size_t row, const HigherRows::List* lists, const std::uint32_t* rows,
                               Pair* out) const {
    V v[kTogether];
    for (std::size_t i = 0; i < kTogether; ++i) v[i] = load(rows + lists[i].begin, lists[i].count);
    sort<kSorted, kTogether>(v);
    for (std::size_t i = 0; i < kTogether; ++i) {
      store<(1u << kSorted) <= kLanes / 2>(static_cast<std::uint32_t>(row + i), v[i], out);
      out += lists[i].count;
    }
    return out;
  }

  template <std::size_t kCount>
  HWY_INLINE void write_vectors(std::uint32_t row, const std::uint32_t* list, std::uint32_t count,
                                Pair* out) const {
    if constexpr (kCount < kVectors)
      if (count > kCount * kLanes) return write_vectors<2 * kCount>(row, list, count, out);
    V v[kCount];
    for (std::uint32_t i = 0; i < kCount; ++i)
      v[i] = load(list + i * kLanes, std::max(count, i * kLanes) - i * kLanes);
    sort<kBits, kCount>(v);
    join<1, kCount>(v);
    for (std::size_t i = 0; i < kCount; ++i) store<false>(row, v[i], out + i * kLanes);
  }

  template <bool kLowerHalf>
  HWY_INLINE void store(std::uint32_t row, V v, Pair* out) const {
    static_assert(sizeof(Pair) == 2 * sizeof(std::uint32_t));
    const D d;
    const V own = hn::Set(d, row), higher = hn::TableLookupLanes(v, halves_);
    auto* const to = reinterpret_cast<std::uint32_t*>(out);
    hn::StoreU(hn::InterleaveLower(d, own, higher), d, to);
    if constexpr (!kLowerHalf) hn::StoreU(hn::InterleaveUpper(d, own, higher), d, to + kLanes);
  }

  /// Merges sorted runs of kSorted vectors until all are one.
  template <std::size_t kSorted, std::size_t kCount>
  HWY_INLINE void join(V* v) const {
    if constexpr (kSorted < kCount) {
      for (std::size_t i = 0; i < kCount; ++i)
        if (i & kSorted) v[i] = hn::TableLookupLanes(v[i], mirror_[kBits - 1]);
      for (std::size_t i = 0; i < kCount; i += 2 * kSorted)
        for (std::size_t k = 0; k < kSorted / 2; ++k)
          std::swap(v[i + kSorted + k], v[i + 2 * kSorted - 1 - k]);
      merge_vectors<kSorted, kCount>(v);
      join<2 * kSorted, kCount>(v);
    }
  }

  /// Sorts each bitonic run of 2 kApart vectors.
  template <std::size_t kApart, std::size_t kCount>
  HWY_INLINE void merge_vectors(V* v) const {
    if constexpr (kApart > 0) {
      for (std::size_t i = 0; i < kCount; ++i) {
        if (i & kApart) continue;
        const V low = hn::Min(v[i], v[i + kApart]);
        v[i + kApart] = hn::Max(v[i], v[i + kApart]);
        v[i] = low;
      }
      merge_vectors<kApart / 2, kCount>(v);
    } else {
      merge<kBits, kCount>(v);
    }
  }

  /// Sorts each 2^kSorted lanes of kCount vectors: each step for all of them, since one must wait for the one
  /// before it.
  template <int kSorted, std::size_t kCount>
  HWY_INLINE void sort(V* v) const {
    if constexpr (kSorted > 0) {
      sort<kSorted - 1, kCount>(v);
      for (std::size_t i = 0; i < kCount; ++i) v[i] = exchange<kSorted - 1>(v[i], mirrored<kSorted>(v[i]));
      merge<kSorted - 1, kCount>(v);
    }
  }
  template <int kSorted, std::size_t kCount>
  HWY_INLINE void merge(V* v) const {
    if constexpr (kSorted > 0) {
      for (std::size_t i = 0; i < kCount; ++i) v[i] = exchange<kSorted - 1>(v[i], across<kSorted - 1>(v[i]));
      merge<kSorted - 1, kCount>(v);
    }
  }

  /// The lower of two goes where the bit is 0.
  template <int kBit>
  HWY_INLINE V exchange(V v, V other) const {
    return hn::IfThenElse(low_[kBit], hn::Min(v, other), hn::Max(v, other));
  }
  /// Of each lane the one whose number differs in a bit, or in all of the lowest kCount.
  template <int kBit>
  HWY_INLINE V across(V v) const {
    if constexpr (kBit == 0) return hn::Shuffle2301(v);
    if constexpr (kBit == 1) return hn::Shuffle1032(v);
    return hn::TableLookupLanes(v, near_[kBit]);
  }
  template <int kCount>
  HWY_INLINE V mirrored(V v) const {
    if constexpr (kCount == 1) return hn::Shuffle2301(v);
    if constexpr (kCount == 2) return hn::Shuffle0123(v);
    return hn::TableLookupLanes(v, mirror_[kCount - 1]);
  }

  Indices near_[kBits], mirror_[kBits], halves_;
  Mask low_[kBits];
};

#else

/// Without vectors the library sorts.
struct RowNetwork {
  static constexpr std::uint32_t kLanes = 0, kMost = 0;
  Pair* write_short(std::size_t, const HigherRows::List*, std::uint32_t, const std::uint32_t*,
                    Pair* out) const {
    return out;
  }
  void write(std::uint32_t, const std::uint32_t*, std::uint32_t, Pair*) const {}
};

#endif

}  // namespace
}  // namespace throng::broadphase::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
