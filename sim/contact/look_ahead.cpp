// SPDX-License-Identifier: MIT
// What ContactFinder does for two that near each other fast: which way they will press shows where they meet,
// not where they are as the step begins. A plane between them as they are then would stop whoever passes.
#include <algorithm>
#include <cmath>

#include "narrowphase/distance.h"
#include "narrowphase/motion/first_contact.h"
#include "narrowphase/motion/nearest_time.h"
#include "sim/contact/contact_key.h"
#include "sim/contact/fast.h"
#include "sim/contact/find_contacts.h"
#include "sim/contact/kept_impulses.h"
#include "sim/contact/pressed.h"

namespace throng {

using narrowphase::Convex;
using narrowphase::FirstContact;
using narrowphase::Manifold;
using narrowphase::Motion;
using narrowphase::Verdict;

namespace {

constexpr double kExact = 1e-8;  // of the two, how far from each other they are where they are said to meet

double least_separation(const Manifold& m) {
  return m.count == 2 ? std::min(m.points[0].separation, m.points[1].separation) : m.points[0].separation;
}

/// How far (m) a turn by so much (rad) may bring a collider's surface.
double turn_way(const Colliders& colliders, std::uint32_t row, double turn) {
  if (is_disc(colliders, row)) return 0.0;
  return turn * colliders.centre[row].norm() + std::min(turn * colliders.radius[row], colliders.swing[row]);
}

}  // namespace

/// m, how far the two may get in a step and are slow.
double ContactFinder::slow_way(const Colliders& colliders, const Touch& touch) const {
  const double a = colliders.radius[touch.pair.a];
  return kAheadWay * (touch.obstacle ? a : std::min(a, colliders.radius[touch.pair.b]));
}

/// Whether the two may get past the plane between them within the step, and not by little.
bool ContactFinder::nears_fast(const Colliders& colliders, std::span<const SolverBody> bodies,
                               std::size_t touch) const {
  const auto& [pair, obstacle, shift, held, lane] = touches_[touch];
  const Manifold& m = manifolds_[touch];
  if (m.count == 0) return false;
  const SolverBody &a = bodies[colliders.body[pair.a]], &b = bodies[other_row(colliders, touches_[touch])];
  const double dt = scene_.time.dt;
  const Vec way = dt * (b.velocity - a.velocity);
  const double turn = turn_way(colliders, pair.a, dt * std::abs(a.spin)) +
                      (obstacle ? 0.0 : turn_way(colliders, pair.b, dt * std::abs(b.spin)));
  const bool falls_a = a.inverse_mass > 0.0, falls_b = b.inverse_mass > 0.0;
  const double drop = plan_.gravity && falls_a != falls_b ? dt * dt * scene_.gravity.dot(m.normal) : 0.0;
  const double fall = std::max(falls_a ? drop : -drop, 0.0);
  if (!(turn + fall - way.dot(m.normal) > least_separation(m))) return false;
  return turn + way.norm() > slow_way(colliders, touches_[touch]);
}

void ContactFinder::look_ahead(const Candidates& candidates, const State& state,
                               std::span<const SolverBody> bodies, Workers& workers) {
  approaches_.clear();
  for (auto i = nears_.begin(); (i = std::find(i, nears_.end(), 1)) != nears_.end(); ++i)
    approaches_.push_back(static_cast<std::uint32_t>(i - nears_.begin()));
  if (approaches_.empty()) return;
  if (plan_.gravity) find_pressed(state, candidates.colliders(), pressed_);
  meetings_.resize(approaches_.size());
  workers.for_ranges(approaches_.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i)
      meetings_[i] = meeting(candidates, state, bodies, approaches_[i]);
  });
  find_who_turns_aside(candidates, bodies);
  workers.for_ranges(approaches_.size(), [&](std::size_t begin, std::size_t end) {
    KeptImpulses memory(state.point_contacts, touches_[approaches_[begin]].key());
    for (std::size_t i = begin; i < end; ++i) {
      const Touch& touch = touches_[approaches_[i]];
      meet_later(candidates, state, bodies, touch, meetings_[i]);
      find_ahead(candidates, state, bodies, i, memory.find(touch.key()));
    }
  });
}

