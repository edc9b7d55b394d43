// SPDX-License-Identifier: MIT
#include "sim/crowd/distance_field.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "sim/crowd/slide.h"
#include "tests/less_when_watched.h"
#include "tests/sim/crowd/box.h"
#include "tools/bench/geodesic.h"

namespace throng {
namespace {

using bench::edges;
using bench::Geodesic;
using bench::rectangle;

/// A field over a region whose edges are the barriers, and `walls` besides.
struct Field {
  Field(Region area, const Region& goal, double cell, double clearance, std::vector<BarrierLine> walls = {},
        double closed = 0.0)
      : walkable(std::move(area)),
        barriers(with(edges(walkable), walls), 1.0),
        plan(floor_plan(walkable, barriers, {cell, clearance}, closed)),
        field(plan, barriers, goal) {}

  static std::vector<BarrierLine> with(std::vector<BarrierLine> lines, const std::vector<BarrierLine>& more) {
    lines.insert(lines.end(), more.begin(), more.end());
    return lines;
  }

  Region walkable;
  Barriers barriers;
  FloorPlan plan;
  DistanceField field;
};

TEST(DistanceField, IsTheStraightDistanceInAnEmptyCorridor) {
  const Field f(box(0, 0, 40, 2), box(39, 0, 40, 2), 0.125, 0.2);
  EXPECT_NEAR(f.field.distance({9, 1}), 30.0, 1e-4);
  EXPECT_NEAR(f.field.distance({20.03, 0.6}), 18.97, 1e-4);
  EXPECT_NEAR((f.field.direction({9, 0.7}) - Vec(1, 0)).norm(), 0.0, 1e-4);
  EXPECT_EQ(f.field.distance({39.5, 1}), 0.0);
  EXPECT_EQ(f.field.direction({39.5, 1}), Vec(0, 0));
}

TEST(DistanceField, LeadsToTheNearestPointOfAWideGoal) {
  const Field f(box(0, 0, 20, 10), box(18, 0, 20, 10), 0.25, 0.25);
  for (const double y : {1.0, 5.0, 8.9})
    EXPECT_NEAR((f.field.direction({3, y}) - Vec(1, 0)).norm(), 0.0, 1e-3);
}

TEST(DistanceField, SlopesWhereItIsWholeAlongItsDirection) {
  const Field f(box(0, 0, 10, 10), box(9, 0, 10, 1), 0.1, 0.05, {{{{5, 0}, {5, 8}}, false}});
  std::mt19937_64 random(4);
  std::uniform_real_distribution<double> place(0.0, 10.0);
  int whole = 0;
  for (int i = 0; i < 1000; ++i) {
    const Vec p(place(random), place(random));
    Vec down;
    if (!f.field.slope(p, down)) continue;
    ++whole;
    EXPECT_EQ(Vec(down / std::sqrt(down.squaredNorm())), f.field.direction(p)) << p.transpose();
  }
  EXPECT_GT(whole, 900);
  Vec down;
  EXPECT_FALSE(f.field.slope({9.5, 0.5}, down)) << "in the goal";
  EXPECT_FALSE(f.field.slope({5.01, 4.0}, down)) << "beside the wall";
  EXPECT_FALSE(f.field.slope({-1.0, 4.0}, down)) << "outside";
}

TEST(DistanceField, GoesRoundAThinWall) {
  const Field f(box(0, 0, 10, 10), box(9, 0, 10, 1), 0.1, 0.05, {{{{5, 0}, {5, 8}}, false}});
  EXPECT_NEAR(f.field.distance({1, 1}), std::hypot(4, 7) + std::hypot(4, 7), 0.3) << "three cells";
  EXPECT_GT(f.field.direction({4.9, 2}).y(), 0.8) << "next to the wall, along it";
  EXPECT_LT(f.field.direction({5.1, 2}).y(), 0.1) << "beyond it, to the goal";
}

TEST(DistanceField, IsInfiniteWhereNoWayLeads) {
  const Field f(box(0, 0, 10, 10), box(9, 0, 10, 1), 0.1, 0.1, {{{{5, -1}, {5, 11}}, false}});
  EXPECT_TRUE(std::isinf(f.field.distance({2, 2})));
  EXPECT_EQ(f.field.direction({2, 2}), Vec(0, 0));
  EXPECT_TRUE(std::isinf(f.field.distance({-3, 2})));
  EXPECT_TRUE(std::isfinite(f.field.distance({6, 9})));
}

TEST(DistanceField, ClosesWhatIsNarrowerThanAnAgent) {
  const std::vector<BarrierLine> door{{{{5, 0}, {5, 4}}, false}, {{{5, 4.5}, {5, 10}}, false}};
  const Field open(box(0, 0, 10, 10), box(9, 0, 10, 1), 0.05, 0.1, door, 0.49);
  const Field closed(box(0, 0, 10, 10), box(9, 0, 10, 1), 0.05, 0.1, door, 0.51);
  EXPECT_TRUE(std::isfinite(open.field.distance({2, 2})));
  EXPECT_TRUE(std::isinf(closed.field.distance({2, 2})));
}

TEST(DistanceField, IsWithinOnePercentOfTheExactGeodesicDistance) {
  const unsigned seed = 5;
  SCOPED_TRACE(seed);
  Region hall = box(0, 0, 50, 50);
  hall.rings.push_back(rectangle(10, 5, 12, 45));
  hall.rings.push_back(rectangle(20, 0.5, 22, 40));
  hall.rings.push_back({{30, 10}, {40, 20}, {35, 35}, {28, 30}});
  const Vec goal(45.0, 30.0);
  const Field f(hall, box(44.999, 29.999, 45.001, 30.001), 0.05, 0.025);
  const Geodesic exact(f.walkable, f.barriers, goal);
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(0.2, 49.8);
  int asked = 0, bent = 0;
  double worst = 0.0;
  while (asked < 2000) {
    const Vec p(uniform(random), uniform(random));
    if (!contains(f.walkable, p) || f.barriers.distance(p, 0.3) < 0.3 || (p - goal).norm() < 1.0) continue;
    const double truth = exact.distance(p);
    worst = std::max(worst, std::abs(f.field.distance(p) - truth) / truth);
    ++asked, bent += truth > (p - goal).norm() * 1.0001;
  }
  EXPECT_LE(worst, 0.01);
  RecordProperty("worst", std::to_string(worst));
  EXPECT_GT(bent, 600) << "the sample must go round corners";
  EXPECT_LT(bent, 1700);
}

TEST(DistanceField, WaysEndInTheGoalFromEverywhere) {
  Region hall = box(0, 0, 12, 12);
  hall.rings.push_back(rectangle(3, 3, 5, 9));
  hall.rings.push_back({{6, 1}, {10, 6}, {6, 11}, {8, 6}});
  const Field f(hall, box(11, 5, 12, 7), 0.1, 0.3);
  std::mt19937 random(3);
  std::uniform_real_distribution<double> uniform(0.05, 11.95);
  for (int k = 0; k < 300; ++k) {
    Vec p(uniform(random), uniform(random));
    if (!contains(f.walkable, p) || f.barriers.distance(p, 0.15) < 0.15) continue;
    const Vec start = p;
    double way = 0.0;
    for (; way < 60.0 && f.field.distance(p) > 0.0; way += 0.02) {
      const Vec next = p + 0.02 * f.field.direction(p);
      ASSERT_FALSE(f.barriers.block(p, next)) << "from " << start.transpose() << " at " << p.transpose();
      p = next;
    }
    EXPECT_LE(way, 1.1 * f.field.distance(start) + 1.0) << start.transpose();
  }
}

// Ways that led from free ground into the ground next to a wall's end, which looked shorter, sent agents to
// and fro before the door for ever.
TEST(DistanceField, TheEndsOfWallsAreNoShortCuts) {
  const std::vector<BarrierLine> door{{{{0, 5}, {4.5, 5}}, false}, {{{5.5, 5}, {10, 5}}, false}};
  for (const double radius : {0.18, 0.2, 0.22}) {
    const Field f(box(0, 0, 10, 10), box(0, 5.5, 1, 10), 0.1, radius, door);
    for (std::size_t i = 0; i < f.plan.size(); i += kStride) {
      if (f.plan.footing[i] != Footing::free) continue;
      Vec p = f.plan.node(i);
      const double way = f.field.distance(p), stride = 0.03;
      int steps = 0;
      while (f.field.distance(p) > 0.05 && steps * stride < 1.1 * way + 0.1)
        p = slide(f.barriers, p, stride * f.field.direction(p), radius).to, ++steps;
      ASSERT_LE(f.field.distance(p), 0.05) << "from " << f.plan.node(i).transpose() << ", " << way << " m";
    }
  }
}

/// A corridor of that width along the x axis, turned by `angle` about the origin and shifted.
struct Corridor {
  Corridor(double width, double radius, double angle, const Vec& shift)
      : turn(Eigen::Rotation2Dd(angle)),
        at(shift),
        walkable(placed(box(0, 0, 12, width))),
        barriers(edges(walkable), 1.0),
        plan(floor_plan(walkable, barriers, resolution_for(walkable, barriers, radius), 0.0)),
        field(plan, barriers, placed(box(11, 0, 12, width))) {}

