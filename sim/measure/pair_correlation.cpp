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

/// Whether what is beyond the room is what is at its other side.
bool repeats(const Scene& scene) {
  return scene.domain.kind == DomainKind::periodic && !scene.asked.correlation_within;
}

/// Width and height of where centres may be, m.
Vec room(const Scene& scene) {
  if (const auto& within = scene.asked.correlation_within) return within->sizes();
  const Vec size = scene.domain.max - scene.domain.min;
  if (repeats(scene)) return size;
  return (size.array() - 2.0 * mean_radius(scene)).max(0.0);
}

/// m, up to where the closed form holds.
double farthest(const Scene& scene) {
  const double side = room(scene).minCoeff();
  return repeats(scene) ? 0.5 * side : side;
}

/// The probability that two points anywhere in it are at most r apart.
double expected(const Scene& scene, const Vec& size, double r) {
  const double area = size.prod();
  if (repeats(scene)) return pi * r * r / area;
  return r * r * (pi * area - 4.0 / 3.0 * size.sum() * r + 0.5 * r * r) / (area * area);
}

std::vector<Vec> centres(const Scene& scene, const State& state) {
  const auto& within = scene.asked.correlation_within;
  std::vector<Vec> result;
  for (std::size_t row = 0; row < state.id.size(); ++row)
    if (const Vec& p = state.position[row];
        scene.bodies.kind[row] == BodyKind::dynamic && (!within || within->contains(p)))
      result.push_back(p);
  return result;
}

}  // namespace

std::string correlation_refusal(const Scene& scene, double up_to) {
  const bool within = scene.asked.correlation_within.has_value();
  if (scene.domain.kind == DomainKind::unbounded && !within)
    return "needs a domain, or observe.correlation_within: in the open plane nobody knows how many pairs to "
           "expect";
  if (const Eigen::AlignedBox2d domain(scene.domain.min, scene.domain.max);
      within && scene.domain.kind != DomainKind::unbounded &&
      !domain.contains(*scene.asked.correlation_within))
    return "needs an observe.correlation_within that lies in the domain";
  if (up_to <= farthest(scene)) return "";
  char text[96];
  std::snprintf(text, sizeof text, "must be at most %.6g m in this %s", farthest(scene),
                within ? "box" : "domain");
  return text;
}

void append_pair_correlation(const Scene& scene, const State& state, const Bins& bins,
                             std::vector<double>& values) {
  const std::vector<Vec> centres = throng::centres(scene, state);
  const broadphase::Period period{scene.domain.min, scene.domain.max - scene.domain.min};
  broadphase::NeighbourLists near;
  broadphase::AllLists().find(centres, bins.up_to, repeats(scene) ? &period : nullptr, near);
  const std::size_t first = values.size(), count = static_cast<std::size_t>(bins.count);
  values.resize(first + count, 0.0);
  for (const double distance : near.distance)  // each pair twice
    values[first + std::min(static_cast<std::size_t>(distance / bins.width()), count - 1)] += 0.5;
  const double n = static_cast<double>(centres.size()), pairs = 0.5 * n * (n - 1.0);
  const Vec size = room(scene);
  for (std::size_t i = 0; i < count; ++i) {
    const double begin = bins.width() * static_cast<double>(i), end = begin + bins.width();
    if (pairs > 0.0) values[first + i] /= pairs * (expected(scene, size, end) - expected(scene, size, begin));
  }
}

}  // namespace throng
