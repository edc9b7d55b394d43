// SPDX-License-Identifier: MIT
#include "narrowphase/search.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "narrowphase/gjk.h"
#include "narrowphase/support.h"
#include "narrowphase/walk.h"
#include "random_shapes.h"

namespace throng::narrowphase {
namespace {

/// A polygon in the unit circle with corners at random angles.
Convex round(Random& random, int count) {
  std::vector<Vec> points;
  for (int i = 0; i < count; ++i) {
    const Pose p = pose({0, 0}, 2 * std::numbers::pi * (i + uniform(random, 0.0, 0.7)) / count);
    points.emplace_back(p.cos, p.sin);
  }
  return convex(points);
}

TEST(Support, IsTheFarthestVertexAlongAnyDirection) {
  Random random(1988);
  for (int i = 0; i < 3000; ++i) {
    const Convex shape = round(random, 3 + static_cast<int>(random() % 500));
    const Pose towards = pose({0, 0}, uniform(random, -4, 4));
    const Vec direction = 3.0 * Vec{towards.cos, towards.sin};
    double most = -std::numeric_limits<double>::infinity();
    for (const Vec& v : shape.vertices) most = std::max(most, direction.dot(v));
    ASSERT_NEAR(direction.dot(shape.vertices[support(shape, direction)]), most, 1e-14)
        << i << " of " << shape.vertices.size() << " seed 1988";
  }
}

TEST(Support, AlongANormalIsAnEndOfItsEdge) {
  Random random(1989);
  const Convex shape = round(random, 100);
  for (std::size_t i = 0; i < 100; ++i) {
    const std::size_t found = support(shape, shape.normals[i]);
    EXPECT_TRUE(found == i || found == next(i, 100)) << i << " " << found;
  }
}

TEST(Gjk, FindsFeaturesThatProveThemselvesOrAnOverlap) {
  Random random(1990);
  int apart = 0, overlapping = 0, unproven = 0;
  for (int i = 0; i < 3000; ++i) {
    const Convex a = round(random, 3 + static_cast<int>(random() % 60)),
                 b = round(random, 3 + static_cast<int>(random() % 60));
    const Pose pose_a = random_pose(random, 1.5), pose_b = random_pose(random, 1.5);
    const bool is_apart = separation(a, pose_a, b, pose_b).distance > 0.0;
    const auto found = gjk(a, b, relative(pose_a, pose_b), {});
    ASSERT_EQ(found.has_value(), is_apart) << i << " seed 1990";
    (is_apart ? apart : overlapping) += 1;
    if (found) unproven += !Look({a, pose_a, b, pose_b}, *found).proves();
  }
  EXPECT_GT(apart, 900);
  EXPECT_GT(overlapping, 900);
  EXPECT_LT(unproven, 10);
}

// From features that knew another place, the walk comes closer at every step; none is lost in a circle.
TEST(Walk, EndsInAProofForAnyShapesApart) {
  Random random(1991);
  int walked = 0, lost = 0;
  for (int i = 0; i < 20000; ++i) {
    const Convex a =
        convex(hull({random_vec(random, 1, 1), random_vec(random, 1, 1), random_vec(random, 1, 0.1),
                     random_vec(random, 0.1, 1), random_vec(random, 1, 1)}));
    const Convex b =
        convex(hull({random_vec(random, 1, 1), random_vec(random, 1, 0.05), random_vec(random, 1, 0.1)}));
    const Pose pose_a = random_pose(random, 2), pose_b = random_pose(random, 2);
    if (!(separation(a, pose_a, b, pose_b).distance > 0.01)) continue;
    const Placed placed{a, pose_a, b, pose_b};
    ClosestFeatures f{static_cast<std::uint32_t>(random() % 3), static_cast<std::uint32_t>(random() % 3),
                      random() % 2 == 0, true};
    if (const Look look(placed, f); look.proves() || !leads_on(look)) continue;
    const Walk to = walk(placed, f, Look(placed, f));
    ++walked;
    lost += !to.proven && to.steps == 32;
  }
  EXPECT_GT(walked, 3000);
  EXPECT_EQ(lost, 0);
}

// Not where edges are collinear or parallel, nor in slivers, nor where the shapes overlap or touch.
TEST(Walk, NeverGoesRoundInCircles) {
  Random random(1992);
  int proven = 0, given_up = 0;
  for (int i = 0; i < 120000; ++i) {
    const auto [family, a, b, scale, world] = random_pair(random);
    ClosestFeatures f{static_cast<std::uint32_t>(random() % 9), static_cast<std::uint32_t>(random() % 9),
                      random() % 2 == 0, true};
    const Placed placed{a.shape, a.pose, b.shape, b.pose};
    if (!exist(f, placed)) continue;
    const Walk to = walk(placed, f, Look(placed, f));
    ASSERT_LT(to.steps, 32) << family << " " << i << " seed 1992";
    ASSERT_TRUE(exist(f, placed)) << family << " " << i << " seed 1992";
    ++(to.proven ? proven : given_up);
  }
  EXPECT_GT(proven, 9000);
  EXPECT_GT(given_up, 9000);
}

}  // namespace
}  // namespace throng::narrowphase
