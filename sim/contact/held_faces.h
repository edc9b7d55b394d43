// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "broadphase/pairs.h"
#include "narrowphase/held_face.h"
#include "sim/contact/block_order.h"
#include "sim/contact/contact.h"

/// Contacts of polygons that have hardly moved since they were searched, as many at a time as the machine has
/// lanes: without a search, and with the bits that one would give.
namespace throng {

/// What contacts ask of a collider that is all of its body, in one cache line.
struct alignas(64) PlacedPart {
  double x, y, cos, sin;  ///< m; where it stands
  double inverse_mass, inverse_inertia;
  double reach;  ///< m, as Candidates::reach
  double pace;   ///< m/s, no point of it is faster
};

/// Eight pairs, a row per quantity. Frames: that of the body whose edge is the reference, that of the other.
struct alignas(64) HeldBlock {
  using Row = double[BlockOrder::kWidth];

  std::uint32_t a[BlockOrder::kWidth], b[BlockOrder::kWidth];  ///< rows of the colliders

  // As narrowphase::HeldFace has them.
  Row at_x, at_y, cos, sin, lever, most;
  Row of_b;                                          ///< 1 where the reference is b's, else 0
  Row origin_x, origin_y, face_head_x, face_head_y;  ///< m, ends of the reference
  Row normal_x, normal_y;                            ///< the reference's
  Row head_x, head_y, tail_x, tail_y;                ///< m, ends of the incident edge
  Row tail_first;                                    ///< 1 where its tail has the lower index
  Row incident_normal_x, incident_normal_y;          ///< the incident edge's
  Row much;                                          ///< m, by which a rival must be wider
  Row radius_reference, radius_incident;             ///< m
  Row shift_x, shift_y;                              ///< m, to the image of b

  // What PointContact has, of as many points as there are.
  Row contact_normal_x, contact_normal_y;
  struct Point {
    Row end;  ///< which of narrowphase::EndNames
    Row first_ax, first_ay, first_bx, first_by, gap, normal_mass, tangent_mass;
  } points[2];
};

/// Of eight pairs: what is asked in a step, a Wanted, and how many points they have, or -1 for unknown.
struct alignas(64) HeldTalk {
  HeldBlock::Row asked, count;
};

/// What would do as an answer.
enum class Wanted : std::uint8_t {
  nothing,
  apart,   ///< that the two are beyond reach
  widest,  ///< the face, if it is the widest
  kept,    ///< the face, which was the reference in the last step
};

class HeldFaces {
 public:
  static constexpr std::uint32_t kNone = ~std::uint32_t{0};

  /// Between the two, for all pairs that may be held, with keys that ascend: the lane of each, the same as
  /// before where it had one. Forgets those that haven't been named for some time. Allocates only to grow.
  void start();
  std::uint32_t lane_of(std::uint64_t key, broadphase::Pair pair);
  void finish();
  void forget_all();

  /// How many pairs were named last, and the contacts of how many are known.
  std::size_t named() const { return named_; }
  std::size_t known() const;

  /// Asks for the contact of the pair, of which the feature `kept` pressed in the last step, or null.
  /// `shift`: to the image of b, or null. Different lanes may be asked about at the same time, as below.
  void ask(std::uint32_t lane, const std::uint32_t* kept, const Vec* shift);

  std::size_t blocks() const { return blocks_.size(); }

  /// Answers what was asked of those blocks. `parts`: a row per collider; `fast` (m/s): pairs that may close
  /// so fast are left unknown.
  void answer(std::size_t begin, std::size_t end, std::span<const PlacedPart> parts, double fast);

  /// Whether the contact is known, and then how many points it has, 0 to 2.
  bool knows(std::uint32_t lane) const { return talk(lane).count[at(lane)] >= 0.0; }
  std::uint8_t points(std::uint32_t lane) const {
    return static_cast<std::uint8_t>(talk(lane).count[at(lane)]);
  }

  /// Of the i-th point.
  std::uint32_t feature(std::uint32_t lane, std::size_t i) const {
    return notes_[lane].names[static_cast<std::size_t>(block(lane).points[i].end[at(lane)])];
  }

  /// Where the answer stands: in lane % BlockOrder::kWidth.
  const HeldBlock& block(std::uint32_t lane) const { return blocks_[lane / BlockOrder::kWidth]; }

  /// Brings the answer of a pair, which will be looked at soon, near to the processor.
  void fetch(std::uint32_t lane) const;

  /// Whether a search of this pair, which found that feature (or nothing: null) where there was no answer
  /// here, should be followed by hold(): not where that was in vain just now, nor where the face is held.
  bool wants_hold(std::uint32_t lane, const std::uint32_t* feature, const narrowphase::Pose& b_in_a);

  /// Remembers what a search found out about the pair, if there is more than `least` (m) to move.
  void hold(std::uint32_t lane, const narrowphase::HeldFace& held, const narrowphase::Convex& a,
            const narrowphase::Convex& b, double least);

 private:
  struct Seat {
    std::uint64_t key;
    std::uint32_t lane;
    std::uint32_t away;  // times that it wasn't named since it was
  };

  struct Note {
    std::array<std::uint32_t, 4> names;
    narrowphase::HeldFace::Kind kind;
    std::uint8_t wait;  // searches until it is worth holding again
  };

  static std::size_t at(std::uint32_t lane) { return lane % BlockOrder::kWidth; }
  HeldBlock& own_block(std::uint32_t lane) { return blocks_[lane / BlockOrder::kWidth]; }
  HeldTalk& talk(std::uint32_t lane) { return talks_[lane / BlockOrder::kWidth]; }
  const HeldTalk& talk(std::uint32_t lane) const { return talks_[lane / BlockOrder::kWidth]; }
  bool holds(std::uint32_t lane, std::uint32_t feature, const narrowphase::Pose& b_in_a) const;
  Wanted wanted(const Note& note, const std::uint32_t* kept) const;
  std::uint32_t take(broadphase::Pair pair);
  void leave_out(const Seat& seat);
  void release(std::uint32_t lane);
  std::vector<HeldBlock> blocks_;
  std::vector<HeldTalk> talks_;     // of each block: what is looked at more often stands by itself
  std::vector<Note> notes_;         // of each lane
  std::vector<Seat> seats_, last_;  // ascending by key
  std::size_t next_ = 0;            // of the last ones
  std::vector<std::uint32_t> free_;
  std::uint32_t lanes_ = 0;  // in use or free
  std::size_t named_ = 0;
  std::size_t moved_in_ = 0;  // since the lanes were in the order of keys
};

}  // namespace throng
