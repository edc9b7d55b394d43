// SPDX-License-Identifier: MIT
#include "tools/bench/validation_walk.h"

#include <algorithm>

#include "scenarios/load.h"
#include "sim/crowd/model.h"
#include "sim/input_error.h"

namespace throng::bench {

namespace {

constexpr double kAway = 1.0;  // m: who is nearer to where he stood may have been pushed

Scene scene_of(const std::string& file, const std::vector<std::string>& overrides) {
  Loaded loaded = load_scenario(file, overrides);
  if (loaded.errors() > 0) throw InputError(to_string(loaded.diagnostics, file));
  return std::move(loaded.scene);
}

/// Fills a Walked, step by step.
class Watch {
 public:
  Watch(const State& state, Walked& walked) : walked_(walked), is_there_(agents(), false) {
    walked.arrival.assign(agents(), kNever), walked.set_out.assign(agents(), kNever);
    walked.last = walked.scene.bodies.position;
    walked.crossings.resize(measures().size());
    walked.crossed.assign(measures().size(), std::vector<double>(agents(), kNever));
    for (const std::uint32_t id : state.id) is_there_[id - 1] = true;
  }

  void after_step(const State& state) {
    const double now = static_cast<double>(state.step) * walked_.scene.time.dt;
    std::vector<bool> is_there(agents(), false);
    for (std::size_t row = 0; row < state.id.size(); ++row) {
      const std::size_t agent = state.id[row] - std::size_t{1};
      is_there[agent] = true;
      if (is_there_[agent]) cross(agent, state.position[row], now);
      walked_.last[agent] = state.position[row];
      note_setting_out(agent, now);
      walked_.outside = std::max(walked_.outside, off_floor(state.position[row]));
    }
    for (std::size_t agent = 0; agent < agents(); ++agent)
      if (is_there_[agent] && !is_there[agent]) walked_.arrival[agent] = now;
    is_there_.swap(is_there);
  }

 private:
  std::size_t agents() const { return walked_.scene.crowd.size(); }
  const std::vector<Measure>& measures() const { return walked_.scene.crowd.measures; }

  void cross(std::size_t agent, const Vec& to, double now) {
    for (std::size_t i = 0; i < measures().size(); ++i) {
      double& crossed = walked_.crossed[i][agent];
      if (crossed < kNever || !measures()[i].area.empty()) continue;
      if (crossing(measures()[i].line, walked_.last[agent], to) <= 0) continue;
      walked_.crossings[i].push_back(now);
      crossed = now;
    }
  }

  void note_setting_out(std::size_t agent, double now) {
    const double way = (walked_.last[agent] - walked_.scene.bodies.position[agent]).norm();
    if (way < kAway || walked_.set_out[agent] < kNever) return;
    walked_.set_out[agent] = now - way / walked_.scene.crowd.desired_speed[agent];
  }

  double off_floor(const Vec& p) const {
    const Region& floor = walked_.scene.crowd.walkable;
    return contains(floor, p) ? 0.0 : (nearest_on_border(floor, p) - p).norm();
  }

  Walked& walked_;
  std::vector<bool> is_there_;
};

}  // namespace

std::vector<Walker> walkers() {
  std::vector<Walker> all;
  for (const ModelKind& kind : walking_models()) {
    all.push_back({kind.name, ""});
    for (const ModelPreset& preset : kind.presets) all.push_back({kind.name, preset.name});
  }
  return all;
}

std::size_t Walked::missing() const {
  return static_cast<std::size_t>(std::ranges::count(arrival, kNever));
}

double Walked::last_arrival() const {
  return *std::ranges::max_element(arrival);
}

const std::vector<std::vector<double>>& Trials::once(
    const std::string& name, const std::function<std::vector<std::vector<double>>()>& measure) const {
  const auto [at, is_new] = known_.try_emplace(name);
  if (is_new) at->second = measure();
  return at->second;
}

Walked Trials::walk(const std::string& scenario, std::vector<std::string> overrides, const Look& look) const {
  const std::string file = folder_ + "/" + scenario + ".toml";
  const std::size_t groups = scene_of(file, {}).crowd.groups.size();
  for (std::size_t group = 0; group < groups; ++group) {
    const std::string agents = "agents[" + std::to_string(group) + "].";
    overrides.push_back(agents + "model=" + walker_.model);
    if (!walker_.preset.empty()) overrides.push_back(agents + walker_.model + ".preset=" + walker_.preset);
    for (const std::string& field : fields_) overrides.push_back(agents + field);
  }
  Walked walked;
  walked.scene = scene_of(file, overrides);
  const auto run = simulation(walked.scene);
  Watch watch(run->state(), walked);
  const auto is_over = [&](const State& state) {
    return state.step >= walked.scene.time.steps() || (state.id.empty() && waiting(state.crowd) == 0);
  };
  while (!is_over(run->state())) {
    run->step();
    watch.after_step(run->state());
    if (look) look(walked.scene, run->state());
  }
  walked.measured = run->state().crowd.measured;
  return walked;
}

}  // namespace throng::bench
