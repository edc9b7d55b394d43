// SPDX-License-Identifier: MIT
#include "tools/bench/convex_pairs.h"

#include <cstdio>
#include <numbers>
#include <random>

#include "narrowphase/distance.h"

namespace throng::bench {

namespace {

using narrowphase::Convex;
using narrowphase::Pose;
using narrowphase::Vec;

class Twister {
 public:
  double uniform(double from, double to) {
    return from + (to - from) * (static_cast<double>(bits_() >> 11) * 0x1p-53);
  }
  double angle() { return uniform(-std::numbers::pi, std::numbers::pi); }

 private:
  std::mt19937_64 bits_{20260101};
};

Convex polygon(Twister& random, std::size_t vertices) {
  std::vector<Vec> points;
  for (std::size_t i = 0; i < vertices; ++i) {
    const double turn = (static_cast<double>(i) + random.uniform(0.0, 0.7)) / static_cast<double>(vertices);
    const Pose p = narrowphase::pose({0.0, 0.0}, 2.0 * std::numbers::pi * turn);
    points.emplace_back(p.cos, p.sin);
  }
  return narrowphase::convex(std::move(points));
}

/// Where pairs begin, and how each goes on.
struct Course {
  double angle_a, angle_b, bearing, distance;
};

Course course(Twister& random, Gap gap) {
  const double angle_a = random.angle(), angle_b = random.angle(), bearing = random.angle();
  const double distance = gap == Gap::overlapping ? random.uniform(1.2, 1.6) : random.uniform(2.0, 2.5);
  return {angle_a, angle_b, bearing, distance};
}

Placement at(const Course& c, double turned) {
  const Pose bearing = narrowphase::pose({0.0, 0.0}, c.bearing);
  const Vec from{0.25 * c.angle_b, -0.5 * c.angle_a};
  return {narrowphase::pose(from, c.angle_a + 0.6 * turned),
          narrowphase::pose(from + bearing * Vec{c.distance, 0.0}, c.angle_b - 0.4 * turned)};
}

/// Moves b until it touches; twice, so that rounding is all that is left.
void touch(const Convex& a, const Convex& b, Placement& p) {
  for (int i = 0; i < 2; ++i) {
    const narrowphase::Separation s = narrowphase::separation(a, p.a, b, p.b);
    p.b.position -= s.distance * s.normal;
  }
}

}  // namespace

std::string case_name(std::size_t vertices, double step, Gap gap) {
  char text[80];
  const char* gaps[] = {"near", "touching", "overlapping"};
  const char* where = gaps[static_cast<int>(gap)];
  if (step > 0.0)
    std::snprintf(text, sizeof text, "coherent %zu vertices %g rad %s", vertices, step, where);
  else
    std::snprintf(text, sizeof text, "incoherent %zu vertices %s", vertices, where);
  return text;
}

ConvexPairs convex_pairs(std::size_t vertices, double step, Gap gap, bool quick) {
  const std::size_t count = vertices <= 40 ? 512 : vertices <= 400 ? 256 : 64;
  const std::size_t times = quick ? 2 : vertices <= 400 ? 64 : 32;
  Twister random;
  ConvexPairs c{case_name(vertices, step, gap), {}, {}, {}, {}, step > 0.0};
  for (int i = 0; i < 8; ++i) c.shapes.push_back(polygon(random, vertices));
  std::vector<Course> courses;
  for (std::size_t i = 0; i < count; ++i) {
    c.a.push_back(static_cast<std::uint32_t>(i % 8)), c.b.push_back(static_cast<std::uint32_t>(i / 8 % 8));
    courses.push_back(course(random, gap));
  }
  for (std::size_t time = 0; time < times; ++time)
    for (std::size_t i = 0; i < count; ++i) {
      if (!c.coherent) courses[i] = course(random, gap);
      Placement p = at(courses[i], step * static_cast<double>(time));
      if (gap == Gap::touching) touch(c.shapes[c.a[i]], c.shapes[c.b[i]], p);
      c.placements.push_back(p);
    }
  return c;
}

}  // namespace throng::bench
