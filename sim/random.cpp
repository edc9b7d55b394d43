// SPDX-License-Identifier: MIT
#include "sim/random.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace throng {

std::array<std::uint32_t, 4> philox(std::array<std::uint32_t, 4> counter, std::array<std::uint32_t, 2> key) {
  for (int round = 0; round < 10; ++round) {
    const std::uint64_t a = std::uint64_t{0xD2511F53} * counter[0];
    const std::uint64_t b = std::uint64_t{0xCD9E8D57} * counter[2];
    counter = {static_cast<std::uint32_t>(b >> 32) ^ counter[1] ^ key[0], static_cast<std::uint32_t>(b),
               static_cast<std::uint32_t>(a >> 32) ^ counter[3] ^ key[1], static_cast<std::uint32_t>(a)};
    key[0] += 0x9E3779B9;
    key[1] += 0xBB67AE85;
  }
  return counter;
}

Random::Random(std::uint64_t seed, std::uint64_t step, std::uint32_t id, Purpose purpose)
    : counter_{0, id, static_cast<std::uint32_t>(step),
               static_cast<std::uint32_t>(step >> 32) | (static_cast<std::uint32_t>(purpose) << 24)},
      key_{static_cast<std::uint32_t>(seed), static_cast<std::uint32_t>(seed >> 32)} {}

std::uint64_t Random::next() {
  half_left_ = !half_left_;
  if (!half_left_) return std::uint64_t{block_[2]} << 32 | block_[3];
  block_ = philox(counter_, key_);
  ++counter_[0];
  return std::uint64_t{block_[0]} << 32 | block_[1];
}

double Random::uniform() {
  return static_cast<double>(next() >> 11) * 0x1p-53;
}

double Random::uniform(double low, double high) {
  return std::clamp(low + (high - low) * uniform(), low, high);
}

double Random::normal() {
  for (;;) {
    const double x = uniform(-1.0, 1.0);
    const double y = uniform(-1.0, 1.0);
    const double s = x * x + y * y;
    if (s > 0.0 && s < 1.0) return x * std::sqrt(-2.0 * logarithm(s) / s);
  }
}

double logarithm(double x) {
  // x = m 2^e with m in [sqrt(1/2), sqrt(2)); log m = 2 artanh(z), z = (m - 1) / (m + 1), |z| < 0.1716.
  constexpr double kLn2High = 0x1.62e42fee00000p-1, kLn2Low = 0x1.a39ef35793c76p-33;
  const auto bits = std::bit_cast<std::uint64_t>(x);
  int exponent = static_cast<int>(bits >> 52) - 1023;
  double m = std::bit_cast<double>((bits & 0xFFFFFFFFFFFFFULL) | 0x3FF0000000000000ULL);
  if (m > 1.4142135623730951) m *= 0.5, ++exponent;
  const double z = (m - 1.0) / (m + 1.0), z2 = z * z;
  double series = 0.0;
  for (int k = 21; k >= 3; k -= 2) series = (series + 1.0 / k) * z2;
  return exponent * kLn2High + (2.0 * z + (2.0 * z * series + exponent * kLn2Low));
}

}  // namespace throng
