// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "broadphase/box_index.h"
#include "narrowphase/convex.h"
#include "narrowphase/motion/motion.h"
#include "sim/contact/body_rows.h"
#include "sim/contact/candidates.h"
#include "sim/contact/contacts.h"
#include "sim/state.h"

namespace throng {

/// Bodies that got farther in a step than they were looked for, as they were struck in it: may they have met
/// somebody there with whom no contact is listed? Else the step needn't be taken again.
class Unseen {
 public:
  Unseen(const Candidates& candidates, double dt) : candidates_(candidates), dt_(dt) {}

  /// `bodies`: where the step that began with `state` brought them, and how fast they are there. Each is
  /// taken to go straight there, or with one bend: the distance from that is a quarter of what the change of
  /// its velocity makes of dt. Who was struck twice in the step may be missed on the way, not where it ends.
  /// Of two who are listed at one point of two it is asked whether the other one got in. True, without being
  /// asked, where the domain repeats, where somebody sleeps and wasn't placed, and where a stray got to no
  /// place that a run bears. O(n + strays and whom they came near).
  bool met(std::span<const Reached> strays, const State& state, BodyRows<const SolverBody> bodies,
           const Contacts& contacts);

 private:
  struct Step {
    const State& state;
    BodyRows<const SolverBody> bodies;
    const Contacts& contacts;
  };

  void index(std::span<const Reached> strays);
  bool met_another(const Step& step, std::uint32_t a, std::uint32_t b);
  bool sank(std::uint32_t collider, const narrowphase::Motion& way, const narrowphase::Convex& other,
            const narrowphase::Motion& other_way);
  bool met_obstacle(const Step& step, std::uint32_t collider);
  bool met_part(const Step& step, std::uint32_t collider, std::uint32_t row, const narrowphase::Convex& part);
  bool met_side(const Step& step, std::uint32_t collider, std::uint32_t side);
  broadphase::Box box(std::uint32_t collider) const;
  narrowphase::Motion motion(const Step& step, std::uint32_t collider) const;
  double arm(std::uint32_t collider) const;
  double bend(const Step& step, std::uint32_t collider) const;
  const narrowphase::Convex& widened(std::uint32_t collider, double by);

  const Candidates& candidates_;
  double dt_;                                // s
  std::vector<double> reach_;                // m, of each collider's bounding disc in the step
  std::vector<broadphase::Extent> extents_;  // of the strays
  broadphase::BoxIndex index_;
  narrowphase::Convex wide_, disc_ = narrowphase::disc(1.0), other_disc_ = narrowphase::disc(1.0);
};

}  // namespace throng
