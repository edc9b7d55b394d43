// SPDX-License-Identifier: MIT
#include "sim/straight_runs.h"

#include <gtest/gtest.h>

#include <cmath>

namespace throng {
namespace {

Wall wall(std::vector<Vec> points, bool closed = false, std::uint32_t material = 0) {
  return {std::move(points), closed, material};
}

std::vector<std::pair<Vec, Vec>> ends(const std::vector<StraightRun>& runs) {
  std::vector<std::pair<Vec, Vec>> result;
  for (const StraightRun& run : runs) result.emplace_back(run.from, run.to);
  return result;
}

using Ends = std::vector<std::pair<Vec, Vec>>;

TEST(StraightRuns, LeaveOutPointsAlongALine) {
  const std::vector<Wall> walls = {wall({{0, 0}, {1, 0}, {2, 0}, {2, 1}, {2, 3}, {4, 5}})};
  EXPECT_EQ(ends(straight_runs(walls)), (Ends{{{0, 0}, {2, 0}}, {{2, 0}, {2, 3}}, {{2, 3}, {4, 5}}}));
}

TEST(StraightRuns, FollowALineThatIsStraightButForRounding) {
  std::vector<Vec> points;
  for (int i = 0; i <= 1000; ++i)
    points.emplace_back(7 + 0.1 * i * std::cos(0.3), -3 + 0.1 * i * std::sin(0.3));
  const std::vector<Wall> walls = {wall(points)};
  EXPECT_EQ(ends(straight_runs(walls)), (Ends{{points.front(), points.back()}}));
}

TEST(StraightRuns, KeepABendThatIsMoreThanRounding) {
  const std::vector<Wall> walls = {wall({{0, 0}, {1, 1e-12}, {2, 0}})};
  EXPECT_EQ(straight_runs(walls).size(), 2u);
}

TEST(StraightRuns, KeepAnArcOfTinyTurns) {
  std::vector<Vec> points;
  for (int i = 0; i <= 1000; ++i) points.emplace_back(std::cos(1e-3 * i), std::sin(1e-3 * i));
  const std::vector<Wall> walls = {wall(points)};
  EXPECT_EQ(straight_runs(walls).size(), 1000u);
}

TEST(StraightRuns, LeaveOutWhatStandsTwice) {
  const std::vector<Wall> back = {wall({{0, 0}, {3, 0}, {1, 0}})};
  EXPECT_EQ(ends(straight_runs(back)), (Ends{{{0, 0}, {3, 0}}}));
  const std::vector<Wall> overlapping = {wall({{0, 0}, {3, 0}}), wall({{4, 0}, {2, 0}})};
  EXPECT_EQ(ends(straight_runs(overlapping)), (Ends{{{0, 0}, {4, 0}}}));
  const std::vector<Wall> of_two = {wall({{0, 0}, {3, 0}}), wall({{0, 0}, {3, 0}}, false, 1)};
  EXPECT_EQ(straight_runs(of_two).size(), 2u) << "of different materials";
}

TEST(StraightRuns, GoOnFromWallToWallOfOneMaterial) {
  const std::vector<Wall> walls = {wall({{2, 0}, {1, 0}}), wall({{0, 0}, {1, 0}}), wall({{2, 0}, {3, 0}}),
                                   wall({{3, 0}, {4, 0}}, false, 1)};
  const std::vector<StraightRun> runs = straight_runs(walls);
  EXPECT_EQ(ends(runs), (Ends{{{3, 0}, {0, 0}}, {{3, 0}, {4, 0}}}));
  EXPECT_EQ(runs[1].material, 1u);
}

TEST(StraightRuns, StopWhereAThirdWallStands) {
  const std::vector<Wall> walls = {wall({{0, 0}, {1, 0}, {2, 0}}), wall({{1, 0}, {1, 5}})};
  EXPECT_EQ(ends(straight_runs(walls)), (Ends{{{0, 0}, {1, 0}}, {{1, 0}, {2, 0}}, {{1, 0}, {1, 5}}}));
}

TEST(StraightRuns, AreCutWhereAWallEndsOnAnother) {
  const std::vector<Wall> walls = {wall({{0, 0}, {9, 3}}), wall({{3, 1}, {3, 5}})};
  EXPECT_EQ(ends(straight_runs(walls)), (Ends{{{0, 0}, {3, 1}}, {{3, 1}, {9, 3}}, {{3, 1}, {3, 5}}}));
}

TEST(StraightRuns, CloseARing) {
  const std::vector<Wall> walls = {wall({{0, 0}, {1, 0}, {2, 0}, {2, 2}, {0, 2}}, true)};
  EXPECT_EQ(ends(straight_runs(walls)),
            (Ends{{{0, 0}, {2, 0}}, {{2, 0}, {2, 2}}, {{2, 2}, {0, 2}}, {{0, 2}, {0, 0}}}));
}

}  // namespace
}  // namespace throng
