// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "sim/contact/body_rows.h"
#include "sim/contact/contact.h"
#include "sim/contact/face_blocks.h"
#include "sim/workers.h"

namespace throng {

/// Faces that turn far within a step, from when somebody touches them on. Others are taken for planes that
/// stand as they did when they were found, felt at the place that the other touched then: who is pushed by a
/// face that turns would sink into it, by half the square of its turn times where it is touched. These are
/// found anew in each substep: the plane turns with the face, and is felt below the other's point. Planes go
/// on beyond their faces, so nobody's plane turns before it is touched, nor on when the other has left it
/// over the face's end.
///
/// Here are those of the blocks; what bounces and hits is placed as it is looked at, see turn_faces().
class TurningFaces {
 public:
  void clear() { faces_.clear(); }

  /// One or two points of a face that turns, as describe_face() made them; `first` of them among the points
  /// of the blocks.
  void add(std::size_t first, std::span<const PointContact> points);

  /// Places all in the blocks, for a substep of h (s) that begins as their bodies stand and move now.
  void turn(FaceBlocks& blocks, BodyRows<const SolverBody> bodies, double h, Workers& workers) const;

 private:
  struct Face {
    std::size_t first, count;
    std::array<PointContact, 2> points;  // with what turns of the arms as the step begins
  };

  static void turn(const Face& face, FaceBlocks& blocks, BodyRows<const SolverBody> bodies, double h);

  std::vector<Face> faces_;
};

}  // namespace throng
