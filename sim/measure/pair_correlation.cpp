// SPDX-License-Identifier: MIT
#include "sim/measure/pair_correlation.h"

#include <algorithm>
#include <cstdio>
#include <numbers>

#include "broadphase/all_lists.h"

namespace throng {

namespace {

using std::numbers::pi;

double mean_radius(const Scene& scene) {
  double sum = 0.0, count = 0.0;
  for (std::size_t row = 0; row < scene.bodies.size(); ++row)
    if (scene.bodies.kind[row] == BodyKind::dynamic) sum += scene.bodies.radius[row], count += 1.0;
  return count > 0.0 ? sum / count : 0.0;
}

/// Width and height of where centres may be, m.
Vec room(const Scene& scene) {
  const Vec size = scene.domain.max - scene.domain.min;
  if (scene.domain.kind == DomainKind::periodic) return size;
  return (size.array() - 2.0 * mean_radius(scene)).max(0.0);
}

/// m, up to where the closed form holds.
double farthest(const Scene& scene) {
  const double side = room(scene).minCoeff();
  return scene.domain.kind == DomainKind::periodic ? 0.5 * side : side;
}

/// The probability that two points anywhere in it are at most r apart.
double expected(const Scene& scene, const Vec& size, double r) {
  const double area = size.prod();
  if (scene.domain.kind == DomainKind::periodic) return pi * r * r / area;
  return r * r * (pi * area - 4.0 / 3.0 * size.sum() * r + 0.5 * r * r) / (area * area);
}

}  // namespace

std::string correlation_refusal(const Scene& scene, double up_to) {
  if (scene.domain.kind == DomainKind::unbounded)
    return "needs a domain: in the open plane nobody knows how many pairs to expect";
  if (up_to <= farthest(scene)) return "";
  char text[96];
  std::snprintf(text, sizeof text, "must be at most %.6g m in this domain", farthest(scene));
  return text;
}

void append_pair_correlation(const Scene& scene, const State& state, const Bins& bins,
                             std::vector<double>& values) {
  std::vector<Vec> centres;
  for (std::size_t row = 0; row < state.id.size(); ++row)
    if (scene.bodies.kind[row] == BodyKind::dynamic) centres.push_back(state.position[row]);
  const broadphase::Period period{scene.domain.min, scene.domain.max - scene.domain.min};
  broadphase::NeighbourLists near;
  const bool repeats = scene.domain.kind == DomainKind::periodic;
  broadphase::AllLists().find(centres, bins.up_to, repeats ? &period : nullptr, near);
  const std::size_t first = values.size(), count = static_cast<std::size_t>(bins.count);
  values.resize(first + count, 0.0);
  for (const double distance : near.distance)  // each pair twice
    values[first + std::min(static_cast<std::size_t>(distance / bins.width()), count - 1)] += 0.5;
  const double n = static_cast<double>(centres.size()), pairs = 0.5 * n * (n - 1.0);
  const Vec size = room(scene);
  for (std::size_t i = 0; i < count; ++i) {
    const double begin = bins.width() * static_cast<double>(i), end = begin + bins.width();
    values[first + i] /= pairs * (expected(scene, size, end) - expected(scene, size, begin));
  }
}

}  // namespace throng
