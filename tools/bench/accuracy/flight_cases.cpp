// SPDX-License-Identifier: MIT
#include "tools/bench/accuracy/cases.h"
#include "tools/bench/accuracy/exact_throw.h"

namespace throng::bench {

namespace {

JudgeMaker thrown(const Scene& scene) {
  const BodyState start = states_of(scene)[0];
  const Vec gravity = scene.gravity;
  return by_trajectory([=](double t) { return std::vector<BodyState>{exact_throw(start, gravity, t)}; }, 0.1);
}

}  // namespace

std::span<const AccuracyCase> flight_cases() {
  static const AccuracyCase all[] = {
      {.name = "flight",
       .what = "A square flies and spins for 10 s with nothing that pulls: what is left is rounding.",
       .error = kOffTrajectory,
       .scene = "flight",
       .dts = halvings(0.1, 5),
       .judges = thrown,
       .smooth = true},
      {.name = "throw",
       .what = "A disc that spins is thrown 3.3 m high, and seen for 2 s. Exact: x + v t + g t² / 2.",
       .error = kOffTrajectory,
       .scene = "throw",
       .dts = halvings(0.1, 8),
       .judges = thrown,
       .smooth = true},
  };
  return all;
}

}  // namespace throng::bench
