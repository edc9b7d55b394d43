// SPDX-License-Identifier: MIT
#pragma once

#include "narrowphase/linkage/link_pairs.h"
#include "narrowphase/motion/motion.h"

namespace throng::narrowphase {

/// A straight line in the space of configurations: every joint at a constant rate, time 0 at its first end
/// and 1 at its last. Joint values are not wrapped: 6.28 is a turn.
class LinkageMotion {
 public:
  /// Both as many values as links. O(links); allocates only to grow. `linkage` must live as long.
  void reset(std::span<const Link> linkage, std::span<const double> from, std::span<const double> to);

  /// Of all links. About 15 ns a link.
  void place(double time, std::span<Pose> poses) const;

  /// Of one link: what `place` says, to the bit. About 15 ns a link between it and the world.
  Pose pose(std::uint32_t link, double time) const;

  /// How fast the gap between the two can change, at any time of the motion. A link moves with the arms that
  /// lead to it, each of which turns at an absolute rate: Omega_k, the sum of the joints' rates up to it, in
  /// which opposite joints cancel. Against obstacles that is
  ///   sum over arms k < i of |Omega_k| l_k, plus |Omega_i| r for a point r from link i's origin;
  /// an arm that a prismatic joint stretches moves its end by |Omega x arm + slide|, which is convex in time:
  /// the larger of both ends. Arms one behind the other that turn at one rate count as one, joined.
  /// Between two links, also of two robots, the arms that lead from one to the other count, seen by who turns
  /// at the rate that makes the sum least: the weighted median of their rates, or the
  /// spin of their nearest common ancestor where that is less. O(arms between) or O(1) against obstacles.
  GapRate rate(const LinkPair& pair);

  /// What rounding may move a point of any link from where the motion has it, summed over both of a pair. m.
  double slack() const { return slack_; }

 private:
  /// Arms one behind the other that turn as one.
  struct Run {
    double spin = 0.0;                   ///< rad
    Vec arm{0.0, 0.0}, slide{0.0, 0.0};  ///< m at time 0, and m by time 1, as they are turned at time 0
    double size = 0.0, slid = 0.0;       ///< m, the sums of the arms' and the slides' lengths

    void join(const Run& arms);
    double speed(
        double seen_by) const;  ///< m, of its end about its beginning, seen by who turns at that rate
  };
  struct LinkState {
    Vec arm{0.0, 0.0},
        slide{0.0, 0.0};              ///< m, in the parent's frame: the origin goes from arm to arm + slide
    double angle = 0.0, spin = 0.0;   ///< rad, absolute, at time 0 and by time 1
    Run last, run;                    ///< the arm that leads here, and with all before it that turn as it
    double before = 0.0;              ///< m, what the arms before `run` move
    double reach = 0.0, error = 0.0;  ///< m, how far off the origin may be, and by rounding
  };
  static LinkState hung(const Link& link, const LinkState& parent, double value, double change);
  Pose hung(std::uint32_t link, const Pose& parent, double time) const;
  void climb(std::uint32_t& link, double sign);
  GapRate rate(const LinkPair& pair, double seen_by) const;
  void collect_runs(LinkPair links, std::uint32_t ancestor);
  double median_spin(const LinkPair& links);

  std::span<const Link> linkage_;
  std::vector<LinkState> states_;
  std::vector<Run> runs_;                         ///< from one link to another, those of b's side from
  std::size_t first_of_side_ = 0;                 ///< here on
  std::vector<std::pair<double, double>> spins_;  ///< rad, and m that it weighs
  double slack_ = 0.0;
};

}  // namespace throng::narrowphase
