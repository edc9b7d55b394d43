// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>

/// Static checks at sampled instants of a motion: what planners and engines do, as a baseline for what throng
/// proves. It misses contacts shorter than its spacing.
namespace throng::narrowphase {

enum class SampleOrder {
  sequential,  ///< from the start: the first hit found is the earliest that the samples know
  bisection    ///< the ends, the middle, the quarters, ...: of a long hit some sample comes soon (van der
               ///< Corput)
};

struct SampledAnswer {
  bool hit;     ///< at a sample; otherwise nothing is known between them
  double time;  ///< s, of that sample
  int samples;  ///< asked
};

/// How many equal steps of `duration` keep what moves at `rate` (m/s) within `spacing` (m) from sample to
/// sample. At least 1, at most 2^30.
inline std::uint32_t sample_steps(double rate, double duration, double spacing) {
  constexpr double kMost = 0x1p30;
  const double steps = std::ceil(rate * duration / spacing);
  return steps >= 1.0 ? static_cast<std::uint32_t>(std::min(steps, kMost)) : 1;
}

/// The bits of `i`, the last first, of as many as it takes to count to `count`.
inline std::uint32_t reversed_bits(std::uint32_t i, std::uint32_t count) {
  std::uint32_t reversed = 0;
  for (; count > 0; count >>= 1, i >>= 1) reversed = reversed << 1 | (i & 1U);
  return reversed;
}

/// Asks `hits(time)` at the ends of all `steps` equal steps, both ends included, until it says true. O(steps)
/// in sequence, O(2 steps) at most by bisection; allocates nothing.
template <class Hits>
SampledAnswer sampled(double duration, std::uint32_t steps, SampleOrder order, Hits hits) {
  int samples = 0;
  const auto ask = [&](std::uint32_t i) {
    ++samples;
    return hits(duration * (static_cast<double>(i) / steps));
  };
  const auto found = [&](std::uint32_t i) {
    return SampledAnswer{true, duration * (static_cast<double>(i) / steps), samples};
  };
  if (order == SampleOrder::sequential) {
    for (std::uint32_t i = 0; i <= steps; ++i)
      if (ask(i)) return found(i);
    return {false, duration, samples};
  }
  if (ask(0)) return found(0);
  if (ask(steps)) return found(steps);
  const std::uint32_t inner = steps - 1;  // numbered from 1
  for (std::uint32_t i = 1, all = std::bit_ceil(steps); i < all; ++i)
    if (const std::uint32_t at = reversed_bits(i, all - 1); at <= inner && at > 0 && ask(at))
      return found(at);
  return {false, duration, samples};
}

}  // namespace throng::narrowphase
