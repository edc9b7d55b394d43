// SPDX-License-Identifier: MIT
#pragma once

/// How contacts learn what they bear. A spring gives way to its load, in a pile each layer more; what a
/// contact has learnt, its preload, it bears without, so that what has stood for a while has hardly sunk.
namespace throng {

struct Learning {
  double share;   ///< of what is missing, in a step
  double weight;  ///< m/s, what gravity gives in a substep: times the mass that is felt, its own weight
  double slow;    ///< m/s: bodies that pass each other faster don't stay together for as long as it takes
  double left;    ///< of a load, to the spring: learnt to the last, piles creep
  double most;    ///< own weights: what bears more swings too slowly

  /// The preload after a step that ended with that impulse (N s), never more than it. Some of a load is left
  /// to the spring, which brings to rest what friction leaves undetermined.
  /// `speed_squared` (m²/s²): of b against a.
  double operator()(double preload, double normal_impulse, double normal_mass, double speed_squared) const;
};

/// What stands in so many layers sinks and rises as a whole in some four substeps for each of them, by
/// springs of the frequency that contacts have. What learns as fast as that is thrown up by what stopped its
/// fall, on and on. So it learns more slowly, and the more layers, the less of a load is left to the springs:
/// what they give way to adds up. `weight` (m/s): what gravity gives in a substep of `h` (s), of which a step
/// has `substeps`; `radius` (m): of the scene's bodies, on average.
Learning learning_in(double layers, double weight, double h, int substeps, double radius);

}  // namespace throng
