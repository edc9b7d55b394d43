// SPDX-License-Identifier: MIT
#include "sim/contact/stumbles.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <numeric>

#include "narrowphase/support.h"
#include "sim/contact/kept_impulses.h"

namespace throng {

using narrowphase::Convex;
using narrowphase::Manifold;
using narrowphase::Pose;

namespace {

constexpr double kSags = 0.01;   // of the radius: so much of how deep A is counts as sag
constexpr double kAsOne = 1e-7;  // of the radius: rounding of places that are one
constexpr double kNears = 1e-6;  // of the radius, in a step: who nears less is stopped by hardly anything

/// Cosines of angles between normals that are as good as one: of a disc, which rolls on over any, and else.
constexpr double kSameOfDisc = 1.0 - 1e-9, kSame = 0.99;

/// A touch as A, one of the two bodies, has it where it stands itself.
struct Seen {
  Vec normal;                // from A to the other
  std::array<Vec, 2> place;  // m, of the points on the other's surface
  int count;
  double depth;  // m, of A in the other, at the deepest point

  Seen(const Touch& touch, const Manifold& m, bool is_a)
      : normal(is_a ? m.normal : -m.normal), count(m.count), depth(-least_separation(m)) {
    assert(count > 0);
    const Vec shift = is_a ? Vec(0.0, 0.0) : Vec(-touch.shift);
    for (int i = 0; i < count; ++i)
      place[i] = m.points[i].point + 0.5 * m.points[i].separation * normal + shift;
  }

  /// m, how high that surface is.
  double top() const { return count == 1 ? height(0) : std::max(height(0), height(1)); }
  double height(int i) const { return -normal.dot(place[i]); }

  /// m, how far along the surface a place is from its points, and what is between them.
  double along(const Vec& p) const {
    const Vec way = tangent(normal);
    const double x = way.dot(p), one = way.dot(place[0]), other = way.dot(place[count - 1]);
    return std::max({std::min(one, other) - x, x - std::max(one, other), 0.0});
  }
};

bool is_a(const Touch& touch, std::uint32_t body) {
  return touch.a == body;
}

std::uint32_t own_part(const Touch& touch, std::uint32_t body) {
  return is_a(touch, body) ? touch.pair.a : touch.pair.b;
}

/// m, how far that way the collider reaches that is the touch's a, or its b, where A stands itself.
double reach_of_collider(const StepStart& start, const Touch& touch, bool of_a, const Vec& shift,
                         const Vec& way) {
  thread_local Convex disc = narrowphase::disc(1.0);
  const Convex& part = !of_a && touch.obstacle
                           ? start.obstacles().part_at(touch.pair.b)
                           : shape(start.colliders(), of_a ? touch.pair.a : touch.pair.b, disc);
  const TouchPoses poses = touch_poses(start, touch);
  Pose pose = of_a ? poses.a : poses.b;
  pose.position += shift;
  return way.dot(pose * part.vertices[narrowphase::support(part, pose.unrotate(way))]) + part.radius;
}

/// That of A's own part, and of the other, which is no side.
double reach_of_own(const StepStart& start, const Touch& touch, bool is_a, const Vec& way) {
  return reach_of_collider(start, touch, is_a, is_a ? Vec(0.0, 0.0) : Vec(-touch.shift), way);
}
double reach_of_other(const StepStart& start, const Touch& touch, bool is_a, const Vec& way) {
  return reach_of_collider(start, touch, !is_a, is_a ? Vec(0.0, 0.0) : Vec(-touch.shift), way);
}

/// Whether what A touches is no lighter than A, which moves.
bool is_heavier(const StepStart& start, const Touch& touch, std::uint32_t body) {
  const SolverBody &a = start.bodies[touch.a], &b = start.bodies[touch.b];
  const SolverBody &own = is_a(touch, body) ? a : b, &other = is_a(touch, body) ? b : a;
  return own.is_dynamic() && other.inverse_mass <= own.inverse_mass;
}

/// m/s, of b against a at the first of the points. A disc that rolls goes on though its surface stands there:
/// its spin is left out.
Vec velocity(const StepStart& start, const Touch& touch, const Manifold& m) {
  const SolverBody &a = start.bodies[touch.a], &b = start.bodies[touch.b];
  const Vec arm_a = m.points[0].point - a.position, arm_b = m.points[0].point - touch.shift - b.position;
  const double spin_a = is_disc(start.colliders(), touch.pair.a) ? 0.0 : a.spin;
  const double spin_b = !touch.obstacle && is_disc(start.colliders(), touch.pair.b) ? 0.0 : b.spin;
  return b.velocity + spin_b * tangent(arm_b) - a.velocity - spin_a * tangent(arm_a);
}

bool rolls(const Colliders& colliders, std::uint32_t collider) {
  return is_disc(colliders, collider) || colliders.shape[collider]->vertices.size() == 1;
}

}  // namespace

bool Stumbles::ask(const StepStart& start, std::span<const Touch> touches, std::size_t touch,
                   const Manifold& m) {
  const Touch& one = touches[touch];
  if (m.count == 0 || is_side(start, one)) return false;
  const double radius = smaller_radius(start.colliders(), one), wide = 4.0 * kSags * radius;
  if (m.count == 2 && (m.points[1].point - m.points[0].point).squaredNorm() > wide * wide) return false;
  suspects_[touch] = -m.normal.dot(velocity(start, one, m)) * dt_ > kNears * radius;
  return suspects_[touch] != 0;
}

std::span<const std::uint32_t> Stumbles::find(const StepStart& start, std::span<const Touch> touches,
                                              std::span<const Manifold> manifolds, const HeldFaces& held,
                                              Workers& workers) {
  found_.clear();
  for (auto i = suspects_.begin(); (i = std::find(i, suspects_.end(), 1)) != suspects_.end(); ++i)
    found_.push_back(static_cast<std::uint32_t>(i - suspects_.begin()));
  if (found_.empty()) return {};
  const Step step{dt_, start, touches, manifolds, held};
  join(step);
  are_.resize(found_.size());
  workers.for_ranges(found_.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) are_[i] = is_one(step, found_[i]);
  });
  std::size_t count = 0;
  for (std::size_t i = 0; i < found_.size(); ++i)
    if (are_[i]) found_[count++] = found_[i];
  found_.resize(count);
  return found_;
}

