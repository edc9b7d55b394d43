// SPDX-License-Identifier: MIT
// What several agents are in doubt by: the numbers that throng::Random draws for each, at once. Included once
// for each width.
#if defined(THRONG_CROWD_DOUBT_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef THRONG_CROWD_DOUBT_INL
#undef THRONG_CROWD_DOUBT_INL
#else
#define THRONG_CROWD_DOUBT_INL
#endif

#include <hwy/highway.h>

#include <cstdint>
#include <span>

#include "sim/crowd/model.h"
#include "sim/crowd/near-inl.h"
#include "sim/random.h"

HWY_BEFORE_NAMESPACE();
namespace throng::HWY_NAMESPACE {

using Bits = hn::RebindToUnsigned<Wide>;
using WideBits = hn::Vec<Bits>;

/// Numbers of several agents.
struct Doubts {
  double x[kTogether + kWide], y[kTogether + kWide];
};

/// The products of the low halves of all.
template <class Numbers>
HWY_INLINE Numbers low_product(Numbers a, std::uint32_t b) {
  if constexpr (kWide == 1) {
    return hn::Set(Bits(), (hn::GetLane(a) & 0xFFFFFFFF) * b);
  } else {
    const hn::Repartition<std::uint32_t, hn::DFromV<Numbers>> halves;
    return hn::MulEven(hn::BitCast(halves, a), hn::Set(halves, b));
  }
}

/// As throng::philox; the upper halves of the numbers mean nothing.
struct Counters {
  WideBits c[4];

  HWY_INLINE void encipher(std::uint64_t key) {
    const Bits d;
    auto low = static_cast<std::uint32_t>(key), high = static_cast<std::uint32_t>(key >> 32);
    for (int round = 0; round < 10; ++round) {
      const WideBits a = low_product(c[0], 0xD2511F53), b = low_product(c[2], 0xCD9E8D57);
      c[0] = hn::Xor(hn::Xor(hn::ShiftRight<32>(b), c[1]), hn::Set(d, low));
      c[2] = hn::Xor(hn::Xor(hn::ShiftRight<32>(a), c[3]), hn::Set(d, high));
      c[1] = b, c[3] = a;
      low += 0x9E3779B9, high += 0xBB67AE85;
    }
  }
};

/// Numbers below 2^52. Exact.
HWY_INLINE WideReals real(WideBits x) {
  const Wide d;
  const WideReals whole = hn::Set(d, 0x1p52);
  return hn::Sub(hn::BitCast(d, hn::Or(x, hn::BitCast(Bits(), whole))), whole);
}

/// As Random::uniform(-most, most) of the 64 bits `high`, `low`, of which the first 53 count.
HWY_INLINE WideReals uniform(WideBits high, WideBits low, double most) {
  const Wide d;
  const WideBits half = hn::Set(Bits(), 0xFFFFFFFF);
  const WideReals counted = hn::Add(hn::Mul(real(hn::And(high, half)), hn::Set(d, 0x1p21)),
                                    real(hn::ShiftRight<11>(hn::And(low, half))));
  const WideReals unit = hn::Mul(counted, hn::Set(d, 0x1p-53)), least = hn::Set(d, -most);
  const WideReals drawn = hn::Add(least, hn::Mul(hn::Set(d, most - -most), unit));
  return hn::Min(hn::Max(drawn, least), hn::Set(d, most));
}

/// The first two numbers of (seed, step, id, Purpose::doubt) of each of at most kTogether agents, both
/// uniform on [-most, most].
HWY_INLINE void draw_doubts(const CrowdView& crowd, std::span<const std::uint32_t> some, double most,
                            Doubts& doubts) {
  const Wide d;
  const Bits bits;
  const auto step = static_cast<std::uint64_t>(crowd.step);
  const std::uint64_t late = step >> 32 | static_cast<std::uint64_t>(Purpose::doubt) << 24;
  for (std::size_t i = 0; i < some.size(); ++i) doubts.x[i] = crowd.id[some[i]];
  for (std::size_t i = some.size(); i < some.size() + kWide; ++i) doubts.x[i] = 0.0;
  for (std::size_t i = 0; i < some.size(); i += kWide) {
    const WideReals id = hn::Add(hn::LoadU(d, doubts.x + i), hn::Set(d, 0x1p52));  // in the low half
    Counters counters{{hn::Zero(bits), hn::BitCast(bits, id), hn::Set(bits, step), hn::Set(bits, late)}};
    counters.encipher(crowd.seed);
    hn::StoreU(uniform(counters.c[0], counters.c[1], most), d, doubts.x + i);
    hn::StoreU(uniform(counters.c[2], counters.c[3], most), d, doubts.y + i);
  }
}

}  // namespace throng::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
