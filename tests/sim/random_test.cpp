// SPDX-License-Identifier: MIT
#include "sim/random.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

namespace throng {

// The known answers that the authors of Random123 publish with it (kat_vectors, philox 4x32-10).
TEST(Philox, GivesThePublishedAnswers) {
  EXPECT_EQ(philox({0, 0, 0, 0}, {0, 0}),
            (std::array<std::uint32_t, 4>{0x6627e8d5, 0xe169c58d, 0xbc57ac4c, 0x9b00dbd8}));
  EXPECT_EQ(philox({0xffffffff, 0xffffffff, 0xffffffff, 0xffffffff}, {0xffffffff, 0xffffffff}),
            (std::array<std::uint32_t, 4>{0x408f276d, 0x41c83b0e, 0xa20bc7c6, 0x6d5451fd}));
  EXPECT_EQ(philox({0x243f6a88, 0x85a308d3, 0x13198a2e, 0x03707344}, {0xa4093822, 0x299f31d0}),
            (std::array<std::uint32_t, 4>{0xd16cfe09, 0x94fdcceb, 0x5001e420, 0x24126ea1}));
}

TEST(Random, DependsOnSeedStepIdAndPurpose) {
  std::set<double> firsts;
  for (std::uint64_t seed : {1ULL, 2ULL, 1ULL << 40})
    for (std::uint64_t step : {0ULL, 1ULL, 1ULL << 33})
      for (std::uint32_t id : {1u, 2u, 1u << 31})
        for (Purpose purpose : {Purpose::radius, Purpose::angle, Purpose::velocity, Purpose::place})
          firsts.insert(Random(seed, step, id, purpose).uniform());
  EXPECT_EQ(firsts.size(), 3u * 3u * 3u * 4u);
}

TEST(Random, GivesTheSameNumbersAgain) {
  Random a(5, 6, 7, Purpose::place), b(5, 6, 7, Purpose::place);
  for (int i = 0; i < 100; ++i) ASSERT_EQ(a.uniform(), b.uniform());
}

TEST(Random, GivesOtherNumbersEachTime) {
  Random random(5, 6, 7, Purpose::place);
  std::set<double> seen;
  for (int i = 0; i < 10'000; ++i) seen.insert(random.uniform());
  EXPECT_EQ(seen.size(), 10'000u);
}

/// Mean of f(x) over many bodies' first draws, as placement uses them.
template <class Draw>
double mean(Draw draw) {
  double sum = 0.0;
  constexpr int kBodies = 200'000;
  for (int id = 1; id <= kBodies; ++id) sum += draw(static_cast<std::uint32_t>(id));
  return sum / kBodies;
}

// Four standard errors of a mean over 200,000 draws: 4 sigma / 447.
TEST(Random, IsUniformOverIds) {
  const auto u = [](std::uint32_t id) { return Random(1, 0, id, Purpose::place).uniform(); };
  EXPECT_NEAR(mean(u), 0.5, 0.0026);
  EXPECT_NEAR(mean([&](std::uint32_t id) { return u(id) * u(id); }), 1.0 / 3.0, 0.0027);
  EXPECT_NEAR(mean([&](std::uint32_t id) { return u(id) * u(id + 1); }), 0.25, 0.0020);
}

TEST(Random, HasTheMomentsOfANormalDistribution) {
  const auto x = [](std::uint32_t id) { return Random(1, 0, id, Purpose::velocity).normal(); };
  EXPECT_NEAR(mean(x), 0.0, 0.009);
  EXPECT_NEAR(mean([&](std::uint32_t id) { return x(id) * x(id); }), 1.0, 0.0127);
  EXPECT_NEAR(mean([&](std::uint32_t id) { return std::pow(x(id), 3); }), 0.0, 0.035);
  EXPECT_NEAR(mean([&](std::uint32_t id) { return std::pow(x(id), 4); }), 3.0, 0.088);
  EXPECT_NEAR(mean([&](std::uint32_t id) { return x(id) < 1.0 ? 1.0 : 0.0; }), 0.841345, 0.0033);
  EXPECT_NEAR(mean([&](std::uint32_t id) { return x(id) < -2.0 ? 1.0 : 0.0; }), 0.022750, 0.0014);
}

TEST(Random, StaysWithinItsBounds) {
  Random random(9, 0, 1, Purpose::radius);
  for (int i = 0; i < 10'000; ++i) {
    const double x = random.uniform(0.1, 0.3);
    ASSERT_TRUE(x >= 0.1 && x <= 0.3) << x;
  }
  EXPECT_EQ(random.uniform(0.7, 0.7), 0.7);
}

TEST(Logarithm, AgreesWithTheLibrary) {
  for (double x :
       {1e-300, 1e-17, 0.1, 0.5, 0.70710678118654746, 0.7071067811865476, 1.0 - 1e-10, 2.0, 1e10, 1e308})
    EXPECT_NEAR(logarithm(x), std::log(x), 4e-16 * std::abs(std::log(x)) + 1e-25) << x;
  Random random(3, 0, 1, Purpose::place);
  for (int i = 0; i < 100'000; ++i) {
    const double x = random.uniform();
    ASSERT_NEAR(logarithm(x), std::log(x), 6e-16 * std::abs(std::log(x))) << x;
  }
  EXPECT_EQ(logarithm(1.0), 0.0);
}

}  // namespace throng
