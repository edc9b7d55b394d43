// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "sim/contact/body_rows.h"
#include "sim/contact/candidates.h"
#include "sim/contact/disc_blocks.h"
#include "sim/contact/parts.h"

namespace throng {

/// Which contacts of two discs the solver looks at, and where in its blocks they sit. Seats outlive the step
/// where bodies are slow: that saves most of the work, and changes no bit.
class DiscFinder {
 public:
  DiscFinder(const Scene& scene, const Plan& plan);

  /// The contacts in `discs` are now those with these keys, ascending, with the impulses that `state` keeps.
  /// Expects that only this function changes the seats of `discs`. `moved`: somebody is in another part than
  /// before. O(pairs near each other).
  void find(const Candidates& candidates, const State& state, BodyRows<const SolverBody> bodies,
            const Parts& parts, bool moved, std::span<const std::uint64_t> keys, DiscBlocks& discs,
            Workers& workers);

  /// Of two discs about their bodies' centres; normal and offset are found in each substep.
  DiscContact contact_of(const Colliders& colliders, broadphase::Pair pair,
                         BodyRows<const SolverBody> bodies) const;

 private:
  static constexpr int kGain = 3;  // steps that seats must serve to be worth some room

  void choose(const Candidates& candidates);
  void seat(const Colliders& colliders, BodyRows<const SolverBody> bodies, const Parts& parts,
            DiscBlocks& discs);

  const Scene& scene_;
  const Plan& plan_;
  std::vector<broadphase::Pair> seated_;  // who has a seat, ascending
  int age_ = kGain;                       // steps that these seats served
  int wait_ = 0;                          // steps in which seats are for one step alone
};

}  // namespace throng
