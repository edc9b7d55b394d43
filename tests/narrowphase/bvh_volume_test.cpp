// SPDX-License-Identifier: MIT
#include "narrowphase/bvh_volume.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "narrowphase/bvh_fit.h"
#include "random_shapes.h"

namespace throng::narrowphase {
namespace {

template <int kDim>
Point<kDim> random_point(Random& random, double size) {
  Point<kDim> p;
  for (int i = 0; i < kDim; ++i) p[i] = uniform(random, -size, size);
  return p;
}

Rotation<2> random_turn(Random& random, const Rotation<2>&) {
  const Pose p = pose({0, 0}, uniform(random, -4, 4));
  Rotation<2> turn;
  turn << p.cos, -p.sin, p.sin, p.cos;
  return turn;
}

/// A quarter of them along the axes, where edges are parallel.
Rotation<3> random_turn(Random& random, const Rotation<3>&) {
  if (random() % 4 == 0) return Rotation<3>::Identity();
  const auto axis = random_point<3>(random, 1.0).normalized();
  return Eigen::AngleAxisd(uniform(random, -3, 3), axis).toRotationMatrix();
}

template <int kDim>
Points<kDim> random_points(Random& random) {
  const double scale = std::pow(10.0, uniform(random, -6, 6));
  const Point<kDim> at = random_point<kDim>(random, random() % 4 == 0 ? 1e6 * scale : scale);
  Point<kDim> sides;
  for (int i = 0; i < kDim; ++i) sides[i] = random() % 5 == 0 ? 0.0 : scale * uniform(random, 0.01, 1.0);
  const Rotation<kDim> turn = random_turn(random, Rotation<kDim>());
  Points<kDim> points;
  for (std::size_t i = 0, count = 1 + random() % 12; i < count; ++i)
    points.push_back(turn * random_point<kDim>(random, 1.0).cwiseProduct(sides) + at);
  return points;
}

/// A point of the volume that has been fitted.
template <class Volume, int kDim = Volume::kDimension>
Point<kDim> sample(Random& random, const Volume& volume) {
  const Point<kDim> p = random_point<kDim>(random, 1.0);
  if constexpr (requires { volume.axes.norm() + volume.radius; }) {
    const Point<kDim> off = volume.axes * p.cwiseProduct(volume.half);
    return volume.centre + off * std::min(1.0, volume.radius / (1e-300 + off.norm()));
  } else if constexpr (requires { volume.axes; })
    return volume.centre + volume.axes * p.cwiseProduct(volume.half);
  else if constexpr (requires { volume.half; })
    return volume.centre + p.cwiseProduct(volume.half);
  else
    return volume.centre + p * (volume.radius / std::max(1.0, p.norm()));
}

template <class Volume>
Volume around(Points<Volume::kDimension> points) {
  Volume volume;
  reduce_to_hull<Volume::kDimension>(points);
  enclose(points, volume);
  return volume;
}

template <class Volume>
class BoundingVolume : public ::testing::Test {};
using AllVolumes = ::testing::Types<Ball<2>, Box<2>, OrientedBox<2>, BoxAndBall<2>, Ball<3>, Box<3>,
                                    OrientedBox<3>, BoxAndBall<3>>;
TYPED_TEST_SUITE(BoundingVolume, AllVolumes);

TYPED_TEST(BoundingVolume, HoldsThePointsThatItWasFittedTo) {
  constexpr int kDim = TypeParam::kDimension;
  Random random(20261121);
  for (int trial = 0; trial < 3000; ++trial) {
    const Points<kDim> points = random_points<kDim>(random);
    const TypeParam volume = around<TypeParam>(points);
    double reach = 0.0;
    for (const auto& p : points) reach = std::max(reach, p.template lpNorm<1>());
    for (const auto& p : points) {
      EXPECT_LE(std::sqrt(squared_bound(volume, p)), 0x1p-47 * reach) << trial;
      EXPECT_LE((p - volume.centre).norm(), radius(volume) + 0x1p-47 * reach) << trial;
    }
  }
}

/// Two volumes of points in random places: samples of both are never nearer than the bound says.
TYPED_TEST(BoundingVolume, IsNeverFartherAwayThanWhatItHolds) {
  constexpr int kDim = TypeParam::kDimension;
  Random random(4);
  int parted = 0, tight = 0;
  for (int trial = 0; trial < 3000; ++trial) {
    Points<kDim> of_a = random_points<kDim>(random);
    const TypeParam a = around<TypeParam>(of_a);
    const Rotation<kDim> turn = random_turn(random, Rotation<kDim>());
    const double size = 1e-300 + radius(a);
    Points<kDim> of_b;
    for (const auto& p : of_a) of_b.push_back(p + random_point<kDim>(random, 0.3 * size));
    const TypeParam b = around<TypeParam>(of_b);
    const Point<kDim> shift =
        a.centre - turn * b.centre + uniform(random, 0.0, 3.0) * random_point<kDim>(random, size);
    const Frame<kDim> place =
        frame<kDim>(turn, shift, a.centre.template lpNorm<1>() + b.centre.template lpNorm<1>() + 9 * size);
    const double least = bound(a, b, place);
    double nearest = std::numeric_limits<double>::infinity();
    for (int i = 0; i < 60; ++i) {
      const Point<kDim> p = sample(random, a);
      for (int j = 0; j < 4; ++j) nearest = std::min(nearest, (turn * sample(random, b) + shift - p).norm());
    }
    EXPECT_LE(least, nearest) << trial;
    EXPECT_TRUE(least <= 0.0 || apart(a, b, place)) << trial;
    const double enough = uniform(random, -1.0, 2.0) * size, quick = bound(a, b, place, enough);
    EXPECT_TRUE(quick == least || (quick >= enough && quick <= nearest)) << trial;
    EXPECT_TRUE(least < enough || quick >= enough) << trial;
    parted += least > 0.0;
    tight += least > 0.5 * nearest;
  }
  EXPECT_GT(parted, 400);
  EXPECT_LT(parted, 2700);
  EXPECT_GT(tight, 100);
}

/// Points that both hold: the same sample, seen from both. No axis may part them.
TYPED_TEST(BoundingVolume, IsNeverApartFromOneThatSharesAPointWithIt) {
  constexpr int kDim = TypeParam::kDimension;
  Random random(5);
  for (int trial = 0; trial < 20000; ++trial) {
    const TypeParam a = around<TypeParam>(random_points<kDim>(random));
    TypeParam b = a;
    if (trial % 3 != 0) b = around<TypeParam>(random_points<kDim>(random));
    const Rotation<kDim> turn = random_turn(random, Rotation<kDim>());
    const Point<kDim> shared = sample(random, a);
    const Point<kDim> shift = shared - turn * sample(random, b);
    const Frame<kDim> place = frame<kDim>(
        turn, shift,
        a.centre.template lpNorm<1>() + b.centre.template lpNorm<1>() + kDim * (radius(a) + radius(b)));
    EXPECT_FALSE(apart(a, b, place)) << trial;
    EXPECT_LE(bound(a, b, place), 0.0) << trial;
  }
}

TYPED_TEST(BoundingVolume, StandsInABoxWhereverItIsPlaced) {
  constexpr int kDim = TypeParam::kDimension;
  Random random(6);
  for (int trial = 0; trial < 5000; ++trial) {
    const TypeParam volume = around<TypeParam>(random_points<kDim>(random));
    const Rotation<kDim> turn = random_turn(random, Rotation<kDim>());
    const Point<kDim> shift = random_point<kDim>(random, 3.0);
    const Frame<kDim> place =
        frame<kDim>(turn, shift, volume.centre.template lpNorm<1>() + 3 * radius(volume));
    const Box<kDim> box = bounds(volume, place);
    const Point<kDim> p = turn * sample(random, volume) + shift;
    EXPECT_LE(((p - box.centre).cwiseAbs() - box.half).maxCoeff(), 0.0) << trial;
  }
}

Frame<2> turned(double angle, const Vec& shift) {
  return frame(pose(shift, angle), 10.0);
}

TEST(BoundingVolumes, AreAsFarApartAsOnPaper) {
  const Ball<2> disc{{0, 0}, 1.0};
  EXPECT_NEAR(bound(disc, disc, turned(1.0, {3, 4})), 3.0, 1e-12);
  const Box<2> square{{0, 0}, {1, 1}};
  EXPECT_NEAR(bound(square, square, turned(0.0, {5, 6})), 5.0, 1e-12);  // corners: 3, 4
  EXPECT_NEAR(bound(square, square, turned(0.25 * std::numbers::pi, {4, 0})), 3 - std::sqrt(2.0), 1e-12);
  EXPECT_NEAR(bound(square, square, turned(0.0, {1.5, 0})), -0.5, 1e-12);
  EXPECT_FALSE(apart(square, square, turned(0.0, {2, 2})));                         // corners touch
  EXPECT_TRUE(apart(square, square, turned(0.25 * std::numbers::pi, {1.8, 1.8})));  // only b's axes show it
}

/// Two long boxes across each other, one above the other: only the axis across both edges parts them.
TEST(BoundingVolumes, InSpaceAreApartAcrossTheirEdges) {
  const OrientedBox<3> bar{{0, 0, 0}, {5, 1, 1}, Rotation<3>::Identity()};
  const Rotation<3> on_edge =
      Eigen::AngleAxisd(0.25 * std::numbers::pi, Eigen::Vector3d::UnitX()).toRotationMatrix();
  const Rotation<3> across =
      Eigen::AngleAxisd(0.5 * std::numbers::pi, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  const OrientedBox<3> a{{0, 0, 0}, bar.half, on_edge}, b{{0, 0, 0}, bar.half, across * on_edge};
  const auto above = [](double z) { return frame<3>(Rotation<3>::Identity(), {0, 0, z}, 20.0); };
  EXPECT_TRUE(apart(a, b, above(2 * std::sqrt(2.0) + 1e-9)));
  EXPECT_FALSE(apart(a, b, above(2 * std::sqrt(2.0) - 1e-9)));
  EXPECT_LE(bound(a, b, above(2.83)), 2.83 - 2 * std::sqrt(2.0));
}

TEST(OrientedBoxes, OfARectanglesCornersAreTheRectangle) {
  for (const double angle : {0.0, 0.3, 1.234567, -2.0}) {
    const Pose p = pose({3, -2}, angle);
    Points<2> corners{p * Vec(2, 1), p * Vec(-2, 1), p * Vec(2, -1), p * Vec(-2, -1), p * Vec(0.5, 0.2)};
    OrientedBox<2> box;
    reduce_to_hull<2>(corners);
    EXPECT_EQ(corners.size(), 4u);
    enclose(corners, box);
    EXPECT_NEAR(box.half.x() * box.half.y(), 2.0, 1e-12);
    EXPECT_NEAR((box.centre - p.position).norm(), 0.0, 1e-12);
    enclose_by_svd(corners, box);
    EXPECT_NEAR(box.half.x() * box.half.y(), 2.0, 1e-12);
  }
}

/// The least of the rectangles along the hull's edges, each measured over all points.
TEST(OrientedBoxes, InThePlaneHaveTheLeastAreaOfAll) {
  Random random(7);
  for (int trial = 0; trial < 2000; ++trial) {
    Points<2> points;
    for (std::size_t i = 0, count = 3 + random() % 40; i < count; ++i)
      points.push_back(random_vec(random, 2, 1));
    reduce_to_hull<2>(points);
    double least = 1e300;
    for (std::size_t i = 0; i < points.size(); ++i) {
      const Vec x = (points[(i + 1) % points.size()] - points[i]).normalized(), y{-x.y(), x.x()};
      double low_x = 1e300, high_x = -1e300, low_y = 1e300, high_y = -1e300;
      for (const Vec& p : points) {
        low_x = std::min(low_x, p.dot(x)), high_x = std::max(high_x, p.dot(x));
        low_y = std::min(low_y, p.dot(y)), high_y = std::max(high_y, p.dot(y));
      }
      least = std::min(least, (high_x - low_x) * (high_y - low_y));
    }
    OrientedBox<2> box, by_svd;
    enclose(points, box);
    enclose_by_svd(points, by_svd);
    EXPECT_NEAR(4 * box.half.prod(), least, 1e-12);
    EXPECT_GE(by_svd.half.prod(), box.half.prod() - 1e-12);
  }
}

TEST(Discs, AroundPointsAreHardlyLargerThanTheLeast) {
  Random random(8);
  for (int trial = 0; trial < 2000; ++trial) {
    Points<2> points{{1, 0}, {-0.5, std::sqrt(0.75)}, {-0.5, -std::sqrt(0.75)}};  // on the unit circle
    for (int i = 0; i < 20; ++i) points.push_back(random_vec(random, 0.7, 0.7));
    for (Vec& p : points) p += Vec(trial, 0.0);
    Ball<2> disc;
    enclose(points, disc);
    EXPECT_GE(disc.radius, 1.0 - 1e-12);
    EXPECT_LE(disc.radius, 1.09);
  }
}

}  // namespace
}  // namespace throng::narrowphase
