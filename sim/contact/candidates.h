// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "broadphase/box_index.h"
#include "broadphase/moving_pairs.h"
#include "sim/colliders.h"
#include "sim/contact/body_rows.h"
#include "sim/contact/contact.h"
#include "sim/plan.h"
#include "sim/rows.h"
#include "sim/state.h"
#include "sim/workers.h"

namespace throng {

/// How far a collider got from where it was found.
struct Reached {
  std::uint32_t collider;
  double way;  ///< m
};

/// Broadphase: who may touch whom within the step.
class Candidates {
 public:
  /// Shares out work among `workers`, which it keeps.
  Candidates(const Scene& scene, const Plan& plan, Workers& workers);

  /// Replaces all pairs by those of the dt (s) that begins with `state`. Allocates only to grow. Throws
  /// SimulationError where a body reaches infinitely far, or farther than a quarter of the period, since it
  /// could meet two images of another, and where nearly everybody could meet everybody in a large scene.
  void find(const State& state, double dt);

  /// The same in two parts, of those `colliders` alone, ascending, which the caller keeps for the step. First
  /// where they are and how far they get; then, of all of them, the pairs.
  void place(const State& state, double dt, Rows colliders);
  void pair_up(const State& state, Rows colliders);

  /// Between the two: places more of them, none of which moves faster than the fastest.
  void place_more(const State& state, Rows colliders);

  /// Whether the discs round two that were placed may meet within the step, each larger by `room` of its
  /// radius.
  bool may_meet(broadphase::Pair pair, double room = 0.0) const;

  /// Whether the pairs that an earlier find() found serve as well for the dt that begins with `state`, unless
  /// somebody is turned aside: where `plan` has flights, which don't mind pairs too many, find() looks
  /// farther than a step. O(n).
  bool serve(const State& state, double dt) const;

  /// Who got farther from where find() found it than find() looked, in a step that brought `bodies` to where
  /// they are. `farthest` (m): how far from there each was on its way, where that is known; or empty. Valid
  /// until the next call. Where there are such, farthest_way() is unbounded from then on.
  std::span<const Reached> strays(BodyRows<const SolverBody> bodies, std::span<const double> farthest = {});

  /// Whether one of those that `reached` tells of got farther than find() looked. If so, the next find()
  /// looks far enough, round `all` bodies if asked for, and the step must be taken again.
  bool widen(std::span<const Reached> reached, bool all);

  /// Whether the domain repeats.
  bool repeats() const { return plan_.periodic; }

  /// Calls f(row) for every obstacle but the box's sides that touches the box, ascending.
  template <class F>
  void for_each_obstacle_near(const broadphase::Box& box, F&& f) const {
    if (!plan_.obstacles) return;
    const auto first = static_cast<std::uint32_t>(obstacles_.side.size());
    index_.for_each_near(box, [&](std::uint32_t item) { f(first + item); });
  }

  /// How far `position` is from where find() found the body, squared (m²); by the shorter way where the
  /// domain repeats.
  double squared_way(std::uint32_t body, const Vec& position) const;

  /// How often find() was called: pairs of one number are the same.
  std::uint64_t finds() const { return finds_; }

  /// The colliders that the pairs are of, ascending.
  Rows rows() const { return rows_; }

  /// Rows of colliders, a < b, ascending. Parts of one body are no pair, nor are two bodies that nothing can
  /// push.
  std::span<const broadphase::Pair> pairs() const { return pairs_; }

  /// Replaces `pairs` by pairs() and, where they are known, further ones of whom each may be farther away by
  /// `room` of its radius: who may be among pairs() soon. Ascending. O(pairs).
  void list_near(double room, std::vector<broadphase::Pair>& pairs) const;

  /// Collider a, row b of the obstacles, ascending.
  std::span<const broadphase::Pair> obstacle_pairs() const { return obstacle_pairs_; }

  /// How far apart (m) the two may be now and still touch within the step.
  double reach(broadphase::Pair pair) const { return reach(pair.a) + reach(pair.b); }
  double reach(std::uint32_t collider) const {
    return turning_.empty() ? margin_[collider] : margin_[collider] + turning_[collider];
  }

  /// The disc round a collider that was placed, with all that it may reach in the step: its centre, m, world,
  /// and radius (m).
  const Vec& centre(std::uint32_t collider) const { return centre_[collider]; }
  double outer_reach(std::uint32_t collider) const { return reach_[collider]; }

