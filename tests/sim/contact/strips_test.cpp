// SPDX-License-Identifier: MIT
#include "sim/contact/strips.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <mutex>
#include <random>
#include <set>

namespace throng {
namespace {

constexpr std::size_t kBodies = 4000;

/// Bodies all over a floor of that size; each tenth moves for nothing.
std::vector<SolverBody> cloud(const Vec& size, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  const Vec none(0.0, 0.0);
  std::vector<SolverBody> bodies(kBodies + kStillRows, {none, 0.0, 0.0, none, 0.0, 0.0});
  for (std::size_t i = 0; i < kBodies; ++i) {
    bodies[i].position = {size.x() * unit(random), size.y() * unit(random)};
    bodies[i].inverse_mass = i % 10 == 0 ? 0.0 : 1.0;
  }
  return bodies;
}

class StripsOfACloud : public ::testing::TestWithParam<bool> {  // whether it lies
 protected:
  const unsigned seed_ = std::random_device()();
  std::vector<SolverBody> bodies_ = cloud(GetParam() ? Vec(100, 40) : Vec(40, 100), seed_);
  Workers workers_{2};
  Strips strips_;
};

TEST_P(StripsOfACloud, HoldEachBodyOnceAndAboutAsManyEach) {
  SCOPED_TRACE("seed " + std::to_string(seed_));
  strips_.cut(bodies_, Rows::all(kBodies), 70000, 0.4, workers_);
  ASSERT_EQ(strips_.count(), 8u);
  std::set<std::uint32_t> seen;
  for (std::size_t i = 0; i < strips_.count(); ++i) {
    std::size_t n = 0;
    strips_.for_each_body(i, [&](std::uint32_t row) {
      EXPECT_TRUE(seen.insert(row).second);
      EXPECT_GT(bodies_[row].inverse_mass, 0.0);
      ++n;
    });
    EXPECT_NEAR(static_cast<double>(n), 450.0, 200.0);
  }
  strips_.for_each_unmoved([&](std::uint32_t row) { EXPECT_TRUE(seen.insert(row).second); });
  EXPECT_EQ(seen.size(), kBodies);
}

TEST_P(StripsOfACloud, LetNoTwoGroupsOfAPhaseMoveOneBody) {
  SCOPED_TRACE("seed " + std::to_string(seed_));
  strips_.cut(bodies_, Rows::all(kBodies), 70000, 0.4, workers_);
  std::vector<std::vector<std::uint32_t>> moved(strips_.groups());
  std::size_t far = 0;
  std::mt19937 random(seed_);
  for (int i = 0; i < 200000; ++i) {
    const auto a = static_cast<std::uint32_t>(random() % kBodies),
               b = static_cast<std::uint32_t>(random() % kBodies);
    const double way = (bodies_[a].position - bodies_[b].position).norm();
    if (a == b || (way > 4.0 && i % 100 != 0)) continue;
    far += way > 30.0;
    const std::uint8_t group = strips_.group(a, b);
    ASSERT_LT(group, strips_.groups());
    for (const std::uint32_t row : {a, b})
      if (bodies_[row].inverse_mass > 0.0) moved[group].push_back(row);
  }
  EXPECT_GT(far, 100u);
  std::mutex mutex;
  std::array<std::set<std::size_t>, Strips::kPhases> groups;
  strips_.for_each_group(workers_, [&](std::size_t group, std::size_t phase) {
    const std::lock_guard lock(mutex);
    groups[phase].insert(group);
  });
  std::size_t all = 0;
  for (const auto& phase : groups) {
    std::vector<std::size_t> owner(kBodies, SIZE_MAX);
    for (const std::size_t group : phase) {
      EXPECT_FALSE(moved[group].empty());
      for (const std::uint32_t row : moved[group]) {
        EXPECT_TRUE(owner[row] == SIZE_MAX || owner[row] == group) << "body " << row;
        owner[row] = group;
      }
      ++all;
    }
  }
  EXPECT_EQ(all, strips_.groups());
}

TEST_P(StripsOfACloud, PutContactsWithObstaclesWhereTheBodyIs) {
  strips_.cut(bodies_, Rows::all(kBodies), 70000, 0.4, workers_);
  for (std::size_t i = 0; i < strips_.count(); ++i)
    strips_.for_each_body(i, [&](std::uint32_t row) { EXPECT_EQ(strips_.group(row, kBodies), i); });
}

TEST_P(StripsOfACloud, AreOneForFewContactsAndWhereBodiesAreWide) {
  strips_.cut(bodies_, Rows::all(kBodies), 5000, 0.4, workers_);
  EXPECT_EQ(strips_.groups(), 1u);
  EXPECT_EQ(strips_.group(0, 1), 0);
  strips_.cut(bodies_, Rows::all(kBodies), 70000, 40.0, workers_);
  EXPECT_EQ(strips_.groups(), 1u);
}

TEST_P(StripsOfACloud, AreTheSameForThoseOfThemWhoAreAwake) {
  std::vector<std::uint32_t> awake;
  for (std::uint32_t row = 0; row < kBodies; row += 2) awake.push_back(row);
  strips_.cut(bodies_, Rows::of(awake), 70000, 0.4, workers_);
  std::size_t n = 0;
  for (std::size_t i = 0; i <= strips_.count(); ++i)
    strips_.for_each_body(i, [&](std::uint32_t row) { n += row % 2 == 0; });
  EXPECT_EQ(n, awake.size());
}

INSTANTIATE_TEST_SUITE_P(, StripsOfACloud, ::testing::Bool());

TEST(Buckets, HoldNumbersAscending) {
  std::mt19937 random(7);
  std::vector<std::uint8_t> of(20000);
  for (auto& bucket : of) bucket = static_cast<std::uint8_t>(random() % 5);
  Workers workers(2);
  Buckets buckets;
  buckets.sort(of, 6, workers);
  std::size_t n = 0;
  for (std::size_t bucket = 0; bucket < 6; ++bucket) {
    EXPECT_TRUE(std::ranges::is_sorted(buckets[bucket]));
    for (const std::uint32_t i : buckets[bucket]) EXPECT_EQ(of[i], bucket);
    n += buckets[bucket].size();
  }
  EXPECT_EQ(n, of.size());
}

}  // namespace
}  // namespace throng
