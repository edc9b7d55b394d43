// SPDX-License-Identifier: MIT
#include "sim/contact/guard.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "narrowphase/motion/first_contact.h"
#include "sim/contact/corner_impact.h"
#include "sim/contact/go_on_as_one.h"
#include "sim/periodic.h"

namespace throng {

using narrowphase::FirstContact;
using narrowphase::Motion;
using narrowphase::Verdict;

namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();

/// Who moves by less, of its thickness and in a step, isn't looked at: as much as the smallest heart is
/// thick.
constexpr double kUnseen = 0.0625;

/// Contacts may take a body so many times as far in a step as the fastest would get as it begins.
constexpr double kFarther = 3.0;

/// Of the thickness: who slowly got so deep into a smallest heart, half of it, is still held.
constexpr double kHeld = 0.03125;

/// Of the thickness, in a substep: how far who is pushed by a driven body gets ahead of it, and how far two
/// whose smallest hearts touch may still come nearer.
constexpr double kLeaves = 0.25, kNearer = 1e-3;

/// Times its width and height, how deep and how far along a side of the domain's box reaches.
constexpr double kFarBehind = 4.0;

/// Cosine of the angle between what is one wall to who rests there.
constexpr double kSameWall = 0.9;

/// How often at most, if others hold up who is pushed.
constexpr int kMostPushes = 8;

/// How far a point of the body gets that is so far from its centre, at most.
double way(const SolverBody& body, const Vec& position, double reach) {
  return (body.position - position).norm() + std::abs(body.turn) * reach;
}

/// Restitution along the normal, Coulomb friction across; then the two part at `leaves` (m/s) more.
void part(const PointArms& at, SolverBody& a, SolverBody& b, const Surface& surface, double leaves) {
  const double speed = at.normal_velocity(a, b);
  if (!(speed < 0.0)) return;
  const auto [normal, across] = corner_impact(at, surface.friction, a, b, -surface.restitution * speed);
  at.apply(a, b, normal + leaves * effective_mass(a, b, at.arm_a, at.arm_b, at.normal), across);
}

/// m/s, at which two whose hearts touch come nearer at that point.
double nearing(const narrowphase::Manifold& touch, std::size_t i, const Motion& a, const Motion& b) {
  const auto velocity = [&](const Motion& m) -> Vec {
    return m.velocity + m.spin * tangent(touch.points[i].point - m.position);
  };
  return (velocity(a) - velocity(b)).dot(touch.normal);
}

/// Whether they do at any of the points, faster than `slow` (m/s).
bool approach(const narrowphase::Manifold& touch, const Motion& a, const Motion& b, double slow) {
  return (touch.count > 0 && nearing(touch, 0, a, b) > slow) ||
         (touch.count > 1 && nearing(touch, 1, a, b) > slow);
}

/// The one where they do, or halfway between two. Expects a point.
Vec struck_point(const narrowphase::Manifold& touch, const Motion& a, const Motion& b) {
  const Vec& first = touch.points[0].point;
  if (touch.count == 1) return first;
  const Vec& second = touch.points[1].point;
  const bool at_first = nearing(touch, 0, a, b) > 0.0, at_second = nearing(touch, 1, a, b) > 0.0;
  if (at_first == at_second) return 0.5 * (first + second);
  return at_first ? first : second;
}

double overlap(const narrowphase::Manifold& touch) {
  return std::max(-least_separation(touch), 0.0);
}

/// What is behind a side of the domain's box, as far as anybody gets who isn't stopped there.
narrowphase::Convex solid(const narrowphase::HalfPlane& side, const Domain& domain) {
  const double far = kFarBehind * (domain.max - domain.min).sum();
  const Vec along = far * tangent(side.normal), behind = -far * side.normal;
  return narrowphase::convex(
      {side.point - along, side.point + along, side.point + along + behind, side.point - along + behind});
}

bool is_driven(const SolverBody& body) {
  return !body.is_dynamic() && (body.velocity != Vec(0.0, 0.0) || body.spin != 0.0);
}

}  // namespace

Guard::Guard(const Scene& scene, const Plan& plan, const Candidates& candidates)
    : scene_(scene),
      plan_(plan),
      candidates_(candidates),
      hearts_(candidates.colliders()),
      reach_(scene.bodies.size(), 0.0) {
  const Colliders& colliders = candidates.colliders();
  for (const narrowphase::HalfPlane& side : candidates.obstacles().side)
    sides_.push_back(solid(side, scene.domain));
  if (colliders.centre.empty()) return;  // a disc that turns stays where it is
  for (std::uint32_t row = 0; row < colliders.size(); ++row)
    if (!is_disc(colliders, row)) reach_[colliders.body[row]] = scene.bodies.radius[colliders.body[row]];
}

