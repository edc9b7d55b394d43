// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "sim/contact_row.h"
#include "sim/overlap.h"
#include "sim/scene.h"
#include "sim/state.h"

/// What is measured on a state, whichever engine made it.
namespace throng {

/// What is measured of a crowd.
struct CrowdObservables {
  double agents = 0.0;           ///< that are there
  double arrived = 0.0;          ///< that got to their goals and left, so far
  std::vector<double> measures;  ///< of each measure of the scene its columns (crowd/measure.h)

  friend bool operator==(const CrowdObservables& a, const CrowdObservables& b);  ///< NaN is NaN
};

/// What a recording measures of a state.
struct Observables {
  double kinetic_energy = 0.0, potential_energy = 0.0;  ///< J
  Vec momentum{0.0, 0.0};                               ///< kg m/s
  double contacts = 0.0;                                ///< points that press
  double max_overlap = 0.0, mean_overlap = 0.0;         ///< m
  std::optional<CrowdObservables> crowd = {};           ///< where there are agents
  std::vector<double> asked = {};                       ///< as measure_bodies() has them

  friend bool operator==(const Observables& a, const Observables& b);  ///< NaN is NaN
};

/// Measures states of one scene, which must outlive it.
class Observer {
 public:
  explicit Observer(const Scene& scene) : scene_(scene), overlaps_(scene) {}

  /// Of all bodies, whose contacts are given; of a state's crowd what was measured and who arrived count.
  /// Dominated by overlaps, whose pairs are looked for anew: about what ten steps take.
  Observables observe(const State& state, std::span<const ContactRow> contacts);

 private:
  const Scene& scene_;
  Overlaps overlaps_;
};

double kinetic_energy(const Scene& scene, const State& state);    ///< J, of dynamic bodies
double potential_energy(const Scene& scene, const State& state);  ///< J, -m g . x, of dynamic bodies
Vec momentum(const Scene& scene, const State& state);             ///< kg m/s, of dynamic bodies

}  // namespace throng
