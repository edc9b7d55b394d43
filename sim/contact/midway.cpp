// SPDX-License-Identifier: MIT
#include "sim/contact/midway.h"

#include <algorithm>
#include <cstddef>
#include <vector>

#include "sim/contact/fast.h"

namespace throng {

using narrowphase::Manifold;
using narrowphase::ManifoldPoint;

namespace {

constexpr double kLittleWay = 0.25;               // of the radius, to the step's middle
constexpr double kNearly = 1e-3;                  // of the radius, in a step: what it falls, or is pushed
constexpr double kOne = 1.0 - 0.5 * 2e-2 * 2e-2;  // cosine, of normals that are as good as one

std::span<const ManifoldPoint> points_of(const Manifold& m) {
  return std::span(m.points).first(static_cast<std::size_t>(m.count));
}

/// A disc and how it goes on.
struct Slider {
  double radius;  // m
  Vec way;        // m, to the step's middle

  bool slides() const {
    const double most = kLittleWay * radius;
    return way != Vec(0.0, 0.0) && way.squaredNorm() < most * most;
  }

  /// Whether it doesn't get to any of the points in the step.
  bool stays_apart(const Manifold& m) const {
    const double near = 2.0 * m.normal.dot(way) + kNearly * radius;
    return std::ranges::all_of(points_of(m), [&](const ManifoldPoint& p) { return p.separation > near; });
  }

  /// Whether it goes along what faces that way, or doesn't get there.
  bool goes_along(const Manifold& m, const Vec& normal) const {
    return stays_apart(m) || (m.normal.dot(normal) >= kOne && m.normal.dot(way) <= 0.5 * kAheadWay * radius);
  }

  Manifold touch_midway(const StepStart& start, const Touch& touch) const {
    TouchPoses poses = touch_poses(start, touch);
    poses.a.position += way;
    Manifold m = touch_manifold(start.candidates, touch, poses, nullptr);
    const double nears = m.normal.dot(way);
    for (int i = 0; i < m.count; ++i)
      m.points[i].point += 0.5 * nears * m.normal - way, m.points[i].separation += nears;
    return m;
  }
};

/// Of one disc: all its touches of walls, from the first on.
void touch_midway(const FoundTouches& found, std::size_t first, std::span<Manifold> manifolds,
                  std::span<std::uint8_t> points) {
  const StepStart& start = found.start;
  const std::span<const Touch> touches = found.touches.subspan(first, manifolds.size());
  const auto bends = [&](const Touch& touch) { return start.obstacles().bends_at(touch.pair.b); };
  if (!is_disc(start.colliders(), touches[0].pair.a) || std::ranges::none_of(touches, bends)) return;
  const Slider disc{start.colliders().radius[touches[0].pair.a],
                    0.5 * found.dt * start.bodies[touches[0].a].velocity};
  const auto stays_apart = [&](const Manifold& m) { return disc.stays_apart(m); };
  const auto touched = std::ranges::find_if_not(manifolds, stays_apart);
  if (!disc.slides() || touched == manifolds.end()) return;
  const Vec normal = touched->normal;
  thread_local std::vector<Manifold> midway;
  midway.assign(manifolds.begin(), manifolds.end());
  for (std::size_t i = 0; i < touches.size(); ++i) {
    if (found.ahead.meeting(first + i)) return;
    if (bends(touches[i]))
      midway[i] = disc.touch_midway(start, touches[i]);
    else if (found.stumbles.has(first + i))
      return;
    if (!disc.goes_along(manifolds[i], normal) || !disc.goes_along(midway[i], normal)) return;
  }
  if (std::ranges::all_of(midway, stays_apart)) return;
  std::ranges::copy(midway, manifolds.begin());
  for (std::size_t i = 0; i < touches.size(); ++i) points[i] = static_cast<std::uint8_t>(midway[i].count);
}

}  // namespace

void touch_midway(const FoundTouches& found, std::span<Manifold> manifolds, std::span<std::uint8_t> points,
                  Workers& workers) {
  if (found.start.obstacles().bends.empty()) return;
  const std::span<const Touch> touches = found.touches;
  const std::size_t walls = found.start.candidates.obstacle_pairs().size(), first = touches.size() - walls;
  const auto begins = [&](std::size_t i) { return i == first || touches[i].pair.a != touches[i - 1].pair.a; };
  workers.for_ranges(walls, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = first + begin; i < first + end; ++i) {
      if (!begins(i)) continue;
      std::size_t count = 1;
      while (i + count < touches.size() && !begins(i + count)) ++count;
      touch_midway(found, i, manifolds.subspan(i, count), points.subspan(i, count));
    }
  });
}

}  // namespace throng
