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
/// on beyond their faces, so nobody's plane turns before it is touched.
class TurningFaces {
 public:
  void clear() { faces_.clear(); }

  /// One or two points of a face whose `turner` is somebody, as describe_face() made them of b's image,
  /// `shift` (m) away, at the time `when` (s) of a step that begins with those bodies; `first` of them among
  /// the points of the blocks.
  void add(std::size_t first, std::span<const PointContact> points, const Vec& shift, double when,
           BodyRows<const SolverBody> bodies);

  /// Places all in the blocks, for a substep of h (s) that begins as their bodies stand and move now.
  void turn(FaceBlocks& blocks, BodyRows<const SolverBody> bodies, double h, Workers& workers) const;

 private:
  struct Face {
    std::size_t first, count;
    std::array<PointContact, 2> points;  // with the normal and what turns of the arms as the step begins
    Vec shift;                           // m
    double from;                         // rad, the turn with which it is touched
  };

  static void turn(const Face& face, FaceBlocks& blocks, BodyRows<const SolverBody> bodies, double h);

  std::vector<Face> faces_;
};

}  // namespace throng
