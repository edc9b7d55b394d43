// SPDX-License-Identifier: MIT
#include "tools/summary.h"

#include <algorithm>
#include <cstdio>
#include <numeric>

#include "sim/observe.h"

namespace throng::tools {

using Json = nlohmann::ordered_json;

namespace {

constexpr std::size_t kLast = 100;  // steps

double seconds(std::chrono::steady_clock::duration d) {
  return std::chrono::duration<double>(d).count();
}

std::string hex(std::uint64_t hash) {
  char text[17];
  std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(hash));
  return text;
}

}  // namespace

void RunTimes::end_step() {
  const double step = seconds(Clock::now() - step_begin_);
  sum_ += step;
  ++steps_;
  last_.push_back(step);
  if (last_.size() > kLast) last_.pop_front();
}

double RunTimes::wall() const {
  return seconds(Clock::now() - begin_);
}
double RunTimes::mean() const {
  return sum_ / static_cast<double>(std::max<std::int64_t>(steps_, 1));
}
double RunTimes::mean_last() const {
  return std::accumulate(last_.begin(), last_.end(), 0.0) /
         static_cast<double>(std::max<std::size_t>(last_.size(), 1));
}

Json summary(const Scene& scene, const Simulation& simulation, const RunTimes& times,
             const std::string& output) {
  const double wall = times.wall();
  const State& state = simulation.state();
  const Overlap overlaps = overlap(scene, state);
  const Vec p = momentum(scene, state);
  Json stages = Json::object();
  for (const auto& [name, total] : simulation.stage_times())
    stages[name] = 1e3 * total / static_cast<double>(std::max<std::int64_t>(times.steps(), 1));
  return {{"scenario", scene.name},
          {"engine", scene.engine == Engine::box2d ? "box2d" : "native"},
          {"steps", state.step},
          {"time", static_cast<double>(state.step) * scene.time.dt},
          {"bodies", scene.bodies.size()},
          {"agents", 0},
          {"wall_s", wall},
          {"step_ms", 1e3 * times.mean()},
          {"step_ms_last", 1e3 * times.mean_last()},
          {"stages", stages},
          {"hash", hex(hash(state))},
          {"max_overlap", overlaps.max},
          {"mean_overlap", overlaps.mean},
          {"kinetic_energy", kinetic_energy(scene, state)},
          {"potential_energy", potential_energy(scene, state)},
          {"momentum", {p.x(), p.y()}},
          {"contacts", simulation.contacts()},
          {"output", output.empty() ? Json(nullptr) : Json(output)}};
}

void print(const Json& summary) {
  std::puts(summary.dump(2, ' ', false, Json::error_handler_t::replace).c_str());
}

}  // namespace throng::tools
