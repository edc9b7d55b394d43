// SPDX-License-Identifier: MIT
#include "tools/summary.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numeric>

#include "sim/crowd/stuck.h"
#include "sim/gas.h"
#include "sim/measure/measured_bodies.h"
#include "sim/observe.h"
#include "tools/printable.h"
#include "tools/seconds.h"

namespace throng::tools {

namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t kLast = 100;  // steps

std::string hex(std::uint64_t hash) {
  char text[17];
  std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(hash));
  return text;
}

template <class T>
Json or_null(const std::optional<T>& value) {
  return value ? Json(*value) : Json(nullptr);
}

Json measure_summary(const Scene& scene, const CrowdState& crowd) {
  Json result = Json::object();
  for (std::size_t i = 0; i < crowd.measured.size(); ++i) {
    const Measure& measure = scene.crowd.measures[i];
    const Measured& measured = crowd.measured[i];
    const Reading read = reading(measure, measured, scene.time.dt);
    Json& one = result[measure.name] = {{"count", read.count}};
    if (measure.area.empty()) one.update({{"forward", measured.count}, {"back", measured.back}});
    one["flow"] = or_null(read.flow);
    if (!measure.area.empty()) one["density"] = or_null(read.density);
    if (measure.cutoff > 0.0) one["density_voronoi"] = or_null(read.density_voronoi);
    one["speed"] = or_null(read.speed);
  }
  return result;
}

/// What agents don't have, who choose their velocities: they are nobody's contacts, and have no mass to speak
/// of.
Json mechanics(const Scene& scene, const Simulation& simulation) {
  const State& state = simulation.state();
  const Vec p = momentum(scene, state);
  return {{"kinetic_energy", kinetic_energy(scene, state)},
          {"potential_energy", potential_energy(scene, state)},
          {"momentum", {p.x(), p.y()}},
          {"contacts", simulation.contacts()}};
}

/// What only scenes with agents have.
Json crowd_summary(const Scene& scene, const State& state) {
  Json stuck = Json::array();
  for (const StuckAgent& agent : stuck_agents(scene, state))
    stuck.push_back({{"id", agent.id}, {"position", {agent.position.x(), agent.position.y()}}});
  const CrowdState& crowd = state.crowd;
  const auto time = [&](std::size_t percent) {
    const std::vector<std::int64_t>& steps = crowd.arrivals;
    if (steps.empty()) return Json(nullptr);
    const std::size_t rank = (percent * steps.size() + 99) / 100;  // of the first by when so many had
    return Json(rounded(static_cast<double>(steps[rank - 1]) * scene.time.dt));
  };
  Json result = {{"arrived", crowd.arrived},
                 {"inside", crowd.stand.size()},
                 {"waiting", waiting(crowd)},
                 {"last_arrival", time(100)},
                 {"arrival_quantiles", {time(5), time(25), time(50), time(75), time(95)}},
                 {"wall_corrections", crowd.wall_corrections},
                 {"stuck_agents", stuck}};
  if (scene.crowd.first > 0) result["squeezed"] = crowd.squeezed;
  if (!crowd.measured.empty()) result["measure"] = measure_summary(scene, crowd);
  return result;
}

/// Whom each look of a sensor found, by the mean.
Json sensor_summary(const Scene& scene, const State& state) {
  Json result = Json::object();
  for (std::size_t i = 0; i < state.sensed.size(); ++i) {
    const auto [looks, sensed] = state.sensed[i];
    const double mean = static_cast<double>(sensed) / static_cast<double>(looks);
    result[scene.sensors[i].name] = {{"looks", looks}, {"mean", looks > 0 ? Json(mean) : Json(nullptr)}};
  }
  return result;
}

/// What only engines know that go from collision to collision.
Json gas_summary(const Scene& scene, const State& state, const Collisions& collisions) {
  return {{"collisions", collisions.pairs},
          {"wall_collisions", collisions.walls},
          {"temperature", temperature(scene, state)},
          {"compressibility_factor", or_null(compressibility_factor(scene, state, collisions))}};
}

Json number_or_null(double value) {
  return std::isfinite(value) ? Json(value) : Json(nullptr);
}

/// From 0 to the last: one more than there are bins.
Json edges(const Bins& bins) {
  Json all = Json::array();
  for (int i = 0; i < bins.count; ++i) all.push_back(i * bins.up_to / bins.count);
  all.push_back(bins.up_to);
  return all;
}

/// What the scene asks for: numbers, and histograms as lists.
Json asked_summary(const Scene& scene, const Simulation& simulation) {
  std::vector<ContactRow> contacts;
  simulation.list_contacts(contacts);
  const std::vector<double> values = measure_bodies(scene, simulation.state(), contacts);
  Json result = Json::object();
  std::size_t at = 0;
  for (const AskedColumn& column : asked_columns(scene)) {
    Json numbers = Json::array();
    for (std::size_t i = 0; i < column.numbers; ++i) numbers.push_back(number_or_null(values[at++]));
    if (column.bins)
      result[column.name] = {
          {"up_to", column.bins.up_to}, {"edges", edges(column.bins)}, {"values", numbers}};
    else
      result[column.name] = numbers[0];
  }
  return result;
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
  Json stages = Json::object();
  for (const auto& [name, total] : simulation.stage_times())
    stages[name] = 1e3 * total / static_cast<double>(std::max<std::int64_t>(times.steps(), 1));
  Json result = {{"scenario", scene.name},
                 {"engine", engine_name(scene.engine)},
                 {"steps", state.step},
                 {"time", rounded(static_cast<double>(state.step) * scene.time.dt)},
                 {"bodies", scene.bodies.size() - scene.crowd.size()},
                 {"agents", scene.crowd.size()},
                 {"wall_s", wall},
                 {"step_ms", 1e3 * times.mean()},
                 {"step_ms_last", 1e3 * times.mean_last()},
                 {"stages", stages},
                 {"hash", hex(hash(state))},
                 {"max_overlap", overlaps.max},
                 {"mean_overlap", overlaps.mean},
                 {"kinetic_energy", nullptr},
                 {"potential_energy", nullptr},
                 {"momentum", nullptr},
                 {"contacts", nullptr},
                 {"output", output.empty() ? Json(nullptr) : Json(output)}};
  if (scene.crowd.size() == 0) result.update(mechanics(scene, simulation));
  if (simulation.collisions()) result.update(gas_summary(scene, state, *simulation.collisions()));
  if (scene.asked.any()) result["observables"] = asked_summary(scene, simulation);
  if (!state.sleep.island.empty()) result["asleep"] = asleep(state.sleep);
  if (scene.crowd.size() > 0) result.update(crowd_summary(scene, state));
  if (!scene.sensors.empty()) result["sensors"] = sensor_summary(scene, state);
  return result;
}

void print(const Json& object) {
  std::puts(object.dump(2, ' ', false, Json::error_handler_t::replace).c_str());
}

}  // namespace throng::tools
