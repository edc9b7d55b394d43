// SPDX-License-Identifier: MIT
#include "sim/crowd/queues.h"

#include <algorithm>
#include <cmath>

namespace throng {

namespace {

constexpr double kSight = 10.0;      // m: nearer than that, the end of a queue is walked to straight on
constexpr double kKeepsPlace = 5.0;  // s: who stands so long where he can't get to his place loses it
constexpr double kOvertakes = 0.5;   // of the spacing: who is so much nearer to a place is before another

}  // namespace

Queues::Queues(const Scene& scene, const Barriers& barriers, const Ways& ways)
    : scene_(scene),
      barriers_(barriers),
      ways_(ways),
      line_(scene.crowd.queues.size()),
      behind_(scene.crowd.queues.size()) {
  for (const Queue& queue : scene.crowd.queues) {
    lines_.emplace_back(queue);
    service_.push_back(Time{scene.time.dt, queue.service, 1}.steps());
  }
}

std::uint32_t Queues::queue(const State& state, Row row) const {
  const std::size_t agent = agent_of(scene_, state, scene_.crowd.first + row);
  return scene_.crowd.leg(agent, state.crowd.stage[row]).options[state.crowd.option[row]];
}

/// m, of who has that place from it.
double Queues::away(const State& state, std::uint32_t queue, std::uint32_t number) const {
  return (position(state, line_[queue][number - 1]) - lines_[queue].place(number)).norm();
}

void Queues::look(const State& state) {
  for (std::vector<Row>& line : line_) line.clear();
  for (Row row = 0; row < state.crowd.place.size(); ++row) {
    const std::uint32_t place = state.crowd.place[row];
    const std::size_t agent = agent_of(scene_, state, scene_.crowd.first + row);
    if (place == 0 || scene_.crowd.leg(agent, state.crowd.stage[row]).kind != Leg::Kind::queue) continue;
    std::vector<Row>& line = line_[queue(state, row)];
    line.resize(std::max<std::size_t>(line.size(), place));
    line[place - 1] = row;
  }
  look_behind(state);
}

void Queues::look_behind(const State& state) {
  for (std::vector<double>& behind : behind_) behind.clear();
  for (Row row = 0; row < state.crowd.place.size(); ++row) {
    const std::size_t agent = agent_of(scene_, state, scene_.crowd.first + row);
    const Leg& leg = scene_.crowd.leg(agent, state.crowd.stage[row]);
    if (leg.kind != Leg::Kind::queue || state.crowd.place[row] > 0 || state.crowd.option[row] == kUndecided)
      continue;
    const std::uint32_t its = leg.options[state.crowd.option[row]];
    if (is_full(its))
      behind_[its].push_back((lines_[its].place(length(its) + 1) - position(state, row)).norm());
  }
  for (std::vector<double>& behind : behind_) std::ranges::sort(behind);
}

/// Whether he gets straight there: who isn't on the line yet only where all of him has room on the way.
bool Queues::reaches(const State& state, Row row, const Vec& place) const {
  const Vec& p = position(state, row);
  const std::uint32_t goal = scene_.crowd.queues[queue(state, row)].goal;
  if (ways_.is_in(goal, p)) return !barriers_.block(p, place);
  return barriers_.leave_room(p, place, radius(state, row));
}

/// Where he walks straight on to get to that place: to it, or to the next bend on the way.
std::optional<Vec> Queues::straight(const State& state, Row row, std::uint32_t number) const {
  const std::uint32_t its = queue(state, row);
  const QueueLine& line = lines_[its];
  const Vec &p = position(state, row), place = line.place(number);
  const bool is_near = state.crowd.place[row] > 0 || line.distance(p) <= spacing(its);
  if ((is_near || (place - p).norm() <= kSight) && reaches(state, row, place)) return place;
  const std::optional<Vec> bend = is_near ? line.bend(p, number) : std::nullopt;
  return bend && reaches(state, row, *bend) ? bend : std::nullopt;
}

Heading Queues::heading(const State& state, Row row) const {
  const Vec& p = position(state, row);
  const std::uint32_t its = queue(state, row), place = state.crowd.place[row];
  const std::uint32_t number = place > 0 ? place : length(its) + 1;
  const std::optional<Vec> to = straight(state, row, number);
  if (!to) return {ways_.to(scene_.crowd.queues[its].goal, radius(state, row)).direction(p), kFree};
  const double distance = (lines_[its].place(number) - p).norm();
  if (place > 0) return straight_to(p, *to, distance);
  if (!is_full(its)) return straight_to(p, *to, kFree);
  const auto nearer = std::ranges::lower_bound(behind_[its], distance) - behind_[its].begin();
  const double off = spacing(its) * (1.0 + std::sqrt(static_cast<double>(nearer)));
  return straight_to(p, *to, std::max(0.0, distance - off));
}

/// Whether the one behind the k-th of the line, from 0, is to take his place: nobody's who is being served,
/// and none by so little that they would change places for ever.
bool Queues::is_overtaken(const State& state, std::uint32_t queue, std::uint32_t k) const {
  const double his = away(state, queue, k + 1);
  const double other = (position(state, line_[queue][k + 1]) - lines_[queue].place(k + 1)).norm();
  return k == 0 ? his > spacing(queue) && other < his : other + kOvertakes * spacing(queue) < his;
}

/// Whether the k-th of the line, from 0, can't get to his place, and stands.
bool Queues::is_lost(const State& state, std::uint32_t queue, std::uint32_t k) const {
  const Row row = line_[queue][k];
  const double stood = static_cast<double>(state.step - state.crowd.stand_step[row]) * scene_.time.dt;
  return stood >= kKeepsPlace && away(state, queue, k + 1) > spacing(queue) && !straight(state, row, k + 1);
}

void Queues::take_out(State& state, std::uint32_t queue, std::uint32_t k) {
  std::vector<Row>& line = line_[queue];
  state.crowd.place[line[k]] = 0;
  line.erase(line.begin() + k);
  for (std::size_t i = k; i < line.size(); ++i) --state.crowd.place[line[i]];
  if (k == 0 && !line.empty()) state.crowd.since[line[0]] = state.step;
}

void Queues::keep_order(State& state, std::uint32_t queue) {
  CrowdState& crowd = state.crowd;
  for (std::uint32_t k = 0; k + 1 < length(queue); ++k) {
    if (!is_overtaken(state, queue, k)) continue;
    Row &first = line_[queue][k], &second = line_[queue][k + 1];
    std::swap(first, second);
    crowd.place[first] = k + 1, crowd.place[second] = k + 2;
    if (k == 0) crowd.since[first] = state.step;
  }
  for (std::uint32_t k = length(queue); k-- > 0;)
    if (is_lost(state, queue, k)) take_out(state, queue, k);
}

void Queues::advance(State& state, std::vector<std::uint8_t>& served) {
  for (std::uint32_t queue = 0; queue < line_.size(); ++queue) {
    keep_order(state, queue);
    if (line_[queue].empty()) continue;
    const Row head = line_[queue][0];
    if (state.step < state.crowd.since[head] + service_[queue] || away(state, queue, 1) > spacing(queue))
      continue;
    served[head] = 1;
    take_out(state, queue, 0);
  }
}

void Queues::line_up(State& state, Row row) {
  const std::uint32_t its = queue(state, row), number = length(its) + 1;
  if (is_full(its)) {
    state.crowd.since[row] = state.step;
    return;
  }
  const Vec end = lines_[its].place(number);
  if ((position(state, row) - end).norm() > spacing(its) || !reaches(state, row, end)) return;
  state.crowd.place[row] = number;
  state.crowd.since[row] = state.step;
  line_[its].push_back(row);
}

}  // namespace throng
