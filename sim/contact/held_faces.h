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
#include "sim/contact/face_blocks.h"

/// Contacts of polygons that have hardly moved since they were searched, as many at a time as the machine has
/// lanes: without a search, and with the bits that one would give.
namespace throng {

/// What contacts ask of a collider that is all of its body, in one cache line.
struct alignas(64) PlacedPart {
  double x, y, cos, sin;  ///< m; where it stands
  double inverse_mass, inverse_inertia;
  double reach;  ///< m, as Candidates::reach
  double pace;   ///< m/s, no point of it is faster; infinite where its faces turn far, as none is held then
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

  Row end[2];  ///< of each point: which of narrowphase::EndNames
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

/// The lanes of those that have a seat among the solver's faces are the same as there: answers are written to
/// where they are solved. Those that haven't come behind.
class HeldFaces {
 public:
  /// A pair that is held, its lane so far, or none, and its seat, or none.
  struct Move {
    broadphase::Pair pair;
    std::uint32_t from, to;
  };

  /// The seats are now those of so many blocks. Gives the pairs without one lanes behind these, as `to`.
  /// Forgets those that aren't among them. O(lanes); allocates only to grow.
  void move(std::size_t blocks, std::span<Move> moves);

  /// The pair has moved to a lane that nobody had.
  void move(std::uint32_t from, std::uint32_t to);

  /// A lane for a pair of which nothing is known, behind all.
  std::uint32_t take(broadphase::Pair pair);

  void forget_all();

  /// The contacts of how many are known.
  std::size_t known() const;

  /// Asks for the contact of the pair, of which the feature `kept` pressed in the last step, or null.
  /// `shift`: to the image of b, or null. Different lanes may be asked about at the same time, as below.
  void ask(std::uint32_t lane, const std::uint32_t* kept, const Vec* shift);

  /// The pair is none that may touch.
  void ask_nothing(std::uint32_t lane);

  std::size_t blocks() const { return talks_.size(); }

  /// Answers what was asked of those blocks, and describes in `faces`, the first blocks, all but the impulses
  /// of who is known. `parts`: a row per collider; `fast` (m/s): pairs that may close so fast are left
  /// unknown.
  void answer(std::size_t begin, std::size_t end, std::span<const PlacedPart> parts, double fast,
              std::span<FaceBlock> faces);

  /// Whether the contact is known, and then how many points it has, 0 to 2.
  bool knows(std::uint32_t lane) const { return talk(lane).count[at(lane)] >= 0.0; }
  std::uint8_t points(std::uint32_t lane) const {
    return static_cast<std::uint8_t>(talk(lane).count[at(lane)]);
  }

  /// Of the i-th point.
  std::uint32_t feature(std::uint32_t lane, std::size_t i) const {
    return notes_[lane].names[static_cast<std::size_t>(block(lane).end[i][at(lane)])];
  }

  const HeldBlock& block(std::uint32_t lane) const { return blocks_[lane / BlockOrder::kWidth]; }

  /// Brings the features of a pair, which will be looked at soon, near to the processor.
  void fetch(std::uint32_t lane) const;

  /// Whether a search of this pair, which found that feature (or nothing: null) where there was no answer
  /// here, should be followed by hold(): not where that was in vain just now, nor where the face is held.
  bool wants_hold(std::uint32_t lane, const std::uint32_t* feature, const narrowphase::Pose& b_in_a);

  /// Remembers what a search found out about the pair, if there is more than `least` (m) to move.
  void hold(std::uint32_t lane, const narrowphase::HeldFace& held, const narrowphase::Convex& a,
            const narrowphase::Convex& b, double least);

 private:
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
  void grow(std::size_t blocks);

  std::vector<HeldBlock> blocks_, last_blocks_;  // never shrink
  std::vector<HeldTalk> talks_, last_talks_;  // of each block: what is looked at more often stands by itself
  std::vector<Note> notes_, last_notes_;      // of each lane
  std::size_t lanes_ = 0;                     // that are not behind all
};

}  // namespace throng
