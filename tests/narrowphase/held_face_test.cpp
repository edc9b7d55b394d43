// SPDX-License-Identifier: MIT
#include "narrowphase/held_face.h"

#include <gtest/gtest.h>

#include <limits>

#include "narrowphase/face.h"
#include "narrowphase/relative.h"
#include "random_shapes.h"

namespace throng::narrowphase {
namespace {

const Convex kSquare = convex({{-0.5, -0.5}, {0.5, -0.5}, {0.5, 0.5}, {-0.5, 0.5}});

HeldFace hold_at(const Convex& a, const Convex& b, const Pose& b_in_a, double reach) {
  return hold(a, b, b_in_a, manifold(a, {}, b, b_in_a, reach));
}

// Their sides overlap by 0.75 where the faces between them do by 0.01: half of the difference.
TEST(HeldFace, OfTwoSquaresHoldsUntilTheirSidesCouldBeAsWide) {
  const HeldFace held = hold_at(kSquare, kSquare, {Vec(0.25, 0.99)}, 0.1);
  ASSERT_EQ(held.kind, HeldFace::Kind::face);
  EXPECT_FALSE(held.of_b);
  EXPECT_EQ(held.reference, 2u) << "the upper edge of the lower square";
  EXPECT_EQ(held.incident, 0u) << "the lower edge of the upper one";
  EXPECT_NEAR(held.most, 0.37, 1e-9);
  EXPECT_NEAR(held.lever, std::sqrt(2.0) + std::hypot(0.25, 0.99), 1e-12);
}

TEST(HeldFace, OfTwoSquaresApartSaysHowFar) {
  const HeldFace held = hold_at(kSquare, kSquare, {Vec(0.25, 1.5)}, 0.1);
  ASSERT_EQ(held.kind, HeldFace::Kind::apart);
  EXPECT_NEAR(held.most, 0.5, 1e-9);
}

TEST(HeldFace, HoldsNothingOfCornersAndWalls) {
  const Pose beyond{Vec(1.04, 1.03)};
  ASSERT_EQ(manifold(kSquare, {}, kSquare, beyond, 0.1).count, 1);
  EXPECT_EQ(hold_at(kSquare, kSquare, beyond, 0.1).kind, HeldFace::Kind::none);
  const Convex wall = segment({-5.0, 0.0}, {5.0, 0.0});
  EXPECT_EQ(hold_at(wall, kSquare, {Vec(0.0, 0.49)}, 0.1).kind, HeldFace::Kind::none);
}

TEST(HeldFace, MovementIsThatOfTheFarthestVertex) {
  HeldFace held;
  held.lever = 2.0;
  EXPECT_DOUBLE_EQ(movement(held, {Vec(3.0, 4.0)}), 5.0);
  EXPECT_DOUBLE_EQ(movement(held, {Vec(0.0, 0.0), 0.0, 1.0}), 2.0 * std::sqrt(2.0));
}

/// Whether all that a held face promises is so at that pose.
bool holds(const HeldFace& held, const Convex& a, const Convex& b, const Pose& b_in_a) {
  const Convex &reference = held.of_b ? b : a, &other = held.of_b ? a : b;
  const Pose other_in_reference = held.of_b ? inverse(b_in_a) : b_in_a;
  const Pose reference_in_other = inverse(other_in_reference);
  const Face face = face_at(reference, held.reference, other, other_in_reference);
  const Vec normal = other_in_reference.unrotate(reference.normals[held.reference]);
  bool widest = true;
  for (std::size_t e = 0; e < reference.normals.size(); ++e)
    if (e != held.reference)
      widest &= face_at(reference, e, other, other_in_reference).separation < face.separation;
  for (std::size_t e = 0; e < other.normals.size(); ++e)
    if (e != held.incident)
      widest &= face_at(other, e, reference, reference_in_other).separation < face.separation;
  const bool ends = face.vertex == held.incident || face.vertex == next(held.incident, other.vertices.size());
  return widest && ends && incident_edge(other, face.vertex, normal) == held.incident;
}

Convex random_polygon(Random& random) {
  std::vector<Vec> points;
  for (std::uint64_t n = 4 + random() % 9; n > 0; --n) points.push_back(random_vec(random, 1.0, 1.0));
  return convex(hull(points), random() % 3 == 0 ? 0.1 : 0.0);
}

TEST(HeldFace, IsTrueAsLongAsNothingMovesFarther) {
  Random random(2311);
  int faces = 0, apart = 0, within = 0, broken = 0;
  for (int i = 0; i < 20'000; ++i) {
    SCOPED_TRACE(i);
    const Convex a = random_polygon(random), b = random_polygon(random);
    const Pose first = pose(random_vec(random, 1.5, 1.5), uniform(random, -3.0, 3.0));
    const double angle = std::atan2(first.sin, first.cos);
    const HeldFace held = hold_at(a, b, first, 0.2);
    if (held.kind == HeldFace::Kind::none) continue;
    ++(held.kind == HeldFace::Kind::face ? faces : apart);
    const double step = held.most * uniform(random, 0.0, 3.0), turn = uniform(random, -1.0, 1.0);
    const Pose then =
        pose(first.position + step * random_vec(random, 1.0, 1.0), angle + turn * step / held.lever);
    const bool near = movement(held, then) <= held.most;
    within += near;
    if (held.kind == HeldFace::Kind::face) {
      const bool is_so = holds(held, a, b, then);
      broken += !is_so;
      EXPECT_TRUE(is_so || !near);
    } else {
      const double widest = widest_faces(a, b, then, inverse(then)).widest().separation;
      EXPECT_GT(widest, held.most - movement(held, then) - kHeldRounding * held.lever);
    }
  }
  EXPECT_GT(faces, 5'000);
  EXPECT_GT(apart, 2'000);
  EXPECT_GT(within, 5'000);
  EXPECT_GT(broken, 500) << "what moved farther seldom changed anything: the bound is loose";
}

}  // namespace
}  // namespace throng::narrowphase
