// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "sim/simulation.h"
#include "tools/bench/accuracy/body_state.h"

/// How far a run is off what is right.
namespace throng::bench {

/// The error of the case first, then what else was seen.
using Figures = std::vector<std::pair<std::string, double>>;

/// Looks at one run.
class Judge {
 public:
  virtual ~Judge() = default;
  virtual void look(double time, const Simulation& simulation) = 0;  ///< after each step, at its time (s)
  virtual Figures figures() const = 0;
};

/// Makes a new judge for a run of the scene, which must outlive it.
using JudgeMaker = std::function<std::unique_ptr<Judge>(const Scene& scene)>;

/// Where all bodies are at a time (s), in the order of the scene.
using Truth = std::function<std::vector<BodyState>(double time)>;

/// Trajectory error: the root mean square, over dynamic bodies and the times k * every (s), of how far the
/// body's place is off the truth and, where angles are `turns`, a point on its rim too; in units of its
/// radius. In a domain that repeats to the nearest image. `error_end` is the same at the last of these times
/// alone.
std::unique_ptr<Judge> trajectory_judge(const Scene& scene, Truth truth, double every, bool turns = true);

/// The bodies as a scene has them at its beginning.
std::vector<BodyState> states_of(const Scene& scene);

}  // namespace throng::bench
