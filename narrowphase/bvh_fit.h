// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "narrowphase/bvh_volume.h"

/// Volumes around points, up to rounding of some 2^-50 of the coordinates (see `Frame::slack`). All expect
/// one point or more.
namespace throng::narrowphase {

template <int kDim>
using Points = std::vector<Point<kDim>>;

/// The points that matter to any volume around all of them: in the plane the corners of their convex hull,
/// counter-clockwise (Andrew 1979), exact; in space all of them. O(n log n).
template <int kDim>
void reduce_to_hull(Points<kDim>& points);
template <>
void reduce_to_hull<2>(Points<2>& points);
template <>
void reduce_to_hull<3>(Points<3>& points);

/// A ball at most a few per cent larger than the least: some steps towards the farthest point (Badoiu and
/// Clarkson 2003). O(n).
template <int kDim>
void enclose(const Points<kDim>& points, Ball<kDim>& volume);

/// O(n).
template <int kDim>
void enclose(const Points<kDim>& points, Box<kDim>& volume);

/// In the plane the rectangle of least area, by rotating calipers (Toussaint 1983): expects a hull. In space
/// `enclose_by_svd`. O(n).
template <int kDim>
void enclose(const Points<kDim>& points, OrientedBox<kDim>& volume);
template <>
void enclose<2>(const Points<2>& hull, OrientedBox<2>& volume);
template <>
void enclose<3>(const Points<3>& points, OrientedBox<3>& volume);

/// The box along the points' principal axes. O(n).
template <int kDim>
void enclose_by_svd(const Points<kDim>& points, OrientedBox<kDim>& volume);

/// The oriented box above, and the least ball around its centre. O(n).
template <int kDim>
void enclose(const Points<kDim>& points, BoxAndBall<kDim>& volume) {
  enclose(points, static_cast<OrientedBox<kDim>&>(volume));
  volume.radius = 0.0;
  for (const Point<kDim>& p : points) volume.radius = std::max(volume.radius, (p - volume.centre).norm());
}

/// Makes room for what is rounded by `margin` (m).
template <int kDim>
void grow(Ball<kDim>& volume, double margin) {
  volume.radius += margin;
}
template <class Boxes>
void grow(Boxes& volume, double margin) {
  volume.half.array() += margin;
}
template <int kDim>
void grow(BoxAndBall<kDim>& volume, double margin) {
  volume.half.array() += margin;
  volume.radius += margin;
}

}  // namespace throng::narrowphase
