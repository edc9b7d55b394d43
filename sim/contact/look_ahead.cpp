// SPDX-License-Identifier: MIT
#include "sim/contact/look_ahead.h"

#include <algorithm>
#include <cmath>

#include "narrowphase/distance.h"
#include "narrowphase/motion/first_contact.h"
#include "narrowphase/motion/nearest_time.h"
#include "sim/contact/fast.h"
#include "sim/contact/pressed.h"

namespace throng {

using narrowphase::Convex;
using narrowphase::FirstContact;
using narrowphase::Manifold;
using narrowphase::Motion;
using narrowphase::Verdict;

namespace {

constexpr double kExact = 1e-8;  // of the two, how far from each other they are where they are said to meet
constexpr double kLyingStill = 1e-3;  // of what is slow
constexpr int kMostLooks = 64;        // until then: who rolls along what turns would be looked at for ever

/// How far (m) a turn by so much (rad) may bring a collider's surface.
double turn_way(const Colliders& colliders, std::uint32_t row, double turn) {
  if (is_disc(colliders, row)) return 0.0;
  return turn * colliders.centre[row].norm() + std::min(turn * colliders.radius[row], colliders.swing[row]);
}

double least_radius(const Colliders& colliders) {
  const auto least = std::ranges::min_element(colliders.radius);
  return least == colliders.radius.end() ? std::numeric_limits<double>::infinity() : *least;
}

}  // namespace

LookAhead::LookAhead(const Scene& scene, const Plan& plan, const Colliders& colliders)
    : scene_(scene), plan_(plan), least_way_(kAheadWay * least_radius(colliders)) {}

/// m, how far the two may get in a step and are slow.
double LookAhead::slow_way(const Colliders& colliders, const Touch& touch) const {
  return kAheadWay * smaller_radius(colliders, touch);
}

/// A bounce shows where it happened, however slowly.
bool LookAhead::bounces(const StepStart& start, const Touch& touch) const {
  return plan_.restitution && surface_of(scene_, plan_, start.obstacles(), touch).restitution > 0.0;
}

bool LookAhead::nears(const StepStart& start, const Touch& touch, const Manifold& m) const {
  if (m.count == 0) return false;
  const Colliders& colliders = start.colliders();
  const SolverBody &a = start.bodies[touch.a], &b = start.bodies[touch.b];
  const double dt = scene_.time.dt;
  const Vec way = dt * (b.velocity - a.velocity);
  const double turn = turn_way(colliders, touch.pair.a, dt * std::abs(a.spin)) +
                      (touch.obstacle ? 0.0 : turn_way(colliders, touch.pair.b, dt * std::abs(b.spin)));
  const bool falls_a = a.is_dynamic(), falls_b = b.is_dynamic();
  const double drop = plan_.gravity && falls_a != falls_b ? dt * dt * scene_.gravity.dot(m.normal) : 0.0;
  const double fall = std::max(falls_a ? drop : -drop, 0.0);
  if (!(turn + fall - way.dot(m.normal) > least_separation(m))) return false;
  const double slow = slow_way(colliders, touch);
  return turn + way.norm() > (bounces(start, touch) ? kLyingStill * slow : slow);
}

void LookAhead::look(const StepStart& start, std::span<const Touch> touches, std::span<Manifold> manifolds,
                     Workers& workers) {
  approaches_.clear();
  for (auto i = nears_.begin(); (i = std::find(i, nears_.end(), 1)) != nears_.end(); ++i)
    approaches_.push_back(static_cast<std::uint32_t>(i - nears_.begin()));
  if (approaches_.empty()) return;
  if (plan_.gravity) find_pressed(start.state, start.colliders(), pressed_);
  meetings_.resize(approaches_.size());
  workers.for_ranges(approaches_.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i)
      meetings_[i] = first_meeting(start, touches[approaches_[i]], manifolds[approaches_[i]]);
  });
  find_who_turns_aside(start, touches);
  workers.for_ranges(approaches_.size(), [&](std::size_t begin, std::size_t end) {
    KeptImpulses memory(start.state.point_contacts, touches[approaches_[begin]].key());
    for (std::size_t i = begin; i < end; ++i) {
      const Touch& touch = touches[approaches_[i]];
      meet_later(start, touch, meetings_[i]);
      find_there(start, touch, meetings_[i], memory.find(touch.key()), manifolds[approaches_[i]]);
    }
  });
}

/// m/s, the mean over the step. What something held in the last one it will hardly let fall in this one.
Vec LookAhead::velocity_ahead(BodyRows<const SolverBody> bodies, std::uint32_t row) const {
  const bool falls = plan_.gravity && bodies[row].is_dynamic() && pressed_[row] == 0;
  if (!falls) return bodies[row].velocity;
  return bodies[row].velocity + 0.5 * (scene_.time.dt + plan_.substep) * scene_.gravity;
}

LookAhead::Courses LookAhead::courses(const StepStart& start, const Touch& touch) const {
  const auto motion = [&](std::uint32_t row) {
    return Motion{start.state.position[row], start.state.angle[row], velocity_ahead(start.bodies, row),
                  start.bodies[row].spin};
  };
  Courses courses{motion(touch.a), {}, 0.0};
  if (!touch.obstacle) courses.b = motion(touch.b);
  courses.b.position += touch.shift;
  return courses;
}

