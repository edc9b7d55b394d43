// SPDX-License-Identifier: MIT
#include "sim/contact/touch.h"

#include <span>

#include "narrowphase/half_plane.h"
#include "sim/contact/fast.h"

namespace throng {

using narrowphase::Convex;
using narrowphase::Manifold;
using narrowphase::ManifoldPoint;
using narrowphase::PlacedConvex;
using narrowphase::Pose;
using narrowphase::Reference;
using narrowphase::Rim;

namespace {

constexpr double kLittleWay =
    0.25;  // of the radius, to the step's middle: so little that nobody is beyond a wall

/// The face that described the contact of a and b in the last step.
Reference reference(const ContactImpulse* kept, const Convex& a, const Convex& b) {
  return kept ? narrowphase::reference(kept->feature, a, b) : Reference{};
}

/// What is left of the contact of a and b once one of them is a piece of its whole: a seam matters to what is
/// smaller than the part beside it.
Manifold on_outline_of_a(const Manifold& m, const PlacedConvex& a, const Rim& rim, const PlacedConvex& b,
                         double reach) {
  return rim.empty() ? m : on_outline(m, a, rim, b, reach, false);
}
Manifold on_outline_of_b(Manifold m, const PlacedConvex& a, const PlacedConvex& b, const Rim& rim,
                         double reach) {
  if (rim.empty()) return m;
  m.normal = -m.normal;
  m = on_outline(m, b, rim, a, reach, true);
  m.normal = -m.normal;
  return m;
}

const Rim& rim(const Colliders& colliders, std::uint32_t row) {
  static const Rim alone;
  return colliders.rim.empty() ? alone : colliders.rims[colliders.rim[row]];
}

/// m, of a disc along a wall that has corners, if that is little; else nothing.
Vec way_to_middle(const StepStart& start, const Touch& touch, double dt) {
  const std::size_t sides = start.obstacles().side.size();
  const Vec way = 0.5 * dt * start.bodies[touch.a].velocity;
  const bool along_corners = touch.obstacle && touch.pair.b >= sides &&
                             is_disc(start.colliders(), touch.pair.a) &&
                             !start.obstacles().rim[touch.pair.b - sides].empty();
  const bool is_little = way.norm() < kLittleWay * start.colliders().radius[touch.pair.a];
  return along_corners && is_little ? way : Vec(0.0, 0.0);
}

}  // namespace

const Surface& surface_of(const Scene& scene, const Plan& plan, const Obstacles& obstacles,
                          const Touch& touch) {
  const std::vector<std::uint32_t>& material = scene.bodies.material;
  return plan.surface(material[touch.a],
                      touch.obstacle ? obstacles.material[touch.pair.b] : material[touch.b]);
}

TouchPoses touch_poses(const StepStart& start, const Touch& touch) {
  const Pose pose_a = start.candidates.pose(start.state, touch.a);
  if (touch.obstacle) return {pose_a, Pose{touch.shift}};
  Pose pose_b = start.candidates.pose(start.state, touch.b);
  pose_b.position += touch.shift;
  return {pose_a, pose_b};
}

Manifold touch_manifold(const Candidates& candidates, const Touch& touch, const TouchPoses& poses,
                        const ContactImpulse* kept) {
  const Colliders& colliders = candidates.colliders();
  const auto [row_a, row_b] = touch.pair;
  const auto& [pose_a, pose_b] = poses;
  thread_local Convex disc_a = narrowphase::disc(1.0), disc_b = disc_a;
  const Convex& a = shape(colliders, row_a, disc_a);
  if (!touch.obstacle) {
    const Convex& b = shape(colliders, row_b, disc_b);
    const double reach = candidates.reach(touch.pair);
    const Manifold m = narrowphase::manifold(a, pose_a, b, pose_b, reach, reference(kept, a, b));
    return colliders.radius[row_a] >= colliders.radius[row_b]
               ? on_outline_of_a(m, {a, pose_a}, rim(colliders, row_a), {b, pose_b}, reach)
               : on_outline_of_b(m, {a, pose_a}, {b, pose_b}, rim(colliders, row_b), reach);
  }
  const Obstacles& obstacles = candidates.obstacles();
  const double reach = candidates.reach(row_a);
  const std::size_t sides = obstacles.side.size();
  if (row_b < sides) return narrowphase::manifold(a, pose_a, obstacles.side[row_b], reach);
  const Convex& part = obstacles.part[row_b - sides];
  return on_outline_of_b(narrowphase::manifold(a, pose_a, part, pose_b, reach, reference(kept, a, part)),
                         {a, pose_a}, {part, pose_b}, obstacles.rim[row_b - sides], reach);
}

Manifold manifold_in_step(const StepStart& start, const Touch& touch, double dt, const ContactImpulse* kept) {
  TouchPoses poses = touch_poses(start, touch);
  const Manifold at_first = touch_manifold(start.candidates, touch, poses, kept);
  const Vec way = way_to_middle(start, touch, dt);
  if (way == Vec(0.0, 0.0)) return at_first;
  poses.a.position += way;
  Manifold m = touch_manifold(start.candidates, touch, poses, kept);
  const double most = 0.5 * kAheadWay * start.colliders().radius[touch.pair.a];
  if (at_first.normal.dot(way) > most || m.normal.dot(way) > most) return at_first;
  for (ManifoldPoint& point : std::span(m.points).first(static_cast<std::size_t>(m.count)))
    point.point -= way, point.separation += m.normal.dot(way);
  return m;
}

}  // namespace throng
