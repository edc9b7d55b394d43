// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "sim/contact/body_rows.h"
#include "sim/contact/bounce.h"
#include "sim/contact/contacts.h"
#include "sim/contact/face_stand.h"

namespace throng {

/// Which contacts of a step are to be looked at for bounces: at first those of two who may meet in the
/// substep, then all those of bodies that were struck. Costs what is looked at, and of the others a few
/// additions and a bit.
class BounceQueue {
 public:
  /// The contacts that a step lists among bounces. O(contacts).
  void start_step(const Contacts& contacts);

  /// Before the first sweep of a substep: waiting are all who may bounce or hit by the rule. O(contacts).
  void start(BodyRows<const SolverBody> bodies, const BounceRule& rule);
  /// Before further sweeps of it, after bodies have moved: waiting is who touches somebody that was struck.
  void go_on();

  /// Looks once at each contact that waits, discs' first, in their order, and at those further on of who is
  /// struck meanwhile; the contacts of two bodies at their points are looked at together. Contacts are
  /// prepared when they are first looked at since start() or go_on(), by the velocities of that moment, which
  /// a strike before may have changed. Returns whether any waits then.
  bool sweep(Contacts& contacts, BodyRows<SolverBody> bodies, const BounceRule& rule);

 private:
  /// A contact of two discs, or those of two bodies at points that stand one after the other.
  struct Entry {
    std::uint32_t a, b;
    std::uint32_t first, count;  // contacts
    double touch;  // m, from centre to centre where they touch: of discs in all, of points along the normal
    bool bounces = false;
    bool turns = false;  // a face of theirs turns far within the step
  };

  /// Of points.
  struct Reach {
    double of_a = 0.0, of_b = 0.0;  // m, how far from the bodies' centres they are
    Vec normal{0.0, 0.0};           // zero where there are several
  };

  bool discs_may_meet(std::size_t i, BodyRows<const SolverBody> bodies, const BounceRule& rule) const;
  bool points_may_meet(std::size_t i, BodyRows<const SolverBody> bodies, const BounceRule& rule) const;
  bool look_at(std::uint32_t entry, Contacts& contacts, BodyRows<SolverBody> bodies, const BounceRule& rule);
  void list(std::span<const DiscContact> contacts);
  void list(std::span<const PointContact> contacts);
  void note_strike(std::uint32_t body, BodyRows<const SolverBody> bodies);
  void join(BodyRows<const SolverBody> bodies);
  void wait_for(std::uint32_t body);
  bool was_struck(std::uint32_t body) const { return struck_in_[body] == phase_; }
  void wait(std::uint32_t entry) { waiting_[entry / 64] |= std::uint64_t{1} << entry % 64; }

  std::vector<Entry> entries_;
  std::size_t discs_ = 0;                  // how many of them are of discs
  std::vector<Reach> reaches_;             // of the others
  std::vector<std::uint64_t> waiting_;     // a bit an entry
  std::vector<std::uint64_t> prepared_;    // of each entry, in which phase
  std::vector<FaceStand> stands_;          // of each contact at a point, in that phase, where faces turn
  std::uint64_t phase_ = 0, substep_ = 0;  // counted from start() and go_on(); the substep's first phase
  std::vector<std::uint64_t> struck_in_;   // of each body, the phase
  std::vector<std::uint32_t> struck_;      // bodies, in this substep, each once
  bool joined_ = false;                    // whether these are of this step:
  std::vector<std::uint32_t> first_of_, of_body_;
};

}  // namespace throng
