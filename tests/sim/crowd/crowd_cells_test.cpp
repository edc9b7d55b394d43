// SPDX-License-Identifier: MIT
#include "sim/crowd/crowd_cells.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace throng {
namespace {

/// How often each row is in what is found round `p`.
std::vector<int> found(const CrowdCells& cells, std::size_t n, const Vec& p, double reach) {
  std::vector<int> times(n, 0);
  cells.for_each_stretch(p, reach, [&](std::size_t first, std::size_t end) {
    for (std::size_t place = first; place < end; ++place) ++times[cells.row()[place]];
  });
  return times;
}

/// All who are computed to be within reach of one are found, each once. Returns how many were found, and how
/// many are within reach.
std::pair<int, int> expect_all_near(const std::vector<Vec>& position, double reach) {
  CrowdCells cells;
  cells.sort(position, reach);
  int all = 0, near = 0;
  for (const Vec& p : position) {
    const std::vector<int> times = found(cells, position.size(), p, reach);
    for (std::size_t row = 0; row < position.size(); ++row) {
      const bool is_near = (position[row] - p).squaredNorm() <= reach * reach;
      EXPECT_LE(times[row], 1);
      EXPECT_TRUE(times[row] == 1 || !is_near) << position[row].transpose() << " from " << p.transpose();
      all += times[row], near += is_near;
    }
  }
  return {all, near};
}

std::vector<Vec> crowd(std::uint64_t seed, std::size_t n, const Vec& low, const Vec& size) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> part(0.0, 1.0);
  std::vector<Vec> position;
  for (std::size_t i = 0; i < n; ++i) {
    const double x = part(random);
    position.push_back(low + Vec(x * size.x(), part(random) * size.y()));
  }
  return position;
}

TEST(CrowdCells, HoldAllWhoAreWithinReachAndFewOthers) {
  const auto [all, near] = expect_all_near(crowd(1, 600, Vec(-7.0, -9.0), Vec(25.0, 25.0)), 2.0);
  EXPECT_LT(all, 3 * near);
}

TEST(CrowdCells, HoldAllWhereTheyAreFew) {
  const auto [all, near] = expect_all_near(crowd(2, 300, Vec(-5e3, 1e4), Vec(1e4, 2e4)), 1.0);
  EXPECT_LT(all, 20 * 300) << "some cells round each, of about one agent each";
  EXPECT_GE(near, 300) << "each one itself";
}

TEST(CrowdCells, HoldAllInALine) {
  expect_all_near(crowd(3, 300, Vec(3.0, -1e3), Vec(0.0, 2e3)), 5.0);
  expect_all_near(crowd(4, 300, Vec(-1e3, 3.0), Vec(2e3, 0.0)), 5.0);
  expect_all_near({Vec(1.0, 1.0), Vec(1.0, 1.0)}, 0.5);
}

/// Rounded, two are just 1 apart, though farther in truth. Where the cells begin is moved ulp by ulp, until a
/// border of theirs is between the one and where the other's reach ends.
TEST(CrowdCells, HoldThoseWhomRoundingBringsWithinReach) {
  constexpr double kUlp = 0x1p-53, kBefore = 1.0 - kUlp;
  for (const Vec& way : {Vec(1.0, 0.0), Vec(0.0, 1.0)})
    for (const double border : {0.25, 0.5, 1.0, 2.0})
      for (int i = -200; i < 200; ++i) {
        const double begin = 1.0 - border + i * kUlp;
        const auto [all, near] = expect_all_near({begin * way, kBefore * way, 2.0 * way}, 1.0);
        ASSERT_GE(near, 5);
        if (HasFailure()) return;
      }
}

TEST(CrowdCells, OrderThoseOfACellByIdOrElseByRow) {
  const std::vector<Vec> position{Vec(0.1, 0.1), Vec(9.0, 9.0), Vec(0.1, 0.2), Vec(0.1, 0.3)};
  CrowdCells cells;
  cells.sort(position, 2.0);
  EXPECT_EQ(std::vector<std::uint32_t>(cells.row().begin(), cells.row().end()),
            (std::vector<std::uint32_t>{0, 2, 3, 1}));
  const std::vector<std::uint32_t> id{7, 1, 9, 3};
  cells.sort(position, 2.0, id);
  EXPECT_EQ(std::vector<std::uint32_t>(cells.row().begin(), cells.row().end()),
            (std::vector<std::uint32_t>{3, 0, 2, 1}));
}

}  // namespace
}  // namespace throng
