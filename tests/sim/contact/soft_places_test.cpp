// SPDX-License-Identifier: MIT
#include "sim/contact/soft_places.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace throng {
namespace {

/// A square lattice of n² points whose rows jump about.
std::vector<Vec> lattice(std::size_t n) {
  std::vector<Vec> points(n * n);
  for (std::size_t i = 0; i < n * n; ++i) {
    const std::size_t row = i * 7919 % (n * n);
    points[row] = {static_cast<double>(i % n), static_cast<double>(i / n)};
  }
  return points;
}

TEST(SoftPlaces, AreTheRowsWhereBodiesAreFew) {
  SoftPlaces places;
  for (const std::size_t n : {30, 40, 20}) {
    places.sort(lattice(n));
    ASSERT_EQ(places.size(), n * n + 1);
    for (std::uint32_t i = 0; i <= n * n; ++i) {
      ASSERT_EQ(places.place(i), i);
      ASSERT_EQ(places.row(i), i);
    }
  }
}

TEST(SoftPlaces, AreAtMostTwoStripsApartForBodiesThatTouchAndEachHasOne) {
  SoftPlaces places;
  std::vector<Vec> points = lattice(60);
  for (const bool upright : {false, true}) {
    for (Vec& point : points) point = upright ? Vec(point.y(), point.x()) : Vec(point.x(), 2.0 * point.y());
    places.sort(points);
    ASSERT_EQ(places.size(), points.size() + 1);
    for (std::uint32_t row = 0; row < places.size(); ++row) ASSERT_EQ(places.row(places.place(row)), row);
    EXPECT_EQ(places.place(3600), 3600u) << "obstacles come last";
    std::uint32_t farthest = 0, touching = 0;
    for (std::uint32_t a = 0; a < 3600; ++a)
      for (std::uint32_t b = 0; b < a; ++b) {
        if ((points[a] - points[b]).norm() > 2.3) continue;
        const std::uint32_t one = places.place(a), other = places.place(b);
        farthest = std::max(farthest, std::max(one, other) - std::min(one, other)), ++touching;
      }
    EXPECT_GT(touching, 3000u);
    EXPECT_LT(farthest, 130u) << "a strip holds sixty";
  }
}

TEST(SoftPlaces, AreThereWhereBodiesStandInALineOrInOnePlace) {
  SoftPlaces places;
  for (const Vec& step : {Vec(1, 0), Vec(0, -1e6), Vec(0, 0)}) {
    std::vector<Vec> points;
    for (int i = 0; i < 2500; ++i) points.push_back(Vec(3, 4) + i * step);
    places.sort(points);
    for (std::uint32_t row = 0; row < 2500; ++row) {
      ASSERT_EQ(places.row(places.place(row)), row);
      ASSERT_NEAR(places.place(row), step.y() < 0.0 ? 2499 - row : row, 1) << "two in a strip, at most";
    }
  }
}

TEST(SoftPlaces, BecomeTheRowsAgainWhereBodiesGotFew) {
  SoftPlaces places;
  places.sort(lattice(60));
  places.sort(lattice(30));
  for (std::uint32_t i = 0; i <= 900; ++i) ASSERT_EQ(places.row(i), i);
}

}  // namespace
}  // namespace throng
