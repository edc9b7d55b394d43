// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "sim/contact/candidates.h"
#include "sim/contact/soft_bodies.h"
#include "sim/contact_row.h"

namespace throng {

/// Soft contacts of two discs. The point in which they touch is the middle of their overlap, so that angular
/// momentum is kept.
class SoftDiscs {
 public:
  SoftDiscs(const Scene& scene, const Plan& plan);

  /// The pairs of discs among the candidates of a step, and the springs that `state` has of them. Allocates
  /// only to grow. O(pairs).
  void find(const Candidates& candidates, const State& state, std::span<const SolverBody> bodies);

  /// Lists who is in contact in this substep, and adds how they push by the velocities of its beginning.
  void press(const SoftSubstep& now);

  /// The same by the velocities of the middle: what counts. The springs give where friction doesn't hold.
  void press_again(const SoftSubstep& now);

  /// Stretches the springs to the end of the substep, by the velocities of then.
  void finish(const SoftSubstep& now);

  void save(double h, State& state) const;  ///< impulses and springs, for the next step
  void list(const State& state, double h, std::span<const SolverBody> bodies,
            std::vector<ContactRow>& rows) const;
  const SoftSqueeze& squeeze() const { return squeeze_; }  ///< since find()

 private:
  struct Pair {
    std::uint32_t a, b;
  };

  struct Touch {  // 64 bytes
    Vec normal;   // from a to b
    SoftSprings springs;
    double depth;  // m, in the middle of the substep
    double force;  // N, along the normal
    std::uint32_t a, b, pair;
  };

  template <class Law>
  void press(const Law& law, const SoftSubstep& now);
  double arm(std::uint32_t body, double depth) const;
  SoftMotion motion(const Touch& touch, const auto& a, const auto& b) const;
  void push(const Touch& touch, const SoftForce& force, std::span<SoftPush> pushes) const;
  SoftSprings springs_of(const Touch& touch, const SoftMotion& moves, const SoftSubstep& now,
                         std::size_t& next) const;
  SoftSprings springs_after(const Touch& touch, const SoftSubstep& now) const;
  void recall(const State& state);
  void fetch(const Pair& pair, const SoftSubstep& now) const;
  Vec between(std::uint32_t pair, const SoftSubstep& now) const;
  void find_near(const SoftSubstep& now);

  static constexpr std::size_t kAhead = 12;  // pairs: what memory takes to answer

  const Scene& scene_;
  const Plan& plan_;
  std::vector<double> ratios_;  // damping ratio of each surface
  std::vector<double> radius_;  // m, of each body
  std::vector<Pair> pairs_;     // rows of bodies, in the order of the keys
  std::vector<std::uint64_t> keys_;
  std::vector<SoftPair> laws_;
  std::vector<Vec> shifts_;            // m, to the image of b; empty where the domain doesn't repeat
  std::vector<std::uint32_t> near_;    // pairs that may be in contact in this substep
  std::vector<Touch> touches_, last_;  // of this substep and of the one before, ascending by pair
  SoftSqueeze squeeze_;
};

}  // namespace throng
