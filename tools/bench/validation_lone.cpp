// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>

#include "tools/bench/rows.h"
#include "tools/bench/validation_cases.h"

namespace throng::bench {

namespace {

/// s, of the first agent from the first line to the second.
double time_between_lines(const Walked& walked, std::size_t agent = 0) {
  return walked.crossed[1][agent] - walked.crossed[0][agent];
}

Finding corridor_at_one(const Trials& trials) {
  return {time_between_lines(trials.walk("corridor"))};
}

Finding corridor_at_walking_pace(const Trials& trials) {
  return {time_between_lines(trials.walk("corridor", {"agents[0].desired_speed=1.33"}))};
}

Finding worst_response(const Trials& trials) {
  const Walked walked = trials.walk("response");
  double worst = 0.0;
  for (std::size_t agent = 0; agent < walked.set_out.size(); ++agent)
    worst = std::max(worst, std::abs(walked.set_out[agent] - walked.scene.crowd.start[agent]));
  return {worst};
}

Finding outside_at_corner(const Trials& trials) {
  return {trials.walk("corner").outside};
}

Finding last_round_corner(const Trials& trials) {
  const Walked walked = trials.walk("corner");
  if (walked.missing() > 0) return {{}, std::to_string(walked.missing()) + " of 20 didn't get there"};
  return {walked.last_arrival()};
}

/// m/s, of each between the lines.
std::vector<double> speeds(const Walked& walked) {
  std::vector<double> result;
  for (std::size_t agent = 0; agent < walked.arrival.size(); ++agent)
    result.push_back(40.0 / time_between_lines(walked, agent));
  return result;
}

double variance(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double value : values) sum += (value - mean(values)) * (value - mean(values));
  return sum / static_cast<double>(values.size() - 1);
}

Finding mean_speed(const Trials& trials) {
  const std::vector<double> walked = speeds(trials.walk("speeds"));
  return {mean(walked), "", {{"variance", variance(walked)}}};
}

/// Of those of each age of RiMEA's table the share that walked at a speed of that age.
Finding speeds_by_age(const Trials& trials) {
  constexpr double kAges[][2] = {{0.58, 1.61}, {1.41, 1.54}, {0.68, 1.41}, {0.46, 0.76}};
  double fewest = 1.0;
  for (const auto& age : kAges) {
    const double low = age[0], high = age[1];
    const std::string bounds = "{ uniform = [" + std::to_string(low) + ", " + std::to_string(high) + "] }";
    const std::vector<double> walked =
        speeds(trials.walk("speeds", {"agents[0].desired_speed=" + bounds, "time.until=200"}));
    const auto within =
        std::ranges::count_if(walked, [&](double v) { return v >= 0.99 * low && v <= 1.01 * high; });
    fewest = std::min(fewest, static_cast<double>(within) / static_cast<double>(walked.size()));
  }
  return {fewest};
}

Finding normal_speeds(const Trials& trials) {
  const std::vector<double> walked = speeds(
      trials.walk("speeds", {"agents[0].count=100", "agents[0].desired_speed={ normal = [1.2, 0.2] }"}));
  return {mean(walked), "", {{"deviation", std::sqrt(variance(walked))}}};
}

/// Who left by another exit than his own, or not at all.
Finding gone_astray(const Trials& trials) {
  const Walked walked = trials.walk("cabins");
  double astray = 0.0;
  for (std::size_t agent = 0; agent < walked.arrival.size(); ++agent) {
    const Crowd& crowd = walked.scene.crowd;
    const std::uint32_t goal = crowd.goal(crowd.groups[crowd.group[agent]].journey.back(), 0);
    const bool there =
        walked.arrival[agent] < kNever &&
        (nearest_on_border(walked.scene.crowd.goals[goal].region, walked.last[agent]) - walked.last[agent])
                .norm() < 0.1;
    astray += there ? 0.0 : 1.0;
  }
  return {astray};
}

/// s, how much later the last of 24 arrives where one more who is slow and wide walks among them.
Finding delay_by_one_who_is_slow(const Trials& trials) {
  const Walked alone = trials.walk("slow", {"agents[1].desired_speed=1.25", "agents[1].radius=0.2"});
  const Walked among = trials.walk("slow");
  if (alone.missing() + among.missing() > 0) return {{}, "not all got there"};
  const auto last = [](const Walked& walked) {
    return *std::max_element(walked.arrival.begin(), walked.arrival.begin() + 24);
  };
  return {last(among) - last(alone)};
}

}  // namespace

std::span<const ValidationCase> lone_cases() {
  static const ValidationCase all[] = {
      {"IMO 1, NIST 2.1: corridor", "time for 40 m at 1 m/s", "s", 38.1, 42.1, corridor_at_one, true},
      {"RiMEA 1: corridor", "time for 40 m at 1.33 m/s", "s", 26.0, 34.0, corridor_at_walking_pace, true},
      {"IMO 5, RiMEA 5: response times", "worst difference between response time and setting out", "s",
       -kNever, 0.5, worst_response, true},
      {"IMO 6, RiMEA 6: corner", "farthest off the floor", "m", -kNever, 1e-3, outside_at_corner, true},
      {"NIST 2.3: corner", "last arrival", "s", -kNever, 60.0, last_round_corner, true},
      {"IMO 7: speeds of men of 30 to 50", "mean of 50 speeds", "m/s", 1.295 - 0.08, 1.295 + 0.08, mean_speed,
       true},
      {"RiMEA 7: speeds by age", "least share that walked at a speed of its age", "", 0.96, 1.0,
       speeds_by_age, false},
      {"NIST 2.4: speeds", "mean of 100 speeds drawn from a normal distribution", "m/s", 1.14, 1.26,
       normal_speeds, true},
      {"IMO 10, RiMEA 10, NIST 3.1: cabins", "who left by another exit than his own, or not at all",
       "persons", -kNever, 0.0, gone_astray, true},
      {"NIST 2.10: one who is slow", "delay of 24 others by one of 0.8 m/s and radius 0.4 m", "s", 0.1,
       kNever, delay_by_one_who_is_slow, true},
  };
  return all;
}

}  // namespace throng::bench
