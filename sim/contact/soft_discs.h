// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "sim/contact/candidates.h"
#include "sim/contact/soft_blocks.h"
#include "sim/contact/soft_places.h"
#include "sim/contact_row.h"

namespace throng {

/// Soft contacts of two discs. The point in which they touch is the middle of their overlap, so that angular
/// momentum is kept.
class SoftDiscs {
 public:
  SoftDiscs(const Scene& scene, const Plan& plan);

  /// The pairs of discs among the candidates of a step, and the springs that `state` has of them. `bodies` by
  /// place. Allocates only to grow. O(pairs).
  void find(const Candidates& candidates, const State& state, const SoftPlaces& places,
            std::span<const SolverBody> bodies);

  std::size_t blocks() const { return blocks_.size(); }

  /// The places before this one are in none of the blocks from `block` on.
  std::uint32_t lowest(std::size_t block) const { return lowest_[block]; }

  /// The blocks before this one, which is `block` or later, have only places before `place`.
  std::size_t block_of(std::size_t block, std::uint32_t place) const;

  /// Finds who is in contact in this substep, and adds how they push by the velocities of its beginning. Of
  /// some blocks.
  void press(const SoftSubstep& now, std::size_t begin, std::size_t end);

  /// The same by the velocities of the middle: what counts. The springs give where friction doesn't hold.
  void press_again(const SoftSubstep& now, std::size_t begin, std::size_t end);

  /// Stretches the springs to the end of the substep, by the velocities of then.
  void finish(const SoftSubstep& now);

  void save(double h, State& state) const;  ///< impulses and springs, for the next step
  /// `bodies` by row.
  void list(const State& state, double h, const SoftPlaces& places, std::span<const SolverBody> bodies,
            std::vector<ContactRow>& rows) const;
  const SoftSqueeze& squeeze() const { return squeeze_; }  ///< since find()

 private:
  struct Candidate {
    std::uint64_t key;
    broadphase::Pair colliders;
    std::uint32_t a, b;          // places
    const ContactImpulse* kept;  // of the state; null where they didn't press
    std::uint32_t seat;          // a lane of some block
  };

  void list_candidates(const Candidates& candidates, const State& state, const SoftPlaces& places);
  void seat_candidates(std::size_t bodies);
  void fill_blocks(const Candidates& candidates, const SoftPlaces& places,
                   std::span<const SolverBody> bodies);
  void find_reaches(std::size_t bodies);
  SoftPair law_of(std::uint32_t a, std::uint32_t b, const SoftPlaces& places,
                  std::span<const SolverBody> bodies) const;

  const Scene& scene_;
  const Plan& plan_;
  const SoftLaw law_;
  std::vector<double> ratios_;          // damping ratio of each surface
  std::vector<Candidate> candidates_;   // ascending by key
  std::vector<std::uint32_t> next_;     // seat for a pair whose lower place is this
  std::vector<SoftBlock> blocks_;       // by the lower place, then the key
  std::vector<std::uint32_t> lowest_;   // place in each block, and a place behind all
  std::vector<std::uint32_t> highest_;  // in each block and all before
  std::vector<SoftShifts> shifts_;      // as the blocks; empty where the domain doesn't repeat
  SoftSqueeze squeeze_;
};

}  // namespace throng
