// SPDX-License-Identifier: MIT
#include "sim/crowd/walk.h"

#include <algorithm>
#include <cstdio>
#include <limits>

#include "sim/crowd/slide.h"
#include "sim/input_error.h"
#include "sim/simulation_error.h"

namespace throng {

namespace {

double largest_radius(const Scene& scene) {
  double largest = 0.0;
  for (std::size_t agent = 0; agent < scene.crowd.size(); ++agent)
    largest = std::max(largest, scene.bodies.radius[agent]);
  return largest;
}

/// The place as people write it.
std::string text(const Vec& p) {
  char buffer[64];
  std::snprintf(buffer, sizeof buffer, "[%.6g, %.6g]", p.x(), p.y());
  return buffer;
}

}  // namespace

std::vector<BarrierLine> barrier_lines(const Scene& scene) {
  std::vector<BarrierLine> lines;
  for (const Wall& wall : scene.walls) lines.push_back({wall.points, wall.closed});
  const Domain& domain = scene.domain;
  if (domain.kind == DomainKind::box)
    lines.push_back(
        {{domain.min, {domain.max.x(), domain.min.y()}, domain.max, {domain.min.x(), domain.max.y()}}, true});
  return lines;
}

Walk::Walk(const Scene& scene, int threads)
    : scene_(scene),
      barriers_(scene.crowd.size() > 0 ? barrier_lines(scene) : std::vector<BarrierLine>(),
                2.0 * largest_radius(scene)),
      lists_(threads) {
  if (scene.crowd.size() == 0) return;
  for (const AgentGroup& group : scene.crowd.groups) {
    models_.push_back(walking_models()[group.model].make(group.parameters));
    reach_ = std::max(reach_, models_.back()->reach(largest_radius(scene)));
  }
  build_goals();
  expect_ways();
}

void Walk::build_goals() {
  const Crowd& crowd = scene_.crowd;
  goals_.resize(crowd.areas.size());
  for (std::uint32_t goal = 0; goal < goals_.size(); ++goal) {
    double least = 0.0, largest = 0.0;
    for (std::size_t agent = 0; agent < crowd.size(); ++agent) {
      if (group(agent).goal != goal) continue;
      const double radius = scene_.bodies.radius[agent];
      least = largest > 0.0 ? std::min(least, radius) : radius;
      largest = std::max(largest, radius);
    }
    if (largest == 0.0) continue;
    const Resolution resolution = resolution_for(crowd.walkable, barriers_, least, largest);
    goals_[goal].plan =
        std::make_unique<FloorPlan>(floor_plan(crowd.walkable, barriers_, resolution, 2.0 * least));
    goals_[goal].field =
        std::make_unique<DistanceField>(*goals_[goal].plan, barriers_, crowd.areas[goal].region);
  }
}

void Walk::expect_ways() const {
  for (std::size_t agent = 0; agent < scene_.crowd.size(); ++agent) {
    const AgentGroup& its = group(agent);
    const Vec& place = scene_.bodies.position[agent];
    if (goals_[its.goal].field->distance(place) < std::numeric_limits<double>::infinity()) continue;
    throw InputError("agents[" + std::to_string(its.index) + "]: no way wide enough leads from " +
                     text(place) + ", where agent " + std::to_string(agent + 1) + " stands, to its goal \"" +
                     scene_.crowd.areas[its.goal].name + "\"");
  }
}

void Walk::look(const State& state) {
  const std::size_t n = state.id.size();
  if (reach_ > 0.0) return lists_.find(state.position, reach_, nullptr, near_);
  near_.begin.assign(n + 1, 0);
}

void Walk::steer(const State& state, Workers& workers) {
  const std::size_t n = state.id.size();
  radius_.resize(n), desired_speed_.resize(n), towards_.resize(n), velocity_.resize(n);
  workers.for_ranges(n, [&](std::size_t begin, std::size_t end) {
    for (std::size_t row = begin; row < end; ++row) {
      const std::size_t its = agent(state, row);
      radius_[row] = scene_.bodies.radius[its];
      desired_speed_[row] = scene_.crowd.desired_speed[its];
      towards_[row] = goals_[group(its).goal].field->direction(state.position[row]);
    }
  });
  const CrowdView view{scene_.time.dt, state.position, state.velocity, towards_,
                       radius_,        desired_speed_, near_,          barriers_};
  workers.for_ranges(n, [&](std::size_t begin, std::size_t end) {
    for (std::size_t row = begin; row < end; ++row)
      velocity_[row] =
          models_[scene_.crowd.group[agent(state, row)]]->velocity(view, static_cast<std::uint32_t>(row));
  });
}

void Walk::walk(State& state, Workers& workers) {
  const double dt = scene_.time.dt;
  const std::size_t n = state.id.size();
  corrected_.resize(n);
  workers.for_ranges(n, [&](std::size_t begin, std::size_t end) {
    for (std::size_t row = begin; row < end; ++row) {
      const double core = radius_[row] * models_[scene_.crowd.group[agent(state, row)]]->core();
      const Vec from = state.position[row];
      const Moved moved = slide(barriers_, from, dt * velocity_[row], core);
      corrected_[row] = moved.corrected;
      state.position[row] = moved.to;
      state.velocity[row] = moved.corrected ? Vec((moved.to - from) / dt) : velocity_[row];
    }
  });
  for (std::size_t row = 0; row < n; ++row) {
    check_body(state, row);
    state.crowd.wall_corrections += corrected_[row];
    if ((state.position[row] - state.crowd.stand[row]).norm() <= radius_[row]) continue;
    state.crowd.stand[row] = state.position[row];
    state.crowd.stand_step[row] = state.step;
  }
}

void Walk::leave(State& state) {
  std::size_t kept = 0;
  for (std::size_t row = 0; row < state.id.size(); ++row) {
    const std::size_t its = agent(state, row);
    if (contains(scene_.crowd.areas[group(its).goal].region, state.position[row])) continue;
    if (kept != row) {
      state.id[kept] = state.id[row];
      state.position[kept] = state.position[row], state.velocity[kept] = state.velocity[row];
      state.angle[kept] = state.angle[row], state.spin[kept] = state.spin[row];
      state.crowd.stand[kept] = state.crowd.stand[row];
      state.crowd.stand_step[kept] = state.crowd.stand_step[row];
    }
    ++kept;
  }
  if (kept == state.id.size()) return;
  state.crowd.arrived += static_cast<std::int64_t>(state.id.size() - kept);
  state.crowd.last_arrival = state.step;
  state.id.resize(kept), state.angle.resize(kept), state.spin.resize(kept);
  state.position.resize(kept), state.velocity.resize(kept);
  state.crowd.stand.resize(kept), state.crowd.stand_step.resize(kept);
}

std::vector<StuckAgent> stuck_agents(const Scene& scene, const State& state) {
  std::vector<StuckAgent> stuck;
  for (std::size_t row = 0; row < state.crowd.stand.size(); ++row) {
    const double since = static_cast<double>(state.step - state.crowd.stand_step[row]) * scene.time.dt;
    if (since >= kStuckTime && scene.crowd.desired_speed[state.id[row] - 1] > 0.0)
      stuck.push_back({state.id[row], state.position[row]});
  }
  return stuck;
}

}  // namespace throng
