// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <span>

#include "sim/crowd/barriers.h"
#include "sim/crowd/crowd_cells.h"

/// How agents decide how to walk. A model is one file: a class that answers for the agents that have it, and
/// what scenario files may set of it; its name joins the list in models.cpp.
namespace throng {

/// Of the agents of a crowd, be they there or not.
struct Largest {
  double radius = 0.0, desired_speed = 0.0;  ///< m, m/s
};

/// The crowd as it is before the step, which every agent reads and none changes: the answers depend on no
/// order. Agents by their places in `cells`; behind the last one all arrays go on for kPadding numbers, which
/// may be read. Who is near, and behind no barrier, is gathered by Others of near-inl.h.
struct CrowdView {
  double dt;           ///< s
  std::uint64_t seed;  ///< of the scene
  std::int64_t step;
  const CrowdCells& cells;
  std::span<const double> x, y;                    ///< m
  std::span<const double> velocity_x, velocity_y;  ///< m/s
  std::span<const double> towards_x, towards_y;   ///< of the way to the goal, 1 long up to 0.0015; zero in it
  std::span<const double> radius, desired_speed;  ///< m, m/s
  std::span<const double> id;
  std::span<const double> clear;  ///< m: no barrier is nearer
  Largest largest;
  const Barriers& barriers;

  static constexpr std::size_t kPadding = 8;

  Vec position(std::uint32_t place) const { return {x[place], y[place]}; }
  Vec velocity(std::uint32_t place) const { return {velocity_x[place], velocity_y[place]}; }
  bool is_clear(std::uint32_t place, double reach) const { return clear[place] > reach; }
  Vec towards(std::uint32_t place) const { return {towards_x[place], towards_y[place]}; }
};

class WalkingModel {
 public:
  virtual ~WalkingModel() = default;

  /// Writes the velocities (m/s) with which the agents at these places go through this step to their places.
  /// Expects that it reads what is within `reach` alone. Called for parts of the crowd at the same time.
  virtual void steer(const CrowdView& crowd, std::span<const std::uint32_t> places,
                     std::span<Vec> velocity) const = 0;

  /// m, how far from centre to centre others matter; 0: the model looks at nobody.
  virtual double reach(const Largest& largest) const = 0;

  /// The longest step (s) that the model bears for an agent of that radius (m) and desired speed (m/s).
  virtual double longest_step(double radius, double desired_speed) const = 0;

  /// Whether who wants nowhere stands still, whoever is near; else others push him, and who is to stay at a
  /// place must go on wanting to it.
  virtual bool stands_at_will() const { return true; }

  /// What of its radius keeps out of barriers whatever happens; the rest is left to the model's own forces.
  virtual double core() const { return 1.0; }
};

/// A number that scenario files may set for a group of agents, or have drawn for each.
struct ModelParameter {
  const char* key;
  double preset, low, high;
  const char* unit;
  const char* doc;
  bool is_whole = false;  ///< a whole number
};

/// Values of all parameters that belong together, which scenario files may start from.
struct ModelPreset {
  const char* name;
  const char* doc;                 ///< what they are for, and where they come from
  std::span<const double> values;  ///< as the parameters
};

struct ModelKind {
  const char* name;  ///< in scenario files, of the model and of the table of its parameters
  const char* doc;
  std::span<const ModelParameter> parameters;
  /// Expects a value for each parameter.
  std::unique_ptr<WalkingModel> (*make)(std::span<const double> values);
  std::span<const ModelPreset> presets = {};
};

/// All that there are.
std::span<const ModelKind> walking_models();

}  // namespace throng
