// SPDX-License-Identifier: MIT
#include "sim/contact/flights.h"

#include <hwy/cache_control.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <functional>
#include <limits>

#include "sim/contact/strike.h"
#include "sim/periodic.h"

namespace throng {

using broadphase::Pair;
using narrowphase::DiscFlight;

namespace {

constexpr std::size_t kPairsAhead = 12;       // pairs: so long before it is needed a body is asked for
constexpr std::size_t kMostCollisions = 100;  // a body and step, all together

}  // namespace

Flights::Flights(const Scene& scene, const Plan& plan)
    : scene_(scene), plan_(plan), half_period_(0.5 * (scene.domain.max - scene.domain.min)) {}

bool Flights::fly(const Candidates& candidates, std::span<SolverBody> bodies, Workers& workers) {
  candidates_ = &candidates, bodies_ = bodies, collisions_ = {};
  pairs_ = static_cast<std::uint32_t>(candidates.pairs().size());
  since_.assign(bodies.size(), 0.0), had_.assign(bodies.size(), 0), farthest_.assign(bodies.size(), 0.0);
  if (!foresee_all(workers)) return false;
  if (!heap_.empty()) {
    if (listed_ != candidates.finds()) list_pairs_of_bodies();
    if (!collide_all()) return false;
  }
  for (std::uint32_t body = 0; body + 1 < bodies.size(); ++body) advance(body, scene_.time.dt);
  return true;
}

Pair Flights::colliders(std::uint32_t pair) const {
  return pair < pairs_ ? candidates_->pairs()[pair] : candidates_->obstacle_pairs()[pair - pairs_];
}

std::uint32_t Flights::body_a(std::uint32_t pair) const {
  return candidates_->colliders().body[colliders(pair).a];
}

/// The row behind all bodies stands for obstacles.
std::uint32_t Flights::body_b(std::uint32_t pair) const {
  if (pair < pairs_) return candidates_->colliders().body[colliders(pair).b];
  return static_cast<std::uint32_t>(bodies_.size() - 1);
}

Vec Flights::place(std::uint32_t body, double time) const {
  return bodies_[body].position + (time - since_[body]) * bodies_[body].velocity;
}

/// The way to the nearest image of what is at the end of `way`.
Vec Flights::nearest(const Vec& way) const {
  if (!plan_.periodic || (way.array().abs() < half_period_.array()).all()) return way;
  return nearest_image(way, 2.0 * half_period_);
}

/// From the first of two bodies to the second.
Vec Flights::between(std::uint32_t pair, double time) const {
  return nearest(place(body_b(pair), time) - place(body_a(pair), time));
}

DiscFlight Flights::flight(std::uint32_t pair, double now) const {
  const auto [a, b] = colliders(pair);
  const Colliders& all = candidates_->colliders();
  const SolverBody& body = bodies_[all.body[a]];
  if (pair < pairs_)
    return narrowphase::disc_flight(between(pair, now), bodies_[all.body[b]].velocity - body.velocity,
                                    all.radius[a] + all.radius[b], scene_.time.dt - now);
  const Obstacles& obstacles = candidates_->obstacles();
  const std::size_t sides = obstacles.side.size();
  const Vec centre = place(all.body[a], now);
  if (b < sides) return narrowphase::disc_flight(centre, all.radius[a], body.velocity, obstacles.side[b]);
  return narrowphase::disc_flight(centre, all.radius[a], body.velocity, obstacles.part[b - sides]);
}

Vec Flights::normal(std::uint32_t pair, double now) const {
  if (pair < pairs_) return between(pair, now).normalized();
  const auto [a, b] = colliders(pair);
  const Obstacles& obstacles = candidates_->obstacles();
  const std::size_t sides = obstacles.side.size();
  if (b < sides) return -obstacles.side[b].normal;
  return narrowphase::towards(place(candidates_->colliders().body[a], now), obstacles.part[b - sides]);
}

const Surface& Flights::surface(std::uint32_t pair) const {
  const auto [a, b] = colliders(pair);
  const std::vector<std::uint32_t>& material = scene_.bodies.material;
  const std::uint32_t of_b =
      pair < pairs_ ? material[candidates_->colliders().body[b]] : candidates_->obstacles().material[b];
  return plan_.surfaces[material[candidates_->colliders().body[a]] * scene_.materials.size() + of_b];
}

/// As flight() at the step's beginning, of two bodies.
DiscFlight Flights::first_flight(const Pair& pair) const {
  const Colliders& all = candidates_->colliders();
  const SolverBody &a = bodies_[all.body[pair.a]], &b = bodies_[all.body[pair.b]];
  return narrowphase::disc_flight(nearest(b.position - a.position), b.velocity - a.velocity,
                                  all.radius[pair.a] + all.radius[pair.b], scene_.time.dt);
}

/// The second body of a later pair: it stands anywhere, where the first one is the last pair's, mostly.
void Flights::ask_for(const Pair& pair) const {
  hwy::Prefetch(&bodies_[candidates_->colliders().body[pair.b]]);
}

/// The collisions that the step begins with. False where bodies overlap.
bool Flights::foresee_all(Workers& workers) {
  first_.resize(count()), heap_.clear();
  const std::span<const Pair> pairs = candidates_->pairs();
  std::atomic<bool> overlap = false;
  workers.for_ranges(first_.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      if (i + kPairsAhead < pairs.size()) ask_for(pairs[i + kPairsAhead]);
      const DiscFlight next =
          i < pairs.size() ? first_flight(pairs[i]) : flight(static_cast<std::uint32_t>(i), 0.0);
      first_[i] = next.time;
      if (next.gap < 0.0 && is_deep(next.gap, static_cast<std::uint32_t>(i)))
        overlap.store(true, std::memory_order_relaxed);
    }
  });
  if (overlap) return false;
  for (std::uint32_t pair = 0; pair < first_.size(); ++pair)
    if (first_[pair] < scene_.time.dt) heap_.push_back({first_[pair], pair, 0});
  std::ranges::make_heap(heap_, std::greater<>());
  return true;
}

