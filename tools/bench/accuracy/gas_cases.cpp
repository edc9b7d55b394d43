// SPDX-License-Identifier: MIT
#include <cstdio>
#include <map>

#include "tools/bench/accuracy/cases.h"
#include "tools/bench/accuracy/gas_judges.h"
#include "tools/bench/accuracy/recorded_truth.h"

namespace throng::bench {

namespace {

constexpr double kLonger = 10.0;   // runs that say what rate is expected last so many times as long
constexpr double kRefined = 1e-4;  // s

Scene event_driven(Scene scene, double dt) {
  scene.engine = Engine::event_driven;
  scene.time.dt = dt;
  return scene;
}

template <int samples>
JudgeMaker by_events(const Scene& scene) {
  const double every = scene.time.until / samples;
  return by_trajectory(recorded_truth(event_driven(scene, every), every), every, false);
}

/// 1/s, as seen at steps of dt in a run of events.
double expected_rate(const Scene& scene, double dt) {
  Scene longer = event_driven(scene, dt);
  longer.time.until *= kLonger;
  const auto run = simulation(longer);
  CollisionRate rate;
  for (std::int64_t i = 1; i <= longer.time.steps(); ++i) {
    run->step();
    rate.look(static_cast<double>(i) * dt, run->state());
  }
  return rate.rate();
}

JudgeMaker by_rate(const Scene& scene) {
  const auto known = std::make_shared<std::map<double, double>>();
  const auto expected = [scene, known](double dt) {
    if (!known->contains(dt)) (*known)[dt] = expected_rate(scene, dt);
    return known->at(dt);
  };
  return [expected](const Scene& prepared) { return rate_judge(prepared, expected); };
}

JudgeMaker by_energy(const Scene&) {
  return energy_judge;
}

/// Of two refined runs the finer one; says on stderr how far the other is off it.
JudgeMaker by_refined_run(const Scene& scene) {
  const double every = scene.time.until / 5.0;
  Scene finer = scene, coarser = scene;
  finer.time.dt = kRefined;
  coarser.time.dt = 2.0 * kRefined;
  const Truth truth = recorded_truth(finer, every);
  std::fprintf(stderr, "the refined run's own error: about %.1g radii\n",
               difference(scene, truth, recorded_truth(coarser, every)));
  return by_trajectory(truth, every);
}

}  // namespace

std::span<const AccuracyCase> gas_cases() {
  static const AccuracyCase all[] = {
      {.name = "gas, 1 mean free time",
       .what = "1,000 elastic discs in a box, 30 % of its area, for 0.42 s, in which each collides once in "
               "the mean. "
               "Exact: event_driven.",
       .error = kOffTrajectory,
       .scene = "gas",
       .overrides = {"time.until=0.42"},
       .dts = halvings(0.03, 6),
       .judges = by_events<7>,
       .knobs = 2},
      {.name = "gas, 10 mean free times",
       .what = "The same for 4.2 s: an error is ten times as large after each collision or so.",
       .error = kOffTrajectory,
       .scene = "gas",
       .dts = halvings(0.03, 5),
       .judges = by_events<7>,
       .heavy = true,
       .knobs = 2},
      {.name = "gas, collision rate",
       .what = "The same for 21 s: 50 collisions a disc. Exact: a run of event_driven ten times as long.",
       .error = "collision rate, relative; below 0.01 it is chance",
       .scene = "gas",
       .overrides = {"time.until=21"},
       .dts = halvings(0.03, 4),
       .judges = by_rate,
       .heavy = true,
       .knobs = 1},
      {.name = "polygon gas, energy",
       .what = "192 elastic polygons of 3 to 8 corners in a box for 10 s. Exact: no energy is lost.",
       .error = "largest change of energy, relative",
       .scene = "polygon_gas",
       .dts = halvings(0.02, 5),
       .judges = by_energy,
       .heavy = true,
       .knobs = 2},
      {.name = "polygon gas, first collisions",
       .what = "The same for 0.5 s. Exact: native's own run at steps of 0.1 ms.",
       .error = kOffTrajectory,
       .scene = "polygon_gas",
       .overrides = {"time.until=0.5"},
       .dts = halvings(0.02, 5),
       .judges = by_refined_run,
       .heavy = true,
       .knobs = 2},
  };
  return all;
}

}  // namespace throng::bench
