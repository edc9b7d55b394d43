// SPDX-License-Identifier: MIT
#pragma once

#include "narrowphase/linkage/linkage_motion.h"
#include "narrowphase/motion/bisect.h"

/// Do robots collide, standing or on the way, with obstacles, with one another, with themselves?
namespace throng::narrowphase {

/// All of it the caller's, who keeps it. Configurations are expected within the linkage's limits, which
/// keep apart the pairs that `pairs_to_check` leaves out: strangers' are asked by `beyond_limits`, the ends
/// of motions by an assert.
struct LinkageScene {
  std::span<const Link> linkage;
  std::span<const LinkPair> pairs;      ///< those that may not touch: see `pairs_to_check`
  const PartsBvh* obstacles = nullptr;  ///< the parts of all of them, in the world's frame; null: none
};

/// The shapes of a pair. Expects obstacles where the pair has them.
inline std::pair<const PartsBvh*, const PartsBvh*> shapes(const LinkageScene& scene, const LinkPair& pair) {
  return {scene.linkage[pair.a].shape, pair.b == kWorld ? scene.obstacles : scene.linkage[pair.b].shape};
}

/// Two links, or a link and an obstacle.
struct LinkContact {
  LinkPair pair;
  std::uint32_t part_a, part_b;  ///< of the links' shapes; part_b of the obstacles' where b is kWorld
  Separation separation;         ///< as `separation` says
};

/// About a path or a segment of it.
struct LinkageAnswer {
  Verdict verdict = Verdict::free;
  std::uint32_t segment = 0;             ///< where the rest is; 0 if free
  double from = 0.0, to = 0.0;           ///< in the segment, from 0 to 1: see who answers
  LinkPair pair{kWorld, kWorld};         ///< hit, or in doubt
  std::uint32_t part_a = 0, part_b = 0;  ///< hit: as in LinkContact
  std::size_t evaluations = 0;           ///< distances of pairs, or bounds of them
};

/// How far a pair has come in the search for the first contact.
struct FirstContactProgress {
  double time;              ///< nothing that isn't in doubt touches up to here
  std::size_t evaluations;  ///< so far
};

/// For a planner's millions of questions: keeps what it works with, allocates only to grow. One a thread.
class LinkageChecker {
 public:
  explicit LinkageChecker(const LinkageScene& scene) : scene_(scene) {}
  const LinkageScene& scene() const { return scene_; }

  /// The first of the pairs that touch, if any does. About 200 ns a pair in the open.
  std::optional<LinkContact> contact(std::span<const double> values);

  /// The pair that is nearest to each other, or deepest in each other. None where there are no pairs.
  std::optional<LinkContact> nearest(std::span<const double> values);

  /// Whether the straight line between two configurations is free, exactly, by `bisect`: neighbourhoods that
  /// distances and `LinkageMotion::bounds` prove free cover it (Schwarzer, Saha and Latombe 2005). Hit: the
  /// pair touches at from = to, mostly not for the first time. Undecided: from `from` to `to` it comes within
  /// options.epsilon or what rounding decides, 2^-34 of the smaller of the two or about 1e-13 of all lengths.
  /// options.covering names a pair by its place in scene.pairs, on a path plus scene.pairs.size() times its
  /// segment.
  LinkageAnswer check_motion(std::span<const double> from, std::span<const double> to,
                             const BisectOptions& options = {});

  /// The same of a path: `waypoints` are configurations one behind the other, two or more. All segments at
  /// once, where a contact is most likely first; stops at the first hit found.
  LinkageAnswer check_path(std::span<const double> waypoints, const BisectOptions& options = {});

  /// The same, each segment answered: expects one of `answers` a segment. Returns the first of the worst.
  LinkageAnswer check_path(std::span<const double> waypoints, const BisectOptions& options,
                           std::span<LinkageAnswer> answers);

  /// When the first of the pairs touches. Hit: nothing touches before `from`, certain with rounding, and the
  /// pair touches at `to`; in between the two move no farther than `width` (m), or than what rounding
  /// decides, about 1e-13 of all lengths, unless they meet so slowly that rounding alone takes longer.
  /// `from` may be earlier than that where another pair's hit or doubt begins sooner. Undecided: nothing
  /// touches before `from`; from there to `to` the pair may touch by that little, or it was asked 10,000
  /// times and got no farther, and no hit was found: later doubts aren't told, nor what follows where a pair
  /// was given up. Each pair advances by `safe_time` on its own, the one that lags behind first: grazing
  /// paths cost as in check_motion.
  LinkageAnswer first_contact(std::span<const double> from, std::span<const double> to, double width = 0.0);

 private:
  void place(std::span<const double> values);
  Pose pose(std::uint32_t link) const { return link == kWorld ? Pose{} : poses_[link]; }
  std::optional<LinkContact> contact_of(const LinkPair& pair) const;
  void find_nearer(const LinkPair& pair, std::optional<LinkContact>& best) const;
  void begin();
  void add_segment(std::span<const double> from, std::span<const double> to);
  void add_path(std::span<const double> waypoints);
  LinkageAnswer named(const PathAnswer& answer) const;

  LinkageScene scene_;
  std::vector<Pose> poses_;
  std::vector<LinkageMotion> motions_;  ///< a segment each; those beyond segments_ are from longer paths
  std::size_t segments_ = 0;
  std::vector<PairBounds> bounds_;  ///< of each pair on each segment
  std::vector<PathAnswer> answers_;
  BisectScratch scratch_;
  std::vector<FirstContactProgress> progress_;
};

}  // namespace throng::narrowphase
