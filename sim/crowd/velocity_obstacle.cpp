// SPDX-License-Identifier: MIT
#include "sim/crowd/velocity_obstacle.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace throng {

namespace {

/// Keeps the nearest of what it is shown.
class Nearest {
 public:
  explicit Nearest(const Vec& v) : v_(v) {}

  void show(const Vec& point, const Vec& normal) {
    const double square = (point - v_).squaredNorm();
    if (square < least_) least_ = square, escape_ = {point, normal};
  }
  const Vec& to() const { return v_; }
  const Escape& escape() const { return escape_; }

 private:
  Vec v_;
  double least_ = std::numeric_limits<double>::infinity();
  Escape escape_;
};

/// The border ahead of the line is a disc's about each end, where it can be seen from velocity 0 ...
void show_end(const Vec& end, const Vec& other, double radius, Nearest& nearest) {
  const Vec out = nearest.to() - end;
  const double length = out.norm();
  if (!(length > 0.0)) return;
  const Vec normal = out / length, point = end + radius * normal;
  if (point.dot(normal) <= 0.0 && normal.dot(other - end) <= 0.0) nearest.show(point, normal);
}

/// ... and a side between them, where that faces it.
void show_side(const Vec& a, const Vec& b, double radius, Nearest& nearest) {
  const Vec along = b - a;
  const double square = along.squaredNorm();
  if (!(square > 0.0)) return;
  Vec normal = Vec(-along.y(), along.x()) / std::sqrt(square);
  if (normal.dot(a) > 0.0) normal = -normal;
  if (normal.dot(a) + radius > 0.0) return;
  const double at = along.dot(nearest.to() - a) / square;
  if (at >= 0.0 && at <= 1.0) nearest.show(a + at * along + radius * normal, normal);
}

/// The way from 0 that touches the disc about `centre` on its left (side 1) or right (-1).
Vec tangent_point(const Vec& centre, double radius, double side) {
  const double square = centre.squaredNorm(), leg = std::sqrt(std::max(0.0, square - radius * radius));
  const Vec left(-centre.y(), centre.x());
  return (leg * centre + side * radius * left) / square;
}

/// The leg on one side: from where it touches the disc that lies farther out on that side.
void show_leg(const Vec& a, const Vec& b, double radius, double side, Nearest& nearest) {
  const Vec at_a = tangent_point(a, radius, side), at_b = tangent_point(b, radius, side);
  const bool is_a = side * cross(at_b, at_a) >= 0.0;
  const Vec& way = is_a ? at_a : at_b;
  const double begin = way.dot(is_a ? a : b), at = std::max(begin, way.dot(nearest.to()));
  nearest.show(at * way, side * Vec(-way.y(), way.x()));
}

}  // namespace

Escape escape(const Vec& a, const Vec& b, double radius, double horizon, const Vec& v) {
  const Vec first = a / horizon, last = b / horizon;
  const double size = radius / horizon;
  Nearest nearest(v);
  show_side(first, last, size, nearest);
  show_end(first, last, size, nearest);
  show_end(last, first, size, nearest);
  show_leg(first, last, size, 1.0, nearest);
  show_leg(first, last, size, -1.0, nearest);
  return nearest.escape();
}

}  // namespace throng
