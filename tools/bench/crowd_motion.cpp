// SPDX-License-Identifier: MIT
#include "tools/bench/crowd_motion.h"

#include <cmath>

#include "sim/random.h"

namespace throng::bench {

namespace {

constexpr double kFrame = 0.04, kRelaxation = 0.5, kPush = 1.0;  // s, s, m/s²

Vec normal_vec(Random& random) {
  const double x = random.normal();
  return {x, random.normal()};
}

}  // namespace

Scene crowd_scene(std::size_t people) {
  Scene scene;
  scene.materials = {{}};
  scene.shapes = {{}};
  scene.time = {kFrame, 1.0, 1};
  Bodies& bodies = scene.bodies;
  const double side = std::sqrt(2.0 * static_cast<double>(people));
  for (std::uint32_t id = 1; id <= people; ++id) {
    Random random(1, 0, id, Purpose::place);
    const double x = random.uniform(0.0, side);
    const Vec way = normal_vec(random);
    bodies.position.push_back({x, random.uniform(0.0, side)});
    bodies.velocity.push_back((1.34 + 0.26 * random.normal()) * way.normalized());
  }
  bodies.shape.assign(people, 0), bodies.material.assign(people, 0);
  bodies.kind.assign(people, BodyKind::dynamic);
  bodies.radius.assign(people, 0.2);
  bodies.angle.assign(people, 0.0), bodies.spin.assign(people, 0.0);
  return scene;
}

std::vector<State> crowd_motion(const Scene& scene, std::size_t frames) {
  std::vector<State> states{initial_state(scene)};
  while (states.size() < frames) {
    State state = states.back();
    ++state.step;
    for (std::size_t row = 0; row < state.id.size(); ++row) {
      Random random(1, static_cast<std::uint64_t>(state.step), state.id[row], Purpose::velocity);
      const Vec back = (scene.bodies.velocity[row] - state.velocity[row]) / kRelaxation;
      state.velocity[row] += kFrame * (back + kPush * normal_vec(random));
      state.position[row] += kFrame * state.velocity[row];
    }
    states.push_back(std::move(state));
  }
  return states;
}

}  // namespace throng::bench
