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
#include "sim/contact/lone_bounce.h"
#include "sim/contact/parts.h"
#include "sim/free_fall.h"
#include "sim/workers.h"

namespace throng {

/// Which contacts of a step are to be looked at for bounces: at first those of two who may meet in the
/// substep, then all those of bodies that were struck. Costs what is looked at, and of the others a few
/// additions and a bit. Those of parts are swept at the same time, those that join parts after; the answer is
/// the same for any number of threads.
class BounceQueue {
 public:
  /// The contacts that a step lists among bounces. `parts` is asked until the next call, and nobody is to be
  /// placed anew until then. O(contacts).
  void start_step(const Contacts& contacts, const Parts& parts);

  /// Before the first sweep of a substep: waiting are all who may bounce or hit by the rule. O(contacts).
  void start(BodyRows<const SolverBody> bodies, const BounceRule& rule, Workers& workers);
  /// Before further sweeps of it, after bodies have moved: waiting is who hits somebody that was struck.
  /// Nobody bounces then.
  void go_on();

  /// Looks once at each contact that waits, group after group, in a group discs' first, in their order, and
  /// at those further on of who is struck meanwhile; the contacts of two bodies at their points are looked at
  /// together. Contacts are prepared when they are first looked at since start() or go_on(), by the
  /// velocities of that moment, which a strike before may have changed. Returns whether any waits then.
  bool sweep(Contacts& contacts, BodyRows<SolverBody> bodies, const BounceRule& rule, Workers& workers);

  /// At the end of a substep, by the rule of its beginning: two discs that bounced off each other, or a body
  /// off what doesn't move, do so when they meet, if nothing else strikes or presses them or is near.
  /// O(those).
  void land(Contacts& contacts, BodyRows<SolverBody> bodies, const FreeFall& free_fall,
            const BounceRule& rule);

  /// Calls f(row) for each body that was stopped by what it hit without a bounce since start().
  template <class F>
  void for_each_stopped(BodyRows<const SolverBody> bodies, F f) const {
    for (const Group& group : groups_)
      for (const std::uint32_t body : group.struck)
        if (strikes_[bodies.slot(body)].stopped) f(body);
  }

 private:
  /// A contact of two discs, or those of two bodies at points that stand one after the other.
  struct Entry {
    std::uint32_t a, b;
    std::uint32_t first, count;  // contacts
    double touch;  // m, from centre to centre where they touch: of discs in all, of points along the normal
    bool bounces = false;
    bool hits = false;
    bool turns = false;  // a face of theirs turns far within the step
  };

  /// Of points.
  struct Reach {
    double of_a = 0.0, of_b = 0.0;  // m, how far from the bodies' centres they are
    Vec normal{0.0, 0.0};           // zero where there are several
  };

  /// Two before they bounced off each other.
  struct Bounce {
    std::uint32_t entry;
    Velocities a, b;
  };

  /// Of a body, in a substep.
  struct Strikes {
    std::uint64_t phase = 0;  // of the last one
    bool again = false;       // it was struck more than once
    bool stopped = false;     // by what it hit without a bounce
  };

  /// The contacts of a part, or those that join parts. At its own lines of cache: threads write there.
  struct alignas(64) Group {
    std::vector<Entry> entries;
    std::size_t discs = 0;                       // how many of them are of discs
    std::vector<Reach> reaches;                  // of the others
    std::vector<std::uint64_t> acting, hitting;  // a bit an entry, of those that bounce or hit, and that hit
    std::vector<std::uint64_t> waiting;          // likewise, perhaps of others, too
    std::vector<std::uint64_t> prepared;         // of each entry, in which phase
    std::vector<std::uint32_t> struck;           // bodies, by its contacts first in this substep
    std::vector<Bounce> bounces;                 // in this substep, of who was struck for the first time
    std::vector<std::uint32_t> outward;  // in this sweep, at each strike, who has contacts that join parts

    void wait(std::uint32_t entry) { waiting[entry / 64] |= std::uint64_t{1} << entry % 64; }
    void mark();
  };

  static bool discs_may_meet(const Entry& entry, BodyRows<const SolverBody> bodies, const BounceRule& rule);
  static bool points_may_meet(const Entry& entry, const Reach& reach, BodyRows<const SolverBody> bodies,
                              const BounceRule& rule);
  static bool may_meet(const Group& group, std::uint32_t entry, BodyRows<const SolverBody> bodies,
                       const BounceRule& rule);
  void list(std::span<const DiscContact> contacts);
  void list(std::span<const PointContact> contacts);
  void join(BodyRows<const SolverBody> bodies);
  void sweep(Group& group, Contacts& contacts, BodyRows<SolverBody> bodies, const BounceRule& rule);
  void look_at(Group& group, std::uint32_t entry, Contacts& contacts, BodyRows<SolverBody> bodies,
               const BounceRule& rule);
  bool bounce_at(Group& group, std::uint32_t entry, Contacts& contacts, BodyRows<SolverBody> bodies,
                 const BounceRule& rule);
  template <class F>
  void for_groups(std::size_t n, bool shared, Workers& workers, F f);
  bool is_lone_bounce(const Group& group, std::uint32_t entry, BodyRows<const SolverBody> bodies) const;
  void note_strike(Group& group, std::uint32_t body, bool bounces, BodyRows<const SolverBody> bodies);
  bool wait_within_part(std::uint32_t body);
  void wait_across(std::uint32_t body);
  const std::vector<std::uint64_t>& asked(const Group& group) const {
    return stopping_ ? group.hitting : group.acting;
  }
  std::size_t count_waiting(const Group& group) const;
  bool is_far(const Group& group, std::uint32_t entry, BodyRows<const SolverBody> bodies,
              const BounceRule& rule, double before) const;
  bool nobody_is_near(std::uint32_t body, const Entry& but, double before, BodyRows<const SolverBody> bodies,
                      const BounceRule& rule) const;
  bool joins_parts(const Group& group) const { return groups_.size() > 1 && &group == &groups_.back(); }

  const Parts* parts_ = nullptr;
  std::vector<Group> groups_;
  std::vector<FaceStand> stands_;          // of each contact at a point, in that phase, where faces turn
  std::uint64_t phase_ = 0, substep_ = 0;  // counted from start() and go_on(); the substep's first phase
  std::vector<Strikes> strikes_;           // by slot of the body
  std::vector<Told> told_;                 // a buffer
  bool stopping_ = false;                  // since go_on()
  bool joined_ = false;                    // whether these are of this step:
  std::vector<std::uint32_t> first_of_, of_body_;  // those of a body in the group of its part, and, marked by
                                                   // the highest bit, those in the last one
};

}  // namespace throng
