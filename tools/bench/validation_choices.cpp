// SPDX-License-Identifier: MIT
#include <algorithm>

#include "tools/bench/validation_cases.h"

namespace throng::bench {

namespace {

/// The goal that was nearest when the agent was seen last: the exit that it left by.
std::uint32_t left_by(const Walked& walked, std::size_t agent, const std::vector<std::uint32_t>& goals) {
  return *std::ranges::min_element(goals, {}, [&](std::uint32_t goal) {
    return (nearest_on_border(walked.scene.crowd.goals[goal].region, walked.last[agent]) - walked.last[agent])
        .norm();
  });
}

/// Of those who left, the share that left by the first option of the first group's journey.
Finding near_exit(const Trials& trials) {
  const Walked walked = trials.walk("two_exits");
  const std::vector<std::uint32_t>& exits = walked.scene.crowd.groups[0].journey.back().options;
  double left = 0.0, near = 0.0;
  for (std::size_t agent = 0; agent < walked.arrival.size(); ++agent) {
    if (walked.arrival[agent] == kNever) continue;
    left += 1.0;
    near += left_by(walked, agent, exits) == exits[0] ? 1.0 : 0.0;
  }
  if (left == 0.0) return {{}, "nobody left"};
  const std::size_t missing = walked.missing();
  return {near / left, missing == 0 ? "" : std::to_string(missing) + " of 1000 were still there after 600 s"};
}

/// The share that was ever above the middle of the floor's longer route: none of them went the short one.
double by_short_route(const Trials& trials, std::vector<std::string> overrides) {
  std::vector<bool> went_long(100, false);
  trials.walk("routes", std::move(overrides), [&](const Scene&, const State& state) {
    for (std::size_t row = 0; row < state.id.size(); ++row)
      if (state.position[row].y() > 8.0) went_long[state.id[row] - 1] = true;
  });
  return 0.01 * static_cast<double>(std::ranges::count(went_long, false));
}

Finding short_route(const Trials& trials) {
  const double nearest = by_short_route(trials, {"agents[0].goal=exit"});
  return {by_short_route(trials, {}), "", {{"by_the_way_alone", nearest}}};
}

/// Of the 20 who have that goal how many leave in the north.
double in_the_north(const Trials& trials, const std::string& goal, const std::string& closes) {
  const Walked walked = trials.walk("closing", {"agents[0].goal=" + goal, "open.south.until=" + closes});
  double north = 0.0;
  for (std::size_t agent = 0; agent < walked.arrival.size(); ++agent)
    north += walked.arrival[agent] < kNever && walked.last[agent].y() > 10.0 ? 1.0 : 0.0;
  return north;
}

/// Who doesn't leave by the exit that stays open, be it the nearest or the least crowded, of twice 20.
Finding exit_that_closes(const Trials& trials) {
  const std::string nearest = "{ nearest = [\"south\", \"north\"] }",
                    least_crowded = "{ least_crowded = { south = 10, north = 0.5 } }";
  const double never = in_the_north(trials, nearest, "1000") + in_the_north(trials, least_crowded, "1000");
  if (never > 0.0) return {{}, "some go there though the nearer exit doesn't close"};
  return {40.0 - in_the_north(trials, nearest, "1") - in_the_north(trials, least_crowded, "1")};
}

/// s, from the first to the last of a group of five of whom one is slow.
Finding company(const Trials& trials) {
  const Walked walked = trials.walk("company");
  if (walked.missing() > 0) return {{}, "not all got there"};
  return {walked.last_arrival() - *std::ranges::min_element(walked.arrival)};
}

}  // namespace

std::span<const ValidationCase> choice_cases() {
  static const ValidationCase all[] = {
      {"RiMEA 11: choice of exits", "share by the nearer of two exits: most, but not all", "", 0.5, 0.99,
       near_exit},
      {"RiMEA 14: choice of routes", "share by the shorter of two routes", "", -kNever, kNever, short_route},
      {"NIST 4.1: an exit that closes",
       "of 40 who don't leave by the other exit when theirs closes after 1 s", "persons", -kNever, 0.0,
       exit_that_closes, true},
      {"NIST 2.9: groups", "from the first to the last of five friends, one of whom walks at 0.5 m/s", "s",
       -kNever, 10.0, company, true},
  };
  return all;
}

}  // namespace throng::bench
