// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "broadphase/box_index.h"
#include "sim/contact/body_rows.h"
#include "sim/contact/candidates.h"
#include "sim/contact/contacts.h"
#include "sim/contact_row.h"
#include "sim/islands.h"
#include "sim/plan.h"
#include "sim/rows.h"
#include "sim/state.h"

namespace throng {

/// Bodies at rest, which leave the loop. An island, dynamic bodies that contacts connect, falls asleep once
/// all of them have been slow for a while: what moves in them wouldn't lift them by 1e-5 of their radius, for
/// half a second and, where they are large, for 2.5 times as long as they would take to fall by half a
/// radius; and once it hasn't gained speed for a tenth of a second, as what begins to slide or to roll does.
/// Nobody sleeps beside a kinematic body that moves. The island stands still then, its contacts'
/// impulses are kept aside, and all of it wakes in the step in which something that is awake may touch one of
/// it, with those impulses.
///
/// What is asleep stands in `SleepState`; here is what follows from that. A scene whose plan has no sleep
/// pays nothing.
class Sleepers {
 public:
  Sleepers(const Scene& scene, const Plan& plan);

  /// To be called where a step begins with a state that no step of these sleepers left. O(bodies).
  void look(const State& state, Candidates& candidates);

  /// Those that are awake, or don't sleep at all.
  Rows bodies() const;
  Rows colliders(const Candidates& candidates) const;

  /// Wakes whoever may be touched in the step that begins with `state`, for which those awake are placed
  /// among the candidates, and whoever may be touched by them; places these too. O(awake + bodies if some
  /// wake).
  void wake(State& state, Candidates& candidates);

  /// Before where `row` is at a step's end gets into the state: who got on, though slow, as who is driven out
  /// of another does whom it overlaps, isn't calm.
  void watch(State& state, std::uint32_t row, const SolverBody& body) const;

  /// Counts for how long bodies have been slow in a step that ended with `state`, and its contacts with
  /// those `bodies`; every tenth of a second lets islands fall asleep. O(awake + bodies if some fall asleep).
  void settle(State& state, Candidates& candidates, const Contacts& contacts,
              BodyRows<const SolverBody> bodies);

 private:
  /// No sleeper comes nearer than `room` to that place (m).
  struct Clear {
    Vec at{0.0, 0.0};
    double room = -1.0;
  };

  /// Of an island: m²/s², summed over its bodies, at the look before and now.
  struct Motion {
    double bodies = 0.0, before = 0.0, now = 0.0;
  };

  /// m²/s², of who is slow.
  double most_calm(std::uint32_t body) const;
  bool is_dynamic(std::uint32_t body) const { return scene_.bodies.kind[body] == BodyKind::dynamic; }
  void list(const State& state, const Colliders& colliders);
  void index(const State& state, Candidates& candidates);
  void find_touched(const State& state, const Candidates& candidates, std::uint32_t collider);
  void rouse(State& state, const Colliders& colliders);
  bool count_calm(State& state) const;
  void connect(const State& state, const Colliders& colliders, std::span<const std::uint64_t> keys);
  void find_islands(const State& state, const Colliders& colliders, const Contacts& contacts);
  void find_gaining(const State& state);
  bool let_sleep(State& state, const Colliders& colliders, const Contacts& contacts);
  void put_contacts_aside(State& state, const Colliders& colliders, const Contacts& contacts,
                          BodyRows<const SolverBody> bodies);

  const Scene& scene_;
  const Plan& plan_;
  std::int64_t every_ = 1;               // steps
  std::vector<std::uint32_t> patience_;  // steps, of each body: so long must it be slow
  bool any_asleep_ = false;
  std::vector<std::uint32_t> bodies_, colliders_;  // awake; only where some sleep
  broadphase::BoxIndex index_;                     // of those who slept when it was made
  std::vector<std::uint32_t> item_;                // their colliders
  std::vector<Clear> clear_;                       // of each collider; as long as index_ stands
  std::vector<std::uint32_t> touched_;             // islands
  std::vector<std::uint32_t> roused_;              // colliders
  Islands islands_;
  std::vector<std::uint8_t> restless_;  // of each body awake, then of each island at its first
  std::vector<Motion> motion_;          // of each island, at its first
  std::vector<ContactRow> rows_;
};

}  // namespace throng