Guard::Meeting Guard::meeting(broadphase::Pair pair, bool obstacle) const {
  const Colliders& colliders = candidates_.colliders();
  const auto ground = static_cast<std::uint32_t>(scene_.bodies.size());
  return {pair.a,
          pair.b,
          colliders.body[pair.a],
          obstacle ? ground : colliders.body[pair.b],
          obstacle,
          obstacle ? candidates_.obstacle_shift(pair.a) : candidates_.shift(pair)};
}

/// All pairs, and of each body its own.
void Guard::list_all() {
  if (listed_ == candidates_.finds()) return;
  listed_ = candidates_.finds();
  meetings_.clear();
  for (const broadphase::Pair& pair : candidates_.pairs()) meetings_.push_back(meeting(pair, false));
  for (const broadphase::Pair& pair : candidates_.obstacle_pairs()) meetings_.push_back(meeting(pair, true));
  begin_.assign(scene_.bodies.size() + 2, 0);
  for (const Meeting& m : meetings_) ++begin_[m.a + 1], ++begin_[m.b + 1];
  std::partial_sum(begin_.begin(), begin_.end(), begin_.begin());
  of_body_.resize(2 * meetings_.size());
  next_ = begin_;
  for (std::uint32_t k = 0; k < meetings_.size(); ++k)
    of_body_[next_[meetings_[k].a]++] = k, of_body_[next_[meetings_[k].b]++] = k;
}

double Guard::thickness(const Meeting& m) const {
  const double of_a = hearts_.thickness(m.row_a);
  return m.obstacle ? of_a : std::min(of_a, hearts_.thickness(m.row_b));
}

const narrowphase::Convex& Guard::heart_of_a(const Meeting& m) const {
  thread_local narrowphase::Convex lent;
  return hearts_.heart(m.row_a, m.depth, lent);
}

/// Obstacles never give way: all of them is heart.
const narrowphase::Convex& Guard::heart_of_b(const Meeting& m) const {
  thread_local narrowphase::Convex lent;
  if (m.obstacle)
    return m.row_b < sides_.size() ? sides_[m.row_b] : candidates_.obstacles().part[m.row_b - sides_.size()];
  return hearts_.heart(m.row_b, m.depth, lent);
}

/// Who got farther in the step than from its surface to its heart.
bool Guard::list_far(const State& state, BodyRows<const SolverBody> bodies) {
  const Colliders& colliders = candidates_.colliders();
  is_far_.assign(colliders.size(), 0);
  bool any = false;
  candidates_.rows().for_each([&](std::uint32_t row) {
    const std::uint32_t body = colliders.body[row];
    const double far = way(bodies[body], state.position[body], reach_[body]);
    is_far_[row] = far > Hearts::kRims[0] * hearts_.thickness(row);
    any |= is_far_[row] != 0;
  });
  return any;
}

bool Guard::saw_meeting(const State& state, BodyRows<const SolverBody> bodies, Workers& workers) {
  const double least = Hearts::kRims[0] * hearts_.least_thickness();
  if (!(kFarther * candidates_.farthest_way() > least) || !list_far(state, bodies)) return false;
  hearts_.make();
  if (!any_met(state, bodies, workers)) return false;
  ++guarded_steps_;
  return true;
}

bool Guard::any_met(const State& state, BodyRows<const SolverBody> bodies, Workers& workers) const {
  const std::span<const broadphase::Pair> pairs = candidates_.pairs();
  const std::span<const broadphase::Pair> obstacle_pairs = candidates_.obstacle_pairs();
  std::atomic<bool> any = false;
  workers.for_ranges(pairs.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end && !any; ++i)
      if ((is_far_[pairs[i].a] || is_far_[pairs[i].b]) && met(meeting(pairs[i], false), state, bodies))
        any = true;
  });
  workers.for_ranges(obstacle_pairs.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end && !any; ++i)
      if (is_far_[obstacle_pairs[i].a] && met(meeting(obstacle_pairs[i], true), state, bodies)) any = true;
  });
  return any;
}

bool Guard::met(Meeting m, const State& state, BodyRows<const SolverBody> bodies) const {
  const auto motion = [&](std::uint32_t body, const Vec& shift) -> Motion {
    return {state.position[body] + shift, state.angle[body], bodies[body].position - state.position[body],
            bodies[body].turn};
  };
  const Motion a = motion(m.a, {0.0, 0.0});
  const Motion b = m.obstacle ? Motion{.position = m.shift} : motion(m.b, m.shift);
  const double turned = std::abs(a.spin) * reach_[m.a] + (m.obstacle ? 0.0 : std::abs(b.spin) * reach_[m.b]);
  if (!((b.velocity - a.velocity).norm() + turned > kUnseen * thickness(m))) return false;
  return first_meeting(m, a, b, 1.0) < kNever;
}

