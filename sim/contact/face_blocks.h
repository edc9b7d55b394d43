// SPDX-License-Identifier: MIT
#pragma once

#include <cassert>
#include <span>
#include <vector>

#include "sim/contact/block_order.h"
#include "sim/contact/body_rows.h"
#include "sim/contact/solve.h"

/// Points of manifolds, as many faces at a time as the machine has lanes. What they compute is what solve.h
/// does, to the last bit.
namespace throng {

/// Eight faces with room for one point or eight for two, a row per quantity. A lane without a face, and the
/// second point of a face that has one, has no mass: no impulse comes to be there.
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

  std::uint32_t a[BlockOrder::kWidth], b[BlockOrder::kWidth];  ///< slots of the bodies
  Row normal_x, normal_y, friction;
  Row round_a, round_b;  ///< m, as in PointContact
  std::size_t count;     ///< points of each face, at most
  Point points[2];
};

/// Blocks in the order in which they are solved.
class FaceSequence {
 public:
  FaceSequence(FaceBlock* blocks, std::span<const std::uint32_t> order) : blocks_(blocks), order_(order) {}

  std::size_t size() const { return order_.size(); }
  bool empty() const { return order_.empty(); }
  FaceBlock& operator[](std::size_t i) const { return blocks_[order_[i]]; }

 private:
  FaceBlock* blocks_;
  std::span<const std::uint32_t> order_;
};

/// Each face has a seat, a lane of some block, and seats outlive the step: the order of blocks is that of the
/// faces whichever of the seats are taken, so the bits don't depend on which are there. (For that no body may
/// come with a velocity of -0, which becomes 0 where no impulse acts on it.)
class FaceBlocks {
 public:
  /// Forgets all seats. `bodies`, `slots`: as in DiscBlocks.
  void start(std::size_t bodies, std::size_t groups = 1, const BodySlots& slots = kOwnSlots);

  /// Makes a seat for a face of one or two points between those rows, behind all those of its group. Of
  /// different groups at the same time, if need be. Returns which lane of the group it is. Allocates only to
  /// grow.
  std::uint32_t seat(std::size_t points, std::uint32_t a, bool a_moves, std::uint32_t b, bool b_moves,
                     std::size_t group = 0);

  /// To be called behind the last of all groups. Who has a seat must be named and filled in now.
  void finish();

  /// Where a block comes in the order of its group, which is that of its lanes.
  std::size_t rank(std::uint32_t lane) const { return rank_[lane / BlockOrder::kWidth]; }

  /// After finish(): makes one more seat, in a block of the group that has at least rank `first` and less
  /// than `end`, or would have if it were there: ranks from there on grow by one. kNoLane where there is no
  /// room left. O(blocks).
  std::uint32_t squeeze_in(std::size_t points, std::size_t group, std::size_t first, std::size_t end);

  /// That lane of the group, as seat() told, among all lanes.
  std::uint32_t lane(std::size_t group, std::uint32_t lane) const {
    return static_cast<std::uint32_t>(groups_[group].first * BlockOrder::kWidth + lane);
  }

  /// Names who sits there, by rows, for as long as there are these seats.
  void name(std::uint32_t lane, std::uint32_t a, std::uint32_t b);

  std::size_t lanes() const { return room_.size() * BlockOrder::kWidth; }

  /// For how many points there is room.
  std::size_t room(std::uint32_t lane) const { return room_[lane / BlockOrder::kWidth]; }

  /// In all seats.
  std::size_t room() const { return all_room_; }

  /// There are no contacts; seats stay.
  void clear() { seat_.clear(); }

  /// The face that sits there has so many points now, 0 for none, which are the next contacts.
  void take(std::uint32_t lane, std::size_t points);

  /// The face that sat there sits elsewhere now: others may come into the block that share its bodies.
  void leave(std::uint32_t lane, std::size_t group);

  /// The points of a face, from the i-th contact on. Different faces may be filled at the same time.
  void fill(std::size_t i, std::span<const PointContact> face);

  /// The same face in another place: impulses stay. Likewise.
  void place(std::size_t i, std::span<const PointContact> face);

  /// Of the face of two polygons that sits there: what doesn't change while it does.
  void set_polygons(std::uint32_t lane, double friction);

  /// Of the i-th point.
  void set_impulses(std::size_t i, const BlockImpulses& impulses);

  BlockContact contact(std::size_t i);  ///< the i-th point

  std::size_t size() const { return seat_.size(); }                          ///< points
  double normal_impulse(std::size_t i) const { return impulses(i).normal; }  ///< N s, of the i-th point

  /// All that the i-th point keeps for the next step.
  BlockImpulses impulses(std::size_t i) const {
    const FaceBlock::Point& p = point(i);
    return {p.normal_impulse[at(i)], p.tangent_impulse[at(i)], p.preload[at(i)]};
  }

  /// Its bodies, normal, arms, radii and impulses as the solver left them; what else a contact has is not
  /// set.
  PointContact operator[](std::size_t i) const;

  /// Brings the impulses of a face, which will be set soon, near to the processor.
  void fetch_impulses(std::uint32_t lane) const;

  std::size_t groups() const { return groups_.size(); }

  FaceSequence blocks(std::size_t group = 0) {
    assert(group < groups_.size());
    return {blocks_.data(), groups_[group].sequence};
  }

  /// Of all groups, and some that nobody sits in.
  std::span<FaceBlock> all_blocks() { return std::span(blocks_).first(room_.size()); }

 private:
  struct Seat {
    std::uint32_t lane, point;  // among all lanes; 0 or 1
  };

  struct Group {
    BlockOrder order;
    std::vector<std::uint8_t> room;       // of each block: points of its faces
    std::size_t first = 0;                // its first block among all
    std::vector<std::uint32_t> sequence;  // of blocks among all
    std::uint32_t nobody = 0;             // whose slot a lane without a face has
  };

  std::size_t at(std::size_t i) const { return seat_[i].lane % BlockOrder::kWidth; }
  FaceBlock& block(std::size_t i) { return blocks_[seat_[i].lane / BlockOrder::kWidth]; }
  const FaceBlock& block(std::size_t i) const { return blocks_[seat_[i].lane / BlockOrder::kWidth]; }
  const FaceBlock::Point& point(std::size_t i) const { return block(i).points[seat_[i].point]; }

  /// A block between the others.
  struct Squeezed {
    std::uint32_t block, group, filled;
  };

  std::uint32_t add_squeezed(std::size_t points, std::size_t group, std::size_t rank);
  void set_ranks(const Group& group, std::size_t first);

  const BodySlots* slots_ = &kOwnSlots;
  std::vector<Group> groups_{1};
  std::vector<Squeezed> squeezed_;
  std::vector<FaceBlock> blocks_;    // of all groups, then those to be squeezed in; never shrinks
  std::vector<std::uint32_t> rank_;  // of each block
  std::vector<std::uint8_t> room_;   // of each block
  std::vector<std::uint8_t> taken_;  // of each lane: how many points its face has
  std::vector<Seat> seat_;           // of each point
  std::size_t all_room_ = 0;
};

/// As the two of solve.h, one after the other.
void prepare_and_start(FaceSequence blocks, BodyRows<SolverBody> bodies);

/// As those of solve.h.
void push_apart(FaceSequence blocks, BodyRows<SolverBody> bodies, const SolverSettings& settings);
void relax(FaceSequence blocks, BodyRows<SolverBody> bodies, const SolverSettings& settings);
void learn(FaceSequence blocks, BodyRows<const SolverBody> bodies, const Learning& learning);

}  // namespace throng
