// SPDX-License-Identifier: MIT
#pragma once

#include <cassert>
#include <span>
#include <vector>

#include "sim/contact/block_order.h"
#include "sim/contact/body_rows.h"
#include "sim/contact/solve.h"
#include "sim/workers.h"

/// Contacts of discs, as many at a time as the machine has lanes. What they compute is what solve.h does, to
/// the last bit.
namespace throng {

/// Eight contacts, a row per quantity. A lane without a contact has no mass and two bodies that don't move.
struct alignas(64) DiscBlock {
  using Row = double[BlockOrder::kWidth];

  std::uint32_t a[BlockOrder::kWidth], b[BlockOrder::kWidth];  ///< slots of the bodies
  Row normal_x, normal_y;
  Row image;       ///< m, along the normal, from b to its image that is nearest to a; in domains that repeat
  Row separation;  ///< m, before bodies move
  Row normal_mass, tangent_mass, friction;  ///< as in ContactBase
  Row normal_impulse, tangent_impulse;      ///< N s
  Row preload;                              ///< N s, as in ContactBase
  Row radius_a, radius_b;                   ///< m
  Row turn_a, turn_b;                       ///< 1/(kg m), radius over moment of inertia
};

/// Each contact has a seat, a lane of some block, and seats outlive the step: the order of blocks is that of
/// the keys whichever of the seats are taken, so the bits don't depend on which are there.
class DiscBlocks {
 public:
  /// Forgets all seats. `bodies`: how many rows there are, of which the last `groups` never move; `slots`:
  /// where they stand, for as long as there are seats.
  void start(std::size_t bodies, std::size_t groups = 1, const BodySlots& slots = kOwnSlots);

  /// Makes a seat, and takes it, for a contact between those bodies, whose key is above all before. Blocks
  /// hold contacts of one group. Allocates only to grow.
  void add(std::uint64_t key, const DiscContact& contact, const SolverBody& a, const SolverBody& b,
           std::size_t group = 0);

  /// To be called behind the last.
  void finish();

  /// The contacts are now those with these keys, which ascend, without impulses. False where one of them has
  /// no seat: then all must be seated anew. Expects that nothing but impulses of a seat's contact has
  /// changed. O(seats).
  bool take(std::span<const std::uint64_t> keys, Workers& workers);

  /// There are no contacts; seats stay.
  void clear() { lane_.clear(); }

  /// Of the i-th contact, N s.
  void set_impulses(std::size_t i, const BlockImpulses& impulses);

  BlockContact contact(std::size_t i);  ///< the i-th

  std::size_t seats() const { return key_.size(); }
  std::size_t size() const { return lane_.size(); }
  double normal_impulse(std::size_t i) const { return impulses(i).normal; }  ///< N s, of the i-th contact

  /// All that the i-th contact keeps for the next step.
  BlockImpulses impulses(std::size_t i) const {
    const DiscBlock& block = this->block(lane_[i]);
    const std::size_t lane = lane_[i].lane % BlockOrder::kWidth;
    return {block.normal_impulse[lane], block.tangent_impulse[lane], block.preload[lane]};
  }

  /// Its bodies, radii, normal and impulses as the solver left them; what else a contact has is not set.
  DiscContact operator[](std::size_t i) const;

  std::size_t groups() const { return groups_.size(); }

  std::span<DiscBlock> blocks(std::size_t group = 0) {
    assert(group < groups_.size());
    return {groups_[group].blocks.data(), groups_[group].order.blocks()};
  }

 private:
  /// What a seat that nobody takes has forgotten.
  struct Owner {
    std::uint32_t a, b;  // slots
    double normal_mass;
  };

  struct Lane {
    std::uint32_t group, lane;  // the lane among all of the group
  };

  struct Group {
    BlockOrder order;
    std::vector<DiscBlock> blocks;  // never shrinks
    std::uint32_t nobody = 0;       // whose slot a lane without a contact has
  };

  bool take(std::span<const std::uint64_t> keys, std::size_t begin, std::size_t end);
  void vacate(std::size_t seat);
  void occupy(std::size_t seat);
  DiscBlock& block(const Lane& lane) { return groups_[lane.group].blocks[lane.lane / BlockOrder::kWidth]; }
  const DiscBlock& block(const Lane& lane) const {
    return groups_[lane.group].blocks[lane.lane / BlockOrder::kWidth];
  }

  const BodySlots* slots_ = &kOwnSlots;
  std::vector<Group> groups_{1};
  std::vector<std::uint64_t> key_;  // of each seat, ascending
  std::vector<Lane> seat_lane_;     // and where it is
  std::vector<std::uint8_t> taken_;
  std::vector<Owner> owner_;
  std::vector<Lane> lane_;  // of each contact
};

/// As the two of solve.h, one after the other. `period`: the domain's, or null.
void prepare_and_start(std::span<DiscBlock> blocks, BodyRows<SolverBody> bodies, const Vec* period,
                       double ahead = 0.0);

/// As those of solve.h.
void push_apart(std::span<DiscBlock> blocks, BodyRows<SolverBody> bodies, const SolverSettings& settings);
void relax(std::span<DiscBlock> blocks, BodyRows<SolverBody> bodies, const SolverSettings& settings,
           bool periodic);
void learn(std::span<DiscBlock> blocks, BodyRows<const SolverBody> bodies, const Learning& learning);

}  // namespace throng
