// SPDX-License-Identifier: MIT
#include "tools/palette.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace throng::tools {

namespace {

constexpr std::array<Colour, 11> kAnchors{{{0.267, 0.005, 0.329},
                                           {0.283, 0.141, 0.458},
                                           {0.254, 0.265, 0.530},
                                           {0.207, 0.372, 0.553},
                                           {0.164, 0.471, 0.558},
                                           {0.128, 0.567, 0.551},
                                           {0.135, 0.659, 0.518},
                                           {0.267, 0.749, 0.441},
                                           {0.478, 0.821, 0.318},
                                           {0.741, 0.873, 0.150},
                                           {0.993, 0.906, 0.144}}};
constexpr double kLowest = 0.12;  // the darkest end looks black on a screen

double blend(double a, double b, double t) {
  return a + t * (b - a);
}

}  // namespace

Colour palette(double value) {
  const double at = (kLowest + (1 - kLowest) * std::clamp(value, 0.0, 1.0)) * (kAnchors.size() - 1);
  const std::size_t i = std::min(static_cast<std::size_t>(at), kAnchors.size() - 2);
  const Colour &a = kAnchors[i], &b = kAnchors[i + 1];
  const double t = at - static_cast<double>(i);
  return {blend(a.red, b.red, t), blend(a.green, b.green, t), blend(a.blue, b.blue, t)};
}

Colour shade(const Colour& colour) {
  return {0.55 * colour.red, 0.55 * colour.green, 0.55 * colour.blue};
}

double round_below(double limit) {
  const double power = std::pow(10.0, std::floor(std::log10(limit)));
  for (double digit : {5.0, 2.0})
    if (digit * power <= limit) return digit * power;
  return power;
}

double top_speed(double* speeds, long count) {
  if (count == 0) return 0.0;
  double* at = speeds + (count - 1) * 99 / 100;
  std::nth_element(speeds, at, speeds + count);
  if (!(*at > 0)) return 0.0;
  const double unit = std::pow(10.0, std::floor(std::log10(*at)) - 1);
  return unit * std::ceil(*at / unit);
}

}  // namespace throng::tools
