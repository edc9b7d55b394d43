// SPDX-License-Identifier: MIT
#include "narrowphase/bvh_fit.h"

#include <Eigen/SVD>
#include <limits>

#include "narrowphase/orientation.h"
#include "narrowphase/relative.h"

namespace throng::narrowphase {

namespace {

/// Appends the chain that keeps all points, in their order, on its left; its last point is left to the next.
template <class Iterator>
void append_chain(Iterator begin, Iterator end, Points<2>& hull) {
  const std::size_t start = hull.size();
  for (Iterator p = begin; p != end; ++p) {
    while (hull.size() >= start + 2 && orientation(hull[hull.size() - 2], hull.back(), *p) <= 0)
      hull.pop_back();
    hull.push_back(*p);
  }
  hull.pop_back();
}

/// The box with these axes. Its centre is taken relative to a point: its place costs no digits.
template <int kDim>
OrientedBox<kDim> box_along(const Points<kDim>& points, const Rotation<kDim>& axes) {
  Point<kDim> low = Point<kDim>::Zero(), high = Point<kDim>::Zero();
  for (const Point<kDim>& p : points) {
    const Point<kDim> along = axes.transpose() * (p - points[0]);
    low = low.cwiseMin(along);
    high = high.cwiseMax(along);
  }
  return {points[0] + axes * (0.5 * (low + high)), 0.5 * (high - low), axes};
}

template <int kDim>
std::size_t farthest(const Points<kDim>& points, const Point<kDim>& from) {
  std::size_t best = 0;
  double squared = -1.0;
  for (std::size_t i = 0; i < points.size(); ++i)
    if (const double d = (points[i] - from).squaredNorm(); d > squared) best = i, squared = d;
  return best;
}

/// Walks round a hull to the corner that is farthest along `axis`.
void advance(const Points<2>& hull, std::size_t& corner, const Vec& axis) {
  for (std::size_t i = 0; i < hull.size(); ++i) {
    const std::size_t after = next(corner, hull.size());
    if (dot(axis, hull[after] - hull[corner]) <= 0.0) return;
    corner = after;
  }
}

/// One side of the least rectangle lies along an edge of the hull.
OrientedBox<2> least_rectangle(const Points<2>& hull) {
  const std::size_t count = hull.size();
  std::size_t right = 0, top = 0, left = 0;
  double least = std::numeric_limits<double>::infinity();
  Rotation<2> best = Rotation<2>::Identity();
  for (std::size_t i = 0; i < count; ++i) {
    const Vec x = direction(hull[next(i, count)] - hull[i], {1.0, 0.0}).unit, y{-x.y(), x.x()};
    if (i == 0) right = top = next(i, count);
    advance(hull, right, x);
    if (i == 0) top = right;
    advance(hull, top, y);
    if (i == 0) left = top;
    advance(hull, left, -x);
    const double area = dot(x, hull[right] - hull[left]) * dot(y, hull[top] - hull[i]);
    if (area < least) least = area, best << x, y;
  }
  return box_along<2>(hull, best);
}

}  // namespace

template <>
void reduce_to_hull<2>(Points<2>& points) {
  std::sort(points.begin(), points.end(), lies_before);
  points.erase(std::unique(points.begin(), points.end()), points.end());
  if (points.size() < 3) return;
  Points<2> hull;
  append_chain(points.begin(), points.end(), hull);
  append_chain(points.rbegin(), points.rend(), hull);
  points = std::move(hull);
}

template <>
void reduce_to_hull<3>(Points<3>&) {}

template <int kDim>
void enclose(const Points<kDim>& points, Box<kDim>& volume) {
  Point<kDim> low = points[0], high = points[0];
  for (const Point<kDim>& p : points) low = low.cwiseMin(p), high = high.cwiseMax(p);
  volume = {low + 0.5 * (high - low), 0.5 * (high - low)};
}

template <int kDim>
void enclose(const Points<kDim>& points, Ball<kDim>& volume) {
  constexpr int kSteps = 8;
  Box<kDim> box;
  enclose(points, box);
  Point<kDim> centre = box.centre;
  volume.radius = std::numeric_limits<double>::infinity();
  for (int step = 1;; ++step) {
    const Point<kDim> away = points[farthest<kDim>(points, centre)] - centre;
    if (const double radius = away.norm(); radius < volume.radius) volume = {centre, radius};
    if (step > kSteps) return;
    centre += away / (step + 1.0);
  }
}

template <int kDim>
void enclose_by_svd(const Points<kDim>& points, OrientedBox<kDim>& volume) {
  Point<kDim> sum = Point<kDim>::Zero();
  for (const Point<kDim>& p : points) sum += p - points[0];
  const Point<kDim> mean = points[0] + sum / static_cast<double>(points.size());
  double scale = 0.0;
  for (const Point<kDim>& p : points) scale = std::max(scale, (p - mean).cwiseAbs().maxCoeff());
  Rotation<kDim> scatter = Rotation<kDim>::Zero();
  for (const Point<kDim>& p : points)
    if (scale > 0.0) scatter += ((p - mean) / scale) * ((p - mean) / scale).transpose();
  const Eigen::JacobiSVD<Rotation<kDim>> svd(scatter, Eigen::ComputeFullU);
  volume = box_along<kDim>(points, svd.matrixU());
}

template <>
void enclose<2>(const Points<2>& hull, OrientedBox<2>& volume) {
  volume = least_rectangle(hull);
}

template <>
void enclose<3>(const Points<3>& points, OrientedBox<3>& volume) {
  enclose_by_svd(points, volume);
}

template void enclose<2>(const Points<2>&, Ball<2>&);
template void enclose<3>(const Points<3>&, Ball<3>&);
template void enclose<2>(const Points<2>&, Box<2>&);
template void enclose<3>(const Points<3>&, Box<3>&);
template void enclose_by_svd<2>(const Points<2>&, OrientedBox<2>&);
template void enclose_by_svd<3>(const Points<3>&, OrientedBox<3>&);

}  // namespace throng::narrowphase
