// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "narrowphase/manifold.h"
#include "sim/contact/candidates.h"
#include "sim/contact/contacts.h"
#include "sim/contact/find_discs.h"
#include "sim/rows.h"
#include "sim/workers.h"

namespace throng {

/// Narrowphase: what the solver must look at among the candidates, with the impulses of the step before. A
/// pair whose contact pressed then keeps its reference face while that is as good as the widest.
class ContactFinder {
 public:
  ContactFinder(const Scene& scene, const Plan& plan);

  /// Replaces `contacts`. `bodies` has a row for each body of `state`, then one that stands for all
  /// obstacles; candidates are of those that are `awake`.
  void find(const Candidates& candidates, const State& state, std::span<const SolverBody> bodies, Rows awake,
            Contacts& contacts, Workers& workers);

 private:
  struct Touch {  // candidates of which one is no disc about its body's centre
    broadphase::Pair pair;
    bool obstacle;  // the pair's b is an obstacle
    Vec shift;      // m, to the image of b that is nearest to a
    std::span<const ContactImpulse> kept = {};
    std::uint32_t first_point = 0;  // among all points
    narrowphase::Manifold manifold = {};

    std::uint64_t key() const;
  };

  std::span<const broadphase::Pair> sort_out(const Candidates& candidates);
  void turn_shapes(const State& state, Rows awake, Workers& workers);
  void touch(const Candidates& candidates, const State& state, const Strips& strips, Workers& workers);
  void count_points(Contacts& contacts);
  narrowphase::Pose pose(const State& state, std::uint32_t body) const;
  narrowphase::Manifold manifold(const Candidates& candidates, const State& state, const Touch& touch) const;
  PointContact point_contact(const Colliders& colliders, const Obstacles& obstacles, const Touch& touch,
                             std::uint32_t obstacle_row) const;
  void add_points(const Candidates& candidates, std::span<const SolverBody> bodies, Contacts& contacts,
                  Workers& workers);
  void add_face(const Touch& touch, const PointContact& contact, const Colliders& colliders,
                std::span<const SolverBody> bodies, std::size_t group, Contacts& contacts) const;

  const Scene& scene_;
  const Plan& plan_;
  DiscFinder discs_;
  std::vector<broadphase::Pair> disc_pairs_;  // empty where there is nothing but discs
  std::vector<narrowphase::Pose> pose_;       // of each body; only where some are no discs
  std::vector<Touch> touches_;
  std::vector<std::uint8_t> group_;  // of each touch; those without a contact have the one behind all groups
  Buckets of_group_;
};

}  // namespace throng