/// m/s, the mean over the step. What something held in the last one it will hardly let fall in this one.
Vec ContactFinder::velocity_ahead(std::span<const SolverBody> bodies, std::uint32_t row) const {
  const bool falls = plan_.gravity && bodies[row].inverse_mass > 0.0 && pressed_[row] == 0;
  if (!falls) return bodies[row].velocity;
  return bodies[row].velocity + 0.5 * (scene_.time.dt + plan_.substep) * scene_.gravity;
}

ContactFinder::Courses ContactFinder::courses(const State& state, std::span<const SolverBody> bodies,
                                              const Colliders& colliders, const Touch& touch) const {
  const auto motion = [&](std::uint32_t row) {
    return Motion{state.position[row], state.angle[row], velocity_ahead(bodies, row), bodies[row].spin};
  };
  Courses courses{motion(colliders.body[touch.pair.a]), {}, 0.0};
  if (!touch.obstacle) courses.b = motion(colliders.body[touch.pair.b]);
  courses.b.position += touch.shift;
  return courses;
}

ContactFinder::Meeting ContactFinder::meeting(const Candidates& candidates, const State& state,
                                              std::span<const SolverBody> bodies, std::size_t touch) const {
  const Touch& one = touches_[touch];
  const Courses courses = this->courses(state, bodies, candidates.colliders(), one);
  const Manifold& m = manifolds_[touch];
  const double gap = least_separation(m);
  if (gap > 0.0 && !(one.obstacle && one.pair.b < candidates.obstacles().side.size()))
    return meeting(candidates, one, courses);
  // What touches now, and a straight border: the normal is known.
  const double closing = -(courses.b.velocity - courses.a.velocity).dot(m.normal), dt = scene_.time.dt;
  const double left = std::max(gap, 0.0);
  Meeting now{0.0, courses.a.position, courses.b.position - one.shift, kUndisturbed, m.normal};
  if (closing * dt - left > slow_way(candidates.colliders(), one)) now.turns_aside = left / closing;
  return now;
}

ContactFinder::Meeting ContactFinder::meeting(const Candidates& candidates, const Touch& touch,
                                              const Courses& courses) const {
  const Colliders& colliders = candidates.colliders();
  thread_local Convex disc_a = narrowphase::disc(1.0), disc_b = disc_a;
  const Convex& a = shape(colliders, touch.pair.a, disc_a);
  const Obstacles& obstacles = candidates.obstacles();
  const Convex& b = touch.obstacle ? obstacles.part[touch.pair.b - obstacles.side.size()]
                                   : shape(colliders, touch.pair.b, disc_b);
  const double left = scene_.time.dt - courses.from;
  const FirstContact found = narrowphase::first_contact(a, courses.a, b, courses.b, left, {.width = kExact});
  const bool hit = found.verdict != Verdict::free;
  const double time = hit ? found.t_lo : narrowphase::nearest_time(a, courses.a, b, courses.b, left);
  Meeting result{courses.from + time,
                 courses.a.position + time * courses.a.velocity,
                 courses.b.position + time * courses.b.velocity - touch.shift,
                 kUndisturbed,
                 {0.0, 0.0}};
  if (!hit) return result;
  result.normal = separation(a, pose_at(courses.a, time), b, pose_at(courses.b, time)).normal;
  const double deep = -(courses.b.velocity - courses.a.velocity).dot(result.normal) * (left - time);
  if (deep > slow_way(colliders, touch)) result.turns_aside = result.when;  // else it grazes
  return result;
}

void ContactFinder::find_who_turns_aside(const Candidates& candidates, std::span<const SolverBody> bodies) {
  turned_.assign(bodies.size(), {});
  for (std::size_t i = 0; i < approaches_.size(); ++i)
    if (meetings_[i].turns_aside < kUndisturbed)
      turn_aside(candidates, bodies, touches_[approaches_[i]], meetings_[i]);
}

