// SPDX-License-Identifier: MIT
#include "sim/contact/soft_places.h"

#include <gtest/gtest.h>

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

TEST(SoftPlaces, AreNearForBodiesThatAreAndEachHasOne) {
  SoftPlaces places;
  const std::vector<Vec> points = lattice(60);
  places.sort(points);
  ASSERT_EQ(places.size(), points.size() + 1);
  for (std::uint32_t row = 0; row < places.size(); ++row) ASSERT_EQ(places.row(places.place(row)), row);
  EXPECT_EQ(places.place(3600), 3600u) << "obstacles come last";
  double way = 0.0;
  for (std::uint32_t place = 1; place < 3600; ++place)
    way += (points[places.row(place)] - points[places.row(place - 1)]).norm();
  EXPECT_LT(way / 3599, 1.2) << "from each to the next, in spacings";
}

TEST(SoftPlaces, BecomeTheRowsAgainWhereBodiesGotFew) {
  SoftPlaces places;
  places.sort(lattice(60));
  places.sort(lattice(30));
  for (std::uint32_t i = 0; i <= 900; ++i) ASSERT_EQ(places.row(i), i);
}

}  // namespace
}  // namespace throng
