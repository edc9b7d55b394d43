// SPDX-License-Identifier: MIT
#include "sim/observe.h"

#include <algorithm>
#include <cmath>

#include "sim/crowd/walk.h"
#include "sim/measure/measured_bodies.h"

namespace throng {

namespace {

bool same(const std::vector<double>& a, const std::vector<double>& b) {
  return std::ranges::equal(a, b,
                            [](double x, double y) { return x == y || (std::isnan(x) && std::isnan(y)); });
}

std::optional<CrowdObservables> observe_crowd(const Scene& scene, const State& state) {
  if (scene.crowd.size() == 0) return std::nullopt;
  CrowdObservables result{
      static_cast<double>(state.id.size() - scene.crowd.first), static_cast<double>(state.crowd.arrived), {}};
  for (std::size_t i = 0; i < scene.crowd.measures.size(); ++i)
    append_columns(scene.crowd.measures[i], state.crowd.measured[i],
                   {std::span(state.position).subspan(scene.crowd.first),
                    std::span(state.velocity).subspan(scene.crowd.first), state.step, scene.time.dt,
                    scene.crowd.walkable},
                   result.measures);
  return result;
}

}  // namespace

bool operator==(const CrowdObservables& a, const CrowdObservables& b) {
  return a.agents == b.agents && a.arrived == b.arrived && same(a.measures, b.measures);
}

bool operator==(const Observables& a, const Observables& b) {
  return a.kinetic_energy == b.kinetic_energy && a.potential_energy == b.potential_energy &&
         a.momentum == b.momentum && a.contacts == b.contacts && a.max_overlap == b.max_overlap &&
         a.mean_overlap == b.mean_overlap && a.crowd == b.crowd && same(a.asked, b.asked);
}

Observables Observer::observe(const State& state, std::span<const ContactRow> contacts) {
  const Overlap overlap = overlaps_.of(state);
  return {kinetic_energy(scene_, state),
          potential_energy(scene_, state),
          momentum(scene_, state),
          static_cast<double>(std::ranges::count_if(contacts, &ContactRow::presses)),
          overlap.max,
          overlap.mean,
          observe_crowd(scene_, state),
          measure_bodies(scene_, state, contacts)};
}

double kinetic_energy(const Scene& scene, const State& state) {
  double sum = 0.0;
  for_dynamic(scene, [&](std::size_t row) {
    sum += 0.5 * mass(scene, row) * state.velocity[row].squaredNorm() +
           0.5 * inertia(scene, row) * state.spin[row] * state.spin[row];
  });
  return sum;
}

double potential_energy(const Scene& scene, const State& state) {
  double sum = 0.0;
  for_dynamic(scene,
              [&](std::size_t row) { sum -= mass(scene, row) * scene.gravity.dot(state.position[row]); });
  return sum;
}

Vec momentum(const Scene& scene, const State& state) {
  Vec sum(0.0, 0.0);
  for_dynamic(scene, [&](std::size_t row) { sum += mass(scene, row) * state.velocity[row]; });
  return sum;
}

}  // namespace throng
