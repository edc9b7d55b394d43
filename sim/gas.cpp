// SPDX-License-Identifier: MIT
#include "sim/gas.h"

namespace throng {

namespace {

struct Motion {
  double energy = 0.0;  // J, of the centres
  double bodies = 0.0;  // less one where their common motion is left out
};

Motion motion(const Scene& scene, const State& state) {
  Motion all;
  double weight = 0.0;
  Vec momentum(0.0, 0.0);
  for (std::size_t row = 0; row < scene.bodies.size(); ++row) {
    if (scene.bodies.kind[row] != BodyKind::dynamic) continue;
    const double m = mass(scene, row);
    all.energy += 0.5 * m * state.velocity[row].squaredNorm();
    momentum += m * state.velocity[row];
    weight += m;
    all.bodies += 1.0;
  }
  if (scene.domain.kind != DomainKind::periodic) return all;
  return {all.energy - 0.5 * momentum.squaredNorm() / weight, all.bodies - 1.0};
}

}  // namespace

double temperature(const Scene& scene, const State& state) {
  const Motion all = motion(scene, state);
  return all.energy / all.bodies;
}

double compressibility_factor(const Scene& scene, const State& state, const Collisions& collisions) {
  const double time = static_cast<double>(state.step) * scene.time.dt;
  return 1.0 + collisions.virial / (2.0 * motion(scene, state).energy * time);
}

}  // namespace throng
