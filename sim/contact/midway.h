// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "narrowphase/manifold.h"
#include "sim/contact/look_ahead.h"
#include "sim/contact/stumbles.h"
#include "sim/contact/touch.h"
#include "sim/workers.h"

namespace throng {

/// Discs that slide along a wall that bends, in pieces that hardly turn. Their contacts are found where they
/// are in the step's middle: normals of its beginning lag behind by half a step, which in a hollow of radius
/// R gives g dt / (2 R) of the energy a second.
///
/// All walls that such a disc touches, at either time, are one to 0.02 rad; none is a stumble or neared fast;
/// and it gets no farther than a quarter of its radius to the middle. Who is thrown back within the step is
/// held no less than by 0.02 of its way.
class Midway {
 public:
  /// A step of `dt` (s), and what its touches' contacts are as it begins.
  struct Step {
    double dt;
    const StepStart& start;
    std::span<const Touch> touches;
    const LookAhead& ahead;
    const Stumbles& stumbles;
  };

  explicit Midway(const Step& step) : step_(step) {}

  /// Replaces the manifolds of these discs, and the numbers of their points. Distances are those of the
  /// step's beginning. O(touches of walls).
  void look(std::span<narrowphase::Manifold> manifolds, std::span<std::uint8_t> points,
            Workers& workers) const;

 private:
  void look_at_disc(std::size_t begin, std::size_t end, std::span<narrowphase::Manifold> manifolds,
                    std::span<std::uint8_t> points) const;
  Vec way(const Touch& touch) const;
  bool is_along(const narrowphase::Manifold& m, const Vec& normal, const Touch& touch) const;
  bool is_settled(std::size_t touch) const;
  narrowphase::Manifold manifold(const Touch& touch) const;

  Step step_;
};

}  // namespace throng
