// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <span>

#include "sim/scene.h"
#include "sim/state.h"

namespace throng {

/// Who senses whom: all whose centres are within a sensor's radius and view and whom nothing hides that the
/// sensor heeds. The answers are those that `throng query` gives for the same state, in order of id; they are
/// the same for any number of threads. A scene without sensors pays nothing, and one that records none keeps
/// no lists.
class Sensing {
 public:
  /// `scene` must outlive this.
  Sensing(const Scene& scene, int threads);
  ~Sensing();

  /// Looks with all sensors that are due at the state's step, and adds what they sense to state.sensed.
  /// O(n log n + k log k), k = the sensed of all; where walls or bodies hide, and what they are asked for
  /// each. Beside what is recorded it takes 24 bytes for each answer of 4096 who ask.
  void sense(State& state);

  /// The same without counting.
  void look(const State& state);

  /// What each recorded sensor of the scene found in the last look; nothing for those that weren't due then.
  std::span<const Sensed> sensed() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace throng
