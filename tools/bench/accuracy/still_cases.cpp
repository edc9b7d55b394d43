// SPDX-License-Identifier: MIT
#include <cmath>

#include "tools/bench/accuracy/cases.h"
#include "tools/bench/accuracy/still_judges.h"

namespace throng::bench {

namespace {

JudgeMaker in_place(const Scene&) {
  return place_judge;
}

JudgeMaker touching(const Scene&) {
  return touch_judge;
}

double weight(const Scene& scene, std::size_t row) {
  return mass(scene, row) * scene.gravity.norm();
}

/// Each box bears all those above it: what lies between row i and the one below is the weight of n - i boxes.
JudgeMaker column_loads(const Scene& scene) {
  const std::size_t n = scene.bodies.size();
  Loads loads;
  for (std::size_t i = 0; i < n; ++i) loads.force.push_back(static_cast<double>(n - i) * weight(scene, i));
  loads.which = [](const ContactRow& row) { return static_cast<int>(row.b == 0 ? row.a : row.b) - 1; };
  return [loads](const Scene& prepared) { return load_judge(prepared, loads); };
}

/// The floor bears all; how it is shared among the boxes no equation of statics says.
JudgeMaker floor_load(const Scene& scene) {
  Loads loads{[](const ContactRow& row) { return row.b == 0 ? 0 : -1; }, {0.0}};
  for (std::size_t row = 0; row < scene.bodies.size(); ++row) loads.force[0] += weight(scene, row);
  return [loads](const Scene& prepared) { return load_judge(prepared, loads); };
}

}  // namespace

std::span<const AccuracyCase> still_cases() {
  static const AccuracyCase all[] = {
      {.name = "column",
       .what = "Twenty boxes stand on one another for 4 s. Exact: where they stand at the beginning.",
       .error = "farthest that a box gets from its place, sides of a box",
       .scene = "column",
       .dts = halvings(1.0 / 15.0, 6),
       .judges = in_place},
      {.name = "column, forces",
       .what = "The same. Exact: between two boxes the weight of all above.",
       .error = "worst force between two boxes, relative, mean over a second",
       .scene = "column",
       .dts = halvings(1.0 / 15.0, 6),
       .judges = column_loads,
       .promised = false},
      {.name = "pyramid",
       .what = "210 boxes stand on a base of 20 for 4 s. Exact: where they stand at the beginning.",
       .error = "farthest that a box gets from its place, sides of a box",
       .scene = "pyramid",
       .dts = halvings(1.0 / 30.0, 4),
       .judges = in_place,
       .heavy = true,
       .knobs = 2},
      {.name = "pyramid, forces",
       .what = "The same. Exact: the floor bears the weight of all.",
       .error = "force on the floor, relative, mean over a second",
       .scene = "pyramid",
       .dts = halvings(1.0 / 30.0, 4),
       .judges = floor_load,
       .heavy = true,
       .promised = false,
       .knobs = 2},
      {.name = "pile",
       .what = "1,000 discs fall into a box and settle. Rigid discs that press on each other touch.",
       .error = "mean distance from touching, radii",
       .scene = "pile",
       .dts = halvings(1.0 / 30.0, 5),
       .judges = touching,
       .heavy = true,
       .knobs = 2},
      {.name = "polygons",
       .what =
           "480 polygons of 3 to 8 corners fall into a box and settle. Those that press on each other touch.",
       .error = "mean distance from touching, radii",
       .scene = "polygons",
       .dts = halvings(1.0 / 30.0, 5),
       .judges = touching,
       .heavy = true,
       .knobs = 2},
  };
  return all;
}

}  // namespace throng::bench