/// When hearts meet that are apart; puts their depth into `m`, which is kDepths where none are. The smallest
/// ones may touch, where they were held before: then they meet at once, if they approach.
double Guard::first_meeting(Meeting& m, const Motion& a, const Motion& b, double duration) const {
  for (m.depth = 0; m.depth < Hearts::kDepths; ++m.depth) {
    const FirstContact first = narrowphase::first_contact(heart_of_a(m), a, heart_of_b(m), b, duration);
    if (first.verdict == Verdict::free) return kNever;
    if (first.t_lo > 0.0 || (first.verdict == Verdict::hit && first.t_hi > 0.0)) return first.t_lo;
  }
  m.depth = Hearts::kDepths - 1;
  const narrowphase::Manifold touch = manifold(m, a, b);
  const double slow = kNearer * thickness(m) / duration;
  if (!(overlap(touch) > kHeld * thickness(m))) return approach(touch, a, b, slow) ? 0.0 : kNever;
  m.depth = Hearts::kDepths;
  return kNever;
}

narrowphase::Manifold Guard::manifold(const Meeting& m, const Motion& a, const Motion& b) const {
  return narrowphase::manifold(heart_of_a(m), pose_at(a, 0.0), heart_of_b(m), pose_at(b, 0.0), thickness(m));
}

void Guard::move(const State& state, BodyRows<SolverBody> bodies, Rows awake, double h) {
  const Substep sub{state, bodies, h};
  since_.assign(bodies.size(), 0.0), stands_.assign(bodies.size(), 0);
  list_all();
  events_.clear();
  for (Meeting& m : meetings_) m.watched = false, m.depth = 0, m.pushes = 0;
  for (std::uint32_t k = 0; k < meetings_.size(); ++k) watch(sub, k);
  while (!events_.empty()) {
    std::pop_heap(events_.begin(), events_.end());
    const Event event = events_.back();
    events_.pop_back();
    if (Meeting& m = meetings_[event.meeting]; m.time == event.time) collide(sub, m);
  }
  awake.for_each([&](std::uint32_t i) {
    if (stands_[i]) return;
    bodies[i].position += (h - since_[i]) * bodies[i].velocity;
    bodies[i].turn += (h - since_[i]) * bodies[i].spin;
  });
}

/// From now on, if the two move far enough in the substep.
void Guard::watch(const Substep& sub, std::uint32_t k) {
  const auto far = [&](std::uint32_t i) {
    return sub.h * (sub.bodies[i].velocity.norm() + std::abs(sub.bodies[i].spin) * reach_[i]);
  };
  Meeting& m = meetings_[k];
  const double unseen = kUnseen / scene_.time.substeps * thickness(m);
  if (!(far(m.a) + (m.obstacle ? 0.0 : far(m.b)) > unseen)) return;
  m.watched = true;
  const double now = std::max(since_[m.a], since_[m.b]);
  m.time = now + first_meeting(m, motion(sub, m, false, now), motion(sub, m, true, now), sub.h - now);
  expect(k);
}

void Guard::expect(std::uint32_t k) {
  if (!(meetings_[k].time < kNever)) return;
  events_.push_back({meetings_[k].time, k});
  std::push_heap(events_.begin(), events_.end());
}

/// Two that were apart.
void Guard::foresee(const Substep& sub, std::uint32_t k) {
  Meeting& m = meetings_[k];
  if (!m.watched) return watch(sub, k);
  if (m.depth == Hearts::kDepths || (stands_[m.a] && (m.obstacle || stands_[m.b]))) {
    m.time = kNever;
    return;
  }
  const double now = std::max(since_[m.a], since_[m.b]);
  const Motion a = motion(sub, m, false, now), b = motion(sub, m, true, now);
  const FirstContact first = narrowphase::first_contact(heart_of_a(m), a, heart_of_b(m), b, sub.h - now);
  m.time = first.verdict == Verdict::free ? kNever : now + first.t_lo;
  const bool touch = m.depth + 1 == Hearts::kDepths && m.time == now;
  if (touch && !approach(manifold(m, a, b), a, b, kNearer * thickness(m) / sub.h)) m.time = kNever;
  expect(k);
}

/// Of one of the two, from where it is at that time of the substep.
Motion Guard::motion(const Substep& sub, const Meeting& m, bool of_b, double time) const {
  if (of_b && m.obstacle) return {.position = m.shift};
  const std::uint32_t body = of_b ? m.b : m.a;
  const SolverBody& at = sub.bodies[body];
  const Vec velocity = stands_[body] ? Vec(0.0, 0.0) : at.velocity;
  const double spin = stands_[body] ? 0.0 : at.spin, passed = time - since_[body];
  const Vec shift = of_b ? m.shift : Vec(0.0, 0.0);
  return {at.position + passed * velocity + shift, sub.state.angle[body] + at.turn + passed * spin, velocity,
          spin};
}

