// SPDX-License-Identifier: MIT
#include "sim/contact/candidates.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdio>
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
constexpr double kShared = 0.75;  // of the radius

/// So few are sooner compared with one another than sorted into cells.
constexpr std::size_t kFewColliders = 32;

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

}  // namespace

Candidates::Candidates(const Scene& scene, const Plan& plan, Workers& workers)
    : scene_(scene),
      plan_(plan),
      workers_(workers),
      colliders_(throng::colliders(scene, plan)),
      disc_pairs_(workers.team()),
      rows_(Rows::all(0)) {
  period_ = {scene.domain.min, scene.domain.max - scene.domain.min};
  if (!plan.obstacles && !plan.box) return;
  const double widest = colliders_.radius.empty() ? 0.0 : *std::ranges::max_element(colliders_.radius);
  // No body reaches farther than a quarter of the period: see find().
  obstacles_ = throng::obstacles(scene, 0.25 * std::max(period_.size.x(), period_.size.y()));
  if (plan.obstacles) index_.build(extents(obstacles_), 2.0 * widest);
}

void Candidates::find(const State& state, double dt) {
  const Rows all = Rows::all(colliders_.size());
  place(state, dt, all);
  pair_up(state, all);
}

void Candidates::pair_up(const State& state, Rows colliders) {
  ++finds_;
  rows_ = colliders;
  if (plan_.pairs) {
    find_pairs_of(colliders);
    if (plan_.composites) drop_own_parts();
    if (pairs_.size() > 10'000'000 + 1000 * colliders_.size()) fail_at_crowd(state, pairs_.size());
  }
  if (plan_.obstacles || plan_.box) find_obstacle_pairs();
}

void Candidates::find_pairs_of(Rows colliders) {
  const broadphase::Period* period = plan_.periodic ? &period_ : nullptr;
  if (colliders.are_all() && colliders.size() <= kFewColliders) return compare_all(period);
  if (colliders.are_all()) return disc_pairs_.find(centre_, reach_, period, pairs_, colliders_.movable);
  some_centres_.clear(), some_reaches_.clear(), some_movable_.clear();
  colliders.for_each([&](std::uint32_t row) {
    some_centres_.push_back(centre_[row]), some_reaches_.push_back(reach_[row]);
    some_movable_.push_back(colliders_.movable[row]);
  });
  disc_pairs_.find(some_centres_, some_reaches_, period, pairs_, some_movable_);
  for (broadphase::Pair& pair : pairs_) pair = {colliders[pair.a], colliders[pair.b]};
}

/// As DiscPairs does.
void Candidates::compare_all(const broadphase::Period* period) {
  pairs_.clear();
  for (std::uint32_t a = 0; a < colliders_.size(); ++a)
    for (std::uint32_t b = a + 1; b < colliders_.size(); ++b) {
      const double reach = reach_[a] + reach_[b];
      const bool near = broadphase::squared_distance(centre_[a], centre_[b], period) <= reach * reach;
      if (near && (colliders_.movable[a] || colliders_.movable[b])) pairs_.push_back({a, b});
    }
}

void Candidates::place(const State& state, double dt, Rows colliders) {
  found_at_.resize(state.position.size());
  if (!colliders_.centre.empty()) pose_.resize(state.position.size());
  centre_.resize(colliders_.size()), margin_.resize(colliders_.size()), reach_.resize(colliders_.size());
  if (!colliders_.swing.empty()) turning_.resize(colliders_.size());
  if (plan_.periodic && !colliders_.centre.empty()) wrap_.resize(colliders_.size(), Vec(0.0, 0.0));
  double fastest = 0.0, turns = 0.0, spin = 0.0;
  colliders.for_each([&](std::uint32_t row) {
    const std::uint32_t body = colliders_.body[row];
    fastest = std::max(fastest, state.velocity[body].squaredNorm());
    if (colliders_.swing.empty()) return;
    if (!is_disc(colliders_, row)) spin = std::max(spin, std::abs(state.spin[body]));
    turns = std::max(turns, std::abs(state.spin[body]) * scene_.bodies.radius[body]);
  });
  dt_ = dt;
  fall_ = plan_.gravity ? scene_.gravity.norm() * dt * dt : 0.0;
  chain_ = std::sqrt(fastest) * dt, farthest_turn_ = spin * dt;
  farthest_way_ = widened_.empty() ? chain_ + fall_ + turns * dt : kUnbounded;
  place_more(state, colliders);
}

