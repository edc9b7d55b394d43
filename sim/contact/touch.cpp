// SPDX-License-Identifier: MIT
#include "sim/contact/touch.h"

#include "narrowphase/half_plane.h"

namespace throng {

using narrowphase::Convex;
using narrowphase::Manifold;
using narrowphase::PlacedConvex;
using narrowphase::Pose;
using narrowphase::Reference;
using narrowphase::Rim;

namespace {

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
  if (obstacles.is_side(row_b)) return narrowphase::manifold(a, pose_a, obstacles.side[row_b], reach);
  const Convex& part = obstacles.part_at(row_b);
  return on_outline_of_b(narrowphase::manifold(a, pose_a, part, pose_b, reach, reference(kept, a, part)),
                         {a, pose_a}, {part, pose_b}, obstacles.rim_at(row_b), reach);
}

}  // namespace throng