void Guard::advance(const Substep& sub, std::uint32_t body, double time) {
  SolverBody& moving = sub.bodies[body];
  if (!moving.is_dynamic()) return;
  if (!stands_[body]) {
    moving.position += (time - since_[body]) * moving.velocity;
    moving.turn += (time - since_[body]) * moving.spin;
  }
  since_[body] = time;
}

void Guard::list(const Substep& sub, const Meeting& m, const Vec& point, double impulse) {
  const std::vector<std::uint32_t>& id = sub.state.id;
  strikes_.push_back({id[m.a], m.obstacle ? 0 : id[m.b], impulse,
                      plan_.periodic ? wrapped(point, scene_.domain) : point, false});
}

/// Two whose hearts meet are struck, and may then get as deep as to the next ones. Who gets to the last ones
/// is held; before a body that is driven, and goes on, it is pushed out.
void Guard::collide(const Substep& sub, Meeting& m) {
  SolverBody &a = sub.bodies[m.a], &b = sub.bodies[m.b];
  advance(sub, m.a, m.time), advance(sub, m.b, m.time);
  const bool is_last = m.depth + 1 == Hearts::kDepths;
  const bool driven = is_driven(a) || (!m.obstacle && is_driven(b));
  const double leaves = is_last && driven ? kLeaves * thickness(m) / sub.h : 0.0;
  const narrowphase::Manifold touch =
      manifold(m, motion(sub, m, false, m.time), motion(sub, m, true, m.time));
  const Vec before_a = a.velocity, before_b = b.velocity;
  if (touch.count > 0) {
    if (driven) leave(m.a, -touch.normal), leave(m.b, touch.normal);
    const Motion of_a = motion(sub, m, false, m.time), of_b = motion(sub, m, true, m.time);
    const Vec point = struck_point(touch, of_a, of_b);
    part({point - of_a.position, point - of_b.position, touch.normal}, a, b, surface(m), leaves);
    if (is_last && !driven) go_on_held(sub, m, touch.normal);
    const double impulse = a.is_dynamic() ? (before_a - a.velocity).dot(touch.normal) / a.inverse_mass
                                          : (b.velocity - before_b).dot(touch.normal) / b.inverse_mass;
    if (plan_.sums_impulses && impulse != 0.0) list(sub, m, point, impulse);
  }
  if (is_last && !driven) stand(a, m.a), stand(b, m.b);
  if (!is_last || !driven || ++m.pushes > kMostPushes) ++m.depth;
  m.time = kNever;
  if (a.is_dynamic()) look_again(sub, m.a);
  if (b.is_dynamic()) look_again(sub, m.b);
}

/// How two go on who are held at each other, `normal` from a to b. Where one of them has stood before in the
/// step, as one, or not into what doesn't move: with the speed that they would else gather, as long as others
/// hold them, they would be thrown in the end.
void Guard::go_on_held(const Substep& sub, const Meeting& m, const Vec& normal) {
  SolverBody &a = sub.bodies[m.a], &b = sub.bodies[m.b];
  if (!b.is_dynamic())
    rest(a, m.a, normal);
  else if (!a.is_dynamic())
    rest(b, m.b, -normal);
  else if (stood_[m.a] || stood_[m.b])
    go_on_as_one(a, b, b.position + m.shift - a.position);
}

/// For the rest of the substep.
void Guard::stand(const SolverBody& body, std::uint32_t row) {
  if (body.is_dynamic()) stands_[row] = stood_[row] = 1;
}

/// At what doesn't move, `normal` towards it. Who has stood before in the step slides along it alone and
/// doesn't turn, or, where it was at something else, doesn't move at all.
void Guard::rest(SolverBody& body, std::uint32_t row, const Vec& normal) {
  const Vec wall = std::exchange(wall_[row], normal);
  if (!stood_[row]) return;
  const bool crushed = wall != Vec(0.0, 0.0) && !(wall.dot(normal) > kSameWall);
  body.velocity -= crushed ? body.velocity : Vec(std::max(body.velocity.dot(normal), 0.0) * normal);
  body.spin = 0.0;
}

/// Who is pushed that way by a body that is driven stands no longer, but at a wall into which that would be.
void Guard::leave(std::uint32_t row, const Vec& push) {
  if (!(wall_[row].dot(push) > 0.0)) stands_[row] = 0;
}

void Guard::look_again(const Substep& sub, std::uint32_t body) {
  for (std::uint32_t i = begin_[body]; i < begin_[body + 1]; ++i) foresee(sub, of_body_[i]);
}

const Surface& Guard::surface(const Meeting& m) const {
  const std::uint32_t other =
      m.obstacle ? candidates_.obstacles().material[m.row_b] : scene_.bodies.material[m.b];
  return plan_.surface(scene_.bodies.material[m.a], other);
}

}  // namespace throng