/// Parts of one body are placed by one thread, as they share its pose.
void Candidates::place_more(const State& state, Rows colliders) {
  std::atomic<bool> all_near = true;
  const auto place = [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i)
      if (!place_one(state, colliders[i])) all_near = false;
  };
  if (plan_.composites)
    place(0, colliders.size());
  else
    workers_.for_ranges(colliders.size(), place);
  if (!all_near) colliders.for_each([&](std::uint32_t row) { check_reach(state, row); });
}

bool Candidates::reaches_too_far(std::uint32_t i) const {
  return !std::isfinite(reach_[i]) || (plan_.periodic && 4.0 * reach_[i] > period_.size.minCoeff());
}

/// Throws of a collider that reaches too far, whoever placed it.
void Candidates::check_reach(const State& state, std::uint32_t i) const {
  if (!reaches_too_far(i)) return;
  if (!std::isfinite(reach_[i])) fail_at_infinity(state, colliders_.body[i]);
  fail_at_period(state, i);
}

/// What a shorter step takes of its way is at least in proportion, but for the skin.
void Candidates::fail_at_period(const State& state, std::uint32_t i) const {
  const double quarter = 0.25 * period_.size.minCoeff(), radius = colliders_.radius[i];
  const double longest = 0.99 * dt_ * (quarter - (1.0 + kSkin) * radius) / (reach_[i] - radius);
  char text[250];
  std::snprintf(
      text, sizeof text,
      "step %lld: body %lld may reach %.3g m within its %.3g s, farther than a quarter of the period, "
      "%.3g m: take ",
      static_cast<long long>(state.step + 1), static_cast<long long>(state.id[colliders_.body[i]]), reach_[i],
      dt_, quarter);
  char dt[50] = "";
  if (longest > 0.0) std::snprintf(dt, sizeof dt, "time.dt at most %.3g s, or ", longest);
  throw SimulationError(std::string(text) + dt + "a wider domain");
}

std::string period_refusal(const Scene& scene) {
  if (scene.domain.kind != DomainKind::periodic) return "";
  const Plan plan = plan_for(scene);
  if (!plan.contacts()) return "";
  Workers alone(1);
  Candidates candidates(scene, plan, alone);
  try {
    candidates.place(initial_state(scene), scene.time.dt, Rows::all(candidates.colliders().size()));
  } catch (const SimulationError& error) {
    return error.what();
  }
  return "";
}

/// False where it reaches too far.
bool Candidates::place_one(const State& state, std::uint32_t i) {
  const std::uint32_t body = colliders_.body[i];
  const double radius = colliders_.radius[i];
  found_at_[body] = centre_[i] = state.position[body];
  const double speed = state.velocity[body].norm();
  margin_[i] = speed * dt_ + fall_ + std::min(chain_, kSkin * radius);
  if (!colliders_.centre.empty()) {
    const bool next_part = i > 0 && colliders_.body[i - 1] == body;
    if (!next_part) pose_[body] = narrowphase::pose(state.position[body], state.angle[body]);
    const Vec offset = pose_[body].rotate(colliders_.centre[i]);
    centre_[i] += offset;
    const double turn = std::abs(state.spin[body]) * dt_;
    margin_[i] += turn * offset.norm();
    turning_[i] = std::min(turn * radius, colliders_.swing[i]);
  }
  if (plan_.flights) {
    const double widest = plan_.periodic ? 0.249 * period_.size.minCoeff() : kUnbounded;
    margin_[i] = std::max(margin_[i], std::min(kShared * radius, widest - radius));
  }
  if (!widened_.empty()) margin_[i] = std::max(margin_[i], widened_[body]);
  reach_[i] = radius + margin_[i];
  if (reaches_too_far(i)) return false;
  if (plan_.periodic && !wrap_.empty()) wrap_centre(i);
  return true;
}

