// SPDX-License-Identifier: MIT
#include "sim/learn_loads.h"

#include <algorithm>
#include <limits>
#include <span>

#include "sim/contact/first_loads.h"
#include "sim/contact/learning.h"
#include "sim/contact/pressed.h"

namespace throng {

namespace {

/// How high the highest of those stands above the lowest (m), of dynamic bodies.
template <class F>
double height(const Scene& scene, const Workspace& work, F counts) {
  const Vec up = -scene.gravity.normalized();
  double lowest = std::numeric_limits<double>::infinity(), highest = -lowest;
  work.sleepers.bodies().for_each([&](std::uint32_t i) {
    if (work.bodies[i].inverse_mass == 0.0 || !counts(i)) return;
    const double at = up.dot(work.bodies[i].position);
    lowest = std::min(lowest, at), highest = std::max(highest, at);
  });
  return std::max(highest - lowest, 0.0);
}

/// How contacts learn whose bodies stand as high as now. Where that seems so high that it matters, those
/// count alone that something presses: who falls far from a tower, and touches nobody, changes nothing in it.
Learning learning(const Scene& scene, const State& state, Workspace& work) {
  const auto layers = [&](double height) { return 1.0 + height / (2.0 * work.mean_radius); };
  double most = layers(height(scene, work, [](std::uint32_t) { return true; }));
  if (most > kFewLayers && state.step > 0) {
    find_pressed(state, work.candidates.colliders(), work.pressed);
    most = layers(height(scene, work, [&](std::uint32_t i) { return work.pressed[i] != 0; }));
  }
  const double weight = scene.gravity.norm() * work.solver.h;
  return learning_in(most, weight, work.solver.h, scene.time.substeps, work.mean_radius);
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
  work.workers.for_each(work.finder.parts().groups(), [&](std::size_t group) {
    learn(work.contacts.discs.blocks(group), work.bodies, work.solver.learning);
    learn(work.contacts.faces.blocks(group), work.bodies, work.solver.learning);
  });
}

}  // namespace throng
