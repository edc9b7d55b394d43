// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "sim/contact/block_order.h"
#include "sim/contact/soft_bodies.h"
#include "sim/contact/soft_law.h"

/// Soft contacts of discs, as many at a time as the machine has lanes. What they compute is what soft_law.h
/// does, to the last bit.
namespace throng {

/// Eight pairs of discs that may touch within the step, a row per quantity. A lane without a pair has no
/// radii and twice the same body: it never touches.
struct alignas(64) SoftBlock {
  using Row = double[BlockOrder::kWidth];

  std::uint32_t a[BlockOrder::kWidth], b[BlockOrder::kWidth];  ///< places of the bodies
  Row radius_a, radius_b;                                      ///< m
  Row stiffness, damping, friction, rolling, roll_radius;      ///< as in SoftPair
  Row touching;                                                ///< in this substep: 1, else 0
  Row normal_x, normal_y;                                      ///< from a to b
  Row depth;                                                   ///< m, in the middle of the substep
  Row slip, roll;                                              ///< as in SoftSprings
  Row force;  ///< N, along the normal, where they touch in a step's last substep
};

/// Where the domain repeats: the way to the images of eight b that are nearest to their a, m.
struct alignas(64) SoftShifts {
  SoftBlock::Row x, y;
};

/// Which law, for all contacts.
struct SoftLaw {
  bool hertz, rolls;
  SoftRatios tangential;
};

/// Finds who touches in this substep, and adds how they push by the velocities of its beginning. No `shifts`
/// where the domain doesn't repeat. Notes in `squeeze` who is in each other too deep.
void press_soft(std::span<SoftBlock> blocks, std::span<const SoftShifts> shifts, const SoftLaw& law,
                const SoftSubstep& now, SoftSqueeze& squeeze);

/// The same for who touches by the velocities of the middle: springs give where friction doesn't hold them.
void press_soft_again(std::span<SoftBlock> blocks, const SoftLaw& law, const SoftSubstep& now);

/// Stretches the springs to the end of the substep, by the velocities of then.
void stretch_soft(std::span<SoftBlock> blocks, const SoftLaw& law, const SoftSubstep& now);

}  // namespace throng
