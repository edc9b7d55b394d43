// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <span>

#include "broadphase/neighbours.h"
#include "sim/crowd/barriers.h"

/// How agents decide how to walk. A model is one file: a class that answers for one agent at a time, and what
/// scenario files may set of it; its name joins the list in models.cpp.
namespace throng {

/// The crowd as it is before the step, which every agent reads and none changes: the answers depend on no
/// order. A row per agent.
struct CrowdView {
  double dt;                                      ///< s
  std::span<const Vec> position, velocity;        ///< m, m/s
  std::span<const Vec> towards;                   ///< unit vector of the way to the goal; zero in it
  std::span<const double> radius, desired_speed;  ///< m, m/s
  const broadphase::NeighbourLists& near;         ///< others by their centres' distance, ascending; as far as
                                                  ///< the farthest `reach` of all models in use
  const Barriers& barriers;
};

class WalkingModel {
 public:
  virtual ~WalkingModel() = default;

  /// The velocity (m/s) with which the agent goes through this step. Expects that it reads what is within
  /// `reach` alone.
  virtual Vec velocity(const CrowdView& crowd, std::uint32_t row) const = 0;

  /// m, how far from centre to centre others matter where no radius is above `largest_radius` (m); 0: the
  /// model looks at nobody.
  virtual double reach(double largest_radius) const = 0;

  /// The longest step (s) that the model bears for an agent of that radius (m) and desired speed (m/s).
  virtual double longest_step(double radius, double desired_speed) const = 0;

  /// What of its radius keeps out of barriers whatever happens; the rest is left to the model's own forces.
  virtual double core() const { return 1.0; }
};

/// A number that scenario files may set for a group of agents.
struct ModelParameter {
  const char* key;
  double preset, low, high;
  const char* unit;
  const char* doc;
};

struct ModelKind {
  const char* name;  ///< in scenario files, of the model and of the table of its parameters
  const char* doc;
  std::span<const ModelParameter> parameters;
  /// Expects a value for each parameter.
  std::unique_ptr<WalkingModel> (*make)(std::span<const double> values);
};

/// All that there are.
std::span<const ModelKind> walking_models();

}  // namespace throng
