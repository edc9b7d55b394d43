// SPDX-License-Identifier: MIT
// throng bench crowd: the floor plan and the distance field of one goal, a million nodes, beside the exact
// shortest ways.
#include <cmath>
#include <stdexcept>

#include "sim/crowd/distance_field.h"
#include "sim/random.h"
#include "tools/bench/benchmarks.h"
#include "tools/bench/geodesic.h"
#include "tools/bench/interleave.h"

namespace throng::bench {

namespace {

constexpr double kSide = 50.0;         // m
constexpr double kWorst = 0.01;        // of the distance, that is promised
constexpr double kFromWalls = 0.3;     // m, of places that are asked
constexpr double kFromGoal = 1.0;      // m, likewise
constexpr std::size_t kAsked = 2'000;  // places

/// Two walls that a way winds round, and a block on its way.
Region hall() {
  return {{rectangle(0, 0, kSide, kSide),
           rectangle(10, 5, 12, 45),
           rectangle(20, 0.5, 22, 40),
           {{30, 10}, {40, 20}, {35, 35}, {28, 30}}}};
}

/// The worst error of the field's distances, relative to the exact ones, over places at random.
double worst_error(const DistanceField& field, const Region& floor, const Barriers& barriers,
                   const Vec& goal) {
  const Geodesic exact(floor, barriers, goal);
  Random random(5, 0, 1, Purpose::place);
  double worst = 0.0;
  for (std::size_t asked = 0; asked < kAsked;) {
    const double x = random.uniform(0.0, kSide);
    const Vec p(x, random.uniform(0.0, kSide));
    if (!contains(floor, p) || barriers.distance(p, kFromWalls) < kFromWalls || (p - goal).norm() < kFromGoal)
      continue;
    const double truth = exact.distance(p);
    worst = std::max(worst, std::abs(field.distance(p) - truth) / truth);
    ++asked;
  }
  return worst;
}

}  // namespace

std::vector<Row> bench_ways(const Options& options) {
  const double cell = options.quick ? kSide / 300.0 : kSide / 1000.0;
  const std::string name = "distance field " + std::to_string(static_cast<int>(std::lround(kSide / cell))) +
                           " x " + std::to_string(static_cast<int>(std::lround(kSide / cell)));
  if (!chosen(name, options)) return {};
  const Region floor = hall();
  const Barriers barriers(edges(floor), 1.0);
  const Vec goal(45.0, 30.0), half(1e-3, 1e-3);
  const Region there{
      {rectangle(goal.x() - half.x(), goal.y() - half.y(), goal.x() + half.x(), goal.y() + half.y())}};
  const Resolution resolution{cell, 0.5 * cell};
  const FloorPlan plan = floor_plan(floor, barriers, resolution, 0.0);
  const double worst = worst_error(DistanceField(plan, barriers, there), floor, barriers, goal);
  if (!options.quick && !(worst <= kWorst))
    throw std::runtime_error(name + " is off by " + std::to_string(worst) + " of the exact distance");
  std::vector<Contestant> contestants{
      {"throng", [&] { DistanceField(plan, barriers, there); }},
      {"its floor plan", [&] { floor_plan(floor, barriers, resolution, 0.0); }}};
  interleave(contestants, options.blocks, 1.0);
  const std::string nodes = "nodes=" + std::to_string(plan.size());
  return {
      {"crowd", name, contestants[0].engine, 1, contestants[0].ms, 1.0, nodes, {{"worst_relative", worst}}},
      {"crowd", name, contestants[1].engine, 1, contestants[1].ms, 1.0, nodes}};
}

}  // namespace throng::bench
