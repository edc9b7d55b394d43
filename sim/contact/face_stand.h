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
  Vec normal, arm_a, arm_b;  ///< unit, from a to b; m, from the bodies' centres
  double separation;         ///< m

  /// As the bodies stand. Expects a turner.
  FaceStand(const PointContact& contact, const SolverBody& a, const SolverBody& b);
};

/// Whether the face of those one or two points turns with its body: one of them touches it by now, and hasn't
/// left it over its end.
bool turns_now(std::span<const PointContact> face, const SolverBody& a, const SolverBody& b);

/// How it is felt in a substep of h (s) that begins now, or of -h that has just ended: as both stand halfway,
/// and of a face that is driven so that who goes along with it keeps his speed.
FaceStand felt(const PointContact& contact, const SolverBody& a, const SolverBody& b, double h);

/// Turns the faces of what may bounce or hit as they are met now; to be called after prepare(), before each
/// look. `ahead` (s): the substep that begins, or, below 0, that in which bodies have just moved.
void turn_faces(std::span<PointContact> contacts, BodyRows<const SolverBody> bodies, double ahead);

/// Turns the contact's plane there. Its arms are then as they are felt; what turns of them stays.
void turn_to(PointContact& contact, const FaceStand& felt, double separation, const SolverBody& a,
             const SolverBody& b);

}  // namespace throng