/// Parts of a body near the seam may stand beyond it.
void Candidates::wrap_centre(std::uint32_t i) {
  const Vec inside = wrapped(centre_[i], scene_.domain);
  wrap_[i] = inside - centre_[i];
  centre_[i] = inside;
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

double Candidates::swung(std::uint32_t i, double turn) const {
  if (turning_.empty()) return 0.0;
  const double radius = colliders_.radius[i], swing = colliders_.swing[i];
  const double unseen = std::min(std::abs(turn) * radius, swing) - turning_[i];
  return std::max(unseen - 0.5 * std::max(radius - swing, 0.0), 0.0);
}

std::span<const Reached> Candidates::strays(BodyRows<const SolverBody> bodies,
                                            std::span<const double> farthest) {
  strays_.clear();
  workers_.gather(rows_.size(), stray_lists_, strays_,
                  [&](std::size_t begin, std::size_t end, std::vector<Reached>& strays) {
                    for (std::size_t k = begin; k < end; ++k) {
                      const std::uint32_t i = rows_[k], body = colliders_.body[i];
                      const double before = farthest.empty() ? 0.0 : farthest[body];
                      if (const auto way = way_astray(i, bodies[body], before)) strays.push_back({i, *way});
                    }
                  });
  if (!strays_.empty()) farthest_way_ = kUnbounded;
  return strays_;
}

/// How far it got (m), where that is farther than find() looked.
std::optional<double> Candidates::way_astray(std::uint32_t i, const SolverBody& body, double before) const {
  if (!colliders_.movable[i]) return {};
  const double turned = colliders_.centre.empty() ? 0.0 : std::abs(body.turn) * colliders_.centre[i].norm();
  const double aside = turned + swung(i, body.turn);
  const double looked = margin_[i] * (1.0 + 1e-9) - aside;
  const double moved = squared_way(colliders_.body[i], body.position);
  if (looked >= before && moved <= looked * looked) return {};
  return std::max(std::sqrt(moved), before) + aside;
}

bool Candidates::widen(std::span<const Reached> reached, bool all) {
  Widened widened;
  for (const auto [collider, way] : reached)
    if (colliders_.movable[collider] && !(way <= margin_[collider] * (1.0 + 1e-9)))
      widen_one(collider, way, widened);
  return keep(widened, all);
}

void Candidates::widen_one(std::uint32_t collider, double way, Widened& widened) {
  const std::uint32_t body = colliders_.body[collider];
  if (widened_.empty()) widened_.resize(found_at_.size(), 0.0);
  widened_[body] = std::max(widened_[body], 1.5 * way);
  widened.longest = std::max(widened.longest, 1.5 * way);
  widened.any = true;
}

bool Candidates::keep(const Widened& widened, bool all) {
  if (!widened.any) widened_.clear();
  if (all)
    for (double& way : widened_) way = std::max(way, widened.longest);
  return widened.any;
}

void Candidates::drop_own_parts() {
  std::erase_if(pairs_, [&](const broadphase::Pair& pair) {
    return colliders_.body[pair.a] == colliders_.body[pair.b];
  });
}

void Candidates::find_obstacle_pairs() {
  obstacle_pairs_.clear();
  workers_.gather(rows_.size(), pair_lists_, obstacle_pairs_,
                  [&](std::size_t begin, std::size_t end, std::vector<broadphase::Pair>& pairs) {
                    for (std::size_t k = begin; k < end; ++k) {
                      const std::uint32_t i = rows_[k];
                      if (!colliders_.movable[i]) continue;
                      if (plan_.box && nears_box(i)) add_box_sides(i, pairs);
                      if (!plan_.obstacles) continue;
                      const broadphase::Box box(centre_[i].array() - reach_[i],
                                                centre_[i].array() + reach_[i]);
                      for_each_obstacle_near(box, [&](std::uint32_t side) { pairs.push_back({i, side}); });
                    }
                  });
}

void Candidates::list_near(double room, std::vector<broadphase::Pair>& pairs) const {
  const std::span<const broadphase::Pair> list = disc_pairs_.list();
  if (!rows_.are_all() || colliders_.size() <= kFewColliders || list.empty()) {
    pairs.assign(pairs_.begin(), pairs_.end());
    return;
  }
  pairs.clear();
  for (const broadphase::Pair& pair : list)
    if (may_meet(pair, room) && colliders_.body[pair.a] != colliders_.body[pair.b]) pairs.push_back(pair);
}

bool Candidates::may_meet(broadphase::Pair pair, double room) const {
  Vec between = centre_[pair.b] - centre_[pair.a];
  if (plan_.periodic) between = nearest_image(between, period_.size);
  const double most =
      reach_[pair.a] + reach_[pair.b] + room * (colliders_.radius[pair.a] + colliders_.radius[pair.b]);
  return between.squaredNorm() <= most * most;
}

/// Whether add_box_sides() could add any.
bool Candidates::nears_box(std::uint32_t i) const {
  const Vec &centre = centre_[i], &min = scene_.domain.min, &max = scene_.domain.max;
  const Eigen::Array2d room = (centre - min).array().min((max - centre).array());
  return !(room >= reach_[i]).all();
}

void Candidates::add_box_sides(std::uint32_t collider, std::vector<broadphase::Pair>& pairs) const {
  for (std::uint32_t i = 0; i < obstacles_.side.size(); ++i) {
    const narrowphase::HalfPlane& side = obstacles_.side[i];
    if (side.normal.dot(centre_[collider] - side.point) < reach_[collider]) pairs.push_back({collider, i});
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
