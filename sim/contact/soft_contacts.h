// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "sim/contact/soft_discs.h"
#include "sim/contact/soft_places.h"
#include "sim/contact/soft_solids.h"
#include "sim/rows.h"

namespace throng {

/// A step of discs that give way where they touch, as granular physics has it: springs, dashpots and
/// Coulomb's law (LAMMPS calls it gran/hooke/history and gran/hertz/history).
///
/// Verlet's method (Phys. Rev. 159, 98, 1967) with positions in the lead: half a substep's way, a substep's
/// forces, half a way. Dashpots need the velocity of the middle, which the forces by that of the beginning
/// foretell. Second order, also in what dashpots take, and complete in State.
class SoftContacts {
 public:
  SoftContacts(const Scene& scene, const Plan& plan);

  /// Takes `bodies`, a row each and one for all obstacles, through the step that begins with `state`. One
  /// thread. O(substeps (bodies + candidates)); allocates only to grow.
  void run(const Candidates& candidates, const State& state, std::span<SolverBody> bodies);

  /// m, how far each body was at most from where the step began.
  std::span<const double> farthest() const { return farthest_; }

  /// Throws SimulationError where a body got farther in a substep than the smallest disc's radius, and so may
  /// have passed others unseen, or two were so deep in each other that no spring tells the inside from the
  /// outside. `state`: that of the step's beginning.
  void check(const State& state) const;

  void save(State& state) const;  ///< impulses and springs, for the next step

  /// Replaces `rows` by the contacts that press, as list_contacts() has them.
  void list(const State& state, std::span<const SolverBody> bodies, std::vector<ContactRow>& rows) const;

 private:
  void take(const State& state, std::span<const SolverBody> bodies);
  void give_back(std::span<SolverBody> bodies);
  void start();
  void substep(const SoftSubstep& now);
  void foretell(std::uint32_t begin, std::uint32_t end);
  void watch_speed();
  void check_speed(const State& state) const;
  std::string name(const State& state, std::uint32_t place) const;
  void kick_and_drift(std::uint32_t begin, std::uint32_t end, double time);

  const Scene& scene_;
  const double h_;     // s
  const double most_;  // m/s, beyond which a body may pass others unseen
  const bool gravity_;
  SoftDiscs discs_;
  SoftSolids solids_;
  SoftPlaces places_;
  std::vector<SolverBody> bodies_;  // these four by place
  std::vector<SoftPush> pushes_;
  std::vector<SoftSpeed> speeds_;
  std::vector<SoftWay> ways_;
  std::vector<double> farthest_;  // by row
  double fastest2_ = 0.0;         // m²/s²
  std::uint32_t fast_ = 0;        // place of the first in a step who was too fast
  double too_fast_ = 0.0;         // m/s, his speed; 0 where nobody was
};

}  // namespace throng