/// As two points that collide.
void ContactFinder::turn_aside(const Candidates& candidates, std::span<const SolverBody> bodies,
                               const Touch& touch, const Meeting& meeting) {
  const Colliders& colliders = candidates.colliders();
  const std::uint32_t a = colliders.body[touch.pair.a], b = other_row(colliders, touch);
  const Vec of_a = velocity_ahead(bodies, a), of_b = velocity_ahead(bodies, b);
  const std::uint32_t material =
      touch.obstacle ? candidates.obstacles().material[touch.pair.b] : scene_.bodies.material[b];
  const double mass = 1.0 / (bodies[a].inverse_mass + bodies[b].inverse_mass);
  const Vec impulse =
      (1.0 + surface(a, material).restitution) * mass * (of_b - of_a).dot(meeting.normal) * meeting.normal;
  const auto turn = [&](std::uint32_t row, const Vec& velocity) {
    if (bodies[row].inverse_mass > 0.0 && meeting.turns_aside < turned_[row].when)
      turned_[row] = {meeting.turns_aside, velocity};
  };
  turn(a, of_a + bodies[a].inverse_mass * impulse);
  turn(b, of_b - bodies[b].inverse_mass * impulse);
}

/// Where the two meet or pass if one of them has met somebody before, who turns it aside.
void ContactFinder::meet_later(const Candidates& candidates, const State& state,
                               std::span<const SolverBody> bodies, const Touch& touch,
                               Meeting& meeting) const {
  const Colliders& colliders = candidates.colliders();
  const TurnedAside &a = turned_[colliders.body[touch.pair.a]], &b = turned_[other_row(colliders, touch)];
  const double from = std::min(a.when, b.when);
  if (!(from < meeting.when)) return;
  Courses courses = this->courses(state, bodies, colliders, touch);
  courses.from = from;
  for (Motion* motion : {&courses.a, &courses.b})
    motion->position += from * motion->velocity, motion->angle += from * motion->spin;
  if (a.when == from) courses.a.velocity = a.velocity;
  if (b.when == from) courses.b.velocity = b.velocity;
  meeting = this->meeting(candidates, touch, courses);
}

/// Where the contact is found ahead; null where it is as the step begins.
const ContactFinder::Meeting* ContactFinder::ahead(std::size_t touch) const {
  if (nears_[touch] == 0) return nullptr;
  const auto i = std::lower_bound(approaches_.begin(), approaches_.end(), touch) - approaches_.begin();
  const Meeting& meeting = meetings_[static_cast<std::size_t>(i)];
  return meeting.when > 0.0 ? &meeting : nullptr;
}

/// The contact of the two when they meet or pass. Where it is that of a part's neighbour, which wasn't looked
/// for ahead, what was found now stays.
void ContactFinder::find_ahead(const Candidates& candidates, const State& state,
                               std::span<const SolverBody> bodies, std::size_t approach,
                               const ContactImpulse* kept) {
  Meeting& meeting = meetings_[approach];
  if (!(meeting.when > 0.0)) return;
  const std::uint32_t touch = approaches_[approach];
  const Touch& one = touches_[touch];
  Courses courses = this->courses(state, bodies, candidates.colliders(), one);
  courses.a.position = meeting.at_a, courses.a.angle += meeting.when * courses.a.spin;
  courses.b.position = meeting.at_b + one.shift, courses.b.angle += meeting.when * courses.b.spin;
  const Manifold ahead = manifold(candidates, one, {pose_at(courses.a, 0.0), pose_at(courses.b, 0.0)}, kept);
  if (ahead.count == 0) {
    meeting.when = 0.0;
    return;
  }
  manifolds_[touch] = ahead;
  points_[touch] = static_cast<std::uint8_t>(ahead.count);
}

}  // namespace throng
