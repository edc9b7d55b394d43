// SPDX-License-Identifier: MIT
#include "sim/colliders.h"

#include <algorithm>
#include <iterator>

#include "sim/straight_runs.h"

namespace throng {

using narrowphase::Convex;

Eigen::AlignedBox2d bounds(const Convex& part) {
  Eigen::AlignedBox2d box;
  for (const Vec& v : part.vertices) box.extend(v);
  return {box.min().array() - part.radius, box.max().array() + part.radius};
}

namespace {

/// However a part turns about the centre, it lies between two circles: how far these are apart.
double swing(const Convex& part, const Vec& centre, double reach) {
  double inner = reach;
  for (std::size_t i = 0; i < part.normals.size(); ++i)
    inner = std::min(inner, part.normals[i].dot(part.vertices[i] - centre));
  return inner >= 0.0 ? reach - inner : 2.0 * (reach + part.radius);  // the centre is in the part, or not
}

/// The middle of the part's bounding box, and how far its surface reaches from there.
void add_part(Colliders& colliders, std::uint32_t body, bool movable, const Convex& part) {
  const Vec centre = bounds(part).center();
  double reach = 0.0;
  for (const Vec& v : part.vertices) reach = std::max(reach, (v - centre).norm());
  colliders.body.push_back(body);
  colliders.radius.push_back(reach + part.radius);
  colliders.movable.push_back(movable);
  colliders.centre.push_back(centre);
  colliders.swing.push_back(swing(part, centre, reach));
  colliders.shape.push_back(&part);
}

void add_disc(Colliders& colliders, std::uint32_t body, bool movable, double radius, bool alone) {
  colliders.body.push_back(body);
  colliders.radius.push_back(radius);
  colliders.movable.push_back(movable);
  if (alone) return;
  colliders.centre.emplace_back(0.0, 0.0);
  colliders.swing.push_back(0.0);
  colliders.shape.push_back(nullptr);
}

Convex moved(Convex shape, const narrowphase::Pose& pose) {
  for (Vec& v : shape.vertices) v = pose * v;
  for (Vec& n : shape.normals) n = pose.rotate(n);
  return shape;
}

void add_walls(Obstacles& obstacles, const std::vector<Wall>& walls) {
  for (const StraightRun& run : straight_runs(walls)) {
    obstacles.part.push_back(narrowphase::segment(run.from, run.to));
    obstacles.material.push_back(run.material);
  }
}

void add_static_body(Obstacles& obstacles, const Scene& scene, std::size_t row) {
  const Bodies& bodies = scene.bodies;
  const narrowphase::Pose pose = narrowphase::pose(bodies.position[row], bodies.angle[row]);
  const Shape& shape = scene.shapes[bodies.shape[row]];
  if (shape.kind == ShapeKind::disc)
    obstacles.part.push_back(narrowphase::disc(bodies.radius[row], bodies.position[row]));
  else
    for (const Convex& part : shape.parts) obstacles.part.push_back(moved(part, pose));
  obstacles.material.resize(obstacles.size(), bodies.material[row]);
}

/// The domain's sides, of the first material.
void add_sides(Obstacles& obstacles, const Domain& domain) {
  obstacles.side = {{domain.min, {1.0, 0.0}},
                    {domain.max, {-1.0, 0.0}},
                    {domain.min, {0.0, 1.0}},
                    {domain.max, {0.0, -1.0}}};
  obstacles.material.assign(4, 0);
}

/// Adds the eight images of each obstacle that come within `reach` of the domain.
void add_images(Obstacles& obstacles, const Domain& domain, double reach) {
  const Eigen::AlignedBox2d near(domain.min.array() - reach, domain.max.array() + reach);
  const Vec period = domain.max - domain.min;
  for (std::size_t i = 0, n = obstacles.part.size(); i < n; ++i)
    for (int x = -1; x <= 1; ++x)
      for (int y = -1; y <= 1; ++y) {
        const Vec shift(x * period.x(), y * period.y());
        if ((x == 0 && y == 0) || !near.intersects(bounds(obstacles.part[i]).translated(shift))) continue;
        obstacles.part.push_back(moved(Convex(obstacles.part[i]), {.position = shift}));
        obstacles.material.push_back(std::uint32_t{obstacles.material[i]});
      }
}

/// Each row's rim, of its part among its shape's; discs have the first, which is empty.
void add_rims(Colliders& colliders, const Scene& scene) {
  colliders.rims.resize(1);
  std::vector<std::uint32_t> first;  // of each shape
  for (const Shape& shape : scene.shapes) {
    first.push_back(static_cast<std::uint32_t>(colliders.rims.size()));
    std::ranges::move(narrowphase::rims(shape.parts), std::back_inserter(colliders.rims));
  }
  std::uint32_t part = 0;
  for (std::size_t row = 0; row < colliders.size(); ++row) {
    part = row > 0 && colliders.body[row] == colliders.body[row - 1] ? part + 1 : 0;
    const std::uint32_t shape = scene.bodies.shape[colliders.body[row]];
    colliders.rim.push_back(scene.shapes[shape].parts.empty() ? 0 : first[shape] + part);
  }
}

}  // namespace

Colliders colliders(const Scene& scene, const Plan& plan) {
  const Bodies& bodies = scene.bodies;
  Colliders result;
  for (std::uint32_t row = 0; row < bodies.size(); ++row) {
    if (bodies.kind[row] == BodyKind::fixed) continue;
    const bool movable = bodies.kind[row] == BodyKind::dynamic;
    const Shape& shape = scene.shapes[bodies.shape[row]];
    if (shape.kind == ShapeKind::disc) add_disc(result, row, movable, bodies.radius[row], !plan.polygons);
    for (const Convex& part : shape.parts) add_part(result, row, movable, part);
  }
  if (plan.composites) add_rims(result, scene);
  return result;
}

Obstacles obstacles(const Scene& scene, double reach) {
  Obstacles result;
  if (scene.domain.kind == DomainKind::box) add_sides(result, scene.domain);
  add_walls(result, scene.walls);
  for (std::size_t row = 0; row < scene.bodies.size(); ++row)
    if (scene.bodies.kind[row] == BodyKind::fixed) add_static_body(result, scene, row);
  if (scene.domain.kind == DomainKind::periodic) add_images(result, scene.domain, reach);
  result.rim = narrowphase::rims(result.part);
  for (std::size_t i = 0; i < result.part.size(); ++i)
    result.bends.push_back(narrowphase::bends_gently(result.part[i], result.rim[i]));
  if (std::ranges::count(result.bends, 1) == 0) result.bends.clear();
  return result;
}

}  // namespace throng
