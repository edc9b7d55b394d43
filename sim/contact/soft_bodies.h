// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "sim/contact/contact.h"
#include "sim/contact/soft_law.h"

/// What soft contacts read of bodies and add to them, by their places (SoftPlaces): one for each body and one
/// for all obstacles.
namespace throng {

/// What pushes a body in a substep.
struct alignas(32) SoftPush {
  Vec force{0.0, 0.0};  ///< N
  double torque = 0.0;  ///< N m
  double none = 0.0;    ///< makes it four, as lanes take them
};

/// How a body moves in the middle of a substep: dashpots feel that.
struct alignas(32) SoftSpeed {
  Vec velocity{0.0, 0.0};  ///< m/s
  double spin = 0.0;       ///< rad/s
  double none = 0.0;       ///< as above
};

/// How far a body got from where the step began.
struct SoftWay {
  Vec from{0.0, 0.0};      ///< m
  double farthest2 = 0.0;  ///< m²
};

/// One substep, as contacts see it.
struct SoftSubstep {
  bool first, last;                    ///< of its step
  double h;                            ///< s
  double past;                         ///< s, how long ago a contact that is new may have begun
  double fringe;                       ///< m, how much nearer two may come before it ends
  std::span<const SolverBody> bodies;  ///< in its middle, with the velocities of its beginning
  std::span<const SoftSpeed> speeds;   ///< of its middle
  std::span<SoftPush> pushes;          ///< added to
};

/// Two places of bodies that are deeper in each other than springs can tell of; none: both 0.
struct SoftSqueeze {
  std::uint32_t a = 0, b = 0;
  double depth = 0.0;  ///< m

  static constexpr double kMost = 0.5;  ///< of the smaller radius

  void note(std::uint32_t place_a, std::uint32_t place_b, double how_deep) {
    if (how_deep > depth) a = place_a, b = place_b, depth = how_deep;
  }
};

}  // namespace throng
