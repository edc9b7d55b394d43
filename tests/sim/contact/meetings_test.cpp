// SPDX-License-Identifier: MIT
// A glance at many pairs, at each width of vectors, against disc_flight pair by pair.
#include "sim/contact/meetings.h"

#include <gtest/gtest.h>
#include <hwy/highway.h>

#include <random>
#include <vector>

#include "narrowphase/disc_flight.h"
#include "sim/periodic.h"

namespace throng {
namespace {

class MeetingsOnEachTarget : public ::testing::TestWithParam<std::int64_t> {
 protected:
  MeetingsOnEachTarget() { use(GetParam()); }
  ~MeetingsOnEachTarget() override { use(0); }

 private:
  static void use(std::int64_t targets) {
    hwy::SetSupportedTargetsForTest(targets);
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
  }
};
INSTANTIATE_TEST_SUITE_P(Targets, MeetingsOnEachTarget,
                         ::testing::ValuesIn(hwy::SupportedAndGeneratedTargets()));

struct Gas {
  std::vector<StraightWay> discs;
  std::vector<broadphase::Pair> pairs;
  std::vector<double> reach;  // m

  explicit Gas(std::size_t count) {
    std::mt19937 bits(static_cast<unsigned>(count));  // plain on all machines
    const auto uniform = [&](double from, double to) { return from + (to - from) * (bits() / 4294967296.0); };
    for (std::size_t i = 0; i < 60; ++i)
      discs.push_back({{uniform(0, 10), uniform(0, 10)}, {uniform(-3, 3), uniform(-3, 3)}});
    for (std::size_t i = 0; i < count; ++i) {
      const auto a = static_cast<std::uint32_t>(bits() % 59);
      pairs.push_back({a, a + 1 + static_cast<std::uint32_t>(bits() % (59 - a))});
      reach.push_back(uniform(0.5, 1.5));
    }
  }

  std::vector<std::uint8_t> found(const Vec* period, double until) const {
    std::vector<std::uint8_t> result((pairs.size() + kMeetingsWide - 1) / kMeetingsWide);
    find_meetings({discs, pairs, reach, period, until}, 0, result.size(), result.data());
    return result;
  }

  narrowphase::DiscFlight flight(std::size_t pair, const Vec* period, double until) const {
    const StraightWay &a = discs[pairs[pair].a], &b = discs[pairs[pair].b];
    const Vec way = b.position - a.position;
    return narrowphase::disc_flight(period ? nearest_image(way, *period) : way, b.velocity - a.velocity,
                                    reach[pair], until);
  }
};

TEST_P(MeetingsOnEachTarget, AreThoseThatAFlightSays) {
  const Vec period(10, 10);
  for (const Vec* around : {static_cast<const Vec*>(nullptr), &period})
    for (const std::size_t count : {1u, 7u, 8u, 9u, 30u, 5003u}) {
      const Gas gas(count);
      const auto found = gas.found(around, 0.7);
      std::size_t meetings = 0, overlaps = 0;
      for (std::size_t i = 0; i < count; ++i) {
        const bool looked = found[i / kMeetingsWide] >> (i % kMeetingsWide) & 1;
        const auto [gap, time] = gas.flight(i, around, 0.7);
        meetings += time < 0.7, overlaps += gap < 0.0;
        ASSERT_TRUE(looked || (time == narrowphase::kNever && gap >= 0.0)) << i << " of " << count;
        ASSERT_TRUE(!looked || gap < 0.0 || gas.flight(i, around, 100.0).time < 100.0)
            << i << " of " << count;
      }
      if (count < 5000) continue;
      EXPECT_GT(meetings, count / 50);
      EXPECT_GT(overlaps, count / 100);
      EXPECT_LT(meetings + overlaps, count / 3);
    }
}

TEST_P(MeetingsOnEachTarget, BehindTheLastPairAreNone) {
  Gas gas(8);
  gas.discs = {{{0, 0}, {1, 0}}, {{1.1, 0}, {-1, 0}}};
  gas.pairs.assign(11, {0, 1}), gas.reach.assign(11, 1.0);
  EXPECT_EQ(gas.found(nullptr, 1.0), (std::vector<std::uint8_t>{0xff, 0x07}));
}

TEST_P(MeetingsOnEachTarget, TwoThatTouchAndComeNearerMeetAndTwoThatPartDoNot) {
  Gas gas(8);
  gas.discs = {{{0, 0}, {1, 0}}, {{1, 0}, {0, 0}}, {{0, 1}, {0, 1}}};
  gas.pairs = {{0, 1}, {0, 2}}, gas.reach = {1.0, 1.0};
  EXPECT_EQ(gas.found(nullptr, 1.0), (std::vector<std::uint8_t>{0x01}));
}

}  // namespace
}  // namespace throng
