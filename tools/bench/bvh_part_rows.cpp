// SPDX-License-Identifier: MIT
#include <cmath>

#include "narrowphase/bvh_parts.h"
#include "narrowphase/decompose.h"
#include "tools/bench/bvh_case.h"
#include "tools/bench/bvh_rows.h"
#include "tools/bench/outlines.h"

namespace throng::bench {

namespace {

using namespace narrowphase;

constexpr int kMotionSteps = 500;

/// Ten steps there, ten back, and so on: the shapes stay about as far apart.
Pose place(const Vec& at, double turn, int step) {
  return pose(at, turn * std::abs(step % 20 - 10));
}

void add_motion(Case& one, const PartsBvh& tree, const Vec& at, double turn) {
  const auto sum = [=](const auto& distance) {
    double total = 0.0;
    for (int step = 0; step < kMotionSteps; ++step) total += distance(place(at, turn, step));
    return total;
  };
  const auto figures = [](const BvhCounters& counters) -> nlohmann::ordered_json {
    return {{"nodes", static_cast<double>(counters.nodes) / kMotionSteps},
            {"leaves", static_cast<double>(counters.leaves) / kMotionSteps}};
  };
  const auto tracked = [&tree, sum](bool keeps_features, BvhCounters* counters) {
    PartsMemory memory;
    return sum([&](const Pose& p) {
      if (!keeps_features) memory.features.fill({});
      return track(tree, Pose{}, tree, p, memory, counters).distance;
    });
  };
  BvhCounters cold, warm;
  sum([&](const Pose& p) { return separation(tree, Pose{}, tree, p, &cold).distance; });
  tracked(true, &warm);
  one.add(
      "from nothing",
      [&tree, sum] { return sum([&](const Pose& p) { return separation(tree, Pose{}, tree, p).distance; }); },
      figures(cold));
  one.add(
      "last parts", [tracked] { return tracked(false, nullptr); }, figures(warm));
  one.add(
      "last parts and features", [tracked] { return tracked(true, nullptr); }, figures(warm));
}

}  // namespace

std::vector<Row> bvh_part_rows(const Options& options) {
  struct Approach {
    const char* name;
    std::vector<double> radii;
    Vec at;
  };
  std::vector<Row> rows;
  for (const Approach& motion : {Approach{"gear n=64 near", gear_radii(64), {2.02, 0.1}},
                                 Approach{"gear n=64 overlapping", gear_radii(64), {1.85, 0.1}},
                                 Approach{"star n=64 near", star_radii(64), {1.9, 0.1}},
                                 Approach{"coast n=256 near", coast_radii(256, 1), {2.3, 0.1}}})
    for (const double turn : {0.001, 0.01, 0.1}) {
      const std::string name = "parts " + std::string(motion.name) + " " + text(turn) + " rad";
      if (!chosen(name, options) || (options.quick && turn != 0.01)) continue;
      const std::vector<Convex> parts = decompose(around(motion.radii));
      const PartsBvh tree = parts_bvh(parts);
      Case one(name, kMotionSteps);
      add_motion(one, tree, motion.at, turn);
      one.finish(options, rows);
    }
  return rows;
}

}  // namespace throng::bench
