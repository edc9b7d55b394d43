// SPDX-License-Identifier: MIT
#include "sim/crowd/walk.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <map>

#include "sim/crowd/entrance.h"
#include "sim/crowd/row_order.h"
#include "sim/crowd/stuck.h"
#include "sim/prefetch.h"
#include "sim/simulation_error.h"

namespace throng {

namespace {

constexpr std::size_t kAgentsAhead = 16;  // agents, in whose time memory comes

Largest largest(const Scene& scene) {
  Largest most;
  for (std::size_t agent = 0; agent < scene.crowd.size(); ++agent) {
    most.radius = std::max(most.radius, scene.bodies.radius[scene.crowd.first + agent]);
    most.desired_speed = std::max(most.desired_speed, scene.crowd.desired_speed[agent]);
  }
  return most;
}

double least_radius(const Scene& scene, const AgentGroup& group) {
  const auto first = scene.bodies.radius.begin() + scene.crowd.first + group.first;
  return *std::min_element(first, first + group.count);
}

/// So many models, each with its parameters, gather their agents from all; those of further ones are asked
/// alone.
constexpr std::size_t kTogetherModels = 32;

constexpr int kSqueezes = 4;     // of bodies against barriers, before the agent gives in
constexpr double kSettle = 0.5;  // s: who wants to stand somewhere comes to a stop within about so long

}  // namespace

std::vector<BarrierLine> barrier_lines(const Scene& scene) {
  std::vector<BarrierLine> lines;
  for (const Wall& wall : scene.walls) lines.push_back({wall.points, wall.closed});
  for (BarrierLine& line : rings(standing_solids(scene))) lines.push_back(std::move(line));
  const Domain& domain = scene.domain;
  if (domain.kind == DomainKind::box)
    lines.push_back(
        {{domain.min, {domain.max.x(), domain.min.y()}, domain.max, {domain.min.x(), domain.max.y()}}, true});
  return lines;
}

Walk::Walk(const Scene& scene)
    : scene_(scene),
      barriers_(scene.crowd.size() > 0 ? barrier_lines(scene) : std::vector<BarrierLine>(),
                2.0 * largest(scene).radius),
      movers_(scene),
      entrances_(scene.crowd.groups.size()),
      largest_(largest(scene)),
      measuring_(scene.crowd) {
  if (scene.crowd.size() == 0) return;
  make_models();
  for (std::size_t i = 0; i < scene.crowd.groups.size(); ++i)
    if (const AgentGroup& group = scene.crowd.groups[i]; group.entrance && group.count > 0)
      entrances_[i] = std::make_unique<Sampler>(group.entrance->within, least_radius(scene, group));
  journeys_.emplace(scene, barriers_);
  if (!movers_.empty()) seen_ = barriers_;
  rows_follow_ = rows_follow(scene.crowd);
}

void Walk::add_model(const AgentGroup& group, std::uint32_t agent) {
  models_.push_back(walking_models()[group.model].make(group.parameters_of(agent)));
  cores_.push_back(models_.back()->core());
  stand_at_will_.push_back(models_.back()->stands_at_will());
  reach_ = std::max(reach_, models_.back()->reach(largest_));
}

void Walk::make_models() {
  std::map<std::pair<std::uint32_t, std::vector<double>>, std::uint32_t> known;
  model_.resize(scene_.crowd.groups.size());
  for (const bool own : {false, true})
    for (std::size_t i = 0; i < model_.size(); ++i) {
      const AgentGroup& group = scene_.crowd.groups[i];
      if (group.own != own) continue;
      model_[i] = static_cast<std::uint32_t>(models_.size());
      if (!own) {
        const auto [at, is_new] = known.try_emplace({group.model, group.parameters}, model_[i]);
        model_[i] = at->second;
        if (!is_new) continue;
      }
      for (std::uint32_t agent = 0; agent < (own ? group.count : 1); ++agent) add_model(group, agent);
      if (!own) shared_ = std::min(models_.size(), kTogetherModels);
    }
}

void Walk::Ranks::resize(std::size_t n) {
  for (std::vector<double>* all : {&x, &y, &velocity_x, &velocity_y, &towards_x, &towards_y, &radius,
                                   &desired_speed, &id, &clear, &square})
    all->resize(n + CrowdView::kPadding);
  model.resize(n);
}

void Walk::sort(const State& state) {
  cells_.sort(
      std::span(state.position).subspan(scene_.crowd.first), reach_,
      rows_follow_ ? std::span(state.id).subspan(scene_.crowd.first) : std::span<const std::uint32_t>());
}

/// Who is near in the plane becomes near in memory. Nothing else follows from it, as who is in a cell stands
/// there in the order of ids.
void Walk::let_rows_follow(State& state, Workers& workers) {
  if (!rows_follow_ || state.step % kRowsFollow != 0) return;
  sort(state);
  reorder_agents(state, scene_.crowd.first, cells_.row(), workers);
}

/// Of who is in that row of the state. Many at a time, where their rows differ.
const Walk::Known& Walk::known(const State& state, std::size_t row) {
  Known& its = known_[row - scene_.crowd.first];
  if (its.id == state.id[row]) return its;
  const std::size_t agent = this->agent(state, row);
  const std::uint32_t group = scene_.crowd.group[agent];
  const AgentGroup& all = scene_.crowd.groups[group];
  its = {scene_.bodies.radius[scene_.crowd.first + agent],
         scene_.crowd.desired_speed[agent],
         scene_.crowd.start[agent],
         state.id[row],
         group,
         model_[group] + (all.own ? static_cast<std::uint32_t>(agent) - all.first : 0)};
  return its;
}

/// Has the memory brought near that ranking who has that place reads.
void Walk::prefetch(const State& state, std::size_t place) const {
  const std::size_t i = cells_.row()[place], row = scene_.crowd.first + i;
  const CrowdState& crowd = state.crowd;
  for (const void* each :
       {static_cast<const void*>(&known_[i]), static_cast<const void*>(&state.id[row]),
        static_cast<const void*>(&state.position[row]), static_cast<const void*>(&state.velocity[row]),
        static_cast<const void*>(&crowd.stage[i]), static_cast<const void*>(&crowd.option[i]),
        static_cast<const void*>(&crowd.place[i]), static_cast<const void*>(&crowd.stand_step[i])})
    throng::prefetch(each);
}

void Walk::rank(const State& state, std::size_t place) {
  const std::size_t row = this->row(place);
  const Known& its = known(state, row);
  const std::uint32_t model = its.model;
  const Vec &p = state.position[row], &v = state.velocity[row];
  const std::size_t i = cells_.row()[place];
  auto [towards, distance, square] = journeys_->heading(state, i, its.group);
  if (stand_at_will_[model] && journeys_->has_settled(state, i, distance))  // else others turn him for ever
    towards = Vec(0.0, 0.0), distance = 0.0, square = 1.0;
  const double now = static_cast<double>(state.step) * scene_.time.dt;
  const double stood = time_stood(scene_, state, i);
  if (stood >= kHesitation && state.crowd.place[i] == 0 && towards != Vec(0.0, 0.0))
    towards = in_doubt(scene_, state, state.id[row], towards / std::sqrt(square), stood), square = 1.0;
  ranks_.x[place] = p.x(), ranks_.y[place] = p.y();
  ranks_.velocity_x[place] = v.x(), ranks_.velocity_y[place] = v.y();
  ranks_.towards_x[place] = towards.x(), ranks_.towards_y[place] = towards.y();
  ranks_.square[place] = square;
  ranks_.model[place] = model, ranks_.radius[place] = its.radius;
  ranks_.desired_speed[place] = now < its.start ? 0.0 : std::min(its.desired_speed, distance / kSettle);
  ranks_.id[place] = state.id[row];
  ranks_.clear[place] = (seen_ ? *seen_ : barriers_).clear(p);
}

/// Roots and quotients of many at once, each of which takes its time.
/// Of at most kAgentsAhead places.
void Walk::make_unit(std::size_t begin, std::size_t end) {
  using Few = Eigen::Array<double, Eigen::Dynamic, 1, Eigen::ColMajor, kAgentsAhead, 1>;
  const auto some = [&](std::vector<double>& all) {
    return Eigen::Map<Few>(all.data() + begin, static_cast<Eigen::Index>(end - begin));
  };
  const Few length = some(ranks_.square).sqrt();
  some(ranks_.towards_x) /= length, some(ranks_.towards_y) /= length;
}

void Walk::look(State& state, Workers& workers) {
  let_rows_follow(state, workers);
  journeys_->look(state);
  if (seen_) movers_.show(state, *seen_);
  const std::size_t n = present(state);
  sort(state);
  ranks_.resize(n), known_.resize(n);
  workers.for_ranges(n, [&](std::size_t begin, std::size_t end) {
    for (std::size_t first = begin; first < end; first += kAgentsAhead) {
      const std::size_t last = std::min(first + kAgentsAhead, end);
      for (std::size_t place = first; place < last; ++place) {
        prefetch(state, std::min(place + 2 * kAgentsAhead, end - 1));
        const std::size_t ahead = std::min(place + kAgentsAhead, end - 1);
        journeys_->prefetch(state, cells_.row()[ahead], known(state, row(ahead)).group);
        barriers_.prefetch(state.position[row(ahead)]);
        rank(state, place);
      }
      make_unit(first, last);
    }
  });
}

void Walk::steer(const State& state, Workers& workers) {
  const std::size_t n = present(state);
  velocity_.resize(n), places_.resize(n);
  const CrowdView view{scene_.time.dt,   scene_.seed,      state.step,        cells_,
                       ranks_.x,         ranks_.y,         ranks_.velocity_x, ranks_.velocity_y,
                       ranks_.towards_x, ranks_.towards_y, ranks_.radius,     ranks_.desired_speed,
                       ranks_.id,        ranks_.clear,     largest_,          seen_ ? *seen_ : barriers_};
  workers.for_ranges(n, [&](std::size_t begin, std::size_t end) {
    std::size_t last = begin;
    for (std::size_t model = 0; model < shared_; ++model) {
      const std::size_t first = last;
      for (std::size_t place = begin; place < end && last < end; ++place) {
        places_[last] = static_cast<std::uint32_t>(place);
        last += ranks_.model[place] == model;  // no branch, which nobody could foretell
      }
      models_[model]->steer(view, std::span(places_).subspan(first, last - first), velocity_);
    }
    for (std::size_t place = begin; last < end; ++place) {
      if (ranks_.model[place] < shared_) continue;
      places_[last] = static_cast<std::uint32_t>(place);
      models_[ranks_.model[place]]->steer(view, std::span(places_).subspan(last++, 1), velocity_);
    }
  });
}

/// Bodies that move push and barriers hold in turn, until neither has anything against it. Else he stays,
/// where no body comes over him; where one does, he is squeezed, and barriers have the last word.
Moved Walk::go_among_bodies(const Vec& from, const Vec& by, double core, bool& squeezed) const {
  Moved moved{from + by, false};
  for (int i = 0; i < kSqueezes; ++i) {
    const Pushed pushed = movers_.push(from, moved.to, core);
    if (i > 0 && !pushed.corrected) return moved;
    const Moved held = slide(barriers_, from, pushed.to - from, core);
    moved = {held.to, moved.corrected || held.corrected};
    if (!held.corrected && pushed.settled) return moved;
  }
  if (!movers_.push(from, from, core).corrected) return {from, true};
  squeezed = true;
  return moved;
}

Moved Walk::go(std::size_t place, const Vec& by, bool& squeezed) const {
  const Vec from(ranks_.x[place], ranks_.y[place]);
  const double core = ranks_.radius[place] * cores_[ranks_.model[place]];
  if (seen_) return go_among_bodies(from, by, core, squeezed);
  if (ranks_.clear[place] > core + std::abs(by.x()) + std::abs(by.y())) return {from + by, false};
  return slide(barriers_, from, by, core);
}

/// Who has that place and that row walks for a step; notes where he stands.
Walk::Hindered Walk::walk_one(State& state, std::size_t place, std::size_t row) const {
  const double dt = scene_.time.dt;
  const Vec from(ranks_.x[place], ranks_.y[place]), by = dt * velocity_[place];
  bool squeezed = false;
  const Moved moved = go(place, by, squeezed);
  state.position[row] = moved.to;
  state.velocity[row] = moved.to == from + by ? velocity_[place] : Vec((moved.to - from) / dt);
  const std::size_t i = row - scene_.crowd.first;
  const double far = (moved.to - state.crowd.stand[i]).squaredNorm();
  const double enough = somewhere(ranks_.radius[place], known_[i].desired_speed, kHesitation);
  if (const auto is_in = [&](double reach) { return far <= reach * reach; };
      !is_in(enough) && !is_in(leash(scene_, state, i, enough))) {
    state.crowd.stand[i] = moved.to, state.crowd.stand_step[i] = state.step;
    if (journeys_->gets_on(state, i)) state.crowd.halt[i] = moved.to, state.crowd.halt_step[i] = state.step;
  }
  return {moved.corrected, squeezed};
}

void Walk::walk(State& state, Workers& workers) {
  std::atomic<std::int64_t> corrected = 0, squeezed = 0;
  std::atomic<bool> all_go_on = true;
  workers.for_ranges(present(state), [&](std::size_t begin, std::size_t end) {
    std::int64_t corrected_here = 0, squeezed_here = 0;
    bool go_on = true;
    for (std::size_t place = begin; place < end; ++place) {
      const std::size_t ahead = this->row(std::min(place + kAgentsAhead, end - 1)), row = this->row(place);
      __builtin_prefetch(&state.position[ahead], 1), __builtin_prefetch(&state.velocity[ahead], 1);
      __builtin_prefetch(&state.crowd.stand[ahead - scene_.crowd.first], 1);
      const auto [was_corrected, was_squeezed] = walk_one(state, place, row);
      corrected_here += was_corrected, squeezed_here += was_squeezed;
      go_on = go_on && can_go_on(state, row);
    }
    corrected += corrected_here, squeezed += squeezed_here;
    if (!go_on) all_go_on = false;
  });
  state.crowd.wall_corrections += corrected, state.crowd.squeezed += squeezed;
  movers_.move(state);
  for (std::size_t row = 0, end = all_go_on ? scene_.crowd.first : state.id.size(); row < end; ++row)
    check_body(state, row);
}

void Walk::measure(State& state) {
  if (measuring_.empty()) return;
  const std::span<Stride> strides = measuring_.strides(present(state));
  for (std::size_t place = 0; place < strides.size(); ++place) {
    const std::size_t row = this->row(place);
    strides[place] = {{ranks_.x[place], ranks_.y[place]},
                      state.position[row],
                      state.velocity[row].norm(),
                      state.id[row],
                      ranks_.radius[place]};
  }
  measuring_.measure(state);
}

void Walk::leave(State& state, Workers& workers) {
  may_be_there_.resize(present(state));
  workers.for_ranges(may_be_there_.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t agent = begin; agent < end; ++agent)
      may_be_there_[agent] = journeys_->may_be_there(state, agent, known_[agent].group);
  });
  journeys_->advance(state, may_be_there_, leaves_);
  std::vector<std::uint32_t>& arrived = state.crowd.arrived_id;
  const auto before = static_cast<std::ptrdiff_t>(arrived.size());
  for (std::size_t agent = 0; agent < leaves_.size(); ++agent)
    if (leaves_[agent]) arrived.push_back(state.id[scene_.crowd.first + agent]);
  const auto count = std::ssize(arrived) - before;
  if (count == 0) return;
  std::sort(arrived.begin() + before, arrived.end());
  remove_agents(state, scene_.crowd.first, leaves_, !rows_follow_);
  state.crowd.arrived += count;
  state.crowd.arrivals.insert(state.crowd.arrivals.end(), static_cast<std::size_t>(count), state.step);
}

