// SPDX-License-Identifier: MIT
#include "sim/crowd/walk.h"

#include <algorithm>
#include <cstdio>
#include <limits>

#include "sim/crowd/entrance.h"
#include "sim/crowd/slide.h"
#include "sim/input_error.h"
#include "sim/simulation_error.h"

namespace throng {

namespace {

constexpr std::size_t kAhead = 16;  // agents, in whose time memory comes

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

Walk::Walk(const Scene& scene)
    : scene_(scene),
      barriers_(scene.crowd.size() > 0 ? barrier_lines(scene) : std::vector<BarrierLine>(),
                2.0 * largest_radius(scene)),
      largest_radius_(largest_radius(scene)) {
  if (scene.crowd.size() == 0) return;
  for (const AgentGroup& group : scene.crowd.groups) {
    models_.push_back(walking_models()[group.model].make(group.parameters));
    reach_ = std::max(reach_, models_.back()->reach(largest_radius_));
  }
  build_goals();
  expect_ways();
}

void Walk::build_goals() {
  const Crowd& crowd = scene_.crowd;
  std::vector<double> least(crowd.goals.size(), 0.0), largest(least);
  for (std::size_t agent = 0; agent < crowd.size(); ++agent)
    for (const std::uint32_t goal : journey(agent)) {
      const double radius = scene_.bodies.radius[agent];
      least[goal] = largest[goal] > 0.0 ? std::min(least[goal], radius) : radius;
      largest[goal] = std::max(largest[goal], radius);
    }
  goals_.resize(crowd.goals.size());
  for (std::uint32_t goal = 0; goal < goals_.size(); ++goal) {
    if (largest[goal] == 0.0) continue;
    const Resolution resolution = resolution_for(crowd.walkable, barriers_, least[goal], largest[goal]);
    goals_[goal].plan =
        std::make_unique<FloorPlan>(floor_plan(crowd.walkable, barriers_, resolution, 2.0 * least[goal]));
    goals_[goal].field =
        std::make_unique<DistanceField>(*goals_[goal].plan, barriers_, crowd.goals[goal].region);
    goals_[goal].bounds = bounds(crowd.goals[goal].region);
  }
}

bool Walk::leads(std::uint32_t goal, const Vec& place) const {
  return goals_[goal].field->distance(place) < std::numeric_limits<double>::infinity();
}

/// Who appears later is checked at a place at random: of those who have his journey one must find a way.
void Walk::expect_ways() const {
  const Crowd& crowd = scene_.crowd;
  std::vector<bool> is_possible(crowd.journeys.size());
  const auto dead_end = [&](std::size_t agent) {
    return std::ranges::find_if_not(
        journey(agent), [&](std::uint32_t goal) { return leads(goal, scene_.bodies.position[agent]); });
  };
  for (std::size_t agent = 0; agent < crowd.size(); ++agent)
    if (group(agent).entrance && dead_end(agent) == journey(agent).end())
      is_possible[crowd.journey[agent]] = true;
  for (std::size_t agent = 0; agent < crowd.size(); ++agent) {
    const auto goal = dead_end(agent);
    if (is_possible[crowd.journey[agent]] || goal == journey(agent).end()) continue;
    throw InputError("agents[" + std::to_string(group(agent).index) + "]: no way wide enough leads from " +
                     text(scene_.bodies.position[agent]) + ", where agent " + std::to_string(agent + 1) +
                     (group(agent).entrance ? " may appear" : " stands") + ", to its goal " +
                     crowd.goals[*goal].name);
  }
}

void Walk::Ranks::resize(std::size_t n) {
  for (std::vector<double>* all :
       {&x, &y, &velocity_x, &velocity_y, &towards_x, &towards_y, &radius, &desired_speed, &id})
    all->resize(n + CrowdView::kPadding);
}

void Walk::rank(const State& state, std::size_t place) {
  const std::size_t row = cells_.row()[place], its = agent(state, row);
  const Vec &p = state.position[row], &v = state.velocity[row];
  const Vec towards = goals_[goal(state, row)].field->direction(p);
  ranks_.x[place] = p.x(), ranks_.y[place] = p.y();
  ranks_.velocity_x[place] = v.x(), ranks_.velocity_y[place] = v.y();
  ranks_.towards_x[place] = towards.x(), ranks_.towards_y[place] = towards.y();
  ranks_.radius[place] = scene_.bodies.radius[its];
  const bool stands = static_cast<double>(state.step) * scene_.time.dt < scene_.crowd.start[its];
  ranks_.desired_speed[place] = stands ? 0.0 : scene_.crowd.desired_speed[its];
  ranks_.id[place] = state.id[row];
}

void Walk::prefetch(const State& state, std::size_t place) const {
  const std::size_t row = cells_.row()[place];
  goals_[goal(state, row)].field->prefetch(state.position[row]);
}

void Walk::look(const State& state, Workers& workers) {
  cells_.sort(state.position, reach_);
  ranks_.resize(state.id.size());
  workers.for_ranges(state.id.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t place = begin; place < end; ++place) {
      prefetch(state, std::min(place + kAhead, end - 1));
      rank(state, place);
    }
  });
}

