// SPDX-License-Identifier: MIT
#include "narrowphase/trigonometry.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <utility>

namespace throng::narrowphase {

namespace {

constexpr double kHalfPi = 0x1.921fb54442d18p+0;
constexpr double kTwoOverPi = 0x1.45f306dc9c883p-1;

/// An angle as quarter * pi/2 + (high + low), |high| at most a little above pi/4.
struct Reduced {
  std::uint64_t quarter;  // modulo 4
  double high, low;
};

/// The nearest integer, ties to even: adding 1.5 * 2^52 leaves no bits for a fraction. Expects |x| < 2^51.
double nearest_integer(double x) {
  return (x + 0x1.8p52) - 0x1.8p52;
}

/// Expects |angle| <= 2^30. pi/2 in parts of 23 bits, so that their products with the count of quarters are
/// exact.
Reduced reduce(double angle) {
  const double quarters = nearest_integer(angle * kTwoOverPi);
  const double first = angle - quarters * 0x1.921fb4p+0;
  const double second = first - quarters * 0x1.4442dp-24;
  const double second_error = (first - second) - quarters * 0x1.4442dp-24;
  const double third = quarters * 0x1.846988p-48;
  const double rest = second_error - quarters * 0x1.8cc51701b839ap-72;
  const double high = second - third;
  const double low = ((second - high) - third) + rest;
  const double sum = high + low;
  return {static_cast<std::uint64_t>(static_cast<std::int64_t>(quarters)), sum, (high - sum) + low};
}

/// The first 1216 bits of 2 / pi.
constexpr std::array<std::uint64_t, 19> kTwoOverPiBits = {
    0xa2f9836e4e441529ULL, 0xfc2757d1f534ddc0ULL, 0xdb6295993c439041ULL, 0xfe5163abdebbc561ULL,
    0xb7246e3a424dd2e0ULL, 0x06492eea09d1921cULL, 0xfe1deb1cb129a73eULL, 0xe88235f52ebb4484ULL,
    0xe99c7026b45f7e41ULL, 0x3991d639835339f4ULL, 0x9c845f8bbdf9283bULL, 0x1ff897ffde05980fULL,
    0xef2f118b5a0a6d1fULL, 0x6d367ecf27cb09b7ULL, 0x4f463f669e5fea2dULL, 0x7527bac7ebe5f17bULL,
    0x3d0739f78a5292eaULL, 0x6bfb5fb11f8d5d08ULL, 0x56033046fc7b6babULL};

/// 64 bits of 2 / pi behind its first `skip` ones; zeros before the first and behind the last.
std::uint64_t two_over_pi(int skip) {
  const auto word = [](int i) { return i < 0 || i >= 19 ? 0 : kTwoOverPiBits[static_cast<std::size_t>(i)]; };
  const int shifted = skip + 64, index = shifted / 64 - 1, offset = shifted % 64;
  return offset == 0 ? word(index) : word(index) << offset | word(index + 1) >> (64 - offset);
}

/// Expects 2^30 < angle < infinity. Multiplies by 192 bits of 2 / pi, those before them being whole turns.
Reduced reduce_large(double angle) {
  using Wide = unsigned __int128;
  int exponent = 0;
  const auto mantissa = static_cast<std::uint64_t>(std::frexp(angle, &exponent) * 0x1p53);
  const int skip = exponent - 53 - 2;
  const Wide low = Wide{mantissa} * two_over_pi(skip + 128);
  const Wide middle = Wide{mantissa} * two_over_pi(skip + 64) + (low >> 64);
  const std::uint64_t top = mantissa * two_over_pi(skip) + static_cast<std::uint64_t>(middle >> 64);
  const Wide turns = Wide{top} << 64 | static_cast<std::uint64_t>(middle);  // in units of 2^-126 quarters
  const auto fraction = static_cast<__int128>(turns << 2) >> 8;  // signed, in units of 2^-120 quarters
  const std::uint64_t quarter = (top >> 62) + (fraction < 0 ? 1 : 0);
  const auto head = static_cast<double>(fraction);
  const auto tail = static_cast<double>(fraction - static_cast<__int128>(head));
  return {quarter, head * 0x1p-120 * kHalfPi, tail * 0x1p-120 * kHalfPi};
}

/// Taylor's series on [-pi/4, pi/4]: the first term left out is below 1e-19 of the result.
double sine(double x, double low) {
  const double z = x * x;
  const double tail =
      -1.0 / 6 +
      z * (1.0 / 120 +
           z * (-1.0 / 5040 +
                z * (1.0 / 362880 +
                     z * (-1.0 / 39916800 + z * (1.0 / 6227020800 + z * (-1.0 / 1307674368000 +
                                                                         z * (1.0 / 355687428096000)))))));
  return x + (x * z * tail + low * (1.0 - 0.5 * z));
}

double cosine(double x, double low) {
  const double z = x * x, half = 0.5 * z, leading = 1.0 - half;
  const double tail =
      1.0 / 24 +
      z * (-1.0 / 720 + z * (1.0 / 40320 + z * (-1.0 / 3628800 +
                                                z * (1.0 / 479001600 + z * (-1.0 / 87178291200 +
                                                                            z * (1.0 / 20922789888000))))));
  return leading + (((1.0 - leading) - half) + (z * z * tail - x * low));
}

SinCos rotate_quarters(SinCos u, std::uint64_t quarter) {
  if (quarter & 1) u = {u.cos, -u.sin};
  return quarter & 2 ? SinCos{-u.sin, -u.cos} : u;
}

/// The arc tangent of t in [0, 1]: a guess good to 0.004, then the small angle that is left, by its series.
double arc_tangent_of(double t) {
  const double guess = t * (0.25 * std::numbers::pi + 0.273 * (1.0 - t));
  const SinCos u = {sine(guess, 0.0), cosine(guess, 0.0)};
  const double d = (u.cos * t - u.sin) / (u.cos + u.sin * t);
  const double z = d * d;
  return guess + d * (1.0 + z * (-1.0 / 3 + z * (1.0 / 5 + z * (-1.0 / 7))));
}

}  // namespace

SinCos sin_cos(double angle) {
  const double size = std::abs(angle);
  if (!(size <= std::numeric_limits<double>::max())) return {angle - angle, angle - angle};
  const Reduced r = size <= 0x1p30 ? reduce(size) : reduce_large(size);
  SinCos u = rotate_quarters({sine(r.high, r.low), cosine(r.high, r.low)}, r.quarter);
  if (std::signbit(angle)) u.sin = -u.sin;
  return u;
}

double arc_tangent(double y, double x) {
  double shorter = std::abs(y), longer = std::abs(x);
  const bool steep = shorter > longer;
  if (steep) std::swap(shorter, longer);
  double angle = longer == 0.0 ? 0.0 : arc_tangent_of(shorter / longer);
  if (steep) angle = kHalfPi - angle;
  if (x < 0.0) angle = std::numbers::pi - angle;
  return y < 0.0 ? -angle : angle;
}

double arc_cosine(double x) {
  return arc_tangent(std::sqrt((1.0 - x) * (1.0 + x)), x);
}

}  // namespace throng::narrowphase
