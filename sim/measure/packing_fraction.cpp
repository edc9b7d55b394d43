// SPDX-License-Identifier: MIT
#include "sim/measure/packing_fraction.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "narrowphase/trigonometry.h"

namespace throng {

namespace {

using Box = Eigen::AlignedBox2d;
using std::numbers::pi;

/// Area of the unit disc between a chord at t from its centre and the diameter along it; below 0 for t < 0.
double strip(double t) {
  return t * std::sqrt(1.0 - t * t) + 0.5 * pi - narrowphase::arc_cosine(t);
}

/// Of the unit disc the area where x <= a and y <= b.
double quadrant(double a, double b) {
  if (a <= -1.0 || b <= -1.0) return 0.0;
  a = std::min(a, 1.0), b = std::min(b, 1.0);
  const double left = 0.5 * pi + strip(a), below = 0.5 * pi + strip(b);  // of the half planes alone
  if (a * a + b * b <= 1.0) return a * b + 0.5 * (left + below) - 0.25 * pi;
  if (a >= 0.0 && b >= 0.0) return left + below - pi;
  if (a < 0.0 && b < 0.0) return 0.0;
  return a < 0.0 ? left : below;
}

/// What of the polygon is where sign * coordinate <= sign * limit (Sutherland and Hodgman 1974).
std::vector<Vec> cut(const std::vector<Vec>& polygon, int axis, double limit, double sign) {
  std::vector<Vec> rest;
  const auto outside = [&](const Vec& p) { return sign * (p[axis] - limit); };
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec &p = polygon[i], &q = polygon[(i + 1) % polygon.size()];
    const double at_p = outside(p), at_q = outside(q);
    if (at_p <= 0.0) rest.push_back(p);
    if ((at_p < 0.0 && at_q > 0.0) || (at_p > 0.0 && at_q < 0.0))
      rest.push_back(p + at_p / (at_p - at_q) * (q - p));
  }
  return rest;
}

double area(const std::vector<Vec>& polygon) {
  double twice = 0.0;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec &p = polygon[i], &q = polygon[(i + 1) % polygon.size()];
    twice += p.x() * q.y() - p.y() * q.x();
  }
  return 0.5 * twice;
}

double part_within(const narrowphase::Convex& part, const narrowphase::Pose& pose, const Box& box) {
  if (part.vertices.size() == 1) return area_within(pose * part.vertices[0], part.radius, box);
  std::vector<Vec> corners;
  for (const Vec& corner : part.vertices) corners.push_back(pose * corner);
  return area_within(std::move(corners), box);
}

double part_area(const narrowphase::Convex& part) {
  return part.vertices.size() == 1 ? pi * part.radius * part.radius : area(part.vertices);
}

double body_within(const Scene& scene, const State& state, std::size_t row, const Vec& shift,
                   const Box& box) {
  const Shape& shape = scene.shapes[scene.bodies.shape[row]];
  const Vec centre = state.position[row] + shift;
  if (shape.kind == ShapeKind::disc) return area_within(centre, scene.bodies.radius[row], box);
  const narrowphase::Pose pose = narrowphase::pose(centre, state.angle[row]);
  double within = 0.0, all = 0.0;
  for (const narrowphase::Convex& part : shape.parts)
    within += part_within(part, pose, box), all += part_area(part);
  return within * shape.area / all;
}

/// Calls visit(shift) for the images of a domain round the one that is listed.
template <class Visit>
void for_images(const Domain& domain, Visit visit) {
  if (domain.kind != DomainKind::periodic) return visit(Vec(0.0, 0.0));
  const Vec size = domain.max - domain.min;
  for (const int x : {-1, 0, 1})
    for (const int y : {-1, 0, 1}) visit(Vec(x * size.x(), y * size.y()));
}

}  // namespace

double area_within(const Vec& centre, double radius, const Box& box) {
  const Vec low = (box.min() - centre) / radius, high = (box.max() - centre) / radius;
  if (low.maxCoeff() <= -1.0 && high.minCoeff() >= 1.0) return pi * radius * radius;
  const double unit = quadrant(high.x(), high.y()) - quadrant(low.x(), high.y()) -
                      quadrant(high.x(), low.y()) + quadrant(low.x(), low.y());
  return std::max(unit, 0.0) * radius * radius;
}

double area_within(std::vector<Vec> polygon, const Box& box) {
  for (const int axis : {0, 1}) {
    polygon = cut(polygon, axis, box.min()[axis], -1.0);
    polygon = cut(polygon, axis, box.max()[axis], 1.0);
  }
  return area(polygon);
}

double packing_fraction(const Scene& scene, const State& state, const Box& box) {
  double within = 0.0;
  for (std::size_t row = 0; row < state.id.size(); ++row) {
    if (scene.bodies.kind[row] != BodyKind::dynamic) continue;
    const double reach = scene.bodies.radius[row];
    for_images(scene.domain, [&](const Vec& shift) {
      const Vec centre = state.position[row] + shift;
      if (box.squaredExteriorDistance(centre) < reach * reach)
        within += body_within(scene, state, row, shift, box);
    });
  }
  return within / box.volume();
}

}  // namespace throng
