// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <vector>

#include "sim/scene.h"

/// What of a scene never moves, for who asks about single bodies before a run.
namespace throng {

/// All that stands still, in its frame.
struct Surroundings {
  using Box = Eigen::AlignedBox2d;  // m

  /// Directions along the walls and across them.
  struct Frame {
    Vec along{1.0, 0.0};

    Vec operator()(const Vec& v) const { return {along.dot(v), along.x() * v.y() - along.y() * v.x()}; }
    Box operator()(const Vec& centre, double radius) const {
      return {(*this)(centre).array() - radius, (*this)(centre).array() + radius};
    }
  };

  /// A straight wall at `at` of axis `across`, from `from` to `to` of the other one.
  struct Side {
    int across;
    double at, from, to;  // m
    std::uint32_t material;

    Box box() const {
      Box box;
      const int along = 1 - across;
      box.min()[across] = box.max()[across] = at, box.min()[along] = from, box.max()[along] = to;
      return box;
    }
  };

  Frame frame;
  bool square = true;  ///< walls are; else they are known by the boxes round them alone
  std::vector<Side> sides;
  std::vector<Box> others;  ///< static bodies, and walls that aren't square
};

/// Whether two directions are along each other, or at a right angle, but for rounding.
bool is_square(const Vec& a, const Vec& b);

/// O(walls + bodies).
Surroundings surroundings(const Scene& scene);

}  // namespace throng
