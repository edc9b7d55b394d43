// SPDX-License-Identifier: MIT
#pragma once

#include "tools/bench/accuracy/judge.h"

/// Judges of elastic gases.
namespace throng::bench {

/// Collisions a disc and second, by what every engine shows: the discs whose velocity changed in a step. Who
/// collides at random at a rate v has collided in a step with the probability 1 - exp(-v dt).
class CollisionRate {
 public:
  void look(double time, const State& state);
  double rate() const;            ///< 1/s
  double relative_error() const;  ///< of statistics: each collision is seen twice

 private:
  std::vector<Eigen::Vector2d> before_;  // m/s
  double changed_ = 0.0, seen_ = 0.0;    // discs and steps
  double last_ = 0.0, dt_ = 0.0;         // s
};

/// Relative error of the collision rate, held against `expected(dt)` (1/s), which is seen in the same way at
/// the same dt. Also: `rate`, `statistical` (its relative error), `temperature`, the relative change of the
/// mean energy, and `kurtosis`, of the speeds: how far the mean fourth power is off twice the squared mean
/// square, as Maxwell has it.
std::unique_ptr<Judge> rate_judge(const Scene& scene, std::function<double(double dt)> expected);

/// The same, held against Enskog's rate of the scene's discs, which are equal and fly where the domain
/// repeats. `seen(dt)` says what share of all collisions CollisionRate sees at that dt; where an engine
/// counts its collisions, they count. Also `compressibility`, by the rate, and `theory`, what it should be.
std::unique_ptr<Judge> theory_judge(const Scene& scene, std::function<double(double dt)> seen);

/// 1/s, of each disc, as an engine that counts its collisions has had them so far.
double counted_rate(const Scene& scene, const Simulation& simulation);

/// The largest relative change of the kinetic energy at any step.
std::unique_ptr<Judge> energy_judge(const Scene& scene);

/// How much the momentum of all changes at most, over the sum of masses times speeds at first.
std::unique_ptr<Judge> momentum_judge(const Scene& scene);

/// How far the distribution of speeds, over all looks, is off Maxwell's of the same mean square: the largest
/// difference of the two, summed up from 0 (Kolmogorov's distance).
std::unique_ptr<Judge> speed_judge(const Scene& scene);

}  // namespace throng::bench
