// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <vector>

#include "sim/scene.h"
#include "sim/state.h"

/// Who wants to walk and gets nowhere.
namespace throng {

/// An agent that wanted to walk and hasn't got on for kStuckTime.
struct StuckAgent {
  std::uint32_t id;
  Vec position;  ///< m
};
inline constexpr double kStuckTime = 10.0;  ///< s

/// Those of the state, by id: agents with a desired speed and on their way somewhere, that for kStuckTime
/// haven't got on from one place, as Journeys::gets_on tells: who goes aside and comes back has got nowhere.
/// Not those who stand in line, want to a queue that is full, or wait.
std::vector<StuckAgent> stuck_agents(const Scene& scene, const State& state);

/// s: who stood so long is in doubt.
inline constexpr double kHesitation = 1.0;

/// s, since that step, for which the agent in this row of the crowd's state has wanted to walk.
inline double time_wanted(const Scene& scene, const State& state, std::size_t row, std::int64_t step) {
  const double dt = scene.time.dt, now = static_cast<double>(state.step) * dt;
  const double whole = now - static_cast<double>(step) * dt;
  if (whole < kHesitation) return whole;
  const double leg = now - static_cast<double>(state.crowd.since[row]) * dt;
  return std::min({whole, leg, now - scene.crowd.start[agent_of(scene, state, scene.crowd.first + row)]});
}

/// s, for which he has wanted to walk and stood.
inline double time_stood(const Scene& scene, const State& state, std::size_t row) {
  return time_wanted(scene, state, row, state.crowd.stand_step[row]);
}

/// Where one who has stood for so long (s) wants to go: at random by (seed, step, id) a little beside his
/// way, else two who meet head on would stand before each other for ever; and once he is stuck anywhere, the
/// more so the longer, each time for a second, else three who hold one another in an arch before a door
/// would, or one would behind somebody who waits there.
Vec in_doubt(const Scene& scene, const State& state, std::uint32_t id, const Vec& towards, double stood);

/// m: who gets farther than that in the time (s) has got somewhere: his radius, or, who is slow, half of what
/// he does when nothing is in his way.
inline double somewhere(double radius, double desired_speed, double time) {
  return std::min(radius, 0.5 * desired_speed * time);
}

/// m: who gets farther from where he has stood, which is `enough` to be somewhere, doesn't stand. More where
/// he is stuck: who goes aside would be drawn back at once.
double leash(const Scene& scene, const State& state, std::size_t row, double enough);

}  // namespace throng
