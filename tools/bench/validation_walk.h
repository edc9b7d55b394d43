// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <limits>
#include <map>
#include <string>
#include <vector>

#include "sim/simulation.h"

/// Walks the scenarios of tools/bench/validation/ with one model, and keeps what the cases look at.
namespace throng::bench {

inline constexpr double kNever = std::numeric_limits<double>::infinity();

/// A model with its paper's parameters, or with a preset of them.
struct Walker {
  std::string model, preset;

  std::string name() const { return preset.empty() ? model : model + " " + preset; }
};

/// All models, and after each its presets.
std::vector<Walker> walkers();

/// A run until everybody has arrived, or to the scenario's end.
struct Walked {
  Scene scene;
  std::vector<double> arrival;                 ///< s, of each agent; kNever
  std::vector<double> set_out;                 ///< s, when it must have begun to walk as fast as it wants
  std::vector<Vec> last;                       ///< m, of each agent: where it was seen last
  std::vector<std::vector<double>> crossings;  ///< s, of each line: when each first crossed it forward
  std::vector<std::vector<double>> crossed;    ///< s, of each such line and agent: when first; kNever
  std::vector<Measured> measured;              ///< as Crowd::measures
  double outside = 0.0;                        ///< m, the farthest that anybody's middle was off the floor

  std::size_t missing() const;  ///< who hasn't arrived
  double last_arrival() const;  ///< s; kNever where somebody hasn't arrived
};

/// Called after each step.
using Look = std::function<void(const Scene&, const State&)>;

class Trials {
 public:
  /// `fields`: "KEY=VALUE", of all agents.
  Trials(Walker walker, std::string folder, std::vector<std::string> fields)
      : walker_(std::move(walker)), folder_(std::move(folder)), fields_(std::move(fields)) {}

  const Walker& walker() const { return walker_; }

  /// What `measure` returns, which several cases look at under that name: it is asked once.
  const std::vector<std::vector<double>>& once(
      const std::string& name, const std::function<std::vector<std::vector<double>>()>& measure) const;

  /// Walks the scenario of that name in the folder, with these values for its fields ("PATH=VALUE").
  /// Throws InputError where it has faults, with all of them.
  Walked walk(const std::string& scenario, std::vector<std::string> overrides = {},
              const Look& look = {}) const;

 private:
  Walker walker_;
  std::string folder_;
  std::vector<std::string> fields_;
  mutable std::map<std::string, std::vector<std::vector<double>>> known_;
};

}  // namespace throng::bench
