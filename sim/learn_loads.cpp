// SPDX-License-Identifier: MIT
#include "sim/learn_loads.h"

#include <algorithm>
#include <limits>

#include "sim/contact/first_loads.h"
#include "sim/contact/learning.h"
#include "sim/contact/pressed.h"

namespace throng {

namespace {

/// How high the highest of some bodies stands above the lowest, and which they are.
struct Height {
  double lowest = std::numeric_limits<double>::infinity(), highest = -lowest;  // m
  std::uint32_t lowest_body = 0, highest_body = 0;

  void add(std::uint32_t body, double at) {
    if (at < lowest) lowest = at, lowest_body = body;
    if (at > highest) highest = at, highest_body = body;
  }
  double layers(double radius) const { return 1.0 + std::max(highest - lowest, 0.0) / (2.0 * radius); }
};

/// Of dynamic bodies of which f(row) is true.
template <class F>
Height height(const Scene& scene, const Workspace& work, F counts) {
  const Vec up = -scene.gravity.normalized();
  Height height;
  work.sleepers.bodies().for_each([&](std::uint32_t i) {
    if (work.bodies[i].is_dynamic() && counts(i)) height.add(i, up.dot(work.bodies[i].position));
  });
  return height;
}

/// How contacts learn whose bodies stand as high as now. Where that seems so high that it matters, those
/// count alone that something presses: who falls far from a tower, and touches nobody, changes nothing in it.
Learning learning(const Scene& scene, const State& state, Workspace& work) {
  const Colliders& colliders = work.candidates.colliders();
  Height all = height(scene, work, [](std::uint32_t) { return true; });
  const bool matters = all.layers(work.mean_radius) > kFewLayers && state.step > 0;
  if (matters && !are_pressed(state, colliders, all.highest_body, all.lowest_body)) {
    find_pressed(state, colliders, work.pressed);
    all = height(scene, work, [&](std::uint32_t i) { return work.pressed[i] != 0; });
  }
  const double weight = scene.gravity.norm() * work.solver.h;
  return learning_in(all.layers(work.mean_radius), weight, work.solver.h, scene.time.substeps,
                     work.mean_radius);
}

void find_first_loads(const Scene& scene, const Plan& plan, Workspace& work) {
  const Vec kick = work.solver.h * scene.gravity;
  const Vec size = scene.domain.max - scene.domain.min, *period = plan.periodic ? &size : nullptr;
  find_first_loads(work.contacts, work.finder.parts(), work.bodies, work.solver, kick, period, work.workers);
}

}  // namespace

void prepare_to_learn(const Scene& scene, const Plan& plan, const State& state, Workspace& work) {
  work.solver.learning = learning(scene, state, work);
  if (state.step == 0) find_first_loads(scene, plan, work);
}

void learn_loads(Workspace& work) {
  work.workers.for_few(work.finder.parts().groups(), [&](std::size_t group) {
    learn(work.contacts.discs.blocks(group), work.bodies, work.solver.learning);
    learn(work.contacts.faces.blocks(group), work.bodies, work.solver.learning);
  });
}

}  // namespace throng
