// SPDX-License-Identifier: MIT
#include "sim/contact/candidates.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "sim/periodic.h"
#include "sim/simulation_error.h"

namespace throng {

namespace {

/// Where a body's velocity and gravity take a point of it within dt, and a little more: a slow body may be
/// hit by the fastest one and hit a third within the same step, as in Newton's cradle.
constexpr double kSkin = 0.1;  // of the radius, at most

/// How far pairs are looked for that several steps of flights shall share.
constexpr double kShared = 0.5;  // of the radius
constexpr double kUnbounded = std::numeric_limits<double>::infinity();

std::vector<broadphase::Extent> extents(const Obstacles& obstacles) {
  std::vector<broadphase::Extent> result;
  for (const narrowphase::Convex& part : obstacles.part) {
    const auto& v = part.vertices;
    result.push_back(v.size() == 2 && part.radius == 0.0 ? broadphase::Extent::of_segment(v[0], v[1])
                                                         : broadphase::Extent::of(bounds(part)));
  }
  return result;
}

[[noreturn]] void fail_at_period(const State& state, std::uint32_t body) {
  throw SimulationError(
      "step " + std::to_string(state.step + 1) + ": body " + std::to_string(state.id[body]) +
      " reaches farther in a step than a quarter of the period: take a shorter dt or a wider domain");
}

/// Where bodies were hit so hard, or contacts of a forged checkpoint push so hard, that no double holds it.
[[noreturn]] void fail_at_infinity(const State& state, std::uint32_t body) {
  throw SimulationError("step " + std::to_string(state.step + 1) + ": body " +
                        std::to_string(state.id[body]) + " gets infinitely far within it");
}

/// Every pair of a small scene, and a thousand partners each in a large one: more is a step so long that
/// nearly all might meet.
[[noreturn]] void fail_at_crowd(const State& state, std::size_t pairs) {
  throw SimulationError("step " + std::to_string(state.step + 1) + ": " + std::to_string(pairs) +
                        " pairs of bodies could meet within it: take a shorter dt");
}

double fastest(const State& state) {
  double most = 0.0;
  for (const Vec& v : state.velocity) most = std::max(most, v.squaredNorm());
  return std::sqrt(most);
}

}  // namespace

Candidates::Candidates(const Scene& scene, const Plan& plan)
    : scene_(scene), plan_(plan), colliders_(throng::colliders(scene, plan)) {
  period_ = {scene.domain.min, scene.domain.max - scene.domain.min};
  if (!plan.obstacles && !plan.box) return;
  const double widest = colliders_.radius.empty() ? 0.0 : *std::ranges::max_element(colliders_.radius);
  // No body reaches farther than a quarter of the period: see find().
  obstacles_ = throng::obstacles(scene, 0.25 * std::max(period_.size.x(), period_.size.y()));
  if (plan.obstacles) index_.build(extents(obstacles_), 2.0 * widest);
}

void Candidates::find(const State& state, double dt) {
  ++finds_;
  found_at_ = state.position;
  place(state, dt);
  if (plan_.pairs) {
    disc_pairs_.find(centre_, reach_, plan_.periodic ? &period_ : nullptr, pairs_, colliders_.movable);
    if (plan_.composites) drop_own_parts();
    if (pairs_.size() > 10'000'000 + 1000 * colliders_.size()) fail_at_crowd(state, pairs_.size());
  }
  if (plan_.obstacles || plan_.box) find_obstacle_pairs();
}

void Candidates::place(const State& state, double dt) {
  const std::size_t n = colliders_.size();
  const double fall = plan_.gravity ? scene_.gravity.norm() * dt * dt : 0.0;
  const double chain = fastest(state) * dt;
  const double widest = plan_.periodic ? 0.249 * period_.size.minCoeff() : kUnbounded;
  centre_.resize(n), margin_.resize(n), reach_.resize(n);
  for (std::size_t i = 0; i < n; ++i) {
    const std::uint32_t body = colliders_.body[i];
    const double radius = colliders_.radius[i];
    centre_[i] = state.position[body];
    margin_[i] = state.velocity[body].norm() * dt + fall + std::min(chain, kSkin * radius);
    if (!colliders_.centre.empty()) {
      const Vec offset = narrowphase::pose({0.0, 0.0}, state.angle[body]).rotate(colliders_.centre[i]);
      centre_[i] += offset;
      margin_[i] += std::abs(state.spin[body]) * offset.norm() * dt;
    }
    if (plan_.flights) margin_[i] = std::max(margin_[i], std::min(kShared * radius, widest - radius));
    if (!widened_.empty()) margin_[i] = std::max(margin_[i], widened_[body]);
    reach_[i] = radius + margin_[i];
    if (!std::isfinite(reach_[i])) fail_at_infinity(state, body);
    if (plan_.periodic && 4.0 * reach_[i] > period_.size.minCoeff()) fail_at_period(state, body);
  }
  if (plan_.periodic && !colliders_.centre.empty()) wrap_centres();
}

/// Parts of a body near the seam may stand beyond it.
void Candidates::wrap_centres() {
  wrap_.resize(centre_.size());
  for (std::size_t i = 0; i < centre_.size(); ++i) {
    const Vec inside = wrapped(centre_[i], scene_.domain);
    wrap_[i] = inside - centre_[i];
    centre_[i] = inside;
  }
}

Vec Candidates::wrap(std::uint32_t collider) const {
  return wrap_.empty() ? Vec(0.0, 0.0) : wrap_[collider];
}

double Candidates::squared_way(std::uint32_t body, const Vec& position) const {
  const Vec way = position - found_at_[body];
  if (!plan_.periodic || (2.0 * way.array().abs() < period_.size.array()).all()) return way.squaredNorm();
  return nearest_image(way, period_.size).squaredNorm();
}

bool Candidates::serve(const State& state, double dt) const {
  if (!plan_.flights || !widened_.empty() || found_at_.size() != state.position.size()) return false;
  for (std::size_t i = 0; i < colliders_.size(); ++i) {
    const std::uint32_t body = colliders_.body[i];
    const double left = margin_[i] - state.velocity[body].norm() * dt;
    if (!(left >= 0.0 && squared_way(body, state.position[body]) <= left * left)) return false;
  }
  return true;
}

bool Candidates::widen(std::span<const SolverBody> bodies, std::span<const double> farthest, bool all) {
  bool farther = false;
  double longest = 0.0;
  for (std::size_t i = 0; i < colliders_.size(); ++i) {
    if (!colliders_.movable[i]) continue;
    const std::uint32_t body = colliders_.body[i];
    const double turned =
        colliders_.centre.empty() ? 0.0 : std::abs(bodies[body].turn) * colliders_.centre[i].norm();
    const double looked = margin_[i] * (1.0 + 1e-9) - turned;
    const double before = farthest.empty() ? 0.0 : farthest[body];
    const double moved = squared_way(body, bodies[body].position);
    if (looked >= before && moved <= looked * looked) continue;
    const double way = std::max(std::sqrt(moved), before) + turned;
    if (widened_.empty()) widened_.resize(bodies.size(), 0.0);
    widened_[body] = std::max(widened_[body], 1.5 * way);
    longest = std::max(longest, 1.5 * way);
    farther = true;
  }
  if (!farther) widened_.clear();
  if (all)
    for (double& way : widened_) way = std::max(way, longest);
  return farther;
}

void Candidates::drop_own_parts() {
  std::erase_if(pairs_, [&](const broadphase::Pair& pair) {
    return colliders_.body[pair.a] == colliders_.body[pair.b];
  });
}

void Candidates::find_obstacle_pairs() {
  obstacle_pairs_.clear();
  for (std::uint32_t i = 0; i < colliders_.size(); ++i) {
    if (!colliders_.movable[i]) continue;
    if (plan_.box) add_box_sides(i);
    if (!plan_.obstacles) continue;
    const Eigen::AlignedBox2d box(centre_[i].array() - reach_[i], centre_[i].array() + reach_[i]);
    const auto first = static_cast<std::uint32_t>(obstacles_.side.size());
    index_.for_each_near(box, [&](std::uint32_t item) { obstacle_pairs_.push_back({i, first + item}); });
  }
}

void Candidates::add_box_sides(std::uint32_t collider) {
  for (std::uint32_t i = 0; i < obstacles_.side.size(); ++i) {
    const narrowphase::HalfPlane& side = obstacles_.side[i];
    if (side.normal.dot(centre_[collider] - side.point) < reach_[collider])
      obstacle_pairs_.push_back({collider, i});
  }
}

Vec Candidates::shift(broadphase::Pair pair) const {
  if (!plan_.periodic) return {0.0, 0.0};
  const Vec between = centre_[pair.b] - centre_[pair.a];
  return nearest_image(between, period_.size) - between + wrap(pair.b) - wrap(pair.a);
}

Vec Candidates::obstacle_shift(std::uint32_t collider) const {
  return -wrap(collider);
}

}  // namespace throng
