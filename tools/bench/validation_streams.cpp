// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>

#include "tools/bench/rows.h"
#include "tools/bench/validation_cases.h"

namespace throng::bench {

namespace {

constexpr int kStreams = 6;                   // draws of the crowd
constexpr int kAgainst[] = {0, 10, 50, 100};  // people

/// s, until the last of 100 is in the other room, against that many of that draw.
double last_against(const Walked& walked) {
  const std::vector<double>& into = walked.crossings[0];
  return into.size() < 100 ? kNever : into.back();
}

std::string jam(const Walked& walked, int against, int seed) {
  return std::to_string(walked.crossings[0].size()) + " of 100 got through against " +
         std::to_string(against) + " in " + std::to_string(static_cast<int>(walked.scene.time.until)) +
         " s, with seed " + std::to_string(seed);
}

/// s, the least that ten, fifty, a hundred against the stream delay its last one, each beside the fewer
/// before.
Finding delay_by_counterflow(const Trials& trials) {
  std::vector<double> last;
  std::vector<std::vector<double>> times;
  Finding found{kNever, "", {}, 0.0, kNever};
  for (const int against : kAgainst) {
    std::vector<double> now, delay;
    for (int seed = 1; seed <= kStreams; ++seed) {
      const Walked walked = trials.walk(
          "counterflow", {"agents[1].count=" + std::to_string(against), "seed=" + std::to_string(seed)});
      now.push_back(last_against(walked));
      if (now.back() == kNever) return {{}, jam(walked, against, seed), {{"last", last}}};
      if (!times.empty()) delay.push_back(now.back() - times.back()[now.size() - 1]);
    }
    times.push_back(now), last.push_back(mean(now));
    if (delay.empty()) continue;
    if (mean(delay) - doubt(delay) < *found.value - found.doubt)
      found.value = mean(delay), found.doubt = doubt(delay);
    found.worst = std::min(*found.worst, *std::ranges::min_element(delay));
  }
  found.series = {{"last", last}, {"draws", times}};
  return found;
}

/// Speed (m/s) at a density (1/m²): Weidmann, "Transporttechnik der Fussgänger" (1993).
double weidmann(double density) {
  return 1.34 * (1.0 - std::exp(-1.913 * (1.0 / density - 1.0 / 5.4)));
}

/// m/s, the worst difference from Weidmann's curve, of crowds of 0.5 to 3 a m².
Finding off_weidmann(const Trials& trials) {
  std::vector<double> densities, speeds;
  double worst = 0.0;
  for (const int people : {90, 180, 360, 540}) {
    const Walked walked = trials.walk("fundamental", {"agents[0].count=" + std::to_string(people)});
    const Reading read = reading(walked.scene.crowd.measures[0], walked.measured[0], walked.scene.time.dt);
    if (!read.density || !read.speed) return {{}, "nobody was in the middle"};
    densities.push_back(*read.density), speeds.push_back(*read.speed);
    worst = std::max(worst, std::abs(*read.speed - std::max(0.0, weidmann(*read.density))));
  }
  return {worst, "", {{"density", densities}, {"speed", speeds}}};
}

/// Of the rows (0.5 m of the corridor's width each) with two people or more in the middle, the mean of
/// ((a - b) / (a + b))^2, a and b of them to the east and to the west: 1 where each is one stream's own.
double order(const Scene& scene, const State& state) {
  constexpr int kRows = 8;
  double to_east[kRows] = {}, to_west[kRows] = {}, sum = 0.0, rows = 0.0;
  for (std::size_t row = 0; row < state.id.size(); ++row) {
    const Vec& p = state.position[row];
    if (p.x() < 12.0 || p.x() > 28.0) continue;
    const int lane = std::clamp(static_cast<int>(2.0 * p.y()), 0, kRows - 1);
    (scene.crowd.group[state.id[row] - 1] == 0 ? to_east : to_west)[lane] += 1.0;
  }
  for (int lane = 0; lane < kRows; ++lane) {
    const double all = to_east[lane] + to_west[lane];
    if (all < 2.0) continue;
    sum += (to_east[lane] - to_west[lane]) * (to_east[lane] - to_west[lane]) / (all * all);
    rows += 1.0;
  }
  return rows > 0.0 ? sum / rows : 0.0;
}

Finding lane_order(const Trials& trials) {
  double sum = 0.0, samples = 0.0;
  trials.walk("lanes", {}, [&](const Scene& scene, const State& state) {
    if (static_cast<double>(state.step) * scene.time.dt < 30.0) return;
    sum += order(scene, state), samples += 1.0;
  });
  return {sum / std::max(samples, 1.0)};
}

/// The density of the second measure over that of the first.
Finding second_over_first(const Trials& trials, const char* scenario) {
  const Walked walked = trials.walk(scenario);
  double density[2] = {};
  for (std::size_t i = 0; i < 2; ++i)
    density[i] = reading(walked.scene.crowd.measures[i], walked.measured[i], walked.scene.time.dt)
                     .density.value_or(0.0);
  if (!(density[0] > 0.0)) return {{}, "nobody was there"};
  return {density[1] / density[0], "", {{"first", density[0]}, {"second", density[1]}}};
}

Finding second_door(const Trials& trials) {
  return second_over_first(trials, "twice");
}

Finding corridor_behind(const Trials& trials) {
  return second_over_first(trials, "congestion");
}

/// How much later the last of 500 comes round a corner than straight on by the corner's inner way, over how
/// much later he comes straight on by its outer way: three draws of the crowd each.
Finding round_corner(const Trials& trials) {
  const std::string straight[] = {
      "walkable=POLYGON ((0 0, 56 0, 56 6, 0 6, 0 0))", "areas.end=POLYGON ((55 0, 56 0, 56 6, 55 6, 55 0))",
      "walkable=POLYGON ((0 0, 68 0, 68 6, 0 6, 0 0))", "areas.end=POLYGON ((67 0, 68 0, 68 6, 67 6, 67 0))"};
  double sum[3] = {};  // s, by the inner way, round the corner, by the outer way
  for (int seed = 1; seed <= 3; ++seed)
    for (std::size_t i = 0; i < 3; ++i) {
      std::vector<std::string> overrides{"seed=" + std::to_string(seed)};
      if (i != 1) overrides.insert(overrides.end(), {straight[i], straight[i + 1]});
      const Walked walked = trials.walk("round", overrides);
      if (walked.missing() > 0) return {{}, "not all got there"};
      sum[i] += walked.last_arrival() / 3.0;
    }
  return {
      (sum[1] - sum[0]) / (sum[2] - sum[0]), "", {{"inner", sum[0]}, {"corner", sum[1]}, {"outer", sum[2]}}};
}

constexpr double kRing = 26.0;  // m, its middle line
/// People a metre, and the speeds (m/s) that 10 and 90 % of those in experiments don't reach there.
constexpr double kSingleFile[][3] = {
    {0.5, 0.71, 1.39}, {0.9, 0.45, 1.10}, {1.1, 0.32, 0.84}, {1.5, 0.11, 0.49}, {2.1, 0.035, 0.27}};

/// m/s, the mean speed along the ring, from 30 s on.
double speed_in_ring(const Trials& trials, int people) {
  std::vector<std::string> counts;
  for (int group = 0; group < 4; ++group)
    counts.push_back("agents[" + std::to_string(group) + "].count=" + std::to_string((people + group) / 4));
  double sum = 0.0, samples = 0.0;
  trials.walk("ring", counts, [&](const Scene& scene, const State& state) {
    if (static_cast<double>(state.step) * scene.time.dt < 30.0) return;
    for (std::size_t row = 0; row < state.id.size(); ++row) {
      const Vec &p = state.position[row], &v = state.velocity[row];
      sum += (p.x() * v.y() - p.y() * v.x()) / p.norm(), samples += 1.0;
    }
  });
  return sum / samples;
}

/// m/s, the most that the mean speed in single file is outside of the band of 10 to 90 % of experiments.
Finding outside_of_band(const Trials& trials) {
  std::vector<double> densities, speeds;
  double worst = 0.0;
  for (const auto& [density, slow, fast] : kSingleFile) {
    const int people = static_cast<int>(std::lround(kRing * density));
    densities.push_back(people / kRing), speeds.push_back(speed_in_ring(trials, people));
    worst = std::max({worst, slow - speeds.back(), speeds.back() - fast});
  }
  return {worst, "", {{"density", densities}, {"speed", speeds}}};
}

}  // namespace

std::span<const ValidationCase> stream_cases() {
  static const ValidationCase all[] = {
      {"IMO 8, NIST 2.8: counterflow", "least delay of the last of 100 by 10, 50, 100 against them", "s",
       0.02, kNever, delay_by_counterflow},
      {"Weidmann, RiMEA 4: fundamental diagram", "worst difference of speed, at 0.5 to 3 people a m^2", "m/s",
       -kNever, 0.3, off_weidmann},
      {"lane formation", "order of two streams, from 1/n where mixed to 1 where apart", "", 0.8, 1.0,
       lane_order},
      {"RiMEA 12c: two doors", "density before the second, over that before the first", "", -kNever, 0.7,
       second_door},
      {"NIST 5.1: congestion", "density in the corridor, over that before the room's exit", "", -kNever, 0.99,
       corridor_behind},
      {"RiMEA 15: large crowd round a corner", "delay by the corner, over that by the way along its outside",
       "", -kNever, 1.0, round_corner},
      {"RiMEA 16: single file in a ring", "worst that speeds are outside the band of 10 to 90 % of people's",
       "m/s", -kNever, 0.0, outside_of_band},
  };
  return all;
}

}  // namespace throng::bench
