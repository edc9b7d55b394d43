// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstdint>

#include "broadphase/pairs.h"
#include "narrowphase/manifold.h"
#include "sim/contact/block_order.h"
#include "sim/contact/body_rows.h"
#include "sim/contact/candidates.h"
#include "sim/contact/contact.h"
#include "sim/contact/contact_key.h"
#include "sim/plan.h"
#include "sim/scene.h"
#include "sim/state.h"

/// Candidates that aren't two discs about their bodies' centres: where they stand, and what of them touches.
namespace throng {

/// A step's beginning: who may touch whom, and where all are. `bodies` has a row for each body of `state`,
/// then one a group of contacts that stands for all obstacles.
struct StepStart {
  const Candidates& candidates;
  const State& state;
  BodyRows<const SolverBody> bodies;

  const Colliders& colliders() const { return candidates.colliders(); }
  const Obstacles& obstacles() const { return candidates.obstacles(); }
};

/// Two that may touch.
struct Touch {
  broadphase::Pair pair;         ///< colliders, or a collider and an obstacle
  std::uint32_t a, b;            ///< rows of their bodies; of an obstacle the one that stands for it
  bool obstacle;                 ///< the pair's b is one
  Vec shift;                     ///< m, to the image of b that is nearest to a
  bool held = false;             ///< has a lane of HeldFaces
  std::uint32_t lane = kNoLane;  ///< there, and of the solver's faces where it sits there

  std::uint64_t key() const { return key_of(pair, obstacle); }
};

/// Whether it is with a side of the domain's box.
inline bool is_side(const StepStart& start, const Touch& touch) {
  return touch.obstacle && start.obstacles().is_side(touch.pair.b);
}

/// m; of an obstacle it isn't known.
inline double smaller_radius(const Colliders& colliders, const Touch& touch) {
  const double a = colliders.radius[touch.pair.a];
  return touch.obstacle ? a : std::min(a, colliders.radius[touch.pair.b]);
}

/// How the two act on each other.
const Surface& surface_of(const Scene& scene, const Plan& plan, const Obstacles& obstacles,
                          const Touch& touch);

struct TouchPoses {
  narrowphase::Pose a, b;  ///< of b its image
};

TouchPoses touch_poses(const StepStart& start, const Touch& touch);

/// Where the two touch, or nearly do, if they stand there; by the face that `kept`, of the last step, names
/// while that is as good as the widest. What of it lies on a seam between two parts of one body is left out.
narrowphase::Manifold touch_manifold(const Candidates& candidates, const Touch& touch,
                                     const TouchPoses& poses, const ContactImpulse* kept);

}  // namespace throng
