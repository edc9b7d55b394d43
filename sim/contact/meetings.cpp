// SPDX-License-Identifier: MIT
#include "sim/contact/meetings.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "sim/contact/meetings.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <algorithm>

#include "sim/contact/lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace throng::HWY_NAMESPACE {
namespace {

constexpr std::size_t kPairsAhead = 16;  // so long before it is needed a pair's second disc is asked for

/// The rows of eight pairs, a lane each.
struct Rows8 {
  std::uint32_t a[kMeetingsWide], b[kMeetingsWide];
};

HWY_INLINE Rows8 rows_of(const broadphase::Pair* pairs) {
  Rows8 rows;
  for (std::size_t k = 0; k < kMeetingsWide; ++k) rows.a[k] = pairs[k].a, rows.b[k] = pairs[k].b;
  return rows;
}

/// As disc_flight(), which takes no root of those left out.
HWY_INLINE Mask may_meet(const Four& a, const Four& b, Reals reach, const MeetingsAsked& asked) {
  const D d;
  const Reals zero = hn::Zero(d);
  Reals x = hn::Sub(b.first, a.first), y = hn::Sub(b.second, a.second);
  if (asked.period) x = nearest(x, asked.period->x()), y = nearest(y, asked.period->y());
  const Reals vx = hn::Sub(b.third, a.third), vy = hn::Sub(b.fourth, a.fourth);
  const Reals excess = hn::Sub(dot(x, y, x, y), hn::Mul(reach, reach));
  const Reals nearing = hn::Neg(dot(x, y, vx, vy));
  const Reals soonest = hn::Mul(hn::Mul(hn::Set(d, 2.0), nearing), hn::Set(d, asked.until));
  const Reals discriminant = hn::Sub(hn::Mul(nearing, nearing), hn::Mul(dot(vx, vy, vx, vy), excess));
  const Mask meets =
      hn::And(hn::And(hn::Gt(nearing, zero), hn::Le(excess, soonest)), hn::Ge(discriminant, zero));
  return hn::Or(meets, hn::Lt(excess, zero));
}

HWY_INLINE unsigned eight(const broadphase::Pair* pairs, const double* reach, const MeetingsAsked& asked) {
  const Rows8 rows = rows_of(pairs);
  const double* const numbers = asked.discs[0].position.data();
  unsigned found = 0;
  for (std::size_t k = 0; k < kMeetingsWide; k += kLanes) {
    const Mask may = may_meet(gather<4>(numbers, rows.a + k), gather<4>(numbers, rows.b + k),
                              hn::LoadU(D(), reach + k), asked);
    std::uint8_t bits[8] = {};
    hn::StoreMaskBits(D(), may, bits);
    found |= static_cast<unsigned>(bits[0]) << k;
  }
  return found;
}

/// Where fewer than eight are left.
HWY_INLINE unsigned last(std::size_t first, const MeetingsAsked& asked) {
  const std::size_t count = asked.pairs.size() - first;
  broadphase::Pair pairs[kMeetingsWide];
  double reach[kMeetingsWide];
  for (std::size_t k = 0; k < kMeetingsWide; ++k) {
    const std::size_t i = first + std::min(k, count - 1);
    pairs[k] = asked.pairs[i], reach[k] = asked.reach[i];
  }
  return eight(pairs, reach, asked) & ((1u << count) - 1u);
}

void find_meetings(const MeetingsAsked& asked, std::size_t begin, std::size_t end, std::uint8_t* found) {
  const std::size_t n = asked.pairs.size();
  for (std::size_t i = begin; i < end; ++i) {
    const std::size_t first = i * kMeetingsWide;
    if (first + kMeetingsWide > n) {
      found[i] = static_cast<std::uint8_t>(last(first, asked));
      continue;
    }
    if (first + kPairsAhead + kMeetingsWide <= n)
      for (std::size_t k = 0; k < kMeetingsWide; ++k)
        hwy::Prefetch(&asked.discs[asked.pairs[first + kPairsAhead + k].b]);
    found[i] = static_cast<std::uint8_t>(eight(&asked.pairs[first], &asked.reach[first], asked));
  }
}

}  // namespace
}  // namespace throng::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace throng {

namespace {
HWY_EXPORT(find_meetings);
}  // namespace

void find_meetings(const MeetingsAsked& asked, std::size_t begin, std::size_t end, std::uint8_t* found) {
  HWY_DYNAMIC_DISPATCH(find_meetings)(asked, begin, end, found);
}

}  // namespace throng
#endif