void Walk::steer(const State& state, Workers& workers) {
  const std::size_t n = state.id.size();
  velocity_.resize(n), places_.resize(n);
  const CrowdView view{scene_.time.dt,   scene_.seed,      state.step,        cells_,
                       ranks_.x,         ranks_.y,         ranks_.velocity_x, ranks_.velocity_y,
                       ranks_.towards_x, ranks_.towards_y, ranks_.radius,     ranks_.desired_speed,
                       ranks_.id,        largest_radius_,  barriers_};
  workers.for_ranges(n, [&](std::size_t begin, std::size_t end) {
    std::size_t last = begin;
    for (std::size_t model = 0; model < models_.size(); ++model) {
      const std::size_t first = last;
      for (std::size_t place = begin; place < end; ++place)
        if (scene_.crowd.group[agent(state, cells_.row()[place])] == model)
          places_[last++] = static_cast<std::uint32_t>(place);
      models_[model]->steer(view, std::span(places_).subspan(first, last - first), velocity_);
    }
  });
}

void Walk::walk(State& state, Workers& workers) {
  const double dt = scene_.time.dt;
  const std::size_t n = state.id.size();
  corrected_.resize(n);
  workers.for_ranges(n, [&](std::size_t begin, std::size_t end) {
    for (std::size_t place = begin; place < end; ++place) {
      const std::size_t row = cells_.row()[place];
      const double core = ranks_.radius[place] * models_[scene_.crowd.group[agent(state, row)]]->core();
      const Vec from = state.position[row];
      const Moved moved = slide(barriers_, from, dt * velocity_[place], core);
      corrected_[row] = moved.corrected;
      state.position[row] = moved.to;
      state.velocity[row] = moved.corrected ? Vec((moved.to - from) / dt) : velocity_[place];
    }
  });
  for (std::size_t row = 0; row < n; ++row) {
    check_body(state, row);
    state.crowd.wall_corrections += corrected_[row];
    const double radius = scene_.bodies.radius[agent(state, row)];
    if ((state.position[row] - state.crowd.stand[row]).squaredNorm() <= radius * radius) continue;
    state.crowd.stand[row] = state.position[row];
    state.crowd.stand_step[row] = state.step;
  }
  if (!scene_.crowd.measures.empty()) measure_all(state);
}

void Walk::measure_all(State& state) {
  strides_.resize(state.id.size());
  for (std::size_t place = 0; place < strides_.size(); ++place) {
    const std::size_t row = cells_.row()[place];
    strides_[place] = {{ranks_.x[place], ranks_.y[place]}, state.position[row], state.velocity[row].norm()};
  }
  for (std::size_t i = 0; i < scene_.crowd.measures.size(); ++i)
    measure(scene_.crowd.measures[i], strides_, state.step, state.crowd.measured[i]);
}

void Walk::leave(State& state) {
  CrowdState& crowd = state.crowd;
  std::size_t kept = 0;
  for (std::size_t row = 0; row < state.id.size(); ++row) {
    const Vec& p = state.position[row];
    const std::uint32_t its = goal(state, row);
    const bool there = goals_[its].bounds.contains(p) && contains(scene_.crowd.goals[its].region, p);
    if (there && ++crowd.stage[row] == journey(agent(state, row)).size()) continue;
    if (kept != row) {
      state.id[kept] = state.id[row];
      state.position[kept] = state.position[row], state.velocity[kept] = state.velocity[row];
      state.angle[kept] = state.angle[row], state.spin[kept] = state.spin[row];
      crowd.stand[kept] = crowd.stand[row], crowd.stand_step[kept] = crowd.stand_step[row];
      crowd.stage[kept] = crowd.stage[row];
    }
    ++kept;
  }
  if (kept == state.id.size()) return;
  crowd.arrived += static_cast<std::int64_t>(state.id.size() - kept);
  crowd.last_arrival = state.step;
  state.id.resize(kept), state.angle.resize(kept), state.spin.resize(kept);
  state.position.resize(kept), state.velocity.resize(kept);
  crowd.stand.resize(kept), crowd.stand_step.resize(kept), crowd.stage.resize(kept);
}

void Walk::appear(State& state) {
  const Crowd& crowd = scene_.crowd;
  const double now = static_cast<double>(state.step) * scene_.time.dt;
  for (std::size_t i = 0; i < crowd.groups.size(); ++i) {
    const AgentGroup& its = crowd.groups[i];
    std::uint32_t& waiting = state.crowd.waiting[i];
    for (; waiting > 0; --waiting) {
      const std::uint32_t agent = its.first + its.count - waiting;
      if (crowd.due[agent] > now) break;
      const std::optional<Vec> place =
          free_place(scene_, barriers_, state, *its.entrance, agent, [&](const Vec& p) {
            return std::ranges::all_of(journey(agent), [&](std::uint32_t goal) { return leads(goal, p); });
          });
      if (!place) break;
      add_agent(state, agent, *place);
      for (std::size_t k = 0; k < crowd.measures.size(); ++k)
        measure_entry(crowd.measures[k], *place, state.step, state.crowd.measured[k]);
    }
  }
}

std::vector<StuckAgent> stuck_agents(const Scene& scene, const State& state) {
  std::vector<StuckAgent> stuck;
  for (std::size_t row = 0; row < state.crowd.stand.size(); ++row) {
    const std::size_t agent = state.id[row] - std::size_t{1};
    const double dt = scene.time.dt, now = static_cast<double>(state.step) * dt;
    const double stood = static_cast<double>(state.crowd.stand_step[row]) * dt;
    if (now - std::max(stood, scene.crowd.start[agent]) >= kStuckTime &&
        scene.crowd.desired_speed[agent] > 0.0)
      stuck.push_back({state.id[row], state.position[row]});
  }
  return stuck;
}

}  // namespace throng
