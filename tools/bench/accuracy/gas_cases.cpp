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

/// A run of events, seen at steps of dt and counted.
struct Seen {
  double rate, counted;  ///< 1/s
};

Seen seen_events(const Scene& scene, double dt, double times_as_long) {
  Scene longer = event_driven(scene, dt);
  longer.time.until *= times_as_long;
  const auto run = simulation(longer);
  CollisionRate rate;
  for (std::int64_t i = 1; i <= longer.time.steps(); ++i) {
    run->step();
    rate.look(static_cast<double>(i) * dt, run->state());
  }
  return {rate.rate(), counted_rate(longer, *run)};
}

/// f(dt), asked for once per dt.
std::function<double(double)> remembered(std::function<double(double)> f) {
  return [f, known = std::make_shared<std::map<double, double>>()](double dt) {
    if (!known->contains(dt)) (*known)[dt] = f(dt);
    return known->at(dt);
  };
}

JudgeMaker by_rate(const Scene& scene) {
  const auto expected = remembered([scene](double dt) { return seen_events(scene, dt, kLonger).rate; });
  return [expected](const Scene& prepared) { return rate_judge(prepared, expected); };
}

JudgeMaker by_theory(const Scene& scene) {
  const auto share = remembered([scene](double dt) {
    const Seen seen = seen_events(scene, dt, 1.0);
    return seen.rate / seen.counted;
  });
  return [share](const Scene& prepared) { return theory_judge(prepared, share); };
}

/// 1,024 discs of radius 0.5 m in a square of that side (m).
std::vector<std::string> dense(const std::string& side, const std::string& spacing,
                               const std::string& until) {
  return {"domain.periodic=[[0, 0], [" + side + ", " + side + "]]",
          "bodies[0].place.lattice.spacing=[" + spacing + ", " + spacing + "]", "time.until=" + until};
}

JudgeMaker by_energy(const Scene&) {
  return energy_judge;
}

JudgeMaker by_momentum(const Scene&) {
  return momentum_judge;
}

JudgeMaker by_speeds(const Scene&) {
  return speed_judge;
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
       .instant = true,
       .promised = false,
       .knobs = 1},
      {.name = "gas, speeds",
       .what = "The same. Exact: Maxwell's distribution.",
       .error = "largest difference of the distributions; of the order of 0.005 it is chance",
       .scene = "gas",
       .overrides = {"time.until=21"},
       .dts = halvings(0.03, 4),
       .judges = by_speeds,
       .heavy = true,
       .promised = false,
       .knobs = 1},
      {.name = "gas, theory, 10 % of the area",
       .what = "1,024 elastic discs in a domain that repeats, which peers have not. Enskog's collision rate, "
               "by Liu's "
               "equation of state; steps in which a disc moves 5 % of its radius, and shorter.",
       .error = "collision rate, relative; of the order of 0.002 it is chance",
       .scene = "gas_theory",
       .overrides = dense("89.68", "2.8025", "1000"),
       .dts = halvings(0.025, 2),
       .judges = by_theory,
       .heavy = true,
       .instant = true,
       .promised = false,
       .knobs = 1},
      {.name = "gas, theory, 30 % of the area",
       .what = "The same, denser.",
       .error = "collision rate, relative; of the order of 0.002 it is chance",
       .scene = "gas_theory",
       .overrides = dense("51.777", "1.618", "600"),
       .dts = halvings(0.025, 2),
       .judges = by_theory,
       .heavy = true,
       .instant = true,
       .promised = false,
       .knobs = 1},
      {.name = "gas, theory, 50 % of the area",
       .what = "The same, denser still.",
       .error = "collision rate, relative; of the order of 0.002 it is chance",
       .scene = "gas_theory",
       .overrides = dense("40.106", "1.2533", "200"),
       .dts = halvings(0.025, 2),
       .judges = by_theory,
       .heavy = true,
       .instant = true,
       .promised = false,
       .knobs = 1},
      {.name = "polygon gas, energy",
       .what = "192 elastic polygons of 3 to 8 corners in a box for 10 s. Exact: no energy is lost.",
       .error = "largest change of energy, relative",
       .scene = "polygon_gas",
       .dts = halvings(0.02, 5),
       .judges = by_energy,
       .heavy = true,
       .promised = false,
       .knobs = 2},
      {.name = "polygon gas, momentum",
       .what = "The same without walls. Exact: the momentum of all stays as it is.",
       .error = "largest change of momentum, over the sum of its parts",
       .scene = "polygon_gas",
       .overrides = {"domain.box=[[-500, -500], [520, 520]]", "time.until=5"},
       .dts = halvings(0.02, 5),
       .judges = by_momentum,
       .heavy = true,
       .promised = false,
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
