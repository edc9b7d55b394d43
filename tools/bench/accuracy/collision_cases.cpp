// SPDX-License-Identifier: MIT
#include "tools/bench/accuracy/cases.h"
#include "tools/bench/accuracy/exact_billiard.h"
#include "tools/bench/accuracy/exact_impact.h"
#include "tools/bench/accuracy/exact_row.h"

namespace throng::bench {

namespace {

/// Bodies 1 and 2, 3 and 4, ... are a pair each.
JudgeMaker struck(const Scene& scene) {
  const std::vector<BodyState> start = states_of(scene);
  std::vector<RigidDisc> discs;
  for (std::size_t i = 0; i < start.size(); ++i)
    discs.push_back({start[i], scene.bodies.radius[i], mass(scene, i)});
  const Material material = scene.materials[0];
  const auto truth = [=](double t) {
    std::vector<BodyState> now;
    for (std::size_t i = 0; i < discs.size(); i += 2)
      for (const BodyState& one :
           exact_impact({discs[i], discs[i + 1]}, material.restitution, material.friction, t))
        now.push_back(one);
    return now;
  };
  return by_trajectory(truth, 0.1);
}

JudgeMaker swung(const Scene& scene) {
  const std::vector<BodyState> start = states_of(scene);
  const double diameter = 2.0 * scene.bodies.radius[0];
  return by_trajectory([=](double t) { return exact_row(start, diameter, t); }, 0.1, false);
}

JudgeMaker reflected(const Scene& scene) {
  const std::vector<BodyState> start = states_of(scene);
  const double radius = scene.bodies.radius[0];
  Table table{scene.domain.min.array() + radius, scene.domain.max.array() - radius};
  if (start.size() > 1) table.post = start[1].position, table.post_reach = radius + scene.bodies.radius[1];
  return by_trajectory(
      [=](double t) {
        std::vector<BodyState> now = start;
        now[0] = exact_billiard(start[0], table, t);
        return now;
      },
      0.1);
}

}  // namespace

std::span<const AccuracyCase> collision_cases() {
  static const AccuracyCase all[] = {
      {.name = "impact",
       .what = "Discs that spin hit others off their centres, with restitution 0.6 and friction 0.3: eight "
               "pairs, whose "
               "collisions fall on other parts of a step. Exact: the impulse, with Coulomb's limit.",
       .error = kOffTrajectory,
       .scene = "impact",
       .dts = halvings(0.05, 8),
       .judges = struck},
      {.name = "cradle",
       .what = "Newton's cradle of six elastic discs, 3 to 5 cm apart. Exact: equal masses swap velocities.",
       .error = kOffTrajectory,
       .scene = "cradle",
       .dts = halvings(0.05, 8),
       .judges = swung},
      {.name = "billiard",
       .what = "A ball in a box, 14 reflections without loss. Exact: the unfolded box.",
       .error = kOffTrajectory,
       .scene = "billiard",
       .dts = halvings(0.05, 8),
       .judges = reflected},
      {.name = "Sinai billiard",
       .what = "A ball among four walls and round a post, from which errors are reflected larger, in the 5 s "
               "before chaos. Exact: reflection by reflection, in long double.",
       .error = kOffTrajectory,
       .scene = "sinai",
       .dts = halvings(0.05, 8),
       .judges = reflected},
  };
  return all;
}

}  // namespace throng::bench
