// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "sim/collisions.h"
#include "sim/scene.h"

/// What changes from step to step. One array per quantity, a row per body.
namespace throng {

/// Impulses of one contact point in a substep, kept from step to step to start the solver warm (ContactRow
/// has that of the whole step). Of soft contacts `tangent` (m) and `rolling` (rad) are how far their springs
/// are stretched (SoftSprings).
struct ContactImpulse {
  std::uint64_t key;       ///< which two colliders; see `Contacts`
  std::uint32_t feature;   ///< the pair of features in contact, and the reference face
  double normal, tangent;  ///< N s
  double rolling = 0.0;    ///< N m s, where the surfaces resist rolling
  double preload = 0.0;    ///< N s, as in ContactBase
};

/// A contact that pressed when its bodies fell asleep, and does so still.
struct SleepingContact {
  ContactImpulse impulse;
  std::uint32_t island;  ///< as SleepState::island
  std::uint32_t a, b;    ///< ids of the bodies; b is 0 for an obstacle
  Vec point;             ///< m
};

/// Who rests, and who has left the loop for it. A row per body where Plan::sleep, else empty.
struct SleepState {
  std::vector<std::uint32_t> calm;    ///< steps for which it has been slow, those awake
  std::vector<double> squared_speed;  ///< m²/s², with its rim's, at the last look for islands at rest
  std::vector<std::uint32_t> island;  ///< 0 awake, else the id of the first of those it sleeps with
  std::vector<SleepingContact> disc_contacts;   ///< ascending by key
  std::vector<SleepingContact> point_contacts;  ///< likewise
};

/// What is remembered of a crowd from step to step.
struct CrowdState {
  std::vector<Vec> stand;                 ///< m, a row per agent: a place that it hasn't gone far from since
  std::vector<std::int64_t> stand_step;   ///< this step, or that in which the leg began
  std::vector<Vec> halt;                  ///< m, likewise: a place from which it hasn't got on since
  std::vector<std::int64_t> halt_step;    ///< this step, or that in which the leg began
  std::vector<std::uint32_t> stage;       ///< leg of its journey
  std::vector<std::uint32_t> option;      ///< of the leg: the one that it goes for, or kUndecided
  std::vector<std::uint32_t> place;       ///< 0 on the way; in a queue from 1 at its head; 1 where it waits
  std::vector<std::int64_t> since;        ///< step in which it got there, became first, or began the leg
  std::vector<Vec> spot;                  ///< m, where it waits
  std::vector<std::uint32_t> waiting;     ///< as Crowd::groups: the last so many haven't appeared yet
  std::int64_t arrived = 0;               ///< agents that got to their goals and left
  std::vector<std::int64_t> arrivals;     ///< steps in which they did, ascending; of frames unused
  std::vector<std::uint32_t> arrived_id;  ///< who did, as arrivals; of one step ascending
  std::int64_t wall_corrections = 0;      ///< agent-steps in which a barrier was in the way
  std::int64_t squeezed = 0;              ///< agent-steps in which a body got into one whom others held
  std::vector<Measured> measured;         ///< as Crowd::measures
  std::vector<OnLine> on_line;            ///< who sways on their lines or beside their areas, ascending

  friend bool operator==(const CrowdState&, const CrowdState&) = default;
};

struct State {
  std::int64_t step = 0;                      ///< the time is step * dt, never a sum
  std::vector<std::uint32_t> id;              ///< the body's name; rows may move, names don't
  std::vector<Vec> position;                  ///< m, of the centre of mass
  std::vector<double> angle;                  ///< rad
  std::vector<Vec> velocity;                  ///< m/s
  std::vector<double> spin;                   ///< rad/s
  std::vector<ContactImpulse> disc_contacts;  ///< of those awake, pressing in the last step, ascending by key
  std::vector<ContactImpulse> point_contacts;  ///< likewise; the points of one manifold stand together
  SleepState sleep;
  CrowdState crowd;               ///< empty where there are no agents
  std::vector<SensedSum> sensed;  ///< as Scene::sensors
  Collisions collisions;          ///< of discs that fly from one to the next; else all 0
};

/// Calls f(array) for each array of a crowd's state that has a row per agent.
template <class Crowd, class F>
void for_each_agent_array(Crowd& crowd, F f) {
  f(crowd.stand), f(crowd.stand_step), f(crowd.stage), f(crowd.option), f(crowd.place), f(crowd.since);
  f(crowd.spot), f(crowd.halt), f(crowd.halt_step);
}

/// Which agent of the crowd is in this row of the state, which is one of the crowd's.
inline std::size_t agent_of(const Scene& scene, const State& state, std::size_t row) {
  return state.id[row] - std::size_t{1} - scene.crowd.first;
}

/// The agent stands there at the beginning of its journey, behind all others of the state.
void add_agent(const Scene& scene, State& state, std::uint32_t agent, const Vec& place);

/// The state at time 0.
State initial_state(const Scene& scene);

/// The bodies of it, no agents, and nothing that steps remember.
State placed_bodies(const Scene& scene);

/// How many bodies sleep. O(bodies).
std::size_t asleep(const SleepState& sleep);

/// How many agents haven't appeared yet.
std::uint64_t waiting(const CrowdState& crowd);

/// Whether it has the rows that a state of the scene has: of bodies, of those who sleep, and of what is
/// remembered of a crowd.
bool fits(const State& state, const Scene& scene);

/// 64 bits over step, ids and all motion, on every machine the same: of what recordings hold, not of what
/// only checkpoints do, such as how far agents are on their journeys. A body's id
/// and motion are mixed one after the other, and the bodies' mixes added up: bodies don't wait for one
/// another, and the row in which one stands doesn't matter, as its id names it. About 12 bytes a ns.
std::uint64_t hash(const State& state);

}  // namespace throng
