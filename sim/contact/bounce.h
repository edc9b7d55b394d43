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
  double within;     ///< s: what would meet so soon bounces
  double threshold;  ///< m/s: what meets more slowly rests
  double hit_speed;  ///< m/s: what hits is stopped from then on, although it doesn't bounce
  Vec kick;          ///< m/s, what gravity adds to a dynamic body's velocity in the substep
};

/// When bodies were struck last: a contact of two who were not since it was looked at needn't be again.
class Strikes {
 public:
  /// To be called before the first sweep of a substep: all may meet. Allocates only to grow.
  void start(std::size_t bodies) { last_.resize(bodies), since_ = 0, first_ = ++sweep_; }
  /// Or before further ones, by another rule: who was struck since then may meet.
  void go_on() { since_ = first_, ++sweep_; }
  void next_sweep() { since_ = sweep_++; }

  bool may_meet(std::uint32_t a, std::uint32_t b) const { return std::max(last_[a], last_[b]) >= since_; }
  void strike(std::uint32_t body) { last_[body] = sweep_; }

 private:
  std::uint64_t sweep_ = 0, first_ = 0;  // of all substeps
  std::uint64_t since_ = 0;              // a sweep: who was struck earlier has been looked at since
  std::vector<std::uint64_t> last_;      // of each body, the sweep in which it was struck
};

/// Lets all bounce once that would meet so soon: one contact after the other, but those that two bodies have
/// with each other, one after the other in the list, as one impact where they have one normal. What doesn't
/// bounce is left to the sweeps, but for what hits: it is stopped at the other's surface, whatever other
/// surfaces of the scene do. The impulses for that are those of all its contacts at once, as call follows
/// call: projected Gauss-Seidel, of which none pulls in sum. To be called after prepare(), for what bounces
/// before gravity acts: then the flight after a bounce with e = 1 mirrors the one before, and energy stays.
/// Returns whether anything bounced: call again until nothing does. O(contacts), and that of a pair's squared
/// where these meet.
bool bounce(std::span<DiscContact> contacts, std::span<SolverBody> bodies, const BounceRule& rule,
            Strikes& strikes);
bool bounce(std::span<PointContact> contacts, std::span<SolverBody> bodies, const BounceRule& rule,
            Strikes& strikes);

}  // namespace throng
