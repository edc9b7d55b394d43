// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "broadphase/box_index.h"
#include "broadphase/disc_pairs.h"
#include "sim/colliders.h"
#include "sim/plan.h"
#include "sim/state.h"

namespace throng {

/// Broadphase: who may touch whom within the step.
class Candidates {
 public:
  Candidates(const Scene& scene, const Plan& plan);

  /// Replaces all pairs by those of the step that begins with `state`. Allocates only to grow.
  void find(const State& state);

  /// Rows of colliders, a < b, ascending. Parts of one body are no pair, nor are two bodies that nothing can
  /// push.
  std::span<const broadphase::Pair> pairs() const { return pairs_; }

  /// Collider a, row b of the obstacles, ascending.
  std::span<const broadphase::Pair> obstacle_pairs() const { return obstacle_pairs_; }

  /// How far apart (m) the two may be now and still touch within the step.
  double reach(broadphase::Pair pair) const { return margin_[pair.a] + margin_[pair.b]; }
  double reach(std::uint32_t collider) const { return margin_[collider]; }

  /// Where the image of b that is nearest to a stands, from b (m). Zero in domains that don't repeat.
  Vec shift(broadphase::Pair pair) const;

  const Colliders& colliders() const { return colliders_; }
  const Obstacles& obstacles() const { return obstacles_; }

 private:
  void place(const State& state);
  void drop_own_parts();
  void find_obstacle_pairs();
  void add_box_sides(std::uint32_t collider);

  const Scene& scene_;
  const Plan& plan_;
  Colliders colliders_;
  Obstacles obstacles_;
  broadphase::BoxIndex index_;
  broadphase::DiscPairs disc_pairs_;
  broadphase::Period period_;
  std::vector<Vec> centre_;     ///< m, world, of each collider's bounding disc
  std::vector<double> margin_;  ///< m, how far it may get within the step
  std::vector<double> reach_;   ///< m, its radius and margin
  std::vector<broadphase::Pair> pairs_, obstacle_pairs_;
};

}  // namespace throng
