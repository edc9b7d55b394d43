// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "narrowphase/disc_flight.h"
#include "sim/collisions.h"
#include "sim/contact/candidates.h"
#include "sim/contact/contact.h"
#include "sim/workers.h"

namespace throng {

/// A step of discs that keep all their energy and that nothing pulls: each flies straight until it meets
/// something, so the step is its collisions in the order of their times (Alder and Wainwright, J. Chem. Phys.
/// 31, 459, 1959). Exact up to rounding, whatever dt and substeps are; an elastic collision may rub
/// (Coulomb).
class Flights {
 public:
  Flights(const Scene& scene, const Plan& plan);

  /// Takes `bodies` through a step. False where some overlap by more than
  /// rounding, or collisions don't end: that is the solver's matter, and `bodies` are to be loaded anew.
  /// O(bodies + candidates + collisions log collisions). Collisions at one time come in the order of their
  /// pairs.
  bool fly(const Candidates& candidates, std::span<SolverBody> bodies, Workers& workers);

  const Collisions& collisions() const { return collisions_; }  ///< of the last fly()

  /// m, how far from where the candidates were found each body was that collided, at its collisions; of
  /// others 0.
  std::span<const double> farthest() const { return farthest_; }

 private:
  struct Collision {
    double time;          // s, since the step began
    std::uint32_t pair;   // of all: candidates' pairs, then those with obstacles
    std::uint32_t stamp;  // the collisions that its two bodies had had when it was foreseen

    bool operator>(const Collision& other) const {
      return time > other.time || (time == other.time && pair > other.pair);
    }
  };

  std::size_t count() const { return pairs_ + candidates_->obstacle_pairs().size(); }
  broadphase::Pair colliders(std::uint32_t pair) const;
  std::uint32_t body_a(std::uint32_t pair) const;
  std::uint32_t body_b(std::uint32_t pair) const;
  Vec place(std::uint32_t body, double time) const;
  Vec nearest(const Vec& way) const;
  Vec between(std::uint32_t pair, double time) const;
  narrowphase::DiscFlight flight(std::uint32_t pair, double now) const;
  Vec normal(std::uint32_t pair, double now) const;
  const Surface& surface(std::uint32_t pair) const;

  void ask_for(const broadphase::Pair& pair) const;
  bool foresee_all(Workers& workers);
  narrowphase::DiscFlight first_flight(const broadphase::Pair& pair) const;
  bool is_deep(double gap, std::uint32_t pair) const;
  void foresee(std::uint32_t pair, double now);
  void list_pairs_of_bodies();
  bool collide_all();
  void collide(std::uint32_t pair, double now);
  void foresee_of(std::uint32_t body, std::uint32_t collided, double now);
  void stop(std::uint32_t body, double now);
  void advance(std::uint32_t body, double time);

  const Scene& scene_;
  const Plan& plan_;
  const Vec half_period_;  // m
  const Candidates* candidates_ = nullptr;
  std::span<SolverBody> bodies_;
  std::uint32_t pairs_ = 0;             // of bodies; those with obstacles follow
  std::vector<double> first_;           // s, of each pair, when it meets if nothing comes between
  std::vector<Collision> heap_;         // the earliest first
  std::uint64_t listed_ = 0;            // the candidates' pairs that are listed below
  std::vector<std::uint32_t> begin_;    // of each body in of_body_, and the end
  std::vector<std::uint32_t> of_body_;  // its pairs
  std::vector<double> since_;           // s, when each body was where bodies_ says
  std::vector<std::uint32_t> had_;      // collisions of each body
  std::vector<double> farthest_;
  Collisions collisions_;
};

}  // namespace throng
