// SPDX-License-Identifier: MIT
#include "sim/gas.h"

#include <cmath>

namespace throng {

namespace {

constexpr double kLost = 1e-6;  // of the energy: more than rounding loses

struct Motion {
  double energy = 0.0;  // J, of the centres
  double bodies = 0.0;  // less one where their common motion is left out
};

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
  if (scene.domain.kind != DomainKind::periodic) return all;
  return {all.energy - 0.5 * momentum.squaredNorm() / weight, all.bodies - 1.0};
}

}  // namespace

double temperature(const Scene& scene, const State& state) {
  const Motion all = motion(scene, state.velocity);
  return all.energy / all.bodies;
}

std::optional<double> compressibility_factor(const Scene& scene, const State& state,
                                             const Collisions& collisions) {
  const double energy = motion(scene, state.velocity).energy;
  const double at_first = motion(scene, scene.bodies.velocity).energy;
  const double time = static_cast<double>(state.step) * scene.time.dt;
  if (!(time > 0.0 && std::abs(energy - at_first) <= kLost * at_first)) return std::nullopt;
  return 1.0 + collisions.virial / (2.0 * energy * time);
}

}  // namespace throng
