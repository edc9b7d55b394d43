// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "sim/contact/buckets.h"
#include "sim/contact/candidates.h"
#include "sim/contact/contacts.h"

namespace throng {

/// Contacts of discs about their bodies' centres: all candidates, since each substep finds anew how far apart
/// two are.
class DiscFinder {
 public:
  DiscFinder(const Scene& scene, const Plan& plan) : scene_(scene), plan_(plan) {}

  /// Replaces those of `contacts` by those pairs, which ascend. Expects its strips to be cut.
  void find(std::span<const broadphase::Pair> pairs, const Candidates& candidates, const State& state,
            std::span<const SolverBody> bodies, Contacts& contacts, Workers& workers);

 private:
  DiscContact contact(const Colliders& colliders, broadphase::Pair pair,
                      std::span<const SolverBody> bodies) const;
  void look_up(std::span<const broadphase::Pair> pairs, const Colliders& colliders, const State& state,
               Contacts& contacts, Workers& workers);

  const Scene& scene_;
  const Plan& plan_;
  std::vector<const ContactImpulse*> kept_;  // of each pair: what it has of the last step, or null
  std::vector<std::uint8_t> group_;
  Buckets of_group_;
};

}  // namespace throng
