// SPDX-License-Identifier: MIT
#pragma once

#include "narrowphase/linkage/link_pairs.h"
#include "narrowphase/motion/clear_time.h"
#include "narrowphase/motion/motion.h"

namespace throng::narrowphase {

/// How a pair moves on a whole motion: seen by who turns at `seen_by` (rad), which no distance depends on.
struct PairBounds {
  double seen_by;         ///< rad by time 1
  GapRate rate;           ///< by time 1: no gap of the two changes faster
  double spin_a, spin_b;  ///< rad by time 1, of the links' frames
  double acceleration;    ///< m by time 1 squared, at most, of one origin relative to the other
};

/// A straight line in the space of configurations: every joint at a constant rate, time 0 at its first end
/// and 1 at its last. Joint values are not wrapped: 6.28 is a turn.
class LinkageMotion {
 public:
  /// Both as many values as links. O(links); allocates only to grow. `linkage` must live as long.
  void reset(std::span<const Link> linkage, std::span<const double> from, std::span<const double> to);

  /// Of all links. About 15 ns a link.
  void place(double time, std::span<Pose> poses) const;

  /// Of one link, seen from a link that it hangs on, or from the world. About 15 ns a link between the two.
  Pose pose(std::uint32_t link, double time, std::uint32_t seen_from = kWorld) const;

  /// Both of a pair at an instant, seen from their nearest common ancestor, and how they move as `bounds` see
  /// it: what `safe_time` asks for. O(arms between).
  struct Instant {
    Pose a, b;
    RelativeMotion motion;
  };
  Instant at(const LinkPair& pair, const PairBounds& bounds, double time) const;

  /// How fast the gap between the two can change and how they accelerate, at any time of the motion. A link
  /// moves with the arms that lead to it, each of which turns at an absolute rate: Omega_k, the sum of the
  /// joints' rates up to it, in which opposite joints cancel. Against obstacles that is
  ///   sum over arms k < i of |Omega_k| l_k, plus |Omega_i| r for a point r from link i's origin;
  /// an arm that a prismatic joint stretches moves its end by |Omega x arm + slide|, which is convex in time:
  /// the larger of both ends. Arms one behind the other that turn at one rate count as one, joined.
  /// Between two links, also of two robots, the arms that lead from one to the other count, seen by who turns
  /// at the rate that makes the sum least: the weighted median of their rates, or the
  /// spin of their nearest common ancestor where that is less. O(arms between) or O(1) against obstacles.
  PairBounds bounds(const LinkPair& pair);

  /// What rounding may do to a pair's gap, velocities' for the whole motion included: farther than that no
  /// point of two links is from where the motion has them. m. Grows with what was added up on the way, though
  /// it cancelled: an angle of 1e6 rad that a joint takes back has cost its digits.
  double slack() const { return slack_; }

 private:
  /// Arms one behind the other that turn as one, as they stand at time 0.
  struct Run {
    double spin = 0.0;    ///< rad by time 1
    Vec arm{0.0, 0.0};    ///< m
    Vec slide{0.0, 0.0};  ///< m by time 1
    double size = 0.0;    ///< m, the sum of the arms' lengths
    double slid = 0.0;    ///< m by time 1, the sum of the slides' lengths

    void join(const Run& arms);
    /// Of its end about its beginning, seen by who turns at that rate. m by time 1, and by time 1 squared.
    double speed(double seen_by) const;
    double acceleration(double seen_by) const;
  };
  struct LinkState {
    Vec arm{0.0, 0.0};    ///< m, in the parent's frame: the link's origin at time 0,
    Vec slide{0.0, 0.0};  ///< m, and what it goes by time 1
    double angle = 0.0;   ///< rad, absolute, at time 0
    double spin = 0.0;    ///< rad by time 1
    Run last;             ///< the arm that leads here,
    Run run;              ///< and those before it that turn as it
    double before = 0.0;  ///< the speed of the arms before `run`
    double bent = 0.0;    ///< and their acceleration
    double reach = 0.0;   ///< m, how far off the origin may be
    double error = 0.0;   ///< m, of the origin, by rounding
    double blur = 0.0;    ///< rad, of angle and spin, by their sums
  };
  /// A link's pose, and how fast its origin goes, seen from a link that it hangs on.
  struct Moving {
    Pose pose;
    Vec velocity{0.0, 0.0};  ///< m by time 1
  };
  static double turned_off(const LinkState& state);
  static LinkState hung(const Link& link, const LinkState& parent, double value, double change);
  Pose hung(std::uint32_t link, const Pose& parent, double time, std::uint32_t seen_from) const;
  Moving moving(std::uint32_t link, double time, std::uint32_t seen_from) const;
  void climb(std::uint32_t& link, double sign);
  PairBounds bounds(const LinkPair& pair, double seen_by) const;
  void collect_runs(LinkPair links, std::uint32_t ancestor);
  double median_spin(const LinkPair& links);
  double angle(std::uint32_t link) const { return link == kWorld ? 0.0 : states_[link].angle; }
  double spin(std::uint32_t link) const { return link == kWorld ? 0.0 : states_[link].spin; }

  std::span<const Link> linkage_;
  std::vector<LinkState> states_;
  std::vector<Run> runs_;                         ///< from one link to another, those of b's side from
  std::size_t first_of_side_ = 0;                 ///< here on
  std::vector<std::pair<double, double>> spins_;  ///< rad, and m that it weighs
  double slack_ = 0.0;
};

}  // namespace throng::narrowphase
