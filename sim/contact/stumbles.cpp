// SPDX-License-Identifier: MIT
#include "sim/contact/stumbles.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "narrowphase/support.h"

namespace throng {

using narrowphase::Convex;
using narrowphase::Manifold;
using narrowphase::Pose;

namespace {

constexpr double kSags = 0.01;   // of the radius: so much of how deep A is counts as sag
constexpr double kAsOne = 1e-7;  // of the radius: rounding of places that are one
constexpr double kNears = 1e-5;  // of the radius, in a step: who nears less is stopped by hardly anything

/// Cosines of angles between normals that are as good as one: of a disc, which rolls on over any, and else.
constexpr double kSameOfDisc = 1.0 - 1e-9, kSame = 0.99;

/// A touch as A, one of the two, has it where it stands itself.
struct Seen {
  Vec normal;                // from A to the other
  std::array<Vec, 2> place;  // m, of the points on the other's surface
  int count;
  double depth;  // m, of A in the other, at the deepest point

  Seen(const Touch& touch, const Manifold& m, bool is_a)
      : normal(is_a ? m.normal : -m.normal), count(m.count) {
    const Vec shift = is_a ? Vec(0.0, 0.0) : Vec(-touch.shift);
    depth = -m.points[0].separation;
    for (int i = 0; i < count; ++i) {
      place[i] = m.points[i].point + 0.5 * m.points[i].separation * normal + shift;
      depth = std::max(depth, -m.points[i].separation);
    }
  }

  /// m, how high its points are at most, or at least.
  double top() const { return count == 1 ? height(0) : std::max(height(0), height(1)); }
  double height(int i) const { return -normal.dot(place[i]); }
};

bool is_a(const Touch& touch, std::uint32_t collider) {
  return touch.obstacle || touch.pair.a == collider;
}

bool is_side(const StepStart& start, const Touch& touch) {
  return touch.obstacle && touch.pair.b < start.obstacles().side.size();
}

/// m, how high, that way, the other one of a touch reaches, as A has it. Not of sides.
double reach_of_other(const StepStart& start, const Touch& touch, bool is_a, const Vec& way) {
  thread_local Convex disc = narrowphase::disc(1.0);
  const TouchPoses poses = touch_poses(start, touch);
  const Obstacles& obstacles = start.obstacles();
  const Convex& other = touch.obstacle ? obstacles.part[touch.pair.b - obstacles.side.size()]
                                       : shape(start.colliders(), is_a ? touch.pair.b : touch.pair.a, disc);
  Pose pose = is_a ? poses.b : poses.a;
  if (!is_a) pose.position -= touch.shift;
  const Vec& farthest = other.vertices[narrowphase::support(other, pose.unrotate(way))];
  return way.dot(pose * farthest) + other.radius;
}

bool rolls(const Colliders& colliders, std::uint32_t collider) {
  return is_disc(colliders, collider) || colliders.shape[collider]->vertices.size() == 1;
}

}  // namespace

bool Stumbles::ask(const StepStart& start, std::span<const Touch> touches, std::size_t touch,
                   const Manifold& m, double dt) {
  const Touch& one = touches[touch];
  if (m.count == 0 || is_side(start, one)) return false;
  const Colliders& colliders = start.colliders();
  const double radius_a = colliders.radius[one.pair.a];
  const double radius = one.obstacle ? radius_a : std::max(radius_a, colliders.radius[one.pair.b]);
  const double wide = 4.0 * kSags * radius;
  if (m.count == 2 && (m.points[1].point - m.points[0].point).squaredNorm() > wide * wide) return false;
  const SolverBody &a = start.bodies[one.a], &b = start.bodies[one.b];
  const Vec arm_a = m.points[0].point - a.position, arm_b = m.points[0].point - one.shift - b.position;
  const Vec velocity = b.velocity + b.spin * tangent(arm_b) - a.velocity - a.spin * tangent(arm_a);
  suspects_[touch] = -m.normal.dot(velocity) * dt > kNears * radius;
  return suspects_[touch] != 0;
}

std::span<const std::uint32_t> Stumbles::find(const StepStart& start, std::span<const Touch> touches,
                                              std::span<const Manifold> manifolds, const HeldFaces& held,
                                              Workers& workers) {
  found_.clear();
  for (auto i = suspects_.begin(); (i = std::find(i, suspects_.end(), 1)) != suspects_.end(); ++i)
    found_.push_back(static_cast<std::uint32_t>(i - suspects_.begin()));
  if (found_.empty()) return {};
  const Step step{start, touches, manifolds, held};
  join(step);
  are_.resize(found_.size());
  workers.for_ranges(found_.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) are_[i] = is_one(step, found_[i]);
  });
  std::size_t count = 0;
  for (std::size_t i = 0; i < found_.size(); ++i)
    if (are_[i]) found_[count++] = found_[i];
  return std::span(found_).first(count);
}