  Vec place(const Vec& p) const { return turn * p + at; }
  Region placed(Region region) const {
    for (std::vector<Vec>& ring : region.rings)
      for (Vec& p : ring) p = place(p);
    return region;
  }

  Eigen::Rotation2Dd turn;
  Vec at;
  Region walkable;
  Barriers barriers;
  FloorPlan plan;
  DistanceField field;
};

double degrees_between(const Vec& a, const Vec& b) {
  return std::atan2(std::abs(cross(a, b)), a.dot(b)) * 180.0 / std::acos(-1.0);
}

/// The worst angle (degrees) to the wall that agents of that radius are led at, from where they touch it on.
double worst_angle(const Corridor& corridor, double width, double radius) {
  double worst = 0.0;
  for (double y = radius; y <= width - radius; y += 0.01)
    for (double x = 1.0; x < 9.0; x += 0.037)
      worst = std::max(worst, degrees_between(corridor.field.direction(corridor.place({x, y})),
                                              corridor.turn * Vec(1, 0)));
  return worst;
}

// The ground beside walls led away from them at 56 degrees, up to half a radius beyond where agents touch
// them: who walked along a wall was thrown off it in each tenth step, and one walked backwards for 8 m.
TEST(DistanceField, WaysAlongWallsLeadAlongThem) {
  for (const double width : {0.7, 0.8, 2.0, 4.0})
    for (const double radius : {0.2, 0.3})
      for (const double shift : {0.0, 0.05, 0.13, 0.2, 0.5}) {
        const Corridor corridor(width, radius, 0.0, {shift, shift});
        EXPECT_LE(worst_angle(corridor, width, radius), 0.1) << width << " m, " << radius << ", " << shift;
      }
}

TEST(DistanceField, WaysAlongWallsLeadAlongThemWhateverTheirAngle) {
  for (const double angle : {0.1, 0.3, 0.5, 0.7854, 1.0, 2.0, 4.0})
    for (const double shift : {0.0, 0.13, 0.21}) {
      const Corridor corridor(2.0, 0.2, angle, {shift, 3.0 * shift});
      EXPECT_LE(worst_angle(corridor, 2.0, 0.2), 10.0) << angle << ", " << shift;
    }
}

// Who is smaller than the ground that others keep clear was led from node to node, one way in this step and
// the other in the next.
TEST(DistanceField, WaysOfSmallerAgentsLeadAlongWallsToo) {
  for (const double angle : {0.0, 0.3, 0.7854})
    for (const double shift : {0.0, 0.05, 0.13, 0.2}) {
      const Corridor corridor(2.0, 0.25, angle, {shift, 3.0 * shift});
      EXPECT_LE(worst_angle(corridor, 2.0, 0.15), angle == 0.0 ? 0.1 : 20.0) << angle << ", " << shift;
    }
}

// A lone agent took 16.93 s for 16.63 m, with 61 to 69 degrees of turning in each tenth step.
TEST(DistanceField, WaysRoundABlockAreSmoothAndShortest) {
  Region hall = box(0, 0, 20, 10);
  hall.rings.push_back(rectangle(8, 3, 12, 8));
  const double radius = 0.2, stride = 0.01;
  const Barriers barriers(edges(hall), 1.0);
  const FloorPlan plan = floor_plan(hall, barriers, resolution_for(hall, barriers, radius), 0.0);
  const DistanceField field(plan, barriers, box(18, 4.5, 19, 5.5));
  Vec p(2, 5), before = field.direction(p);
  double sharpest = 0.0;
  int steps = 0;
  for (; field.distance(p) > 0.0 && steps < 2000; ++steps) {
    const Vec direction = field.direction(p);
    if (field.distance(p) > 1.0) sharpest = std::max(sharpest, degrees_between(before, direction));
    p = slide(barriers, p, stride * direction, radius).to, before = direction;
  }
  EXPECT_LE(sharpest, 12.0);
  EXPECT_NEAR(steps * stride, 16.66, 0.05);
}

}  // namespace
}  // namespace throng