/// Whether the next of the group is due.
bool Walk::is_due(const State& state, std::size_t group) const {
  const AgentGroup& its = scene_.crowd.groups[group];
  const std::uint32_t waiting = state.crowd.waiting[group];
  return waiting > 0 && scene_.crowd.due[its.first + its.count - waiting] <=
                            static_cast<double>(state.step) * scene_.time.dt;
}

/// The next of the group, where there is room: beside the company of those with whom he appears, if some of
/// them have in this step.
bool Walk::bring_in(State& state, std::size_t group, std::optional<Company>& company) {
  const Crowd& crowd = scene_.crowd;
  const AgentGroup& its = crowd.groups[group];
  const std::uint32_t agent = its.first + its.count - state.crowd.waiting[group];
  const double radius = scene_.bodies.radius[crowd.first + agent];
  const std::uint32_t number = (agent - its.first) / its.entrance->together;
  if (company && company->number != number) company.reset();
  const std::optional<Vec> place = free_place(
      scene_, seen_ ? *seen_ : barriers_, standing_, *entrances_[group], agent, state.step,
      company ? std::optional(company->place) : std::nullopt,
      [&](const Vec& p) { return movers_.depth(p) == 0.0 && journeys_->ways().lead_on(its, radius, p); });
  if (!place) return false;
  if (!company) company = Company{number, *place};
  add_agent(scene_, state, agent, *place);
  standing_.add(*place, radius);
  for (std::size_t k = 0; k < crowd.measures.size(); ++k)
    measure_entry(crowd.measures[k], *place, state.step, state.crowd.measured[k]);
  --state.crowd.waiting[group];
  return true;
}

void Walk::appear(State& state) {
  bool known = false;
  for (std::size_t group = 0; group < scene_.crowd.groups.size(); ++group) {
    if (!known && is_due(state, group)) {
      standing_.clear();
      if (seen_) movers_.show(state, *seen_);
      for (std::size_t row = scene_.crowd.first; row < state.id.size(); ++row)
        standing_.add(state.position[row], scene_.bodies.radius[state.id[row] - std::size_t{1}]);
      known = true;
    }
    std::optional<Company> company;
    while (is_due(state, group) && bring_in(state, group, company)) continue;
  }
}

}  // namespace throng
