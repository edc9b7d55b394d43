// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <vector>

/// The one shape that the narrowphase knows: a convex polygon, rounded by a radius.
/// One vertex makes a disc, two a segment or a capsule.
namespace throng::narrowphase {

using Vec = Eigen::Vector2d;

struct Convex {
  std::vector<Vec> vertices;  ///< m, counter-clockwise, strictly convex, in the body's frame
  std::vector<Vec> normals;   ///< unit, outward; normals[i] belongs to the edge from vertices[i] to the next
  double radius = 0.0;        ///< m, how far the surface lies outside the vertices' hull
};

/// Where a shape stands: rotate by (cos, sin) about the local origin, then translate.
struct Pose {
  Vec position{0.0, 0.0};  ///< m
  double cos = 1.0, sin = 0.0;

  Vec rotate(const Vec& v) const { return {cos * v.x() - sin * v.y(), sin * v.x() + cos * v.y()}; }
  Vec unrotate(const Vec& v) const { return {cos * v.x() + sin * v.y(), cos * v.y() - sin * v.x()}; }
  /// By coordinate: a sum of vectors loads what `rotate` has just stored in halves, and waits for it.
  Vec operator*(const Vec& v) const {
    return {cos * v.x() - sin * v.y() + position.x(), sin * v.x() + cos * v.y() + position.y()};
  }
};

/// The pose at `angle` (rad), by throng's own sine and cosine: the same bits on every machine.
Pose pose(const Vec& position, double angle);

/// A Convex with its normals. Expects vertices as Convex has them; a stranger's polygon goes through `clean`
/// and `decompose` of polygon.h first.
Convex convex(std::vector<Vec> vertices, double radius = 0.0);
Convex disc(double radius, const Vec& centre = Vec{0.0, 0.0});
Convex segment(const Vec& p, const Vec& q, double radius = 0.0);  ///< expects p != q

}  // namespace throng::narrowphase
