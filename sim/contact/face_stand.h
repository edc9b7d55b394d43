// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "sim/contact/body_rows.h"
#include "sim/contact/contact.h"

/// How faces stand that turn far within a step, and who touches them.
namespace throng {

/// `v` turned by that angle (rad), to rounding: by what Turn leaves out each step's face would stand ahead of
/// where the last one's went.
Vec turned(const Vec& v, double angle);

/// A face and who touches it: the arm of whose face it is ends below the other's point.
struct FaceStand {
  Vec normal{0.0, 0.0}, arm_a{0.0, 0.0}, arm_b{0.0, 0.0};  ///< unit, from a to b; m, from the bodies' centres
  double separation = 0.0;                                 ///< m
  bool turns = false;  ///< the face with its body: one of its points is touched by now, and hasn't been left
};

/// How faces stand while their bodies stand as they do: of each contact of two bodies at points, one after
/// the other. What has no turner doesn't turn.
void find_stands(std::span<const PointContact> contacts, const SolverBody& a, const SolverBody& b,
                 std::span<FaceStand> stands);

/// How a face is felt that stands so in a substep of h (s) that begins now, or of -h that has just ended, as
/// if they had come as they move now: as both stand halfway, and of a face that is driven so that who goes
/// along with it keeps his speed.
FaceStand felt(const PointContact& contact, const FaceStand& now, const SolverBody& a, const SolverBody& b,
               double h);

/// Turns the faces of two bodies that bounce or hit as they are met now; to be called before each look, as
/// strikes change how they move. `h`: as in felt().
void turn_faces(std::span<PointContact> contacts, std::span<const FaceStand> stands, const SolverBody& a,
                const SolverBody& b, double h);

/// Turns the contact's plane there. Its arms are then as they are felt; what turns of them stays.
void turn_to(PointContact& contact, const FaceStand& felt, double separation, const SolverBody& a,
             const SolverBody& b);

}  // namespace throng
