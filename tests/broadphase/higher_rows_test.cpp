// SPDX-License-Identifier: MIT
#include "broadphase/higher_rows.h"

#include <gmock/gmock.h>
#include <hwy/targets.h>

#include <algorithm>

#include "tests/broadphase/clouds.h"

namespace throng::broadphase {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using Pairs = std::vector<Pair>;

/// As a search may find them: in two buffers.
PairList found(const Pairs& pairs) {
  PairList list;
  list.reset(2);
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    PairBuffer& buffer = list.buffer(2 * i < pairs.size() ? 0 : 1);
    Pair* const out = buffer.room(1);
    *out = pairs[i];
    buffer.keep(out + 1);
  }
  return list;
}

Pairs written(HigherRows& higher) {
  Pairs pairs{{7, 7}};
  higher.write(pairs);
  return pairs;
}

TEST(HigherRows, BringPairsIntoAscendingOrder) {
  HigherRows higher;
  higher.assign(found({{2, 5}, {0, 3}, {2, 4}, {0, 1}, {1, 3}}), 6);
  EXPECT_THAT(written(higher), ElementsAre(Pair{0, 1}, Pair{0, 3}, Pair{1, 3}, Pair{2, 4}, Pair{2, 5}));
  higher.assign(found({}), 0);
  EXPECT_THAT(written(higher), IsEmpty());
}

TEST(HigherRows, LeaveOutPairsThatNeitherCanMove) {
  HigherRows higher;
  higher.assign(found({{0, 3}, {0, 2}, {0, 1}, {1, 3}, {2, 3}}), 4);
  higher.keep_movable(std::vector<std::uint8_t>{0, 0, 1, 0});
  EXPECT_THAT(written(higher), ElementsAre(Pair{0, 2}, Pair{2, 3}));
}

/// Pairs of which row i has lengths[i].
Pairs random_pairs(Random& random, const std::vector<std::size_t>& lengths) {
  const auto n = static_cast<std::uint32_t>(lengths.size());
  std::vector<std::uint32_t> rows;
  for (std::uint32_t row = 0; row < 1000; ++row) rows.push_back(n + row * 1000);
  Pairs pairs;
  for (std::uint32_t row = 0; row < n; ++row) {
    random.shuffle(rows);
    for (std::size_t k = 0; k < lengths[row]; ++k) pairs.push_back({row, rows[k]});
  }
  random.shuffle(pairs);
  return pairs;
}

// Each length has networks of its own, and so have the longest of a few that are sorted together.
TEST(HigherRows, SortListsOfEveryLengthWithEveryWidthOfVectors) {
  const std::uint64_t seed = 13;
  SCOPED_TRACE("seed " + std::to_string(seed));
  Random random(seed);
  std::vector<std::vector<std::size_t>> cases;
  for (const std::size_t most : {2u, 5u, 9u, 17u, 33u, 300u})
    for (std::size_t rows = 1; rows < 60; rows += most) {
      cases.emplace_back();
      for (std::size_t row = 0; row < rows; ++row) cases.back().push_back(random.below(most));
    }
  cases.emplace_back();
  for (std::size_t length = 0; length < 270; ++length) cases.back().push_back(length);
  for (const std::vector<std::size_t>& lengths : cases) {
    const Pairs pairs = random_pairs(random, lengths);
    Pairs ascending = pairs;
    std::sort(ascending.begin(), ascending.end());
    HigherRows higher;
    for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) {
      hwy::SetSupportedTargetsForTest(target);
      hwy::GetChosenTarget().Update(hwy::SupportedTargets());
      higher.assign(found(pairs), lengths.size());
      EXPECT_EQ(written(higher), ascending) << hwy::TargetName(target) << ", " << lengths.size() << " rows";
    }
  }
  hwy::SetSupportedTargetsForTest(0);
  hwy::GetChosenTarget().Update(hwy::SupportedTargets());
}

}  // namespace
}  // namespace throng::broadphase
