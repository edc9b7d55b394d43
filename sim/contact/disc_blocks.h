// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "sim/contact/block_order.h"
#include "sim/contact/solve.h"

/// Contacts of discs, as many at a time as the machine has lanes. What they compute is what solve.h does, to
/// the last bit.
namespace throng {

/// Eight contacts, a row per quantity. A lane without a contact has no mass and two bodies that don't move.
struct alignas(64) DiscBlock {
  using Row = double[BlockOrder::kWidth];

  std::uint32_t a[BlockOrder::kWidth], b[BlockOrder::kWidth];  ///< rows of the bodies
  Row normal_x, normal_y;
  Row image;       ///< m, along the normal, from b to its image that is nearest to a; in domains that repeat
  Row separation;  ///< m, before bodies move
  Row normal_mass, tangent_mass, friction;  ///< as in ContactBase
  Row normal_impulse, tangent_impulse;      ///< N s
  Row radius_a, radius_b;                   ///< m
  Row turn_a, turn_b;                       ///< 1/(kg m), radius over moment of inertia
};

class DiscBlocks {
 public:
  /// Forgets all contacts. `free_from` and `base` as BlockOrder::start; `nobody`: a row that never moves.
  void start(std::span<std::uint32_t> free_from, std::uint32_t base, std::uint32_t nobody);

  /// Adds a contact between those bodies and returns its seat. Allocates only to grow.
  std::uint32_t add(const DiscContact& contact, const SolverBody& a, const SolverBody& b);

  /// To be called behind the last.
  void finish();

  double normal_impulse(std::uint32_t seat) const;   ///< N s, of the contact that has this seat
  double tangent_impulse(std::uint32_t seat) const;  ///< N s

  /// Its bodies, radii, normal and impulses as the solver left them; what else a contact has is not set.
  DiscContact operator[](std::uint32_t seat) const;

  std::span<DiscBlock> blocks() { return {blocks_.data(), order_.blocks()}; }

 private:
  BlockOrder order_;
  std::uint32_t nobody_ = 0;
  std::vector<DiscBlock> blocks_;  // never shrinks
};

/// As the two of solve.h, one after the other. `period`: the domain's, or null.
void prepare_and_start(std::span<DiscBlock> blocks, std::span<SolverBody> bodies, const Vec* period);

/// As those of solve.h.
void push_apart(std::span<DiscBlock> blocks, std::span<SolverBody> bodies, const SolverSettings& settings);
void relax(std::span<DiscBlock> blocks, std::span<SolverBody> bodies, const SolverSettings& settings,
           bool periodic);

}  // namespace throng