/// Deeper than what rounding leaves.
bool Flights::is_deep(double gap, std::uint32_t pair) const {
  return gap < -kTouchRounding * candidates_->colliders().radius[colliders(pair).a];
}

void Flights::foresee(std::uint32_t pair, double now) {
  const double time = now + flight(pair, now).time;
  if (!(time < scene_.time.dt)) return;
  heap_.push_back({time, pair, had_[body_a(pair)] + had_[body_b(pair)]});
  std::ranges::push_heap(heap_, std::greater<>());
}

void Flights::list_pairs_of_bodies() {
  const auto n = static_cast<std::uint32_t>(first_.size());
  listed_ = candidates_->finds();
  begin_.assign(bodies_.size() + 1, 0);
  for (std::uint32_t pair = 0; pair < n; ++pair) {
    ++begin_[body_a(pair)];
    if (pair < pairs_) ++begin_[body_b(pair)];
  }
  std::uint32_t sum = 0;
  for (std::uint32_t& begin : begin_) begin = sum += begin;
  of_body_.resize(sum);
  for (std::uint32_t pair = n; pair-- > 0;) {
    of_body_[--begin_[body_a(pair)]] = pair;
    if (pair < pairs_) of_body_[--begin_[body_b(pair)]] = pair;
  }
}

/// Takes collisions in their order. False where they don't end.
bool Flights::collide_all() {
  std::size_t left = kMostCollisions * bodies_.size();
  while (!heap_.empty()) {
    std::ranges::pop_heap(heap_, std::greater<>());
    const Collision next = heap_.back();
    heap_.pop_back();
    if (next.stamp != had_[body_a(next.pair)] + had_[body_b(next.pair)]) continue;
    if (left-- == 0) return false;
    collide(next.pair, next.time);
  }
  return true;
}

void Flights::collide(std::uint32_t pair, double now) {
  const std::uint32_t a = body_a(pair), b = body_b(pair);
  const Colliders& all = candidates_->colliders();
  const double radius_b = pair < pairs_ ? all.radius[colliders(pair).b] : 0.0;
  const Vec n = normal(pair, now);
  stop(a, now);
  if (pair < pairs_) stop(b, now);
  const Touch touch{n, all.radius[colliders(pair).a], radius_b};
  const double impulse = strike(bodies_[a], bodies_[b], touch, surface(pair));
  if (pair < pairs_)
    collisions_.add_pair(touch.radius_a + touch.radius_b, impulse,
                         bodies_[a].inverse_mass + bodies_[b].inverse_mass);
  else
    ++collisions_.walls;
  foresee_of(a, pair, now);
  if (pair < pairs_) foresee_of(b, pair, now);
}

/// What a body meets next, which has just collided: not at once the same one again.
void Flights::foresee_of(std::uint32_t body, std::uint32_t collided, double now) {
  for (std::uint32_t i = begin_[body]; i < begin_[body + 1]; ++i)
    if (of_body_[i] != collided) foresee(of_body_[i], now);
}

/// Where a body's way bends.
void Flights::stop(std::uint32_t body, double now) {
  advance(body, now);
  ++had_[body];
  farthest_[body] =
      std::max(farthest_[body], std::sqrt(candidates_->squared_way(body, bodies_[body].position)));
}

void Flights::advance(std::uint32_t body, double time) {
  SolverBody& one = bodies_[body];
  const double way = time - since_[body];
  one.position += way * one.velocity;
  one.turn += way * one.spin;
  since_[body] = time;
}

}  // namespace throng
