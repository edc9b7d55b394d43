// SPDX-License-Identifier: MIT
#include "sim/crowd/sampler.h"

#include <gtest/gtest.h>

#include <array>

#include "sim/crowd/standing.h"

namespace throng {
namespace {

TEST(Sampler, FindsPlacesInARegionThatFillsLittleOfItsBox) {
  // a frame 100 m wide and 1 m thick: 4 % of its box
  const Region frame{{{{0, 0}, {100, 0}, {100, 100}, {0, 100}}, {{1, 1}, {1, 99}, {99, 99}, {99, 1}}}};
  const Sampler sampler(frame, 0.3);
  Random random(1, 0, 1, Purpose::place);
  int held = 0;
  std::array<int, 4> sides{};
  for (int i = 0; i < 4000; ++i) {
    const Vec p = sampler.draw(random);
    if (!sampler.holds(p, 0.3)) continue;
    ++held;
    EXPECT_GE(nearest_on_border(frame, p).x(), 0.0);
    EXPECT_GE((nearest_on_border(frame, p) - p).norm(), 0.3);
    ++sides[p.y() < 1 ? 0 : p.y() > 99 ? 1 : p.x() < 1 ? 2 : 3];
  }
  EXPECT_GT(held, 500) << "0.4 of 1 m across can be taken: of the box that were 1.6 %";
  for (const int side : sides) EXPECT_NEAR(side, held / 4.0, 0.2 * held) << "uniformly";
}

TEST(Sampler, IsUniform) {
  const Region square{{{{0, 0}, {10, 0}, {10, 10}, {0, 10}}}};
  const Sampler sampler(square, 0.0);
  Random random(2, 0, 1, Purpose::place);
  std::array<int, 100> cells{};
  for (int i = 0; i < 100'000; ++i) {
    const Vec p = sampler.draw(random);
    ASSERT_TRUE(p.x() >= 0 && p.x() <= 10 && p.y() >= 0 && p.y() <= 10);
    ++cells[std::min(9, static_cast<int>(p.y())) * 10 + std::min(9, static_cast<int>(p.x()))];
  }
  double chi2 = 0.0;
  for (const int n : cells) chi2 += (n - 1000.0) * (n - 1000.0) / 1000.0;
  EXPECT_LT(chi2, 148.2) << "99.9 % of what is uniform is below, of 99 degrees of freedom";
}

TEST(Sampler, IsEmptyWhereNoDiscFits) {
  const Region sliver{{{{0, 0}, {10, 0}, {10, 0.3}, {0, 0.3}}}};
  EXPECT_TRUE(Sampler(sliver, 0.5).empty());
  EXPECT_FALSE(Sampler(sliver, 0.1).empty());
}

TEST(Standing, KnowsWhomADiscWouldOverlapHoweverManyThereAre) {
  Standing standing;
  std::vector<Vec> centre;
  std::vector<double> radius;
  Random random(3, 0, 1, Purpose::place);
  int met = 0;
  for (int i = 0; i < 3000; ++i) {
    const double x = random.uniform(-20, 20);
    const Vec p(x, random.uniform(-20, 20));
    const double r = random.uniform(0.05, 0.4);
    bool meets = false;
    for (std::size_t k = 0; k < centre.size(); ++k) meets = meets || (p - centre[k]).norm() < r + radius[k];
    ASSERT_EQ(standing.meets(p, r), meets) << i;
    met += meets;
    if (meets && i % 3 != 0) continue;
    standing.add(p, r), centre.push_back(p), radius.push_back(r);
  }
  EXPECT_TRUE(met > 900 && met < 2500) << met;
  standing.clear();
  EXPECT_FALSE(standing.meets(centre[0], 1.0));
}

TEST(Standing, SaysWhomADiscWouldOverlapUntilOneCounts) {
  for (const int others : {0, 1000}) {  // few are looked at one by one, many in a grid
    SCOPED_TRACE(others);
    Standing standing;
    standing.add({0, 0}, 0.2), standing.add({1, 0}, 0.2);
    for (int i = 0; i < others; ++i) standing.add({i % 50, 10 + i / 50}, 0.2);
    std::vector<double> met;
    const auto is_right = [&](const Vec& centre) {
      met.push_back(centre.x());
      return centre.x() > 0.5;
    };
    EXPECT_FALSE(standing.meets({0.3, 0}, 0.2, is_right));
    EXPECT_EQ(met, std::vector<double>{0});
    EXPECT_TRUE(standing.meets({0.5, 0}, 0.4, is_right));
    EXPECT_EQ(met, (std::vector<double>{0, 0, 1}));
  }
}

}  // namespace
}  // namespace throng
