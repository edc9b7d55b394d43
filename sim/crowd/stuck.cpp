// SPDX-License-Identifier: MIT
#include "sim/crowd/stuck.h"

#include <algorithm>

#include "sim/random.h"

namespace throng {

namespace {

constexpr double kDoubt = 1e-3;     // of his desired speed: who is in doubt wants what he wants up to this
constexpr double kMostDoubt = 5.0;  // beside a way that is 1
constexpr double kAside = 1.0;      // s: so long who is stuck tries one direction
constexpr double kLeash = 3.0;      // of what is enough else

}  // namespace

Vec in_doubt(const Scene& scene, const State& state, std::uint32_t id, const Vec& towards, double stood) {
  const bool is_stuck = stood >= kStuckTime;
  const double most = is_stuck ? std::min(stood / kStuckTime, kMostDoubt) : kDoubt;
  const double now = static_cast<double>(state.step) * scene.time.dt;
  const auto draw =
      is_stuck ? static_cast<std::uint64_t>(now / kAside) : static_cast<std::uint64_t>(state.step);
  Random random(scene.seed, draw, id, Purpose::hesitation);
  const double x = random.uniform(-most, most);
  const Vec wanted = towards + Vec(x, random.uniform(-most, most));
  return is_stuck && wanted != Vec(0.0, 0.0) ? Vec(wanted / wanted.norm()) : wanted;
}

double leash(const Scene& scene, const State& state, std::size_t row, double enough) {
  const bool is_stuck = state.crowd.place[row] == 0 && time_stood(scene, state, row) >= kStuckTime;
  return is_stuck ? kLeash * enough : enough;
}

std::vector<StuckAgent> stuck_agents(const Scene& scene, const State& state) {
  std::vector<StuckAgent> stuck;
  for (std::size_t i = 0; i < state.crowd.stand.size(); ++i) {
    if (state.crowd.place[i] > 0 || state.crowd.option[i] == kUndecided) continue;
    const std::size_t row = scene.crowd.first + i, agent = agent_of(scene, state, row);
    if (time_wanted(scene, state, i, state.crowd.halt_step[i]) >= kStuckTime &&
        scene.crowd.desired_speed[agent] > 0.0)
      stuck.push_back({state.id[row], state.position[row]});
  }
  std::ranges::sort(stuck, {}, &StuckAgent::id);
  return stuck;
}

}  // namespace throng
