// SPDX-License-Identifier: MIT
#include "scenarios/body_distance.h"

#include <algorithm>
#include <limits>
#include <span>

#include "narrowphase/distance.h"

namespace throng::scenarios {

namespace {

using narrowphase::Convex;
using narrowphase::Pose;

/// The convex parts of a body; a disc's one part is made on the spot.
class Parts {
 public:
  Parts(const Scene& scene, std::uint32_t row) : shape_(scene.shapes[scene.bodies.shape[row]]) {
    if (shape_.kind == ShapeKind::disc) disc_ = narrowphase::disc(scene.bodies.radius[row]);
  }

  std::span<const Convex> all() const {
    if (shape_.kind == ShapeKind::disc) return {&disc_, 1};
    return shape_.parts;
  }

 private:
  const Shape& shape_;
  Convex disc_;
};

double distance(std::span<const Convex> a, const Pose& pose_a, std::span<const Convex> b,
                const Pose& pose_b) {
  double least = std::numeric_limits<double>::infinity();
  for (const Convex& part_a : a)
    for (const Convex& part_b : b)
      least = std::min(least, narrowphase::separation(part_a, pose_a, part_b, pose_b).distance);
  return least;
}

bool is_disc(const Scene& scene, std::uint32_t row) {
  return scene.shapes[scene.bodies.shape[row]].kind == ShapeKind::disc;
}

}  // namespace

double distance(const Scene& scene, const Placed& a, const Placed& b) {
  const Bodies& bodies = scene.bodies;
  if (is_disc(scene, a.row) && is_disc(scene, b.row))
    return (b.position - a.position).norm() - (bodies.radius[a.row] + bodies.radius[b.row]);
  const Parts parts_a(scene, a.row), parts_b(scene, b.row);
  return distance(parts_a.all(), narrowphase::pose(a.position, bodies.angle[a.row]), parts_b.all(),
                  narrowphase::pose(b.position, bodies.angle[b.row]));
}

double distance(const Scene& scene, const Placed& body, const WallGrid::Piece& piece) {
  if (is_disc(scene, body.row)) return distance(piece, body.position) - scene.bodies.radius[body.row];
  const Convex wall = narrowphase::segment(piece.a, piece.b);
  return distance(Parts(scene, body.row).all(),
                  narrowphase::pose(body.position, scene.bodies.angle[body.row]), {&wall, 1}, Pose{});
}

Eigen::AlignedBox2d extent(const Scene& scene, std::uint32_t row) {
  const double radius = scene.bodies.radius[row];
  if (is_disc(scene, row)) return {Vec(-radius, -radius), Vec(radius, radius)};
  const Pose pose = narrowphase::pose({0.0, 0.0}, scene.bodies.angle[row]);
  Eigen::AlignedBox2d box;
  for (const Convex& part : scene.shapes[scene.bodies.shape[row]].parts)
    for (const Vec& vertex : part.vertices) {
      const Vec corner = pose * vertex, rounding(part.radius, part.radius);
      box.extend(Vec(corner - rounding));
      box.extend(Vec(corner + rounding));
    }
  return box;
}

double touching(double smaller_radius, const Vec& position) {
  return 1e-9 * smaller_radius +
         8.0 * std::numeric_limits<double>::epsilon() * position.cwiseAbs().maxCoeff();
}

}  // namespace throng::scenarios
