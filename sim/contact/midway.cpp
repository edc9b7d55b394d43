// SPDX-License-Identifier: MIT
#include "sim/contact/midway.h"

#include <algorithm>
#include <vector>

#include "sim/contact/fast.h"

namespace throng {

using narrowphase::Manifold;
using narrowphase::ManifoldPoint;

namespace {

constexpr double kLittleWay = 0.25;               // of the radius, to the step's middle
constexpr double kOne = 1.0 - 0.5 * 2e-2 * 2e-2;  // cosine, of normals that are as good as one

bool is_of_whole(const StepStart& start, const Touch& touch) {
  const std::size_t sides = start.obstacles().side.size();
  return touch.pair.b >= sides && !start.obstacles().rim[touch.pair.b - sides].empty();
}

}  // namespace

void Midway::look(std::span<Manifold> manifolds, std::span<std::uint8_t> points, Workers& workers) const {
  const std::span<const Touch> touches = step_.touches;
  const std::size_t walls = step_.start.candidates.obstacle_pairs().size(), first = touches.size() - walls;
  const auto begins = [&](std::size_t i) { return i == first || touches[i].pair.a != touches[i - 1].pair.a; };
  workers.for_ranges(walls, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = first + begin; i < first + end; ++i) {
      if (!begins(i)) continue;
      std::size_t last = i + 1;
      while (last < touches.size() && !begins(last)) ++last;
      look_at_disc(i, last, manifolds, points);
    }
  });
}

/// All of one disc's touches of walls.
void Midway::look_at_disc(std::size_t begin, std::size_t end, std::span<Manifold> manifolds,
                          std::span<std::uint8_t> points) const {
  const StepStart& start = step_.start;
  const std::span<const Touch> touches = step_.touches.subspan(begin, end - begin);
  if (!is_disc(start.colliders(), touches[0].pair.a) || way(touches[0]) == Vec(0.0, 0.0)) return;
  const std::span<Manifold> now = manifolds.subspan(begin, end - begin);
  const auto touching = std::ranges::find_if(now, [](const Manifold& m) { return m.count > 0; });
  if (touching == now.end()) return;
  const Vec normal = touching->normal;
  thread_local std::vector<Manifold> then;
  then.assign(now.begin(), now.end());
  for (std::size_t i = 0; i < then.size(); ++i) {
    if (is_settled(begin + i) || !is_along(now[i], normal, touches[i])) return;
    if (is_of_whole(start, touches[i])) then[i] = manifold(touches[i]);
    if (!is_along(then[i], normal, touches[i])) return;
  }
  if (std::ranges::none_of(then, [](const Manifold& m) { return m.count > 0; })) return;
  std::ranges::copy(then, now.begin());
  for (std::size_t i = 0; i < then.size(); ++i) points[begin + i] = static_cast<std::uint8_t>(then[i].count);
}

/// m, to the step's middle, if that is little; else nothing.
Vec Midway::way(const Touch& touch) const {
  const Vec way = 0.5 * step_.dt * step_.start.bodies[touch.a].velocity;
  const double most = kLittleWay * step_.start.colliders().radius[touch.pair.a];
  return way.squaredNorm() < most * most ? way : Vec(0.0, 0.0);
}

/// Whether the disc nowhere comes up to what it touches, which faces where the normal does.
bool Midway::is_along(const Manifold& m, const Vec& normal, const Touch& touch) const {
  if (m.count == 0) return true;
  const double most = 0.5 * kAheadWay * step_.start.colliders().radius[touch.pair.a];
  return m.normal.dot(normal) >= kOne && m.normal.dot(way(touch)) <= most;
}

bool Midway::is_settled(std::size_t touch) const {
  return step_.ahead.meeting(touch) || step_.stumbles.has(touch);
}

Manifold Midway::manifold(const Touch& touch) const {
  const StepStart& start = step_.start;
  const Vec way = this->way(touch);
  TouchPoses poses = touch_poses(start, touch);
  poses.a.position += way;
  Manifold m = touch_manifold(start.candidates, touch, poses, nullptr);
  for (ManifoldPoint& point : std::span(m.points).first(static_cast<std::size_t>(m.count)))
    point.point -= way, point.separation += m.normal.dot(way);
  return m;
}

}  // namespace throng
