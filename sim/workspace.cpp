// SPDX-License-Identifier: MIT
#include "sim/workspace.h"

#include <numeric>

namespace throng {

namespace {

constexpr double kContactHertz = 0.18;  // of the substep's rate: stiffer, tall pyramids tremble
constexpr double kContactDamping = 20.0;
constexpr double kAjar = 2.0;     // of the way that gravity gives in a substep, g h²
constexpr double kPushOut = 2.0;  // radii a second: the fastest that overlap is undone

double mean_radius_of(const Colliders& colliders) {
  const double sum = std::accumulate(colliders.radius.begin(), colliders.radius.end(), 0.0);
  return colliders.radius.empty() ? 0.0 : sum / static_cast<double>(colliders.size());
}

}  // namespace

Workspace::Workspace(const Scene& scene, const Plan& plan, int threads)
    : workers(threads),
      candidates(scene, plan, workers),
      sleepers(scene, plan),
      flights(scene, plan),
      soft(scene, plan),
      finder(scene, plan, candidates.colliders()),
      bodies(scene.bodies.size() + finder.parts().groups()),
      free_fall(scene, bodies.size()),
      unseen(candidates, scene.time.dt),
      mean_radius(mean_radius_of(candidates.colliders())),
      crowd(scene),
      sensing(scene, threads) {
  if (plan.contacts() && !plan.crowd && !plan.soft) guard.emplace(scene, plan, candidates);
  for (SolverBody& body : bodies.rows().by_slot()) body = {Vec(0.0, 0.0), 0.0, 0.0, Vec(0.0, 0.0), 0.0, 0.0};
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    if (scene.bodies.kind[i] != BodyKind::dynamic) continue;
    bodies[i].inverse_mass = 1.0 / mass(scene, i);
    if (plan.rotation) bodies[i].inverse_inertia = 1.0 / inertia(scene, i);
  }
  const double h = plan.substep;
  const Softness spring = softness(kContactHertz / h, kContactDamping, h);
  const double ajar = plan.gravity ? kAjar * scene.gravity.norm() * h * h : 0.0;
  solver = {h, spring, {}, kPushOut * mean_radius, plan.friction, ajar};
}

}  // namespace throng