  /// How far the fastest of them gets within the step by its velocity (m).
  double chain() const { return chain_; }

  /// rad, how far the one that spins fastest, of those that aren't discs, turns in a step.
  double farthest_turn() const { return farthest_turn_; }

  /// How far the fastest body's velocity, gravity and the widest turn take any point within the step (m);
  /// infinite where bodies got farther.
  double farthest_way() const { return farthest_way_; }

  /// Where a body that was placed stands. Discs look the same from all sides: where there is nothing else,
  /// nobody has turned.
  narrowphase::Pose pose(const State& state, std::uint32_t body) const {
    return pose_.empty() ? narrowphase::Pose{state.position[body]} : pose_[body];
  }

  /// Where the image of b that is nearest to a stands, from b (m). Zero in domains that don't repeat.
  Vec shift(broadphase::Pair pair) const;

  /// The same for an obstacle that `collider` may touch.
  Vec obstacle_shift(std::uint32_t collider) const;

  const Colliders& colliders() const { return colliders_; }
  const Obstacles& obstacles() const { return obstacles_; }

 private:
  bool place_one(const State& state, std::uint32_t collider);
  bool reaches_too_far(std::uint32_t collider) const;
  void check_reach(const State& state, std::uint32_t collider) const;
  [[noreturn]] void fail_at_period(const State& state, std::uint32_t collider) const;
  void wrap_centre(std::uint32_t collider);
  void find_pairs_of(Rows colliders);
  void compare_all(const broadphase::Period* period);
  Vec wrap(std::uint32_t collider) const;
  void drop_own_parts();
  void find_obstacle_pairs();
  struct Widened {
    double longest = 0.0;  // m
    bool any = false;
  };
  void widen_one(std::uint32_t collider, double way, Widened& widened);
  bool keep(const Widened& widened, bool all);
  /// How much farther (m) its surface got by that `turn` (rad) than place() thought, which knew of no impact,
  /// and than half the way to its middle: so deep in another it isn't through, and is pushed out again.
  double swung(std::uint32_t collider, double turn) const;
  bool nears_box(std::uint32_t collider) const;
  void add_box_sides(std::uint32_t collider, std::vector<broadphase::Pair>& pairs) const;
  std::optional<double> way_astray(std::uint32_t collider, const SolverBody& body, double before) const;

  const Scene& scene_;
  const Plan& plan_;
  Workers& workers_;
  Colliders colliders_;
  Obstacles obstacles_;
  broadphase::BoxIndex index_;
  broadphase::MovingPairs disc_pairs_;
  broadphase::Period period_;
  std::uint64_t finds_ = 0;
  Rows rows_;                            ///< of the colliders that the pairs are of
  double dt_ = 0.0, fall_ = 0.0;         ///< s; m, what gravity gives in it
  double chain_ = 0.0;                   ///< m, what the fastest body moves in it
  double farthest_turn_ = 0.0;           ///< rad, likewise
  double farthest_way_ = 0.0;            ///< m
  std::vector<Vec> found_at_;            ///< m, of each body
  std::vector<narrowphase::Pose> pose_;  ///< of each body; empty where all are discs
  std::vector<Vec> centre_;      ///< m, world, of each collider's bounding disc; inside a domain that repeats
  std::vector<Vec> wrap_;        ///< m, what that moved it by; empty where it moves nothing
  std::vector<double> margin_;   ///< m, how far that disc may get within the step
  std::vector<double> turning_;  ///< m, how much farther turning may bring its surface; empty for discs
  std::vector<double> reach_;    ///< m, its radius and margin
  std::vector<Reached> strays_;
  std::vector<std::vector<Reached>> stray_lists_;
  std::vector<double>
      widened_;  ///< m, the least margin of each body, while a step is taken again; else empty
  std::vector<broadphase::Pair> pairs_, obstacle_pairs_;
  std::vector<std::vector<broadphase::Pair>> pair_lists_;
  std::vector<Vec> some_centres_;  ///< as those above, of `rows_` alone where these are not all
  std::vector<double> some_reaches_;
  std::vector<std::uint8_t> some_movable_;
};

/// Why engine native can't take bodies through the first step, who reach farther in it than a quarter of a
/// periodic domain; empty where it can. O(n log n).
std::string period_refusal(const Scene& scene);

}  // namespace throng
