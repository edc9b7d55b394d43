// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <limits>

#include "narrowphase/relative.h"

/// The gap of two points along an axis that turns at a constant rate, to second order.
namespace throng::narrowphase {

/// gap + rate t - bend t² / 2. m, m/s, m/s².
struct Parabola {
  double gap, rate, bend;

  double at(double t) const { return gap + t * (rate - 0.5 * bend * t); }

  /// When it comes down to 0: never later, rounding apart, also where squares under- or overflow. Expects gap
  /// > 0, bend >= 0; 0 where they are none.
  double root() const {
    if (bend == 0.0) return rate < 0.0 ? gap / -rate : std::numeric_limits<double>::infinity();
    constexpr double kSquaresKeepTheirDigits = 0x1p-960;
    const double squared = discriminant();
    if (squared > kSquaresKeepTheirDigits && std::isfinite(squared)) [[likely]]
      return root(std::sqrt(squared));
    const double scale = squared < 1.0 ? 0x1p600 : 0x1p-600;  // which no root depends on
    const Parabola scaled{scale * gap, scale * rate, scale * bend};
    return scaled.root(std::sqrt(scaled.discriminant()));
  }

 private:
  double discriminant() const { return rate * rate + 2.0 * bend * gap; }
  double root(double r) const {
    if (!std::isfinite(r)) return 0.0;
    return rate < 0.0 ? 2.0 * gap / (r - rate) : (r + rate) / bend;
  }
};

/// How fast two origins, b's at `offset` from a's, go apart along an axis of that spin. m/s.
inline double rate_of_origins(const Vec& normal, double spin, const Vec& velocity, const Vec& offset) {
  return dot(normal, velocity) + spin * cross(normal, offset);
}

/// How they bend their gap along it at most, for as long as they go straight at `speed`, `apart` being their
/// distance now: n(t).(o + v t) is at least n.o + (n'.o + n.v) t - (|w|² |o| + 2 |w| |v|) t² / 2, for n turns
/// by no more than |w| t from where it was. m/s².
inline double bend_of_origins(double spin, double speed, double apart) {
  const double turn = std::abs(spin);
  return turn * (2.0 * speed + turn * apart);
}

/// How much a vertex adds that is `reach` from its origin, which turns by `turning` in the axis' frame. m/s².
inline double bend_of_vertex(double turning, double reach) {
  return turning * turning * reach;
}

}  // namespace throng::narrowphase
