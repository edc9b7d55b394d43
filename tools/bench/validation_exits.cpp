// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>

#include "tools/bench/rows.h"
#include "tools/bench/validation_cases.h"

namespace throng::bench {

namespace {

using Json = nlohmann::ordered_json;

std::string number(double value) {
  return std::to_string(value);
}

std::string unfinished(const Walked& walked) {
  return std::to_string(walked.missing()) + " of " + std::to_string(walked.arrival.size()) +
         " were still there after " + std::to_string(static_cast<int>(walked.scene.time.until)) + " s";
}

/// 1/s, from the first to the last through the line.
double flow(const std::vector<double>& crossings) {
  return static_cast<double>(crossings.size() - 1) / (crossings.back() - crossings.front());
}

constexpr int kDraws = 10;  // of the crowd, over which flows are averaged

/// Of these the one that differs most from `right`.
double farthest_from(double right, const std::vector<double>& draws) {
  return *std::ranges::max_element(draws, {}, [right](double draw) { return std::abs(draw - right); });
}

/// 1/s over the whole period, from the start to the last through the exit.
Finding flow_through_exit(const Trials& trials) {
  std::vector<double> flows;
  Json times = Json::array();
  for (int seed = 1; seed <= kDraws; ++seed) {
    const Walked walked = trials.walk("exit", {"seed=" + std::to_string(seed)});
    const std::vector<double>& through = walked.crossings[0];
    if (through.size() < walked.arrival.size()) return {{}, unfinished(walked)};
    flows.push_back(static_cast<double>(through.size()) / through.back());
    times.push_back(through);
  }
  return {mean(flows), "", {{"times", times}}, doubt(flows), *std::ranges::max_element(flows)};
}

constexpr double kWidths[] = {0.8, 0.9, 1.0, 1.1, 1.2};              // m
constexpr double kSeyfried[] = {1.288, 1.674, 1.900, 2.123, 2.364};  // 1/s

std::string seyfried_floor(double width) {
  const std::string low = number(4.0 - 0.5 * width), high = number(4.0 + 0.5 * width);
  return "walkable=POLYGON ((0 0, 8 0, 8 " + low + ", 10.8 " + low + ", 10.8 0, 16 0, 16 8, 10.8 8, 10.8 " +
         high + ", 8 " + high + ", 8 8, 0 8, 0 0))";
}

/// 1/s, by draw.
using Flows = std::vector<double>;

std::vector<Flows> measured_flows(const Trials& trials) {
  std::vector<Flows> flows;
  for (const double width : kWidths) {
    Flows its;
    for (int seed = 1; seed <= kDraws; ++seed) {
      const Walked walked = trials.walk("seyfried", {seyfried_floor(width), "seed=" + std::to_string(seed)});
      if (walked.missing() > 0) return flows;
      its.push_back(flow(walked.crossings[0]));
    }
    flows.push_back(its);
  }
  return flows;
}

/// For each of kWidths; stops short where people don't get through.
const std::vector<Flows>& bottleneck_flows(const Trials& trials) {
  return trials.once("bottleneck flows", [&] { return measured_flows(trials); });
}

std::vector<double> means(const std::vector<Flows>& flows) {
  std::vector<double> all;
  for (const Flows& its : flows) all.push_back(mean(its));
  return all;
}

Json curve(const std::vector<Flows>& flows) {
  return {{"width", kWidths}, {"flow", means(flows)}, {"seyfried_2009", kSeyfried}, {"draws", flows}};
}

std::string stuck_at(const std::vector<Flows>& flows) {
  return "not all got through " + number(kWidths[flows.size()]).substr(0, 3) + " m in time";
}

/// Of that width whose mean, with its doubt, is farthest off.
Finding off_seyfried(const Trials& trials) {
  const std::vector<Flows>& flows = bottleneck_flows(trials);
  if (flows.size() < std::size(kWidths)) return {{}, stuck_at(flows), curve(flows)};
  Finding found{0.0, "", curve(flows), 0.0, 0.0};
  for (std::size_t i = 0; i < flows.size(); ++i) {
    const double off = std::abs(mean(flows[i]) - kSeyfried[i]), its_doubt = doubt(flows[i]);
    if (off + its_doubt > *found.value + found.doubt) found.value = off, found.doubt = its_doubt;
    for (const double each : flows[i]) found.worst = std::max(*found.worst, std::abs(each - kSeyfried[i]));
  }
  return found;
}

/// The share of the variance of these flows (as kWidths) that a straight line over the width explains, with
/// the line's sign.
double explained(const std::vector<double>& flows) {
  double xy = 0.0, xx = 0.0, yy = 0.0;
  for (std::size_t i = 0; i < flows.size(); ++i) {
    const double x = kWidths[i] - 1.0, y = flows[i] - mean(flows);
    xy += x * y, xx += x * x, yy += y * y;
  }
  return xy * std::abs(xy) / (xx * yy);
}

/// Of the means of draws, which have no doubt of their own; beside it the worst of each draw.
Finding linear_in_width(const Trials& trials) {
  const std::vector<Flows>& flows = bottleneck_flows(trials);
  if (flows.size() < std::size(kWidths)) return {{}, stuck_at(flows)};
  double worst = 1.0;
  for (std::size_t draw = 0; draw < kDraws; ++draw) {
    std::vector<double> its;
    for (const Flows& each : flows) its.push_back(each[draw]);
    worst = std::min(worst, explained(its));
  }
  return {explained(means(flows)), "", Json::object(), 0.0, worst};
}

constexpr int kHalls = 6;  // draws of the crowd in the hall

/// As many as the hall has, or by the eastern two alone.
std::vector<std::string> exits_of_hall(bool all, int seed) {
  std::vector<std::string> overrides{"seed=" + std::to_string(seed)};
  if (!all)
    overrides.insert(overrides.end(),
                     {"walls[0].segment=[[0, 0], [15, 0]]", "walls[1].segment=[[15, 0], [19.5, 0]]",
                      "walls[3].segment=[[0, 20], [15, 20]]", "walls[4].segment=[[15, 20], [19.5, 20]]",
                      "agents[0].goal={ nearest = [\"south_east\", \"north_east\"] }"});
  return overrides;
}

/// How many times as long it takes to leave the hall by two of its four exits.
Finding half_the_exits(const Trials& trials) {
  std::vector<double> four, two, times;
  for (int seed = 1; seed <= kHalls; ++seed)
    for (const bool all : {true, false}) {
      const Walked walked = trials.walk("hall", exits_of_hall(all, seed));
      if (walked.missing() > 0) return {{}, (all ? "by four exits " : "by two exits ") + unfinished(walked)};
      (all ? four : two).push_back(walked.last_arrival());
    }
  for (std::size_t i = 0; i < kHalls; ++i) times.push_back(two[i] / four[i]);
  return {mean(times), "", {{"four", four}, {"two", two}}, doubt(times), farthest_from(2.0, times)};
}

constexpr int kPanics = 5;  // crowds, over which times are averaged

/// How many times as long it takes people who want 5 m/s as those who want 1.5 m/s.
Finding hurry(const Trials& trials) {
  double mean[2] = {};
  for (int seed = 1; seed <= kPanics; ++seed)
    for (std::size_t i = 0; i < 2; ++i) {
      const Walked walked = trials.walk(
          "panic",
          {"seed=" + std::to_string(seed), std::string("agents[0].desired_speed=") + (i ? "5" : "1.5")});
      if (walked.crossings[0].size() < walked.arrival.size()) return {{}, unfinished(walked)};
      mean[i] += walked.crossings[0].back() / kPanics;
    }
  return {mean[1] / mean[0], "", {{"at_1.5", mean[0]}, {"at_5", mean[1]}}};
}

std::string behind_exit(double distance) {
  const std::string from = number(8.2 + distance), to = number(9.2 + distance);
  return "areas.beyond=POLYGON ((" + from + " 0, " + to + " 0, " + to + " 5, " + from + " 5, " + from +
         " 0))";
}

/// s, how much later the last one arrives 10 m behind the exit than at once behind it.
Finding farther_goal(const Trials& trials) {
  const std::string floor =
      "walkable=POLYGON ((0 0, 8 0, 8 2, 8.2 2, 8.2 0, 20 0, 20 5, 8.2 5, 8.2 3, 8 3, 8 5, 0 5, 0 0))";
  double last[2] = {};
  for (std::size_t i = 0; i < 2; ++i) {
    const Walked walked = trials.walk("exit", {floor, behind_exit(i ? 10.0 : 0.0)});
    if (walked.missing() > 0) return {{}, unfinished(walked)};
    last[i] = walked.last_arrival();
  }
  return {last[1] - last[0]};
}

/// The flow into a bottleneck 5 m long over that into one of 0.2 m, of each of kDraws of the crowd.
Finding longer_bottleneck(const Trials& trials) {
  std::vector<double> flows[2], ratios;
  for (std::size_t i = 0; i < 2; ++i) {
    const std::string end = number(i ? 13.0 : 8.2);
    const std::string floor = "walkable=POLYGON ((0 0, 8 0, 8 3.5, " + end + " 3.5, " + end +
                              " 0, 16 0, 16 8, " + end + " 8, " + end + " 4.5, 8 4.5, 8 8, 0 8, 0 0))";
    for (int seed = 1; seed <= kDraws; ++seed) {
      const Walked walked = trials.walk("seyfried", {floor, "seed=" + std::to_string(seed)});
      if (walked.missing() > 0) return {{}, unfinished(walked)};
      flows[i].push_back(flow(walked.crossings[0]));
    }
  }
  for (std::size_t i = 0; i < kDraws; ++i) ratios.push_back(flows[1][i] / flows[0][i]);
  return {mean(ratios),
          "",
          {{"short", flows[0]}, {"long", flows[1]}},
          doubt(ratios),
          *std::ranges::max_element(ratios)};
}

}  // namespace

std::span<const ValidationCase> exit_cases() {
  static const ValidationCase all[] = {
      {"IMO 4, NIST 5.2: exit of a room", "flow through 1 m over the whole period", "1/s", -kNever, 1.33,
       flow_through_exit, true},
      {"Seyfried 2009: flow through bottlenecks", "worst difference of widths from 0.8 to 1.2 m", "1/s",
       -kNever, 0.5, off_seyfried},
      {"Seyfried 2009, RiMEA 12d: flow over width", "R^2 of a rising line, from 0.8 to 1.2 m", "", 0.9, 1.0,
       linear_in_width},
      {"IMO 9, RiMEA 9: half the exits", "time to leave the hall, over that by all four exits", "", 1.6, 2.4,
       half_the_exits},
      {"RiMEA 12a: goal behind an exit", "how much later the last arrives 10 m behind it than at it", "s",
       0.0, kNever, farther_goal},
      {"RiMEA 12b: length of a bottleneck", "flow through 5 m over that through 0.2 m", "", -kNever, 1.0,
       longer_bottleneck},
      {"faster is slower", "time to leave at 5 m/s over that at 1.5 m/s", "", 1.0, kNever, hurry},
  };
  return all;
}

}  // namespace throng::bench
