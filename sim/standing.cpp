// SPDX-License-Identifier: MIT
#include "sim/standing.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "sim/observe.h"
#include "sim/plan.h"
#include "sim/step.h"

namespace throng {

namespace {

constexpr double kTouching = 1e-9;  // radii
constexpr double kProbe = 4e-3;     // sqrt(radius / g): a step of those that show who stays
constexpr int kProbeSteps = 16;     // of the first of three looks, each after twice as many as the one before
constexpr double kSteady = 0.2;     // how far off twice the speed is after twice the time

/// m, across gravity.
double width(const Scene& scene) {
  const Vec across(-scene.gravity.normalized().y(), scene.gravity.normalized().x());
  if (scene.domain.kind != DomainKind::unbounded)
    return std::abs(across.x()) * (scene.domain.max - scene.domain.min).x() +
           std::abs(across.y()) * (scene.domain.max - scene.domain.min).y();
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for_dynamic(scene, [&](std::size_t row) {
    const double at = across.dot(scene.bodies.position[row]), radius = scene.bodies.radius[row];
    low = std::min(low, at - radius), high = std::max(high, at + radius);
  });
  return high - low;
}

/// A run of the scene in steps so short that nothing gets anywhere.
Scene probe_of(const Scene& scene) {
  double least = std::numeric_limits<double>::infinity();
  for_dynamic(scene, [&](std::size_t row) { least = std::min(least, scene.bodies.radius[row]); });
  Scene probe = scene;
  probe.time.dt = kProbe * std::sqrt(least / scene.gravity.norm());
  probe.time.substeps = 4;
  probe.sleep = false;
  probe.sensors.clear();
  return probe;
}

/// After n, 2n and 4n steps from rest: from whom nothing but a steady push takes so much each time.
bool is_steady(const Vec& first, const Vec& second, const Vec& third) {
  return (second - 2.0 * first).norm() <= kSteady * second.norm() &&
         (third - 2.0 * second).norm() <= kSteady * third.norm();
}

}  // namespace

double mean_load(const Scene& scene) {
  double all = 0.0, lightest = std::numeric_limits<double>::infinity(), widest = 0.0;
  for_dynamic(scene, [&](std::size_t row) {
    all += mass(scene, row);
    lightest = std::min(lightest, mass(scene, row));
    widest = std::max(widest, 2.0 * scene.bodies.radius[row]);
  });
  const double total = all / lightest;
  return std::clamp(total * widest / width(scene), 1.0, total);
}

bool touch_at_rest(const Scene& scene) {
  std::size_t dynamic = 0;
  bool still = true;
  double least = std::numeric_limits<double>::infinity();
  for_dynamic(scene, [&](std::size_t row) {
    still = still && scene.bodies.velocity[row] == Vec(0.0, 0.0) && scene.bodies.spin[row] == 0.0;
    least = std::min(least, scene.bodies.radius[row]);
    ++dynamic;
  });
  if (!still) return false;
  Scene grown = scene;  // so that they overlap where they touch
  const double gap = kTouching * least;
  for (double& radius : grown.bodies.radius) radius += gap;
  for (Shape& shape : grown.shapes)
    for (narrowphase::Convex& part : shape.parts) part.radius += gap;
  const Overlap found = overlap(grown, initial_state(scene));
  return found.pairs >= dynamic && found.max <= 4.0 * gap;
}

bool stay(const Scene& scene, double allowed) {
  const Scene probe = probe_of(scene);
  const Plan plan = plan_for(probe);
  State state = initial_state(probe);
  Workspace work(probe, plan, 1);
  std::vector<Vec> looks[3];
  for (int look = 0, until = kProbeSteps; look < 3; ++look, until *= 2) {
    while (state.step < until) step(probe, plan, state, work);
    looks[look] = state.velocity;
  }
  const double time = static_cast<double>(state.step) * probe.time.dt, until = scene.time.until;
  bool all = true;
  for_dynamic(scene, [&](std::size_t row) {
    const double way = 0.5 * looks[2][row].norm() / time * until * until;
    all = all && (way <= allowed || !is_steady(looks[0][row], looks[1][row], looks[2][row]));
  });
  return all;
}

}  // namespace throng
