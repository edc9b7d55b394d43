// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <cstdint>

/// Points of the plane, and of the plane that repeats: the one meaning of "distance" on this floor.
namespace throng::broadphase {

using Point = Eigen::Vector2d;

/// The period of a periodic domain: x and y repeat each `size` (m, > 0). Points lie in [origin, origin +
/// size].
struct Period {
  Point origin, size;
};

/// The image of `d` nearest to 0 where lengths repeat each `size`. Expects |d| < 1.5 size; fold(-d) ==
/// -fold(d).
inline double fold(double d, double size) {
  const double half = 0.5 * size;
  const double shift = d > half ? size : d < -half ? -size : 0.0;
  return d - shift;
}

/// Squared distance in the plane. Both metrics are symmetric to the bit.
struct PlaneMetric {
  double operator()(const Point& a, const Point& b) const {
    const double dx = a.x() - b.x(), dy = a.y() - b.y();
    return dx * dx + dy * dy;
  }
};

/// Squared distance of the nearest images.
struct PeriodicMetric {
  Point size;  ///< m
  double operator()(const Point& a, const Point& b) const {
    const double dx = fold(a.x() - b.x(), size.x()), dy = fold(a.y() - b.y(), size.y());
    return dx * dx + dy * dy;
  }
};

/// The squared distance that every answer of this floor is defined by, in either domain.
inline double squared_distance(const Point& a, const Point& b, const Period* period) {
  return period ? PeriodicMetric{period->size}(a, b) : PlaneMetric{}(a, b);
}

}  // namespace throng::broadphase
