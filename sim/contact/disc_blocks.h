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
  /// Forgets all contacts. `bodies`: how many rows there are, of which the last never moves.
  void start(std::size_t bodies);

  /// Adds a contact between those bodies. Allocates only to grow.
  void add(const DiscContact& contact, const SolverBody& a, const SolverBody& b);

  /// To be called behind the last.
  void finish();

  std::size_t size() const { return lane_.size(); }
  double normal_impulse(std::size_t i) const;   ///< N s, of the i-th contact that was added
  double tangent_impulse(std::size_t i) const;  ///< N s

  /// Its bodies, radii, normal and impulses as the solver left them; what else a contact has is not set.
  DiscContact operator[](std::size_t i) const;

  std::span<DiscBlock> blocks() { return {blocks_.data(), order_.blocks()}; }

 private:
  BlockOrder order_;
  std::uint32_t nobody_ = 0;
  std::vector<std::uint32_t> lane_;  // of each contact
  std::vector<DiscBlock> blocks_;    // never shrinks
};

/// As the two of solve.h, one after the other. `period`: the domain's, or null.
void prepare_and_start(std::span<DiscBlock> blocks, std::span<SolverBody> bodies, const Vec* period);

/// As those of solve.h.
void push_apart(std::span<DiscBlock> blocks, std::span<SolverBody> bodies, const SolverSettings& settings);
void relax(std::span<DiscBlock> blocks, std::span<SolverBody> bodies, const SolverSettings& settings,
           bool periodic);

}  // namespace throng
