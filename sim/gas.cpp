// SPDX-License-Identifier: MIT
#include "sim/gas.h"

#include <algorithm>
#include <cmath>

#include "sim/periodic.h"

namespace throng {

namespace {

constexpr double kLost = 1e-6;  // of the energy: more than rounding loses

struct Motion {
  double energy = 0.0;  // J, of the centres
  double bodies = 0.0;  // less one where their common motion is left out
};

/// Whether nothing but other dynamic bodies acts on them.
bool keeps_momentum(const Scene& scene) {
  const auto yields = [](BodyKind kind) { return kind == BodyKind::dynamic; };
  return scene.domain.kind != DomainKind::box && scene.walls.empty() && scene.gravity == Vec(0.0, 0.0) &&
         std::ranges::all_of(scene.bodies.kind, yields);
}

Motion motion(const Scene& scene, const std::vector<Vec>& velocity) {
  Motion all;
  double weight = 0.0;
  Vec momentum(0.0, 0.0);
  for (std::size_t row = 0; row < scene.bodies.size(); ++row) {
    if (scene.bodies.kind[row] != BodyKind::dynamic) continue;
    const double m = mass(scene, row);
    all.energy += 0.5 * m * velocity[row].squaredNorm();
    momentum += m * velocity[row];
    weight += m;
    all.bodies += 1.0;
  }
  if (!keeps_momentum(scene)) return all;
  const double common = 0.5 * momentum.squaredNorm() / weight;
  return {std::max(all.energy - common, 0.0), all.bodies - 1.0};
}

/// 2 E t; nothing where the gas isn't the one that it was, or not all of its collisions are known.
std::optional<double> action(const Scene& scene, const State& state, const Collisions& collisions) {
  const double energy = motion(scene, state.velocity).energy;
  const double at_first = motion(scene, scene.bodies.velocity).energy;
  const double time = static_cast<double>(state.step) * scene.time.dt;
  if (!(time > 0.0 && std::abs(energy - at_first) <= kLost * at_first) || collisions.pushed > 0)
    return std::nullopt;
  return 2.0 * energy * time;
}

}  // namespace

double temperature(const Scene& scene, const State& state) {
  const Motion all = motion(scene, state.velocity);
  return all.energy / all.bodies;
}

std::optional<double> compressibility_factor(const Scene& scene, const State& state,
                                             const Collisions& collisions) {
  const std::optional<double> all = action(scene, state, collisions);
  if (!all) return std::nullopt;
  return 1.0 + collisions.virial / *all;
}

std::optional<double> compressibility_by_rate(const Scene& scene, const State& state,
                                              const Collisions& collisions) {
  const std::optional<double> all = action(scene, state, collisions);
  if (!all) return std::nullopt;
  return 1.0 + collisions.equilibrium * std::sqrt(temperature(scene, state)) / *all;
}

std::optional<double> compressibility_now(const Scene& scene, const State& state,
                                          std::span<const ContactRow> contacts) {
  const double energy = motion(scene, state.velocity).energy;
  if (!(energy > 0.0) || state.step == 0) return std::nullopt;
  const Vec period = scene.domain.max - scene.domain.min;
  double virial = 0.0;  // N m s
  for (const ContactRow& row : contacts) {
    if (row.b == 0) continue;
    const Vec way = state.position[row.b - 1] - state.position[row.a - 1];
    const bool repeats = scene.domain.kind == DomainKind::periodic;
    virial += row.impulse * (repeats ? nearest_image(way, period) : way).norm();
  }
  return 1.0 + virial / scene.time.dt / (2.0 * energy);
}

}  // namespace throng
