// SPDX-License-Identifier: MIT
#include "sim/contact/flights.h"

#include <algorithm>
#include <atomic>
#include <bit>
#include <cmath>
#include <functional>

#include "sim/contact/collide_discs.h"
#include "sim/periodic.h"
#include "sim/simulation_error.h"

namespace throng {

using broadphase::Pair;
using narrowphase::DiscFlight;

namespace {

/// Collisions count as endless, as of discs that are wedged in, where this many a body take less than this
/// part of the step.
constexpr std::size_t kMostCollisions = 100;
constexpr double kGoesOn = 1e-5;

}  // namespace

Flights::Flights(const Scene& scene, const Plan& plan)
    : scene_(scene), plan_(plan), period_(scene.domain.max - scene.domain.min), half_period_(0.5 * period_) {}

bool Flights::fly(const Candidates& candidates, const State& state, BodyRows<const SolverBody> masses,
                  Workers& workers) {
  begin(candidates, state, masses);
  if (!foresee_all(workers)) return false;
  if (!heap_.empty() && !collide_all()) return false;
  reach();
  return true;
}

void Flights::begin(const Candidates& candidates, const State& state, BodyRows<const SolverBody> masses) {
  candidates_ = &candidates, state_ = &state, masses_ = masses, pairs_ = candidates.pairs();
  collisions_ = {}, strikes_.clear(), heap_.clear(), reached_.clear();
  for (const Bent& one : bent_) bent_of_[one.disc] = kStraight;
  bent_.clear();
  const std::vector<std::uint32_t>& body = candidates.colliders().body;
  bent_of_.resize(body.size(), kStraight), straight_.resize(body.size());
  for (std::size_t disc = 0; disc < body.size(); ++disc)
    straight_[disc] = {state.position[body[disc]], state.velocity[body[disc]]};
  if (listed_ != candidates.finds()) list_pairs_of_discs();
}

/// The second of a pair with an obstacle is the obstacle's row.
Pair Flights::discs(std::uint32_t pair) const {
  return is_pair(pair) ? pairs_[pair] : candidates_->obstacle_pairs()[pair - pairs_.size()];
}

std::uint32_t Flights::stamp(std::uint32_t pair) const {
  const auto [a, b] = discs(pair);
  return had(a) + (is_pair(pair) ? had(b) : 0);
}

Vec Flights::place(std::uint32_t disc, double time) const {
  if (bent_of_[disc] == kStraight) return straight_[disc].position + time * straight_[disc].velocity;
  const Bent& one = bent(disc);
  return one.body.position + (time - one.since) * one.body.velocity;
}

const Vec& Flights::velocity(std::uint32_t disc) const {
  return bent_of_[disc] == kStraight ? straight_[disc].velocity : bent(disc).body.velocity;
}

/// The way to the nearest image of what is at the end of `way`.
Vec Flights::nearest(const Vec& way) const {
  if (!plan_.periodic || (way.array().abs() < half_period_.array()).all()) return way;
  return nearest_image(way, period_);
}

/// From the first of two discs to the second.
Vec Flights::between(const Pair& pair, double time) const {
  return nearest(place(pair.b, time) - place(pair.a, time));
}

DiscFlight Flights::flight(std::uint32_t pair, double now) const {
  const auto [a, b] = discs(pair);
  if (is_pair(pair))
    return narrowphase::disc_flight(between({a, b}, now), velocity(b) - velocity(a), reach_[pair],
                                    scene_.time.dt - now);
  const Obstacles& obstacles = candidates_->obstacles();
  const Vec centre = place(a, now);
  const double radius = candidates_->colliders().radius[a];
  if (obstacles.is_side(b)) return narrowphase::disc_flight(centre, radius, velocity(a), obstacles.side[b]);
  return narrowphase::disc_flight(centre, radius, velocity(a), obstacles.part_at(b));
}

Vec Flights::normal(std::uint32_t pair, double now) const {
  const auto [a, b] = discs(pair);
  if (is_pair(pair)) return between({a, b}, now).normalized();
  const Obstacles& obstacles = candidates_->obstacles();
  if (obstacles.is_side(b)) return -obstacles.side[b].normal;
  return narrowphase::towards(place(a, now), obstacles.part_at(b));
}

const Surface& Flights::surface(std::uint32_t pair) const {
  if (plan_.surfaces.size() == 1) return plan_.surfaces[0];
  const auto [a, b] = discs(pair);
  const std::vector<std::uint32_t>&material = scene_.bodies.material, &body = candidates_->colliders().body;
  const std::uint32_t of_b = is_pair(pair) ? material[body[b]] : candidates_->obstacles().material[b];
  return plan_.surface(material[body[a]], of_b);
}

/// The collisions that the step begins with. False where discs overlap.
bool Flights::foresee_all(Workers& workers) {
  const MeetingsAsked asked{straight_, pairs_, reach_, plan_.periodic ? &period_ : nullptr, scene_.time.dt};
  meetings_.resize((pairs_.size() + kMeetingsWide - 1) / kMeetingsWide);
  workers.for_ranges(meetings_.size(), [&](std::size_t begin, std::size_t end) {
    find_meetings(asked, begin, end, meetings_.data());
  });
  look_at_obstacles(workers);
  for (std::size_t i = 0; i < meetings_.size(); ++i)
    for (unsigned bits = meetings_[i]; bits != 0; bits &= bits - 1) {
      const auto pair = static_cast<std::uint32_t>(i * kMeetingsWide) + std::countr_zero(bits);
      if (!foresee_first(pair, flight(pair, 0.0))) return false;
    }
  for (std::uint32_t i = 0; i < obstacle_flights_.size(); ++i)
    if (!foresee_first(static_cast<std::uint32_t>(pairs_.size()) + i, obstacle_flights_[i])) return false;
  std::ranges::make_heap(heap_, std::greater<>());
  return true;
}

void Flights::look_at_obstacles(Workers& workers) {
  const auto first = static_cast<std::uint32_t>(pairs_.size());
  obstacle_flights_.resize(candidates_->obstacle_pairs().size());
  workers.for_ranges(obstacle_flights_.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i)
      obstacle_flights_[i] = flight(first + static_cast<std::uint32_t>(i), 0.0);
  });
}

