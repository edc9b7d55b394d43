// SPDX-License-Identifier: MIT
#include "sim/crowd/journeys.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace throng {

namespace {

constexpr double kFree = std::numeric_limits<double>::infinity();
constexpr double kQueueSight = 10.0;  // m: nearer than that, the end of a queue is walked to straight on
constexpr int kSpotTries = 100;
constexpr double kPatience = 5.0, kLongest = 15.0;  // s: who gets nowhere on the way to a place to wait, or
                                                    // not there in time, stays where he is

Heading straight_to(const Vec& from, const Vec& to, double distance) {
  const double length = (to - from).norm();
  return {length > 0.0 ? Vec((to - from) / length) : Vec(0.0, 0.0), distance};
}

/// The fewest steps that take so long, up to rounding.
std::int64_t steps(double time, double dt) {
  return Time{dt, time, 1}.steps();
}

}  // namespace

Journeys::Journeys(const Scene& scene, const Barriers& barriers)
    : scene_(scene),
      barriers_(barriers),
      ways_(scene, barriers),
      least_crowded_(scene, ways_),
      samplers_(scene.crowd.goals.size()) {
  const Crowd& crowd = scene.crowd;
  for (const Queue& queue : crowd.queues) {
    lines_.emplace_back(queue);
    service_.push_back(steps(queue.service, scene.time.dt));
  }
  for (const AgentGroup& group : crowd.groups)
    for (const Leg& leg : group.journey) {
      chooses_ = chooses_ || leg.options.size() > 1;
      if (leg.kind == Leg::Kind::wait && !samplers_[leg.options[0]])
        samplers_[leg.options[0]] = std::make_unique<Sampler>(crowd.goals[leg.options[0]].region, 0.0);
    }
}

std::uint32_t Journeys::choice(const State& state, Row row) {
  const Leg& its = leg(state, row);
  if (its.weights.empty())
    return least_crowded_.choose(its, position(state, row), scene_.crowd.desired_speed[agent(state, row)]);
  Random random(scene_.seed, state.crowd.stage[row], state.id[scene_.crowd.first + row], Purpose::journey);
  const double drawn = random.uniform() * its.weights.back();
  return static_cast<std::uint32_t>(std::upper_bound(its.weights.begin(), its.weights.end() - 1, drawn) -
                                    its.weights.begin());
}

/// Expects that places in line are 1 to as many as there are.
void Journeys::look_at_queues(const State& state) {
  line_.resize(lines_.size());
  for (std::vector<Row>& line : line_) line.clear();
  for (Row row = 0; row < state.crowd.place.size(); ++row) {
    const std::uint32_t place = state.crowd.place[row];
    if (place == 0 || !is_queueing(state, row)) continue;
    std::vector<Row>& line = line_[queue(state, row)];
    line.resize(std::max<std::size_t>(line.size(), place));
    line[place - 1] = row;
  }
}

void Journeys::look(State& state) {
  if (!lines_.empty()) look_at_queues(state);
  if (!chooses_) return;
  std::vector<std::uint32_t>& option = state.crowd.option;
  bool counted = false;
  for (Row row = 0; row < option.size(); ++row) {
    if (option[row] != kUndecided) continue;
    if (!counted) least_crowded_.count(state);
    counted = true;
    option[row] = choice(state, row);
  }
}

Heading Journeys::heading(const State& state, Row row) const {
  const Vec& p = position(state, row);
  if (is_queueing(state, row)) return queue_heading(state, row);
  if (state.crowd.place[row] == 0) return {ways_.to(goal(state, row)).direction(p), kFree};
  const Vec& spot = state.crowd.spot[row];
  return straight_to(p, spot, (spot - p).norm());
}

/// Who isn't in line yet walks to the line, and, where he can, straight to its end; behind a full one he
/// stops.
Heading Journeys::queue_heading(const State& state, Row row) const {
  const Vec& p = position(state, row);
  const std::uint32_t its = queue(state, row), place = state.crowd.place[row];
  const QueueLine& line = lines_[its];
  const double spacing = scene_.crowd.queues[its].spacing;
  const std::uint32_t number = place > 0 ? place : length(its) + 1;
  const double distance = (line.place(number) - p).norm();
  const bool full = number > line.places();
  if (place == 0 && line.distance(p) > spacing &&
      (distance > kQueueSight || barriers_.block(p, line.place(number))))
    return {ways_.to(goal(state, row)).direction(p), kFree};
  const double stop = place > 0 ? distance : full ? std::max(0.0, distance - spacing) : kFree;
  return straight_to(p, line.towards(p, number, barriers_), stop);
}

/// Who stands nearer to a place than the one behind whom he is takes it: those who are pushed out of a line,
/// or kept from moving up, hold up nobody.
void Journeys::keep_order(State& state) {
  CrowdState& crowd = state.crowd;
  for (std::uint32_t queue = 0; queue < line_.size(); ++queue)
    for (std::uint32_t k = 0; k + 1 < length(queue); ++k) {
      Row &first = line_[queue][k], &second = line_[queue][k + 1];
      const Vec place = lines_[queue].place(k + 1);
      if ((position(state, second) - place).squaredNorm() >= (position(state, first) - place).squaredNorm())
        continue;
      std::swap(first, second);
      crowd.place[first] = k + 1, crowd.place[second] = k + 2;
      if (k == 0) crowd.since[first] = state.step;
    }
}