/// If nobody turns them aside before.
LookAhead::Meeting LookAhead::first_meeting(const StepStart& start, const Touch& touch,
                                            const Manifold& m) const {
  const Courses courses = this->courses(start, touch);
  const double gap = least_separation(m);
  if (gap > 0.0 && !is_side(start, touch)) return meeting_on(start.candidates, touch, courses);
  // What touches now, and a straight border: the normal is known.
  const double closing = -(courses.b.velocity - courses.a.velocity).dot(m.normal), dt = scene_.time.dt;
  const double left = std::max(gap, 0.0);
  Meeting now{0.0, courses.a.position, courses.b.position - touch.shift, kUndisturbed, m.normal};
  if (closing * dt - left > slow_way(start.colliders(), touch)) now.turns_aside = left / closing;
  return now;
}

LookAhead::Meeting LookAhead::meeting_on(const Candidates& candidates, const Touch& touch,
                                         const Courses& courses) const {
  const Colliders& colliders = candidates.colliders();
  thread_local Convex disc_a = narrowphase::disc(1.0), disc_b = disc_a;
  const Convex& a = shape(colliders, touch.pair.a, disc_a);
  const Convex& b =
      touch.obstacle ? candidates.obstacles().part_at(touch.pair.b) : shape(colliders, touch.pair.b, disc_b);
  const double left = scene_.time.dt - courses.from;
  const FirstContact found = narrowphase::first_contact(a, courses.a, b, courses.b, left,
                                                        {.width = kExact, .evaluations = kMostLooks});
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

void LookAhead::find_who_turns_aside(const StepStart& start, std::span<const Touch> touches) {
  turned_.assign(start.bodies.size(), {});
  for (std::size_t i = 0; i < approaches_.size(); ++i)
    if (meetings_[i].turns_aside < kUndisturbed) turn_aside(start, touches[approaches_[i]], meetings_[i]);
}

/// As two points that collide.
void LookAhead::turn_aside(const StepStart& start, const Touch& touch, const Meeting& meeting) {
  const SolverBody &a = start.bodies[touch.a], &b = start.bodies[touch.b];
  const Vec of_a = velocity_ahead(start.bodies, touch.a), of_b = velocity_ahead(start.bodies, touch.b);
  const double restitution = surface_of(scene_, plan_, start.obstacles(), touch).restitution;
  const double mass = effective_mass(a, b, 0.0, 0.0);
  const Vec impulse = (1.0 + restitution) * mass * (of_b - of_a).dot(meeting.normal) * meeting.normal;
  const auto turn = [&](std::uint32_t row, const Vec& velocity) {
    const bool can_go_on = std::isfinite(4.0 * velocity.squaredNorm());  // else the step fails at its end
    if (start.bodies[row].is_dynamic() && meeting.turns_aside < turned_[row].when && can_go_on)
      turned_[row] = {meeting.turns_aside, velocity};
  };
  turn(touch.a, of_a + a.inverse_mass * impulse);
  turn(touch.b, of_b - b.inverse_mass * impulse);
}

/// Where the two meet or pass if one of them has met somebody before, who turns it aside.
void LookAhead::meet_later(const StepStart& start, const Touch& touch, Meeting& meeting) const {
  const TurnedAside &a = turned_[touch.a], &b = turned_[touch.b];
  const double from = std::min(a.when, b.when);
  if (!(from < meeting.when)) return;
  Courses courses = this->courses(start, touch);
  courses.from = from;
  for (Motion* motion : {&courses.a, &courses.b})
    motion->position += from * motion->velocity, motion->angle += from * motion->spin;
  if (a.when == from) courses.a.velocity = a.velocity;
  if (b.when == from) courses.b.velocity = b.velocity;
  meeting = meeting_on(start.candidates, touch, courses);
}

/// The contact of the two when they meet or pass.
void LookAhead::find_there(const StepStart& start, const Touch& touch, Meeting& meeting,
                           const ContactImpulse* kept, Manifold& m) const {
  if (!(meeting.when > 0.0)) return;
  Courses courses = this->courses(start, touch);
  courses.a.position = meeting.at_a, courses.a.angle += meeting.when * courses.a.spin;
  courses.b.position = meeting.at_b + touch.shift, courses.b.angle += meeting.when * courses.b.spin;
  const Manifold ahead =
      touch_manifold(start.candidates, touch, {pose_at(courses.a, 0.0), pose_at(courses.b, 0.0)}, kept);
  if (ahead.count == 0)
    meeting.when = 0.0;
  else
    m = ahead;
}

const LookAhead::Meeting* LookAhead::meeting(std::size_t touch) const {
  if (nears_[touch] == 0) return nullptr;
  const auto i = std::lower_bound(approaches_.begin(), approaches_.end(), touch) - approaches_.begin();
  const Meeting& meeting = meetings_[static_cast<std::size_t>(i)];
  return meeting.when > 0.0 ? &meeting : nullptr;
}

}  // namespace throng
