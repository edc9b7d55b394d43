// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Geometry>
#include <vector>

namespace throng {

using Vec = Eigen::Vector2d;

inline double cross(const Vec& a, const Vec& b) {
  return a.x() * b.y() - a.y() * b.x();
}

/// A part of the plane by its rings, outer ones and holes alike: inside is what an odd number of them
/// encloses. Expects rings that don't cross each other.
struct Region {
  std::vector<std::vector<Vec>> rings;  ///< m, each closed from its last point to its first

  bool empty() const { return rings.empty(); }
};

/// Whether `p` is inside; on the border either may be said. O(n), exact.
bool contains(const Region& region, const Vec& p);

/// The point of the rings that is nearest to `p`; of equally near ones that of the first edge. Expects a
/// region that isn't empty. O(n).
Vec nearest_on_border(const Region& region, const Vec& p);

Eigen::AlignedBox2d bounds(const Region& region);

/// The point of the segment from `a` to `b` that is nearest to `p`.
Vec nearest_on_segment(const Vec& a, const Vec& b, const Vec& p);

}  // namespace throng
