// SPDX-License-Identifier: MIT
#include "sim/crowd/journeys.h"

#include <algorithm>
#include <cmath>

namespace throng {

namespace {

constexpr int kSpotTries = 100, kChoices = 3;
constexpr double kPatience = 5.0, kJostled = 15.0;  // s: who stands on the way to a place to wait, or doesn't
                                                    // get on that long, stays where he is
constexpr double kSettled = 2.0;                    // s: who stands so long at his place stays so
constexpr double kAtPlace = 0.5;                    // of a line's spacing: not farther he is at his place
constexpr double kBeside = 3.0;                     // radii: who waits is that near where he keeps others out
constexpr double kAway = 10.0;  // radii: who is stuck and goes aside comes back from nearer
constexpr int kSeveral = 2;     // who wait for anything bar the way: one can be walked round

}  // namespace

Journeys::Journeys(const Scene& scene, const Barriers& barriers)
    : scene_(scene),
      barriers_(barriers),
      ways_(scene, barriers),
      least_crowded_(scene, ways_),
      queues_(scene, barriers, ways_),
      samplers_(scene.crowd.goals.size()),
      spots_(scene.crowd.goals.size()),
      walkers_(scene.crowd.goals.size()) {
  const Crowd& crowd = scene.crowd;
  for (const AgentGroup& group : crowd.groups)
    for (const Leg& leg : group.journey) {
      chooses_ = chooses_ || leg.options.size() > 1;
      if (leg.kind == Leg::Kind::wait && !samplers_[leg.options[0]])
        samplers_[leg.options[0]] = std::make_unique<Sampler>(crowd.goals[leg.options[0]].region, 0.0);
    }
}

/// Whether it hasn't set out at all by then.
bool Journeys::stands_at(const State& state, Row row, std::int64_t step) const {
  return static_cast<double>(step) * scene_.time.dt < scene_.crowd.start[agent(state, row)];
}

std::uint32_t Journeys::choice(const State& state, Row row) {
  const Leg& its = leg(state, row);
  if (!its.weights.empty()) return drawn(state, row);
  return least_crowded_.choose(its, agent(state, row), position(state, row));
}

/// By weight, of the options that are open, of all where none is. Premovement changes nothing in what is
/// drawn first, but for what is open then.
std::uint32_t Journeys::drawn(const State& state, Row row) const {
  const Leg& its = leg(state, row);
  std::vector<double> weights = its.weights;  // added up
  for (std::size_t i = 0; ways_.change() && i < weights.size(); ++i) {
    const double before = i > 0 ? its.weights[i - 1] : 0.0;
    weights[i] = (i > 0 ? weights[i - 1] : 0.0) + (is_open(its, i) ? its.weights[i] - before : 0.0);
  }
  if (!(weights.back() > 0.0)) weights = its.weights;
  const std::int64_t step = stands_at(state, row, state.step - 1) ? state.crowd.since[row] : state.step;
  const auto again = static_cast<std::uint64_t>(ways_.change() ? step : 0);
  Random random(scene_.seed, again << 16 | state.crowd.stage[row], state.id[scene_.crowd.first + row],
                Purpose::journey);
  const double drawn = random.uniform() * weights.back();
  return static_cast<std::uint32_t>(std::upper_bound(weights.begin(), weights.end() - 1, drawn) -
                                    weights.begin());
}

/// Lets those go on who waited before what is open now. Makes those undecided whose goal is closed where
/// another option of theirs is open.
void Journeys::heed_openings(State& state) const {
  CrowdState& crowd = state.crowd;
  for (Row row = 0; row < crowd.option.size(); ++row) {
    const Leg& its = leg(state, row);
    if (its.kind != Leg::Kind::pass || !is_decided(state, row)) continue;
    const bool goes_on = is_open(its, crowd.option[row]);
    for (std::size_t option = 0; !goes_on && option < its.options.size(); ++option)
      if (is_open(its, option)) crowd.option[row] = kUndecided;
    if (goes_on || !is_decided(state, row)) crowd.place[row] = 0;
  }
}

void Journeys::look(State& state) {
  ways_.look(state.step);
  if (!queues_.empty()) queues_.look(state);
  if (ways_.change()) heed_openings(state);
  if (!chooses_) return;
  std::vector<std::uint32_t>& option = state.crowd.option;
  const auto for_each_undecided = [&](auto&& f) {
    for (Row row = 0; row < option.size(); ++row)
      if (!is_decided(state, row) && !stands_yet(state, row)) f(row);
  };
  for_each_undecided([&](Row row) {
    if (!leg(state, row).weights.empty()) option[row] = choice(state, row);
  });
  bool counted = false;
  for_each_undecided([&](Row row) {
    if (!counted) least_crowded_.count(state);
    counted = true;
    option[row] = choice(state, row);
  });
}

bool Journeys::has_settled(const State& state, Row row, double distance) const {
  if (state.crowd.place[row] == 0 || since(state, state.crowd.stand_step[row]) < kSettled) return false;
  const Leg& its = leg(state, row);
  const double near = its.kind == Leg::Kind::queue
                          ? kAtPlace * scene_.crowd.queues[its.options[state.crowd.option[row]]].spacing
                          : kFree;
  return distance <= std::min(radius(state, row), near);
}

bool Journeys::gets_on(const State& state, Row row) const {
  const Vec &p = position(state, row), &halt = state.crowd.halt[row];
  const double radius = this->radius(state, row);
  if (!is_decided(state, row) || (p - halt).norm() > kAway * radius) return true;
  const DistanceField& way = this->way(state, row, goal(state, row));
  const double speed = scene_.crowd.desired_speed[agent(state, row)];
  return way.distance(p) <= way.distance(halt) - somewhere(radius, speed, kStuckTime);
}

Heading Journeys::heading(const State& state, Row row, std::uint32_t group) const {
  const Vec& p = position(state, row);
  if (!is_decided(state, row)) return {Vec(0.0, 0.0), 0.0};
  const Leg& leg = scene_.crowd.groups[group].journey[state.crowd.stage[row]];
  if (leg.kind == Leg::Kind::queue) return queues_.heading(state, row);
  const DistanceField& way = this->way(state, row, scene_.crowd.goal(leg, state.crowd.option[row]));
  if (Vec down; state.crowd.place[row] == 0 && way.slope(p, down)) return {down, kFree, down.squaredNorm()};
  if (state.crowd.place[row] == 0) return {way.direction(p), kFree};
  const Vec& spot = state.crowd.spot[row];
  const double distance = (spot - p).norm();
  if (is_off_spot(state, row) && barriers_.block(p, spot))  // pushed behind a wall
    if (const Vec round = way.direction(p); round != Vec(0.0, 0.0)) return {round, kFree};
  return straight_to(p, spot, distance);
}

void Journeys::gather_spots(const State& state) {
  for (std::vector<Standing>* all : {&spots_, &walkers_})
    for (Standing& some : *all) some.clear();
  for (Row row = 0; row < state.crowd.place.size(); ++row) {
    if (is_at_the_end(state, row) || !is_decided(state, row) || leg(state, row).kind == Leg::Kind::queue)
      continue;
    const bool waits = state.crowd.place[row] > 0;
    (waits ? spots_ : walkers_)[goal(state, row)].add(waits ? state.crowd.spot[row] : position(state, row),
                                                      radius(state, row));
  }
  spots_known_ = true;
}

/// Whether nobody waits there but himself.
bool Journeys::has_room(const State& state, Row row, const Vec& p) {
  const Vec& own = state.crowd.spot[row];
  const bool waits = state.crowd.place[row] > 0;
  const double radius = this->radius(state, row);
  return std::ranges::none_of(spots_, [&](Standing& spots) {
    return spots.meets(p, radius, [&](const Vec& spot) { return !waits || spot != own; });
  });
}

/// Whether nobody waits on his straight way. O(length over radius).
bool Journeys::is_way_clear(const State& state, Row row, const Vec& to) {
  const Vec& p = position(state, row);
  const double length = (to - p).norm(), radius = this->radius(state, row);
  for (double gone = radius; gone < length; gone += radius)
    if (!has_room(state, row, p + gone / length * (to - p))) return false;
  return true;
}

/// Calls f(place) for places at random in the area that he sees and where he has room, as long as it returns
/// true.
template <class F>
void Journeys::for_each_free_spot(const State& state, Row row, F&& f) {
  if (!spots_known_) gather_spots(state);
  const Vec& p = position(state, row);
  const double radius = this->radius(state, row);
  const Sampler& sampler = *samplers_[goal(state, row)];
  Random random(scene_.seed, static_cast<std::uint64_t>(state.step), state.id[scene_.crowd.first + row],
                Purpose::spot);
  for (int i = 0; i < kSpotTries && !sampler.empty(); ++i) {
    const Vec q = sampler.draw(random);
    if (!sampler.holds(q, radius) || !has_room(state, row, q) || barriers_.distance(q, radius) < radius ||
        barriers_.block(p, q))
      continue;
    if (!f(q)) return;
  }
}

/// Of several the farthest, where others who wait may be in the way: who took a nearer one would be in the
/// way of those who come later. Where he is, where there is none.
Vec Journeys::free_spot(const State& state, Row row) {
  const Vec& p = position(state, row);
  Vec farthest = p;
  int choices = 0;
  for_each_free_spot(state, row, [&](const Vec& q) {
    if ((q - p).squaredNorm() > (farthest - p).squaredNorm()) farthest = q;
    return ++choices < kChoices;
  });
  return farthest;
}

/// Of all that are looked at the farthest with nobody who waits in the way; where he is, where there is none.
Vec Journeys::spot_within_reach(const State& state, Row row) {
  const Vec& p = position(state, row);
  Vec farthest = p;
  for_each_free_spot(state, row, [&](const Vec& q) {
    if ((q - p).squaredNorm() > (farthest - p).squaredNorm() && is_way_clear(state, row, q)) farthest = q;
    return true;
  });
  return farthest;
}

/// Whether he is near one of those who wait for a goal, and on the same side of all walls.
bool Journeys::is_among(const State& state, Row row, std::uint32_t goal) {
  if (!spots_known_) gather_spots(state);
  const Vec& p = position(state, row);
  return spots_[goal].meets(p, kBeside * radius(state, row),
                            [&](const Vec& spot) { return !barriers_.block(p, spot); });
}

/// Whether he is near several of those who wait, whatever they wait for, and on the same side of all walls.
bool Journeys::is_among_several(const State& state, Row row) {
  if (!spots_known_) gather_spots(state);
  const Vec& p = position(state, row);
  int beside = 0;
  return std::ranges::any_of(spots_, [&](Standing& spots) {
    return spots.meets(p, kBeside * radius(state, row),
                       [&](const Vec& spot) { return !barriers_.block(p, spot) && ++beside >= kSeveral; });
  });
}

/// Whether one who walks to the same goal is beside him and nearer to it.
bool Journeys::is_behind_one(const State& state, Row row) {
  if (!spots_known_) gather_spots(state);
  const Vec& p = position(state, row);
  const DistanceField& way = this->way(state, row, goal(state, row));
  const double distance = way.distance(p);
  return walkers_[goal(state, row)].meets(p, kBeside * radius(state, row),
                                          [&](const Vec& q) { return way.distance(q) < distance; });
}

/// Whether he has stood for a while since he set out for his goal, or walked to and fro for longer, beside
/// one who waits for it, or beside several who wait for whatever it is: they won't make way. In a jam they do
/// so to the foremost alone: to others they may be bystanders.
bool Journeys::is_kept_out(const State& state, Row row) {
  const double under_way =
      static_cast<double>(state.step) * scene_.time.dt - scene_.crowd.start[agent(state, row)];
  const bool gets_nowhere = std::min(since(state, state.crowd.stand_step[row]), under_way) >= kPatience ||
                            std::min(since(state, state.crowd.halt_step[row]), under_way) >= kJostled;
  if (!gets_nowhere) return false;
  return (is_among(state, row, goal(state, row)) || is_among_several(state, row)) &&
         !is_behind_one(state, row);
}

void Journeys::go_to(State& state, Row row, const Vec& spot) {
  CrowdState& crowd = state.crowd;
  crowd.spot[row] = spot;
  crowd.halt[row] = position(state, row);
  crowd.stand_step[row] = crowd.halt_step[row] = state.step;
  spots_[goal(state, row)].add(spot, radius(state, row));
}

void Journeys::stay(State& state, Row row, const Vec& spot) {
  state.crowd.place[row] = 1;
  state.crowd.since[row] = state.step;
  go_to(state, row, spot);
}

/// In the area at a free place, or where he is where there is none; and there too, before the area, where
/// others who wait keep him out: else he would be in the way of those who want out, for ever.
void Journeys::begin_to_wait(State& state, Row row) {
  if (has_reached(state, row)) {
    stay(state, row, free_spot(state, row));
  } else if (is_kept_out(state, row)) {
    stay(state, row, position(state, row));
  }
}

/// Whether he isn't where he wants to stand.
bool Journeys::is_off_spot(const State& state, Row row) const {
  return (position(state, row) - state.crowd.spot[row]).norm() > radius(state, row);
}

/// Who doesn't get to his place stays where he is; outside of the area until he sees one that he can get to.
void Journeys::look_for_room(State& state, Row row) {
  CrowdState& crowd = state.crowd;
  const Vec& p = position(state, row);
  const bool is_in = this->is_in(state, row);
  bool looks = std::fmod(since(state, crowd.since[row]), kPatience) < scene_.time.dt;
  if (is_off_spot(state, row)) {
    looks = since(state, crowd.stand_step[row]) >= kPatience ||
            (is_in && since(state, crowd.halt_step[row]) >= kJostled);
    if (looks) crowd.spot[row] = p;
  }
  if (is_in || !looks) return;
  if (const Vec spot = spot_within_reach(state, row); spot != p) go_to(state, row, spot);
}

/// Whether the agent's time is over.
bool Journeys::wait(State& state, Row row) {
  CrowdState& crowd = state.crowd;
  if (crowd.place[row] == 0) begin_to_wait(state, row);
  if (crowd.place[row] == 0) return false;
  look_for_room(state, row);
  const Leg& its = leg(state, row);
  if (its.times.empty()) return false;
  const std::size_t in_group =
      agent(state, row) - scene_.crowd.groups[scene_.crowd.group[agent(state, row)]].first;
  const std::int64_t from = its.until ? 0 : crowd.since[row];
  return state.step >= from + Time{scene_.time.dt, its.times[in_group], 1}.steps();
}

/// Before a closed exit he stands where he gets to it, or to others who wait for it, or where they who wait
/// for something else keep him out; he isn't stuck.
void Journeys::wait_for_opening(State& state, Row row) {
  const Vec& p = position(state, row);
  if (state.crowd.place[row] > 0) {
    if (is_off_spot(state, row) && since(state, state.crowd.stand_step[row]) >= kPatience)
      state.crowd.spot[row] = p;
  } else if (way(state, row, goal(state, row)).distance(p) <= radius(state, row) ||
             is_among(state, row, goal(state, row)) || is_kept_out(state, row)) {
    stay(state, row, p);
  }
  state.crowd.since[row] = state.step;
}

bool Journeys::is_there(State& state, Row row) {
  switch (leg(state, row).kind) {
    case Leg::Kind::pass:
      if (ways_.is_open(goal(state, row)))
        return has_reached(state, row) ||
               has_reached_another(state, row, scene_.crowd.group[agent(state, row)]);
      wait_for_opening(state, row);
      return false;
    case Leg::Kind::wait:
      return wait(state, row);
    case Leg::Kind::queue:
      if (state.crowd.place[row] == 0) queues_.line_up(state, row);
  }
  return false;
}

void Journeys::begin_leg(State& state, Row row) const {
  state.crowd.option[row] = leg(state, row).first_option();
  state.crowd.place[row] = 0;
  state.crowd.since[row] = state.crowd.stand_step[row] = state.crowd.halt_step[row] = state.step;
  state.crowd.halt[row] = position(state, row);
}

bool Journeys::has_reached_another(const State& state, Row row, std::uint32_t group) const {
  const Journey& journey = scene_.crowd.groups[group].journey;
  const Leg& its = journey[state.crowd.stage[row]];
  if (its.options.size() == 1 || &its != &journey.back()) return false;
  const Vec from = this->from(state, row);
  const Vec& p = position(state, row);
  return std::ranges::any_of(its.options, [&](std::uint32_t goal) {
    return ways_.is_open(goal) && ways_.may_reach(goal, from, p) &&
           (ways_.is_in(goal, p) || ways_.meets_border(goal, from, p) ||
            (ways_.has_strips(goal) && ways_.is_at_strip(goal, radius(state, row), p, false)));
  });
}

bool Journeys::may_be_there(const State& state, Row row, std::uint32_t group) const {
  if (!is_decided(state, row)) return false;
  const Leg& its = scene_.crowd.groups[group].journey[state.crowd.stage[row]];
  if (its.kind == Leg::Kind::pass) {
    const std::uint32_t goal = scene_.crowd.goal(its, state.crowd.option[row]);
    if (ways_.is_open(goal) &&
        !(ways_.may_reach(goal, from(state, row), position(state, row)) && has_reached(state, row)) &&
        !has_reached_another(state, row, group))
      return false;
  }
  return !stands_yet(state, row);
}

void Journeys::advance(State& state, std::span<const std::uint8_t> may_be_there,
                       std::vector<std::uint8_t>& leaves) {
  spots_known_ = false;
  leaves.assign(state.crowd.stage.size(), 0);
  queues_.advance(state, leaves);
  for (Row row = 0; row < leaves.size(); ++row) {
    if (!leaves[row] && !(may_be_there[row] && is_there(state, row))) continue;
    ++state.crowd.stage[row];
    leaves[row] = is_at_the_end(state, row);
    if (!leaves[row]) begin_leg(state, row);
  }
}

}  // namespace throng
