// SPDX-License-Identifier: MIT
#pragma once

/// How contacts learn what they bear. A spring gives way to its load, in a pile each layer more; what a
/// contact has learnt, its preload, it bears without, so that what has stood for a while has hardly sunk.
namespace throng {

struct Learning {
  double share;   ///< of what is missing, in a step
  double weight;  ///< m/s, what gravity gives in a substep: times the mass that is felt, its own weight
  double slow;    ///< m/s: bodies that pass each other faster don't stay together for 300 substeps
  double left;    ///< of a load, to the spring: learnt to the last, piles creep
  double most;    ///< own weights: what bears more swings too slowly

  /// The preload after a step that ended with that impulse (N s), never more than it. Some of a load is left
  /// to the spring, which brings to rest what friction leaves undetermined.
  /// `speed_squared` (m²/s²): of b against a.
  double operator()(double preload, double normal_impulse, double normal_mass, double speed_squared) const;
};

inline constexpr double kFewLayers = 49.0;  ///< as many and fewer learn alike

/// What is learnt lags behind what is borne, and so feeds a swing, by the square of how long that lasts. The
/// slowest swing of what stands lasts as long as it has layers: contacts learn more slowly by the square of
/// their number, where they aren't few, but not more slowly than they must: what came down, and overlaps,
/// would rise for long while it learns, and all of it rub upwards along its walls. (By springs of
/// kContactHertz and kContactDamping 0.0072 substeps for each layer squared are the least; in heaps of discs
/// of 218 and 470 layers, 0.025 bring to rest and 0.011 don't.) `weight` (m/s): what gravity gives in a
/// substep of `h` (s), of which a step has `substeps`; `radius` (m): of what may touch, on average.
Learning learning_in(double layers, double weight, double h, int substeps, double radius);

}  // namespace throng
