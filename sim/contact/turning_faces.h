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

/// A face and who touches it, as their bodies stand: the arm of whose face it is ends below the other's
/// point.
struct FaceStand {
  Vec normal, arm_a, arm_b;  ///< unit, from a to b; m, from the bodies' centres
  double separation;         ///< m

  /// Expects a turner.
  FaceStand(const PointContact& face, const SolverBody& a, const SolverBody& b);
};

/// Whether the face is touched by now and not left over its end, as the bodies stand.
bool turns_now(const PointContact& face, const FaceStand& stand, const SolverBody& a, const SolverBody& b);

/// Faces that turn far within a step, from when somebody touches them on. Others are taken for planes that
/// stand as they did when they were found, felt at the place that the other touched then: who is pushed by a
/// face that turns would sink into it, by half the square of its turn times where it is touched. These are
/// found anew in each substep: the plane turns with the face, and is felt below the other's point. Planes go
/// on beyond their faces, so nobody's plane turns before it is touched, nor on when the other has left it
/// over the face's end.
///
/// Here are those of the blocks; what bounces and hits is placed as it is looked at, see prepare().
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
