// SPDX-License-Identifier: MIT
// Who of those near an agent are the nearest few. Included once for each width.
#if defined(THRONG_CROWD_NEAREST_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef THRONG_CROWD_NEAREST_INL
#undef THRONG_CROWD_NEAREST_INL
#else
#define THRONG_CROWD_NEAREST_INL
#endif

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "sim/crowd/near-inl.h"

HWY_BEFORE_NAMESPACE();
namespace throng::HWY_NAMESPACE {

/// How far is looked for the nearest `most` before looking as far as `reach` (m): a seventh farther than the
/// agents before, who stood near, had to. It decides speed, never who is found.
class Outlook {
 public:
  Outlook(double reach, std::size_t most) : most_(most), reach_(reach), first_(0.25 * reach) {}

  /// Adds all who may be of the agent's nearest.
  HWY_INLINE Near add_nearest(const CrowdView& crowd, std::uint32_t own, Others& others) const {
    for (double far = first_;; far = std::min(2.0 * far, reach_)) {
      const Near near = others.add_near<Tell::who>(crowd, own, far);
      if (near.size >= most_ || far >= reach_) return near;
      others.drop();
    }
  }

  /// The mean of squares (m²) of how far away the last of the nearest was, or of `reach` where there are
  /// fewer.
  void learn(double square) { first_ = std::clamp(kMargin * std::sqrt(square), reach_ / 16.0, reach_); }

 private:
  static constexpr double kMargin = 1.15;

  std::size_t most_;
  double reach_, first_;
};

/// Some in the order of how near they are.
struct Ranks {
  std::vector<double> square;        // m², of all
  std::vector<std::int64_t> rank;    // of all: how many are nearer, or as near and before him
  std::vector<std::uint32_t> order;  // of the nearest ones: which of all they are, and a place to waste

  void make_room(std::size_t all, std::size_t most) {
    if (rank.size() < all + kWide) rank.resize(all + kWide), square.resize(all + kWide);
    if (order.size() <= most) order.resize(most + 1);
  }
};

/// Adds 1 where that is so.
template <class Counts>
HWY_INLINE Counts counted(Counts counts, WideMask is) {
  const hn::RebindToSigned<Wide> whole;
#if HWY_TARGET == HWY_AVX3  // which adds under a mask
  return hn::IfThenElse(hn::RebindMask(whole, is), hn::Add(counts, hn::Set(whole, 1)), counts);
#else
  return hn::Sub(counts, hn::BitCast(whole, hn::VecFromMask(Wide(), is)));
#endif
}

/// Behind the last one some who are farther than all fill up a vector. Returns where that ends.
HWY_INLINE std::size_t rank_all(const Others& others, const Near& near, Ranks& ranks) {
  const Wide d;
  const hn::RebindToSigned<Wide> whole;
  const std::size_t end = (near.size + kWide - 1) / kWide * kWide;
  double* const square = ranks.square.data();
  const auto farther = hn::Set(d, std::numeric_limits<double>::infinity());
  for (std::size_t k = 0; k < end; k += kWide)
    hn::StoreU(hn::IfThenElse(hn::FirstN(d, near.size - k), others.square(near.first + k), farther), d,
               square + k);
  const auto in_vector = hn::Iota(d, 0.0);
  for (std::size_t k = 0; k < end; k += kWide) {
    const auto own = hn::LoadU(d, square + k);
    auto rank = hn::Zero(whole);
    const auto count = [&](WideMask is) HWY_ATTR { rank = counted(rank, is); };
    for (std::size_t j = 0; j < k; j += kWide)
      for (std::size_t i = 0; i < kWide; ++i) count(hn::Le(hn::Set(d, square[j + i]), own));
    for (std::size_t i = 0; i < kWide; ++i) {
      const auto other = hn::Set(d, square[k + i]), before = hn::Set(d, static_cast<double>(i));
      count(hn::Or(hn::Lt(other, own), hn::And(hn::Eq(other, own), hn::Lt(before, in_vector))));
    }
    for (std::size_t j = k + kWide; j < end; j += kWide)
      for (std::size_t i = 0; i < kWide; ++i) count(hn::Lt(hn::Set(d, square[j + i]), own));
    hn::StoreU(rank, whole, ranks.rank.data() + k);
  }
  return end;
}

/// Orders the nearest `most`. O(all^2), eight at a time.
HWY_INLINE void order_nearest(const Others& others, const Near& near, std::size_t most, Ranks& ranks) {
  ranks.make_room(near.size, most);
  const std::size_t end = rank_all(others, near, ranks);
  const std::int64_t* const rank = ranks.rank.data();
  std::uint32_t* const order = ranks.order.data();
  for (std::uint32_t k = 0; k < end; ++k) order[std::min(static_cast<std::size_t>(rank[k]), most)] = k;
}

}  // namespace throng::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
