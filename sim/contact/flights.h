// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "narrowphase/disc_flight.h"
#include "sim/collisions.h"
#include "sim/contact/body_rows.h"
#include "sim/contact/candidates.h"
#include "sim/contact/contact.h"
#include "sim/contact/meetings.h"
#include "sim/contact_row.h"
#include "sim/workers.h"

namespace throng {

/// A step of discs that keep all their energy and that nothing pulls: each flies straight until it meets
/// something, so the step is its collisions in the order of their times (Alder and Wainwright, J. Chem. Phys.
/// 31, 459, 1959). Exact up to rounding, whatever dt and substeps are; an elastic collision may rub
/// (Coulomb).
class Flights {
 public:
  Flights(const Scene& scene, const Plan& plan);

  /// Looks where all are after a step from `state`, of whose bodies `masses` has rows. False where some
  /// overlap by more than rounding, or collisions go on and on while no time does: that is the solver's
  /// matter. O(bodies + candidates + collisions log collisions). Collisions at one time come in the order of
  /// their pairs.
  bool fly(const Candidates& candidates, const State& state, BodyRows<const SolverBody> masses,
           Workers& workers);

  /// Brings `state` to where fly() looked. False where a body can't go on; that one is left where it got.
  bool land(State& state, Workers& workers);

  const Collisions& collisions() const { return collisions_; }  ///< of the last fly()

  /// The same one by one, where contacts are recorded, none of which presses at the end.
  std::span<const ContactRow> strikes() const { return strikes_; }

  /// How far those got that collided; all others fly straight.
  std::span<const Reached> reached() const { return reached_; }

 private:
  struct Collision {
    double time;          // s, since the step began
    std::uint32_t pair;   // of all: candidates' pairs, then those with obstacles
    std::uint32_t stamp;  // the collisions that its two discs had had when it was foreseen

    bool operator>(const Collision& other) const {
      return time > other.time || (time == other.time && pair > other.pair);
    }
  };

  /// A disc that has collided, since its last collision.
  struct Bent {
    SolverBody body;
    double since;        // s, when it was there
    double farthest;     // m, from where the candidates were found, at its collisions
    std::uint32_t disc;  // row of the colliders, as all discs here
    std::uint32_t had;   // collisions
  };

  static constexpr std::uint32_t kStraight = UINT32_MAX;

  std::size_t count() const { return pairs_.size() + candidates_->obstacle_pairs().size(); }
  bool is_pair(std::uint32_t pair) const { return pair < pairs_.size(); }
  broadphase::Pair discs(std::uint32_t pair) const;
  std::uint32_t had(std::uint32_t disc) const { return bent_of_[disc] == kStraight ? 0 : bent(disc).had; }
  std::uint32_t stamp(std::uint32_t pair) const;
  const Bent& bent(std::uint32_t disc) const { return bent_[bent_of_[disc]]; }
  Vec place(std::uint32_t disc, double time) const;
  const Vec& velocity(std::uint32_t disc) const;
  Vec nearest(const Vec& way) const;
  Vec between(const broadphase::Pair& pair, double time) const;
  narrowphase::DiscFlight flight(std::uint32_t pair, double now) const;
  Vec normal(std::uint32_t pair, double now) const;
  const Surface& surface(std::uint32_t pair) const;

  void begin(const Candidates& candidates, const State& state, BodyRows<const SolverBody> masses);
  bool foresee_all(Workers& workers);
  void look_at_obstacles(Workers& workers);
  bool foresee_first(std::uint32_t pair, const narrowphase::DiscFlight& flight);
  void foresee(std::uint32_t pair, double now);
  void list_pairs_of_discs();
  bool collide_all();
  void collide(std::uint32_t pair, double now);
  void list(std::uint32_t pair, const Vec& point, double impulse);
  void foresee_of(std::uint32_t disc, std::uint32_t collided, double now);
  void stop(std::uint32_t disc, double now);
  void advance(Bent& bent, double time);
  void reach();
  bool land_straight(State& state, std::size_t begin, std::size_t end) const;
  bool settle(State& state, std::size_t body) const;

  const Scene& scene_;
  const Plan& plan_;
  const Vec period_, half_period_;  // m
  const Candidates* candidates_ = nullptr;
  const State* state_ = nullptr;
  BodyRows<const SolverBody> masses_;
  std::span<const broadphase::Pair> pairs_;  // of discs; those with obstacles follow
  std::vector<StraightWay> straight_;        // of each disc, as the step begins
  std::vector<std::uint8_t> meetings_;       // which pairs are worth a look: see find_meetings()
  std::vector<narrowphase::DiscFlight> obstacle_flights_;
  std::vector<Collision> heap_;         // the earliest first
  std::uint64_t listed_ = 0;            // the candidates' pairs that are listed below
  std::vector<double> reach_;           // m, of each pair the sum of the radii
  std::vector<std::uint32_t> begin_;    // of each disc in of_disc_, and the end
  std::vector<std::uint32_t> of_disc_;  // its pairs
  std::vector<std::uint32_t> bent_of_;  // of each disc its row in bent_, or kStraight
  std::vector<Bent> bent_;
  std::vector<Reached> reached_;
  Collisions collisions_;
  std::vector<ContactRow> strikes_;
};

}  // namespace throng
