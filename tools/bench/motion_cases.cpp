// SPDX-License-Identifier: MIT
#include "tools/bench/motion_cases.h"

#include <algorithm>
#include <array>
#include <cstdio>

#include "narrowphase/decompose.h"
#include "narrowphase/polygon.h"
#include "tools/bench/outlines.h"

namespace throng::bench {

namespace {

using namespace narrowphase;

/// Numbers of one case, each asked for once.
class CaseRandom {
 public:
  explicit CaseRandom(std::uint64_t seed) : seed_(seed) {}
  double uniform(double from, double to) { return 0.5 * (from + to + (to - from) * noise(seed_, next_++)); }
  double angle() { return uniform(-std::numbers::pi, std::numbers::pi); }
  Vec bearing() { return narrowphase::pose({0.0, 0.0}, angle()).rotate({1.0, 0.0}); }

 private:
  std::uint64_t seed_, next_ = 0;
};

Convex box(const Vec& low, const Vec& high) {
  return convex({low, {high.x(), low.y()}, high, {low.x(), high.y()}});
}

/// On a circle, at uneven angles.
Convex round_polygon(CaseRandom& random, std::size_t vertices, double radius) {
  Ring ring;
  for (std::size_t i = 0; i < vertices; ++i) {
    const double turn = (static_cast<double>(i) + random.uniform(0.0, 0.7)) / static_cast<double>(vertices);
    ring.push_back(narrowphase::pose({0.0, 0.0}, 2.0 * std::numbers::pi * turn).rotate({radius, 0.0}));
  }
  return convex(std::move(ring));
}

/// b comes from up to 4.5 m away, in a straight line that passes a's origin within `aside`; both turn.
MotionQuery passing(CaseRandom& random, const Solid* a, const Solid* b, double aside) {
  const Vec from = random.bearing(), home{random.uniform(-9.0, 9.0), random.uniform(-9.0, 9.0)};
  const Vec drift{random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0)};
  const double far = random.uniform(2.1, 4.5), by = random.uniform(-aside, aside);
  const double way = random.uniform(2.0, 4.0);
  const Motion motion_a{home, random.angle(), drift, random.uniform(-1.0, 1.0)};
  const Vec start = home + far * from + by * Vec(-from.y(), from.x());
  return {a, b, motion_a, {start, random.angle(), drift - way * from, random.uniform(-1.0, 1.0)}};
}

/// Every pair of eight solids, as often as wanted.
MotionCase passing_pairs(std::string name, std::vector<std::vector<Convex>> shapes, double aside,
                         std::size_t queries) {
  MotionCase c{std::move(name), 2.0, false};
  for (std::vector<Convex>& parts : shapes) c.solids.push_back(std::make_unique<Solid>(std::move(parts)));
  const std::size_t n = c.solids.size();
  CaseRandom random(20261121);
  for (std::size_t i = 0; i < queries; ++i)
    c.queries.push_back(passing(random, c.solids[i % n].get(), c.solids[i / n % n].get(), aside));
  return c;
}

/// Seen from elsewhere: no edge is parallel to an axis.
Motion in(const Pose& world, double angle, const Motion& motion) {
  return {world * motion.position, motion.angle + angle, world.rotate(motion.velocity), motion.spin};
}

}  // namespace

bool MotionCase::convex() const {
  return std::ranges::all_of(solids, [](const auto& solid) { return solid->parts.size() == 1; });
}

MotionCase bar_past_post(double clearance, std::size_t queries) {
  const double reach = Vec(1.0, 0.1).norm();
  char name[64];
  std::snprintf(name, sizeof name, clearance > 0.0 ? "bar past post, clearance %g" : "bar into post, %g deep",
                std::abs(clearance));
  MotionCase c{name, 4.0, clearance > 0.0};
  c.solids.push_back(std::make_unique<Solid>(std::vector{box({-3.0, -0.1}, {1.0, 0.1})}));
  c.solids.push_back(
      std::make_unique<Solid>(std::vector{box({reach + clearance, -0.5}, {reach + clearance + 1.0, 0.5})}));
  CaseRandom random(7);
  for (std::size_t i = 0; i < queries; ++i) {
    const double angle = random.angle();
    const Pose world = narrowphase::pose({random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0)}, angle);
    const double turn = i % 2 == 0 ? 1.0 : -1.0, begin = turn * random.uniform(-2.1, -2.0);
    c.queries.push_back({c.solids[0].get(), c.solids[1].get(),
                         in(world, angle, {{0.0, 0.0}, begin, {0.0, 0.0}, 4.1 * turn}),
                         in(world, angle, {})});
  }
  return c;
}

MotionCase random_octagons(std::size_t queries) {
  CaseRandom random(8);
  std::vector<std::vector<Convex>> shapes;
  for (int i = 0; i < 8; ++i) shapes.push_back({round_polygon(random, 8, 1.0)});
  return passing_pairs("octagons, random", std::move(shapes), 3.4, queries);
}

MotionCase random_rods(std::size_t queries) {
  const Convex rod = box({-1.0, -0.01}, {1.0, 0.01});
  return passing_pairs("rods, random", {{rod}, {rod}}, 1.2, queries);
}

MotionCase random_outlines(const std::string& family, std::size_t edges, std::size_t queries) {
  std::vector<std::vector<Convex>> shapes;
  for (std::uint64_t seed : {1, 2}) {
    const Ring ring = around(family == "gear" ? gear_radii(edges) : coast_radii(edges, seed));
    shapes.push_back(decompose(clean(ring).vertices));
  }
  return passing_pairs(family + "s n=" + std::to_string(edges) + ", random", std::move(shapes), 3.2, queries);
}

MotionCase random_clutter(std::size_t queries) {
  CaseRandom random(9);
  MotionCase c{"bracket in clutter of 400, random", 1.0, false};
  c.solids.push_back(
      std::make_unique<Solid>(std::vector{box({-0.1, -0.1}, {0.9, 0.1}), box({-0.1, 0.1}, {0.1, 0.9})}));
  std::vector<Convex> obstacles;
  for (int i = 0; i < 400; ++i) {
    const Vec at{1.5 * (i % 20) + random.uniform(-0.4, 0.4), 1.5 * (i / 20) + random.uniform(-0.4, 0.4)};
    Convex polygon = round_polygon(random, 3 + static_cast<std::size_t>(i % 5), random.uniform(0.05, 0.3));
    for (Vec& v : polygon.vertices) v += at;
    obstacles.push_back(convex(std::move(polygon.vertices)));
  }
  c.solids.push_back(std::make_unique<Solid>(std::move(obstacles)));
  while (c.queries.size() < queries) {
    const Vec start{random.uniform(0.0, 28.5), random.uniform(0.0, 28.5)};
    const Motion motion{start, random.angle(), random.uniform(0.1, 1.5) * random.bearing(),
                        random.uniform(-1.5, 1.5)};
    if (separation(c.solids[0]->bvh, pose_at(motion, 0.0), c.solids[1]->bvh, {}).distance > 0.0)
      c.queries.push_back({c.solids[0].get(), c.solids[1].get(), motion, {}});
  }
  return c;
}

}  // namespace throng::bench