/// Lists the touches of each collider.
void Stumbles::join(const Step& step) {
  first_of_.assign(step.start.colliders().size() + 1, 0);
  const auto for_each_end = [&](auto f) {
    for (std::uint32_t i = 0; i < step.touches.size(); ++i) {
      f(step.touches[i].pair.a, i);
      if (!step.touches[i].obstacle) f(step.touches[i].pair.b, i);
    }
  };
  for_each_end([&](std::uint32_t collider, std::uint32_t) { ++first_of_[collider]; });
  std::partial_sum(first_of_.begin(), first_of_.end(), first_of_.begin());
  of_.resize(first_of_.back());
  for_each_end([&](std::uint32_t collider, std::uint32_t touch) { of_[--first_of_[collider]] = touch; });
}

bool Stumbles::is_one(const Step& step, std::uint32_t touch) const {
  const Touch& one = step.touches[touch];
  return is_hidden(step, touch, one.pair.a) || (!one.obstacle && is_hidden(step, touch, one.pair.b));
}

/// Two that hide each other are one: the first stays.
bool Stumbles::is_hidden(const Step& step, std::uint32_t touch, std::uint32_t collider) const {
  for (std::uint32_t i = first_of_[collider]; i < first_of_[collider + 1]; ++i)
    if (const std::uint32_t other = of_[i]; other != touch && hides(step, other, touch, collider) &&
                                            !(touch < other && hides(step, touch, other, collider)))
      return true;
  return false;
}

Manifold Stumbles::manifold(const Step& step, std::uint32_t touch) {
  const Touch& one = step.touches[touch];
  if (!one.held || !step.held.knows(one.lane)) return step.manifolds[touch];
  return touch_manifold(step.start.candidates, one, touch_poses(step.start, one), nullptr);
}

/// Whether the surface that A touches in one touch hides what it touches in another.
bool Stumbles::hides(const Step& step, std::uint32_t surface, std::uint32_t touch, std::uint32_t collider) {
  const StepStart& start = step.start;
  const Touch &its = step.touches[surface], &one = step.touches[touch];
  if (is_side(start, one)) return false;
  const Manifold m = manifold(step, surface), n = manifold(step, touch);
  if (m.count == 0 || n.count == 0) return false;
  const Seen shown(its, m, is_a(its, collider)), seen(one, n, is_a(one, collider));
  const Colliders& colliders = start.colliders();
  if (seen.normal.dot(shown.normal) > (rolls(colliders, collider) ? kSameOfDisc : kSame)) return false;
  const double radius = colliders.radius[collider];
  const double flush = std::clamp(shown.depth, 0.0, kSags * radius) + kAsOne * radius, top = shown.top();
  for (int i = 0; i < seen.count; ++i)
    if (std::abs(-shown.normal.dot(seen.place[i]) - top) > 2.0 * flush) return false;
  return std::abs(reach_of_other(start, one, is_a(one, collider), -shown.normal) - top) <= flush;
}

}  // namespace throng
