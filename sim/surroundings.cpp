// SPDX-License-Identifier: MIT
#include "sim/surroundings.h"

#include <algorithm>
#include <cmath>

#include "sim/straight_runs.h"

namespace throng {

namespace {

constexpr double kParallel = 1e-9;  // sine of the angle up to which walls are parallel

bool is_parallel(const Vec& a, const Vec& b) {
  return std::abs(a.x() * b.y() - a.y() * b.x()) <= kParallel * a.norm() * b.norm();
}

void add_domain(const Scene& scene, Surroundings& all) {
  const Vec &low = scene.domain.min, &high = scene.domain.max;
  for (int axis = 0; axis < 2; ++axis)
    for (const double at : {low[axis], high[axis]})
      all.sides.push_back({axis, at, low[1 - axis], high[1 - axis], 0});
}

void add_wall(const StraightRun& run, Surroundings& all) {
  const Vec from = all.frame(run.from), to = all.frame(run.to);
  if (!all.square) return all.others.push_back(Surroundings::Box(from.cwiseMin(to), from.cwiseMax(to)));
  const Vec way = (to - from).cwiseAbs();
  const int along = way.x() > way.y() ? 0 : 1;
  all.sides.push_back({1 - along, from[1 - along], std::min(from[along], to[along]),
                       std::max(from[along], to[along]), run.material});
}

}  // namespace

bool is_square(const Vec& a, const Vec& b) {
  return is_parallel(a, b) || is_parallel(a, Vec(-b.y(), b.x()));
}

Surroundings surroundings(const Scene& scene) {
  Surroundings all;
  const std::vector<StraightRun> runs = straight_runs(scene.walls);
  if (scene.domain.kind == DomainKind::unbounded && !runs.empty())
    all.frame.along = (runs[0].to - runs[0].from).normalized();
  for (const StraightRun& run : runs)
    all.square = all.square && is_square(run.to - run.from, all.frame.along);
  if (scene.domain.kind == DomainKind::box) add_domain(scene, all);
  for (const StraightRun& run : runs) add_wall(run, all);
  for (std::size_t row = 0; row < scene.bodies.size(); ++row)
    if (scene.bodies.kind[row] == BodyKind::fixed)
      all.others.push_back(all.frame(scene.bodies.position[row], scene.bodies.radius[row]));
  return all;
}

}  // namespace throng