/// False where the two overlap deeper than what rounding leaves.
bool Flights::foresee_first(std::uint32_t pair, const DiscFlight& flight) {
  if (flight.gap < -kTouchRounding * candidates_->colliders().radius[discs(pair).a]) return false;
  if (flight.time < scene_.time.dt) heap_.push_back({flight.time, pair, 0});
  return true;
}

void Flights::foresee(std::uint32_t pair, double now) {
  const double time = now + flight(pair, now).time;
  if (!(time < scene_.time.dt)) return;
  heap_.push_back({time, pair, stamp(pair)});
  std::ranges::push_heap(heap_, std::greater<>());
}

void Flights::list_pairs_of_discs() {
  const std::vector<double>& radius = candidates_->colliders().radius;
  listed_ = candidates_->finds();
  reach_.clear();
  begin_.assign(radius.size() + 1, 0);
  for (const auto [a, b] : pairs_) {
    ++begin_[a], ++begin_[b];
    reach_.push_back(radius[a] + radius[b]);
  }
  const std::span<const Pair> with_obstacles = candidates_->obstacle_pairs();
  for (const Pair& pair : with_obstacles) ++begin_[pair.a];
  std::uint32_t sum = 0;
  for (std::uint32_t& begin : begin_) begin = sum += begin;
  of_disc_.resize(sum);
  auto row = static_cast<std::uint32_t>(count());
  for (std::size_t i = with_obstacles.size(); i-- > 0;) of_disc_[--begin_[with_obstacles[i].a]] = --row;
  for (; row-- > 0;) of_disc_[--begin_[pairs_[row].a]] = row, of_disc_[--begin_[pairs_[row].b]] = row;
}

/// Takes collisions in their order. False where they don't end.
bool Flights::collide_all() {
  const std::size_t most = kMostCollisions * (straight_.size() + 1);
  std::size_t left = most;
  double since = 0.0;
  while (!heap_.empty()) {
    std::ranges::pop_heap(heap_, std::greater<>());
    const Collision next = heap_.back();
    heap_.pop_back();
    if (next.stamp != stamp(next.pair)) continue;
    if (left-- == 0) {
      if (!(next.time - since > kGoesOn * scene_.time.dt)) return false;
      left = most, since = next.time;
    }
    collide(next.pair, next.time);
  }
  return true;
}

