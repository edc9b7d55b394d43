// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cassert>
#include <span>
#include <vector>

#include "sim/contact/block_order.h"
#include "sim/contact/held_faces.h"
#include "sim/contact/solve.h"

/// Points of manifolds, as many faces at a time as the machine has lanes. What they compute is what solve.h
/// does, to the last bit.
namespace throng {

/// Eight faces of one point or eight of two, a row per quantity. A lane without a face has no mass and two
/// bodies that don't move.
struct alignas(64) FaceBlock {
  using Row = double[BlockOrder::kWidth];

  struct alignas(64) Point {
    Row arm_ax, arm_ay, arm_bx, arm_by;               ///< m, in this substep
    Row offset;                                       ///< m, as in ContactBase
    Row separation;                                   ///< m, before bodies move
    Row normal_mass, tangent_mass;                    ///< kg
    Row normal_impulse, tangent_impulse;              ///< N s
    Row preload;                                      ///< N s, as in ContactBase
    Row first_ax, first_ay, first_bx, first_by, gap;  ///< m, as in PointContact
  };

  std::uint32_t a[BlockOrder::kWidth], b[BlockOrder::kWidth];  ///< rows of the bodies
  Row normal_x, normal_y, friction;
  Row round_a, round_b;                   ///< m, as in PointContact
  std::size_t count;                      ///< points of each face
  std::size_t used = BlockOrder::kWidth;  ///< lanes from there on are clear
  Point points[2];
};

class FaceBlocks {
 public:
  /// Forgets all contacts. `bodies`: how many rows there are, of which the last `groups` never move.
  void start(std::size_t bodies, std::size_t groups = 1);

  /// Makes seats for so many points in all. Allocates only to grow.
  void resize(std::size_t points) { seat_.resize(points); }

  /// Seats a face of one or two points between those rows, points that are the i-th and the next. Those of
  /// one group in their order; of different groups at the same time, if need be. Allocates only to grow.
  void seat(std::size_t i, std::size_t points, std::uint32_t a, bool a_moves, std::uint32_t b, bool b_moves,
            std::size_t group = 0);

  /// To be called behind the last of a group.
  void finish(std::size_t group = 0);

  /// The points of a face that was seated, from the i-th on. Different faces may be filled at the same time.
  void fill(std::size_t i, std::span<const PointContact> face);

  /// The same of two polygons whose contact stands in that lane, with what each point did before.
  void fill(std::size_t i, const HeldBlock& held, std::size_t lane, double friction,
            const std::array<BlockImpulses, 2>& impulses);

  BlockContact contact(std::size_t i);  ///< the i-th point

  std::size_t size() const { return seat_.size(); }                          ///< points
  double normal_impulse(std::size_t i) const { return impulses(i).normal; }  ///< N s, of the i-th point

  /// All that the i-th point that was seated keeps for the next step.
  BlockImpulses impulses(std::size_t i) const {
    const FaceBlock::Point& p = point(i);
    const std::size_t lane = seat_[i].lane % BlockOrder::kWidth;
    return {p.normal_impulse[lane], p.tangent_impulse[lane], p.preload[lane]};
  }

  /// Its bodies, normal, arms and impulses as the solver left them; what else a contact has is not set.
  PointContact operator[](std::size_t i) const;

  std::span<FaceBlock> blocks(std::size_t group = 0) {
    assert(group < groups_.size());
    return {groups_[group].blocks.data(), groups_[group].order.blocks()};
  }

 private:
  struct Seat {
    std::uint32_t lane;  // among all lanes of the group
    std::uint16_t group;
    std::uint16_t point;  // 0 or 1
  };

  struct Group {
    BlockOrder order;
    std::vector<FaceBlock> blocks;  // never shrinks
    std::uint32_t nobody = 0;       // whose row a lane without a contact has
  };

  const FaceBlock& block(std::size_t i) const {
    return groups_[seat_[i].group].blocks[seat_[i].lane / BlockOrder::kWidth];
  }
  const FaceBlock::Point& point(std::size_t i) const { return block(i).points[seat_[i].point]; }

  std::vector<Group> groups_{1};
  std::vector<Seat> seat_;  // of each point
};

/// As the two of solve.h, one after the other.
void prepare_and_start(std::span<FaceBlock> blocks, std::span<SolverBody> bodies);

/// As those of solve.h.
void push_apart(std::span<FaceBlock> blocks, std::span<SolverBody> bodies, const SolverSettings& settings);
void relax(std::span<FaceBlock> blocks, std::span<SolverBody> bodies, const SolverSettings& settings);
void learn(std::span<FaceBlock> blocks, std::span<const SolverBody> bodies, const Learning& learning);

}  // namespace throng
