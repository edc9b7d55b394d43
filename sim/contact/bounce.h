// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "sim/contact/contact.h"

/// Bounces, before the sweeps of a substep: one pair after the other as in Guendelman, Bridson and Fedkiw
/// (2003), where bodies would meet in this substep.
namespace throng {

/// What of a substep bounces.
struct BounceRule {
  double h;          ///< s, the substep
  double threshold;  ///< m/s: what meets more slowly rests
  double hit_speed;  ///< m/s: what hits is stopped from then on, although it doesn't bounce
  Vec kick;          ///< m/s, what gravity adds to a dynamic body's velocity in the substep
};

/// When bodies were struck last: a contact of two who were not since it was looked at needn't be again.
class Strikes {
 public:
  /// To be called before the first sweep. O(bodies); allocates only to grow.
  void start(std::size_t bodies) { sweep_ = 1, last_.assign(bodies, 0); }
  void next_sweep() { ++sweep_; }

  bool may_meet(std::uint32_t a, std::uint32_t b) const { return std::max(last_[a], last_[b]) + 1 >= sweep_; }
  void strike(std::uint32_t body) { last_[body] = sweep_; }

 private:
  std::uint32_t sweep_ = 1;
  std::vector<std::uint32_t> last_;  // sweep in which it was struck
};

/// Lets all bounce once that would meet: one contact after the other, but those that two bodies have with
/// each other, one after the other in the list, as one impact where they have one normal. What doesn't bounce
/// is left to the sweeps, but for what hits: it is stopped at the other's surface, whatever other surfaces of
/// the scene do. To be called after prepare() and before gravity acts: then the flight after a bounce with e
/// = 1 mirrors the one before, and energy stays. Returns whether anything bounced: call again until nothing
/// does. O(contacts), and that of a pair's squared where these meet.
bool bounce(std::span<DiscContact> contacts, std::span<SolverBody> bodies, const BounceRule& rule,
            Strikes& strikes);
bool bounce(std::span<PointContact> contacts, std::span<SolverBody> bodies, const BounceRule& rule,
            Strikes& strikes);

}  // namespace throng
