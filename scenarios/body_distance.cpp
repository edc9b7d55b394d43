// SPDX-License-Identifier: MIT
#include "scenarios/body_distance.h"

#include <algorithm>
#include <limits>
#include <span>

#include "narrowphase/nearest_parts.h"

namespace throng::scenarios {

namespace {

using narrowphase::Bound;
using narrowphase::bound;
using narrowphase::Convex;
using narrowphase::Pose;

/// The convex parts of a body; a disc's one part is made on the spot.
class BodyParts {
 public:
  BodyParts(const Scene& scene, std::uint32_t row) : shape_(scene.shapes[scene.bodies.shape[row]]) {
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

/// False only where rounding can't make them come closer than `gap`.
bool may_be_closer(const Bound& a, const Bound& b, double gap) {
  const double sum = a.radius + b.radius + gap;
  const double rounding = 1e-12 * (sum + a.centre.cwiseAbs().maxCoeff());
  return (a.centre - b.centre).norm() <= sum + rounding;
}

bool is_closer(std::span<const Convex> a, const Pose& pose_a, std::span<const Convex> b, const Pose& pose_b,
               const Bound& all_b, double gap, std::int64_t& work) {
  constexpr std::int64_t kWorkOfSeparation = 16;
  std::vector<Bound> bounds;
  for (const Convex& part : b) bounds.push_back(bound(part, pose_b));
  work += static_cast<std::int64_t>(a.size() + b.size());
  for (const Convex& part : a) {
    const Bound bound_a = bound(part, pose_a);
    if (!may_be_closer(bound_a, all_b, gap)) continue;
    work += static_cast<std::int64_t>(b.size());
    for (std::size_t i = 0; i < b.size(); ++i) {
      if (!may_be_closer(bound_a, bounds[i], gap)) continue;
      work += kWorkOfSeparation;
      if (narrowphase::separation(part, pose_a, b[i], pose_b).distance < gap) return true;
    }
  }
  return false;
}

bool is_disc(const Scene& scene, std::uint32_t row) {
  return scene.shapes[scene.bodies.shape[row]].kind == ShapeKind::disc;
}

}  // namespace

double distance(const Scene& scene, const Placed& a, const Placed& b) {
  const Bodies& bodies = scene.bodies;
  if (is_disc(scene, a.row) && is_disc(scene, b.row))
    return (b.position - a.position).norm() - (bodies.radius[a.row] + bodies.radius[b.row]);
  const BodyParts parts_a(scene, a.row), parts_b(scene, b.row);
  return narrowphase::separation(parts_a.all(), narrowphase::pose(a.position, bodies.angle[a.row]),
                                 parts_b.all(), narrowphase::pose(b.position, bodies.angle[b.row]))
      .distance;
}

double distance(const Scene& scene, const Placed& body, const WallGrid::Piece& piece) {
  if (is_disc(scene, body.row)) return distance(piece, body.position) - scene.bodies.radius[body.row];
  const Convex wall = narrowphase::segment(piece.a, piece.b);
  return narrowphase::separation(BodyParts(scene, body.row).all(),
                                 narrowphase::pose(body.position, scene.bodies.angle[body.row]), {&wall, 1},
                                 Pose{})
      .distance;
}

bool is_closer(const Scene& scene, const Placed& a, const Placed& b, double gap, std::int64_t& work) {
  const Bodies& bodies = scene.bodies;
  if (is_disc(scene, a.row) && is_disc(scene, b.row)) return distance(scene, a, b) < gap;
  const BodyParts parts_a(scene, a.row), parts_b(scene, b.row);
  return is_closer(parts_a.all(), narrowphase::pose(a.position, bodies.angle[a.row]), parts_b.all(),
                   narrowphase::pose(b.position, bodies.angle[b.row]), {b.position, bodies.radius[b.row]},
                   gap, work);
}

bool is_closer(const Scene& scene, const Placed& body, const WallGrid::Piece& piece, double gap,
               std::int64_t& work) {
  if (is_disc(scene, body.row)) return distance(scene, body, piece) < gap;
  const Convex wall = narrowphase::segment(piece.a, piece.b);
  return is_closer(BodyParts(scene, body.row).all(),
                   narrowphase::pose(body.position, scene.bodies.angle[body.row]), {&wall, 1}, Pose{},
                   bound(wall, Pose{}), gap, work);
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
