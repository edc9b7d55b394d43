// SPDX-License-Identifier: MIT
#include "sim/contact/describe_face.h"

#include <algorithm>
#include <cmath>

#include "sim/contact/face_stand.h"
#include "sim/contact/fast.h"

namespace throng {

using narrowphase::Convex;
using narrowphase::Manifold;
using narrowphase::ManifoldPoint;
using narrowphase::Pose;

namespace {

constexpr double kOneNormal = 1.0 - 1e-12;  // cosine of the angle between two that are one
constexpr double kTouches = 0.02;           // of the smaller radius: nobody stands between them

/// m, the radius of a disc; 0 for a polygon.
double rounding(const Colliders& colliders, std::uint32_t row) {
  return is_disc(colliders, row) ? colliders.radius[row] : colliders.shape[row]->radius;
}

/// Sets what all points of one manifold share. Number after number: to copy it from one point to the other
/// would wait until all that was written before has left the processor.
void describe(const Colliders& colliders, const Touch& touch, const Surface& surface, const Vec& normal,
              PointContact& contact) {
  contact.normal = normal;
  contact.a = touch.a, contact.b = touch.b;
  contact.round_a = rounding(colliders, touch.pair.a);
  contact.round_b = touch.obstacle ? 0.0 : rounding(colliders, touch.pair.b);
  contact.friction = surface.friction;
  contact.restitution = surface.restitution;
}

/// Fills in what one point of a manifold adds. The point is midway between the surfaces: `own` puts it on
/// those of the bodies, as it turns with neither where they are far apart.
void place(PointContact& contact, const ManifoldPoint& point, const SolverBody& a, const SolverBody& b,
           const Vec& shift, bool about_a, bool about_b, bool own) {
  const Vec& n = contact.normal;
  const double half = 0.5 * point.separation;
  const Vec to_a = point.point - a.position, to_b = point.point - (b.position + shift);
  const bool round_a = own || contact.round_a > 0.0, round_b = own || contact.round_b > 0.0;
  contact.first_a = about_a ? Vec(0.0, 0.0) : round_a ? Vec(to_a - (contact.round_a + half) * n) : to_a;
  contact.first_b = about_b ? Vec(0.0, 0.0) : round_b ? Vec(to_b + (contact.round_b + half) * n) : to_b;
  contact.arm_a = contact.first_a + contact.round_a * n,
  contact.arm_b = contact.first_b - contact.round_b * n;
  contact.gap = point.separation - n.dot((b.position - a.position) + (contact.arm_b - contact.arm_a));
  set_masses(contact, a, b);
}

SolverBody moved(SolverBody body, const Vec& to) {
  body.position = to;
  return body;
}

/// What turns of the arms of a contact that was found when its bodies had turned by so much (rad), as they
/// begin.
void turn_back(PointContact& contact, double turn_a, double turn_b) {
  contact.first_a = turned(contact.first_a, -turn_a);
  contact.first_b = turned(contact.first_b, -turn_b);
}

/// Whether the two touch, or nearly so.
bool is_met(const Colliders& colliders, const Touch& touch, const Manifold& m) {
  const double near = kTouches * smaller_radius(colliders, touch);
  return std::ranges::any_of(std::span(m.points).first(static_cast<std::size_t>(m.count)),
                             [&](const ManifoldPoint& point) { return point.separation <= near; });
}

/// Whether an obstacle has a face there. A side of the domain's box is nothing else.
bool has_face(const Obstacles& obstacles, std::uint32_t row, const Vec& outward) {
  if (obstacles.is_side(row)) return true;
  return std::ranges::any_of(obstacles.part_at(row).normals,
                             [&](const Vec& normal) { return normal.dot(outward) > kOneNormal; });
}

/// Of whose face the normal is, `when` (s) the two meet, if that one turns far. Of two parallel faces that of
/// who is no impulse's to move, or else that on which the manifold was described.
Turner turner_of(const StepStart& start, const Touch& touch, const Manifold& m, double when, double dt) {
  const SolverBody &a = start.bodies[touch.a], &b = start.bodies[touch.b];
  const bool far_a = turns_far(a.spin, dt), far_b = turns_far(b.spin, dt);
  if (!(far_a || far_b) || !is_met(start.colliders(), touch, m)) return {};
  const auto face = [&](Turner::Body whose, std::uint32_t collider, double spin,
                        std::uint32_t row) -> Turner {
    if (is_disc(start.colliders(), collider)) return {};
    const Convex& shape = *start.colliders().shape[collider];
    const Pose at = narrowphase::pose(Vec(0.0, 0.0), start.state.angle[row] + when * spin);
    const Vec outward = whose == Turner::Body::a ? m.normal : Vec(-m.normal), along = tangent(m.normal);
    for (std::size_t e = 0; e < shape.normals.size(); ++e) {
      if (at.rotate(shape.normals[e]).dot(outward) <= kOneNormal) continue;
      const double tail = along.dot(at.rotate(shape.vertices[e]));
      const double head = along.dot(at.rotate(shape.vertices[(e + 1) % shape.vertices.size()]));
      return {whose,       std::min(tail, head), std::max(tail, head), turned(m.normal, -when * spin),
              touch.shift, when * spin};
    }
    return {};
  };
  const Turner of_a = face(Turner::Body::a, touch.pair.a, a.spin, touch.a);
  const Turner of_b = touch.obstacle ? Turner{} : face(Turner::Body::b, touch.pair.b, b.spin, touch.b);
  const bool face_b = touch.obstacle ? has_face(start.obstacles(), touch.pair.b, Vec(-m.normal))
                                     : of_b.body != Turner::Body::none;
  const bool rather_b =
      a.is_dynamic() != b.is_dynamic() ? a.is_dynamic() : narrowphase::reference_is_b(m.points[0].feature);
  const bool is_b = face_b && (of_a.body == Turner::Body::none || rather_b);
  return is_b ? (far_b ? of_b : Turner{}) : (far_a ? of_a : Turner{});
}

}  // namespace

std::span<PointContact> describe_face(const StepStart& start, const Touch& touch, const Surface& surface,
                                      const Manifold& m, const LookAhead::Meeting* meeting, double dt,
                                      std::array<PointContact, 2>& points) {
  const Colliders& colliders = start.colliders();
  const bool about_a = is_disc(colliders, touch.pair.a);
  const bool about_b = !touch.obstacle && is_disc(colliders, touch.pair.b);
  const SolverBody &a = start.bodies[touch.a], &b = start.bodies[touch.b];
  const auto count = static_cast<std::size_t>(m.count);
  const Turner turner = turner_of(start, touch, m, meeting ? meeting->when : 0.0, dt);
  const bool of_side = is_side(start, touch);
  for (std::size_t p = 0; p < count; ++p) {
    describe(colliders, touch, surface, m.normal, points[p]);
    points[p].is_second = p > 0, points[p].turner = turner;
    if (meeting) {
      place(points[p], m.points[p], moved(a, meeting->at_a), moved(b, meeting->at_b), touch.shift, about_a,
            about_b, true);
      turn_back(points[p], meeting->when * a.spin, meeting->when * b.spin);
    } else {
      place(points[p], m.points[p], a, b, touch.shift, about_a, about_b,
            of_side || turner.body != Turner::Body::none);
    }
  }
  return {points.data(), count};
}

}  // namespace throng