void Flights::collide(std::uint32_t pair, double now) {
  const auto [a, b] = discs(pair);
  const std::vector<double>& radius = candidates_->colliders().radius;
  const Vec n = normal(pair, now);
  stop(a, now);
  if (is_pair(pair)) stop(b, now);
  SolverBody obstacle{Vec(0.0, 0.0), 0.0, 0.0, Vec(0.0, 0.0), 0.0, 0.0};
  SolverBody &one = bent_[bent_of_[a]].body, &other = is_pair(pair) ? bent_[bent_of_[b]].body : obstacle;
  const DiscTouch touch{n, radius[a], is_pair(pair) ? radius[b] : 0.0};
  const double impulse = collide_discs(one, other, touch, surface(pair));
  if (is_pair(pair))
    collisions_.add_pair(touch.radius_a + touch.radius_b, impulse, one.inverse_mass + other.inverse_mass);
  else
    ++collisions_.walls;
  if (plan_.sums_impulses) list(pair, one.position + radius[a] * n, impulse);
  foresee_of(a, pair, now);
  if (is_pair(pair)) foresee_of(b, pair, now);
}

void Flights::list(std::uint32_t pair, const Vec& point, double impulse) {
  const auto [a, b] = discs(pair);
  const auto id = [&](std::uint32_t disc) { return state_->id[candidates_->colliders().body[disc]]; };
  strikes_.push_back({id(a), is_pair(pair) ? id(b) : 0, impulse,
                      plan_.periodic ? wrapped(point, scene_.domain) : point, false});
}

/// What a disc meets next, which has just collided: not at once the same one again.
void Flights::foresee_of(std::uint32_t disc, std::uint32_t collided, double now) {
  for (std::uint32_t i = begin_[disc]; i < begin_[disc + 1]; ++i)
    if (of_disc_[i] != collided) foresee(of_disc_[i], now);
}

/// Where a disc's way bends.
void Flights::stop(std::uint32_t disc, double now) {
  const std::uint32_t body = candidates_->colliders().body[disc];
  if (bent_of_[disc] == kStraight) {
    const auto& [position, velocity] = straight_[disc];
    bent_of_[disc] = static_cast<std::uint32_t>(bent_.size());
    bent_.push_back({{velocity, state_->spin[body], masses_[body].inverse_mass, position, 0.0,
                      masses_[body].inverse_inertia},
                     0.0,
                     0.0,
                     disc,
                     0});
  }
  Bent& one = bent_[bent_of_[disc]];
  advance(one, now);
  ++one.had;
  one.farthest = std::max(one.farthest, std::sqrt(candidates_->squared_way(body, one.body.position)));
}

void Flights::advance(Bent& one, double time) {
  const double way = time - one.since;
  one.body.position += way * one.body.velocity;
  one.body.turn += way * one.body.spin;
  one.since = time;
}

/// To the step's end.
void Flights::reach() {
  for (Bent& one : bent_) {
    advance(one, scene_.time.dt);
    const std::uint32_t body = candidates_->colliders().body[one.disc];
    const double way = std::sqrt(candidates_->squared_way(body, one.body.position));
    reached_.push_back({one.disc, std::max(one.farthest, way)});
  }
}

bool Flights::land(State& state, Workers& workers) {
  for (Bent& one : bent_) one.body.turn += state.angle[candidates_->colliders().body[one.disc]];
  std::atomic<bool> all_go_on = true;
  workers.for_ranges(state.position.size(), [&](std::size_t begin, std::size_t end) {
    if (!land_straight(state, begin, end)) all_go_on = false;
  });
  for (const Bent& one : bent_) {
    const std::uint32_t i = candidates_->colliders().body[one.disc];
    state.position[i] = one.body.position, state.velocity[i] = one.body.velocity;
    state.angle[i] = one.body.turn, state.spin[i] = one.body.spin;
    if (!settle(state, i)) all_go_on = false;
  }
  return all_go_on;
}

/// As if none of those rows had collided.
bool Flights::land_straight(State& state, std::size_t begin, std::size_t end) const {
  bool all_go_on = true;
  for (std::size_t i = begin; i < end; ++i) {
    state.position[i] += scene_.time.dt * state.velocity[i];
    if (plan_.rotation) state.angle[i] += scene_.time.dt * state.spin[i];
    all_go_on &= settle(state, i);
  }
  return all_go_on;
}

/// Back into a domain that repeats. False where the body can't go on.
bool Flights::settle(State& state, std::size_t body) const {
  if (!can_go_on(state, body)) return false;
  if (plan_.periodic) state.position[body] = wrapped(state.position[body], scene_.domain);
  return true;
}

}  // namespace throng
