// SPDX-License-Identifier: MIT
// Whom a disc meets first, at each width of vectors, against disc_flight one by one.
#include "sim/event_driven/soonest_meeting.h"

#include <gtest/gtest.h>
#include <hwy/highway.h>

#include <random>
#include <vector>

#include "narrowphase/disc_flight.h"

namespace throng {
namespace {

class MeetingOnEachTarget : public ::testing::TestWithParam<std::int64_t> {
 protected:
  MeetingOnEachTarget() { use(GetParam()); }
  ~MeetingOnEachTarget() override { use(0); }

 private:
  static void use(std::int64_t targets) {
    hwy::SetSupportedTargetsForTest(targets);
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
  }
};
INSTANTIATE_TEST_SUITE_P(Targets, MeetingOnEachTarget,
                         ::testing::ValuesIn(hwy::SupportedAndGeneratedTargets()));

std::vector<Flying> discs(std::size_t count, std::mt19937& bits) {
  const auto uniform = [&](double from, double to) { return from + (to - from) * (bits() / 4294967296.0); };
  std::vector<Flying> all;
  for (std::size_t i = 0; i < count; ++i)
    all.push_back({Vec(uniform(0, 4), uniform(0, 4)), Vec(uniform(-1, 1), uniform(-1, 1)), uniform(0, 2),
                   uniform(0.1, 0.5), 0.0});
  return all;
}

Looker looking(const std::vector<Flying>& all, std::uint32_t disc, double now, const Vec* pull) {
  const Flying& one = all[disc];
  const double flown = now - one.since;
  if (!pull) return {one.position + flown * one.velocity, one.velocity, one.radius, now, disc, UINT32_MAX};
  return {one.position + flown * (one.velocity + 0.5 * flown * *pull),
          one.velocity + flown * *pull,
          one.radius,
          now,
          disc,
          UINT32_MAX};
}

/// The definition.
Meeting first_met(const std::vector<Flying>& all, const std::vector<std::uint32_t>& near, const Vec& shift,
                  const Vec* pull, const Looker& looker, Meeting first) {
  for (const std::uint32_t other : near) {
    const Looker two = looking(all, other, looker.now, pull);
    const double time =
        narrowphase::disc_flight(two.position + shift - looker.position, two.velocity - looker.velocity,
                                 looker.radius + two.radius, narrowphase::kNever)
            .time;
    if (other != looker.spared && looker.now + time < first.time) first = {looker.now + time, other};
  }
  return first;
}

Meeting met(const std::vector<Flying>& all, std::vector<std::uint32_t> near, const Vec& shift,
            const Vec* pull, const Looker& looker, Meeting first) {
  const std::size_t count = near.size();
  near.resize(count + kMeetingPadding);
  meet(all.data(), near.data(), count, shift, pull, looker, first);
  return first;
}

TEST_P(MeetingOnEachTarget, HasTheBitsOfTheDefinition) {
  std::mt19937 bits(11);
  const Vec pull(0.3, -1.0);
  int meetings = 0;
  for (int i = 0; i < 3000; ++i) {
    const std::vector<Flying> all = discs(40, bits);
    std::vector<std::uint32_t> near;
    for (std::size_t k = bits() % 20; k > 0; --k) near.push_back(static_cast<std::uint32_t>(bits() % 40));
    const Vec shift(i % 3 == 0 ? 4.0 : 0.0, i % 5 == 0 ? -4.0 : 0.0), *const pulled =
                                                                          i % 2 == 0 ? &pull : nullptr;
    Looker looker = looking(all, static_cast<std::uint32_t>(bits() % 40), 2.5, pulled);
    const Meeting sooner{i % 7 == 0 ? 4.0 : narrowphase::kNever, 77};
    if (i % 4 == 0) looker.spared = first_met(all, near, shift, pulled, looker, sooner).other;
    const Meeting expected = first_met(all, near, shift, pulled, looker, sooner);
    const Meeting found = met(all, near, shift, pulled, looker, sooner);
    ASSERT_EQ(found.time, expected.time) << i;
    ASSERT_EQ(found.other, expected.other) << i;
    meetings += found.other != 77;
  }
  EXPECT_GT(meetings, 500);
  EXPECT_LT(meetings, 2500);
}

TEST_P(MeetingOnEachTarget, IsTheFirstOfThoseAtOneTime) {
  std::vector<Flying> all(12, {Vec(0, 0), Vec(1, 0), 0.0, 0.5, 0.0});
  for (std::size_t i = 1; i < all.size(); ++i) all[i].position.x() = 3, all[i].velocity.x() = 0;
  const Looker looker = looking(all, 0, 0.0, nullptr);
  for (const auto& near :
       {std::vector<std::uint32_t>{0, 7, 3, 5, 1}, {3, 2, 1}, {0, 0, 0, 0, 0, 0, 0, 11, 10}}) {
    const Meeting found = met(all, near, Vec(0, 0), nullptr, looker, {narrowphase::kNever, 77});
    EXPECT_EQ(found.time, 2.0);
    EXPECT_EQ(found.other, *std::ranges::find_if(near, [](std::uint32_t row) { return row != 0; }));
  }
}

TEST_P(MeetingOnEachTarget, NobodyMeetsHimselfOrNobody) {
  const std::vector<Flying> all(2, {Vec(0, 0), Vec(1, 0), 0.0, 0.5, 0.0});
  const Looker looker = looking(all, 1, 3.0, nullptr);
  EXPECT_EQ(met(all, {1}, Vec(0, 0), nullptr, looker, {narrowphase::kNever, 77}).other, 77u);
  EXPECT_EQ(met(all, {}, Vec(0, 0), nullptr, looker, {narrowphase::kNever, 77}).other, 77u);
}

}  // namespace
}  // namespace throng
