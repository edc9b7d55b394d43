// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

/// Where does a polynomial of low degree change its sign? By isolation: between two sign changes of the
/// derivative it has at most one.
namespace throng::narrowphase {

/// Coefficients, that of the constant first.
template <std::size_t Degree>
using Polynomial = std::array<double, Degree + 1>;

template <std::size_t Terms>
double value(const std::array<double, Terms>& p, double x) {
  double sum = p[Terms - 1];
  for (std::size_t i = Terms - 1; i-- > 0;) sum = sum * x + p[i];
  return sum;
}

template <std::size_t Terms>
std::array<double, Terms - 1> derivative(const std::array<double, Terms>& p) {
  std::array<double, Terms - 1> result;
  for (std::size_t i = 1; i < Terms; ++i) result[i - 1] = static_cast<double>(i) * p[i];
  return result;
}

/// Places in ascending order.
template <std::size_t Most>
struct Places {
  std::array<double, Most> at{};
  std::size_t count = 0;

  void add(double x) { at[count++] = x; }
};

/// The one sign change within [low, high], at whose ends the signs differ: Newton's steps where they stay
/// between the ends, else halves. Within a few ulps of where the rounded polynomial changes its sign.
template <std::size_t Terms>
double sign_change(const std::array<double, Terms>& p, double low, double high) {
  constexpr int kSteps =
      200;  // halving alone takes 64 from end to end, and up to 1100 to the smallest double
  const bool rises = value(p, low) < 0.0;
  const auto slope = derivative(p);
  double x = low + 0.5 * (high - low);
  for (int i = 0; i < kSteps && x > low && x < high; ++i) {
    const double y = value(p, x);
    ((y < 0.0) == rises ? low : high) = x;
    const double newton = x - y / value(slope, x);
    if (newton == x) break;
    x = newton > low && newton < high ? newton : low + 0.5 * (high - low);
  }
  return x;
}

/// All of them in (low, high), ascending. Where it only touches zero there is none, or by rounding two close
/// together.
template <std::size_t Terms>
Places<Terms - 1> sign_changes(const std::array<double, Terms>& p, double low, double high) {
  Places<Terms - 1> result;
  if constexpr (Terms == 2) {
    const double x = -p[0] / p[1];
    if (x > low && x < high) result.add(x);
  } else {
    double from = low;
    const auto look = [&](double to) {
      if ((value(p, from) < 0.0) != (value(p, to) < 0.0)) result.add(sign_change(p, from, to));
      from = to;
    };
    const auto turns = sign_changes(derivative(p), low, high);
    for (std::size_t i = 0; i < turns.count; ++i) look(turns.at[i]);
    look(high);
  }
  return result;
}

}  // namespace throng::narrowphase