void Journeys::serve(State& state, std::vector<std::uint8_t>& done) {
  CrowdState& crowd = state.crowd;
  for (std::uint32_t queue = 0; queue < line_.size(); ++queue) {
    std::vector<Row>& line = line_[queue];
    if (line.empty() || state.step < crowd.since[line[0]] + service_[queue]) continue;
    const double away = (position(state, line[0]) - lines_[queue].place(1)).norm();
    if (away > scene_.crowd.queues[queue].spacing) continue;
    done[line[0]] = 1;
    line.erase(line.begin());
    for (const Row row : line) --crowd.place[row];
    if (!line.empty()) crowd.since[line[0]] = state.step;
  }
}

void Journeys::line_up(State& state, Row row) {
  const std::uint32_t its = queue(state, row), number = length(its) + 1;
  const Vec &p = position(state, row), end = lines_[its].place(number);
  if (number > lines_[its].places() || (p - end).norm() > scene_.crowd.queues[its].spacing ||
      barriers_.block(p, end))
    return;
  state.crowd.place[row] = number;
  state.crowd.since[row] = state.step;
  line_[its].push_back(row);
}

void Journeys::gather_spots(const State& state) {
  spots_.clear();
  for (Row row = 0; row < state.crowd.place.size(); ++row)
    if (state.crowd.place[row] > 0 && leg(state, row).kind == Leg::Kind::wait)
      spots_.add(state.crowd.spot[row], scene_.bodies.radius[scene_.crowd.first + agent(state, row)]);
  spots_known_ = true;
}

void Journeys::take_spot(State& state, Row row) {
  if (!spots_known_) gather_spots(state);
  const Vec& p = position(state, row);
  const std::uint32_t id = state.id[scene_.crowd.first + row];
  const double radius = scene_.bodies.radius[id - std::size_t{1}];
  const Sampler& sampler = *samplers_[goal(state, row)];
  Random random(scene_.seed, static_cast<std::uint64_t>(state.step), id, Purpose::spot);
  Vec spot = p;
  for (int i = 0; i < kSpotTries && spot == p; ++i) {
    const Vec q = sampler.draw(random);
    if (sampler.holds(q, radius) && !spots_.meets(q, radius) && !(barriers_.distance(q, radius) < radius) &&
        !barriers_.block(p, q))
      spot = q;
  }
  state.crowd.place[row] = 1;
  state.crowd.since[row] = state.step;
  state.crowd.spot[row] = spot;
  spots_.add(spot, radius);
}

/// Whether the agent's time is over.
bool Journeys::wait(State& state, Row row) {
  CrowdState& crowd = state.crowd;
  const Leg& its = leg(state, row);
  const double dt = scene_.time.dt;
  if (crowd.place[row] == 0) {
    if (ways_.is_in(goal(state, row), position(state, row))) take_spot(state, row);
    if (crowd.place[row] == 0 || its.times.empty()) return false;
  }
  const Vec& p = position(state, row);
  const double near = 2.0 * scene_.bodies.radius[state.id[scene_.crowd.first + row] - std::size_t{1}];
  const bool far = (p - crowd.spot[row]).squaredNorm() > near * near;
  const double there = static_cast<double>(state.step - crowd.since[row]) * dt;
  const double stood = static_cast<double>(state.step - crowd.stand_step[row]) * dt;
  const bool gives_up = far && (there >= kLongest || std::min(there, stood) >= kPatience);
  if (gives_up && ways_.is_in(goal(state, row), p)) crowd.spot[row] = p;
  if (its.times.empty()) return false;
  const std::size_t in_group =
      agent(state, row) - scene_.crowd.groups[scene_.crowd.group[agent(state, row)]].first;
  const std::int64_t from = its.until ? 0 : crowd.since[row];
  return state.step >= from + steps(its.times[in_group], dt);
}

bool Journeys::is_there(State& state, Row row) {
  switch (leg(state, row).kind) {
    case Leg::Kind::pass:
      return ways_.is_in(goal(state, row), position(state, row));
    case Leg::Kind::wait:
      return wait(state, row);
    case Leg::Kind::queue:
      if (state.crowd.place[row] == 0) line_up(state, row);
  }
  return false;
}

void Journeys::begin_leg(State& state, Row row) const {
  state.crowd.option[row] = leg(state, row).first_option();
  state.crowd.place[row] = 0;
  state.crowd.since[row] = state.step;
}

void Journeys::advance(State& state, std::vector<std::uint8_t>& leaves) {
  spots_known_ = false;
  leaves.assign(state.crowd.stage.size(), 0);
  keep_order(state);
  serve(state, leaves);
  for (Row row = 0; row < leaves.size(); ++row) {
    if (!leaves[row] && !is_there(state, row)) continue;
    const Journey& journey = scene_.crowd.groups[scene_.crowd.group[agent(state, row)]].journey;
    leaves[row] = ++state.crowd.stage[row] == journey.size();
    if (!leaves[row]) begin_leg(state, row);
  }
}

}  // namespace throng
