// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <vector>

#include "sim/contact/candidates.h"
#include "sim/contact/soft_bodies.h"
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

  /// Lists who is in contact in this substep, and adds how they push by the velocities of its beginning.
  void press(const SoftSubstep& now);

  /// The same by the velocities of the middle: what counts. The springs give where friction doesn't hold.
  void press_again(const SoftSubstep& now);

  /// Stretches the springs to the end of the substep, by the velocities of then. After that touches are told
  /// by save() and list(), ascending by key.
  void finish(const SoftSubstep& now);

  void save(double h, State& state) const;  ///< impulses and springs, for the next step
  /// `bodies` by row.
  void list(const State& state, double h, const SoftPlaces& places, std::span<const SolverBody> bodies,
            std::vector<ContactRow>& rows) const;
  const SoftSqueeze& squeeze() const { return squeeze_; }  ///< since find()

 private:
  struct Pair {
    std::uint32_t a, b;  // places
  };

  struct Candidate {
    std::uint64_t key;
    broadphase::Pair colliders;
    Pair pair;
    std::uint32_t kept;  // which of the state's contacts it was, or kNone
  };
  static constexpr std::uint32_t kNone = 0xffffffff;

  struct Touch {  // 64 bytes
    Vec normal;   // from a to b
    SoftSprings springs;
    double depth;  // m, in the middle of the substep
    double force;  // N, along the normal
    std::uint32_t a, b, pair;
  };

  /// Pairs whose square roots and divisions are done beside each other, before anything waits for them.
  static constexpr std::size_t kBatch = 64;
  using Batch = std::array<Touch, kBatch>;

  template <class Law>
  void press(const Law& law, const SoftSubstep& now);
  template <class Law>
  void press(const Law& law, Touch touch, const SoftSubstep& now, std::size_t& next);
  double arm(std::uint32_t body, double depth) const;
  SoftMotion motion(const Touch& touch, const auto& a, const auto& b) const;
  void push(const Touch& touch, const SoftForce& force, std::span<SoftPush> pushes) const;
  SoftSprings springs_of(const Touch& touch, const SoftMotion& moves, const SoftSubstep& now,
                         std::size_t& next) const;
  SoftSprings springs_after(const Touch& touch, const SoftSubstep& now) const;
  void list_candidates(const Candidates& candidates, const State& state, const SoftPlaces& places);
  void sort_candidates(std::size_t places);
  void add(const Candidate& candidate, const Candidates& candidates, const SoftPlaces& places,
           std::span<const SolverBody> bodies);
  Vec between(std::size_t pair, const SoftSubstep& now) const;
  std::size_t find_near(std::size_t first, std::size_t last, const SoftSubstep& now, Batch& batch) const;

  const Scene& scene_;
  const Plan& plan_;
  std::vector<double> ratios_;             // damping ratio of each surface
  std::vector<double> radius_;             // m, by place
  std::vector<Candidate> found_, sorted_;  // ascending by key; by the lower place, then the key
  std::vector<std::uint32_t> start_;       // of each place's, in `sorted_`
  std::vector<Pair> pairs_;                // as `sorted_`
  std::vector<SoftPair> laws_;
  std::vector<Vec> shifts_;            // m, to the image of b; empty where the domain doesn't repeat
  std::vector<Touch> touches_, last_;  // of this substep and of the one before, ascending by pair
  SoftSqueeze squeeze_;
};

}  // namespace throng