/// Lists the touches of each body.
void Stumbles::join(const Step& step) {
  first_of_.assign(step.start.bodies.size() + 1, 0);
  const auto for_each_end = [&](auto f) {
    for (std::uint32_t i = 0; i < step.touches.size(); ++i) {
      f(step.touches[i].a, i);
      if (!step.touches[i].obstacle) f(step.touches[i].b, i);
    }
  };
  for_each_end([&](std::uint32_t body, std::uint32_t) { ++first_of_[body]; });
  std::partial_sum(first_of_.begin(), first_of_.end(), first_of_.begin());
  of_.resize(first_of_.back());
  for_each_end([&](std::uint32_t body, std::uint32_t touch) { of_[--first_of_[body]] = touch; });
}

bool Stumbles::is_one(const Step& step, std::uint32_t touch) const {
  const Touch& one = step.touches[touch];
  return is_hidden(step, touch, one.a) || (!one.obstacle && is_hidden(step, touch, one.b));
}

/// Two that hide each other are one: the first stays.
bool Stumbles::is_hidden(const Step& step, std::uint32_t touch, std::uint32_t body) const {
  if (!is_heavier(step.start, step.touches[touch], body)) return false;
  for (std::uint32_t i = first_of_[body]; i < first_of_[body + 1]; ++i)
    if (const std::uint32_t other = of_[i];
        other != touch && is_heavier(step.start, step.touches[other], body) &&
        hides(step, other, touch, body) && !(touch < other && hides(step, touch, other, body)))
      return true;
  return false;
}

Manifold Stumbles::manifold(const Step& step, std::uint32_t touch) {
  const Touch& one = step.touches[touch];
  if (!one.held || !step.held.knows(one.lane)) return step.manifolds[touch];
  KeptImpulses memory(step.start.state.point_contacts, one.key());
  return touch_manifold(step.start.candidates, one, touch_poses(step.start, one), memory.find(one.key()));
}

/// Whether the surface that A touches in one touch hides what it touches in another.
bool Stumbles::hides(const Step& step, std::uint32_t surface, std::uint32_t touch, std::uint32_t body) {
  const StepStart& start = step.start;
  const Touch &its = step.touches[surface], &one = step.touches[touch];
  if (is_side(start, one)) return false;
  const Manifold m = manifold(step, surface), n = manifold(step, touch);
  if (m.count == 0 || n.count == 0) return false;
  const Seen shown(its, m, is_a(its, body)), seen(one, n, is_a(one, body));
  const bool rolls = throng::rolls(start.colliders(), own_part(one, body));
  if (seen.normal.dot(shown.normal) > (rolls ? kSameOfDisc : kSame)) return false;
  const double radius = smaller_radius(start.colliders(), one);
  const Vec comes = velocity(start, one, n), slides = comes - comes.dot(shown.normal) * shown.normal;
  if (!(-n.normal.dot(slides) * step.dt > kNears * radius)) return false;
  const double flush = std::clamp(shown.depth, 0.0, kSags * radius) + kAsOne * radius, top = shown.top();
  const double beside = 2.0 * radius + std::max(-seen.depth, 0.0);
  for (int i = 0; i < seen.count; ++i)
    if (std::abs(-shown.normal.dot(seen.place[i]) - top) > 2.0 * flush || shown.along(seen.place[i]) > beside)
      return false;
  if (own_part(its, body) != own_part(one, body) &&
      -reach_of_own(start, one, is_a(one, body), shown.normal) < top - flush)
    return false;  // that part of A may be beside the surface
  return std::abs(reach_of_other(start, one, is_a(one, body), -shown.normal) - top) <= flush;
}

}  // namespace throng
