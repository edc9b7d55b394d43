// SPDX-License-Identifier: MIT
#include "broadphase/disc_pairs.h"

#include <gmock/gmock.h>

#include "broadphase/brute_force.h"
#include "tests/broadphase/clouds.h"

namespace throng::broadphase {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using Pairs = std::vector<Pair>;
using Reaches = std::vector<double>;

Pairs disc_pairs(const Points& centres, const Reaches& reach, const Period* period = nullptr) {
  Pairs pairs{{7, 7}};
  DiscPairs().find(centres, reach, period, pairs);
  return pairs;
}

TEST(DiscPairs, FindsThePairsThatPaperFinds) {
  // A large disc at the origin touches a small one at 11 exactly, and not the one at 11.5; the small ones
  // touch.
  EXPECT_THAT(disc_pairs({{11, 0}, {0, 0}, {11.5, 0}}, {1.0, 10.0, 1.0}),
              ElementsAre(Pair{0, 1}, Pair{0, 2}));
}

TEST(DiscPairs, FindsNothingAmongNoneOrOne) {
  EXPECT_THAT(disc_pairs({}, {}), IsEmpty());
  EXPECT_THAT(disc_pairs({{1, 2}}, {3.0}), IsEmpty());
}

TEST(DiscPairs, FindsCoincidentPointsOfNoSize) {
  EXPECT_THAT(disc_pairs({{1, 2}, {1, 3}, {1, 2}}, {0.0, 0.0, 0.0}), ElementsAre(Pair{0, 2}));
  EXPECT_THAT(disc_pairs({{1, 2}, {1, 3}, {1, 2}}, {0.0, 1.0, 0.0}),
              ElementsAre(Pair{0, 1}, Pair{0, 2}, Pair{1, 2}));
}

TEST(DiscPairs, TellsSizesApartBeyondAllPowersOfTwo) {
  const Reaches reach{1e9, 1e-9, 1e-30, 0.0, 5e-324, 1e-9};
  const Points centres{{0, 0}, {1e9, 0}, {0, 0}, {0, 1}, {0, 1}, {1e9, 0}};
  EXPECT_EQ(disc_pairs(centres, reach), brute_force::pairs(centres, reach));
}

/// Reaches of which the largest is `ratio` times the smallest, as many of each power of two.
Reaches mixed(Random& random, std::size_t n, double largest, double ratio) {
  Reaches reach;
  const int octaves = std::ilogb(ratio) + 1;
  for (std::size_t i = 0; i < n; ++i) {
    const double top =
        std::ldexp(largest, -static_cast<int>(random.below(static_cast<std::size_t>(octaves))));
    reach.push_back(i % 16 == 7 ? top : std::max(largest / ratio, top * random.between(0.5, 1.0)));
  }
  return reach;
}

TEST(DiscPairs, AgreesWithTheDefinitionForEveryMixOfSizes) {
  const std::uint64_t seed = 4711;
  SCOPED_TRACE("seed " + std::to_string(seed));
  Random random(seed);
  double near = 0.0, all = 0.0;
  for (const double ratio : {1.0, 1.6, 2.0, 3.0, 5.0, 30.0, 1000.0, 1e7}) {
    for (int round = 0; round < 40; ++round) {
      const std::size_t n = 2 + random.below(200);
      const double side = random.between(4.0, 20.0);
      const Period torus{{0, 0}, {side, side}};
      const Period* period = round % 2 ? &torus : nullptr;
      const Points centres = cloud(random, n, side);
      const Reaches reach = mixed(random, n, random.between(0.05, 0.25) * side, ratio);
      const Pairs pairs = disc_pairs(centres, reach, period);
      EXPECT_EQ(pairs, brute_force::pairs(centres, reach, period))
          << "ratio " << ratio << ", round " << round;
      near += static_cast<double>(pairs.size());
      all += 0.5 * static_cast<double>(n) * static_cast<double>(n - 1);
    }
  }
  EXPECT_GT(near / all, 0.05);
  EXPECT_LT(near / all, 0.5);
}

TEST(DiscPairs, AgreesWithTheDefinitionFarFromTheOrigin) {
  Random random(3);
  const Reaches reach = mixed(random, 400, 1.0, 200.0);
  const Points near = cloud(random, 400, 12.0);
  for (const double offset : {-1e6, 1e9}) {
    const Points centres = moved(near, {offset, offset});
    EXPECT_EQ(disc_pairs(centres, reach), brute_force::pairs(centres, reach));
  }
}

TEST(DiscPairs, LeavesOutPairsThatNeitherCanMove) {
  const Points centres{{0, 0}, {1, 0}, {2, 0}, {3, 0}};
  const std::vector<std::uint8_t> movable{0, 0, 1, 0};
  for (const double small : {0.5, 0.1}) {
    Pairs pairs;
    DiscPairs().find(centres, Reaches{0.9, 0.5, 0.5, small}, nullptr, pairs, movable);
    EXPECT_THAT(pairs, testing::ElementsAreArray(small == 0.5 ? Pairs{{1, 2}, {2, 3}} : Pairs{{1, 2}}));
  }
}

TEST(DiscPairs, AnswersOneSceneAfterAnother) {
  Random random(8);
  DiscPairs discs;
  Pairs pairs;
  for (const std::size_t n : {300u, 10u, 500u, 0u, 40u}) {
    const Points centres = cloud(random, n, 9.0);
    for (const double ratio : {1.0, 100.0, 2.0, 5.0}) {
      const Reaches reach = mixed(random, n, 0.7, ratio);
      discs.find(centres, reach, nullptr, pairs);
      EXPECT_EQ(pairs, brute_force::pairs(centres, reach));
    }
  }
}

}  // namespace
}  // namespace throng::broadphase
