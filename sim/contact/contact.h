// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "sim/scene.h"

/// What the contact solver works on: bodies as it sees them, and contacts. All that it holds is that of one
/// step: the next one may leave contacts in their seats (disc_blocks.h, face_blocks.h), but takes nothing
/// over that isn't among the impulses in `State`.
namespace throng {

/// `v` turned left by a right angle.
inline Vec tangent(const Vec& v) {
  return {-v.y(), v.x()};
}

/// One body in one cache line: what contacts change stands in its first half.
struct alignas(64) SolverBody {
  Vec velocity;            ///< m/s
  double spin;             ///< rad/s
  double inverse_mass;     ///< 1/kg, 0 for all but dynamic bodies
  Vec position;            ///< m
  double turn;             ///< rad, since the step began
  double inverse_inertia;  ///< 1/(kg m²), as the inverse mass; 0 where nothing turns

  bool is_dynamic() const { return inverse_mass > 0.0; }
};
static_assert(sizeof(SolverBody) == 64);

/// What each kind of contact has.
struct ContactBase {
  Vec normal{0.0, 0.0};        ///< unit, from a to b
  std::uint32_t a = 0, b = 0;  ///< rows of the bodies
  double offset = 0.0;       ///< m, the separation less normal . (position_b - position_a), now; points: less
                             ///< what their arms have turned, too
  double normal_mass = 0.0;  ///< kg, what the contact feels along its normal
  double tangent_mass = 0.0;     ///< kg, and across
  double friction = 0.0;         ///< Coulomb's coefficient
  double restitution = 0.0;      ///< 0 to 1
  double lever = 0.0;            ///< m, as in RollContact; for bounces, and 0 where nothing resists rolling
  double normal_impulse = 0.0;   ///< N s, on b, of one substep; a feels the opposite
  double tangent_impulse = 0.0;  ///< N s, likewise, along the normal turned left
  double preload = 0.0;     ///< N s, of the normal impulse, what it bears without giving way: see Learning
  double separation = 0.0;  ///< m, before bodies move in a substep
  double struck = 0.0;      ///< N s, among bounces: the normal impulses so far, and of friction in
  double rubbed = 0.0;      ///< them, on b,
  double rolled = 0.0;      ///< N m s, and of what holds back rolling, on b
  double fall = 0.0;  ///< m/s, among bounces: what gravity does between the two, when it was last struck
  double slip = 0.0;  ///< m/s, among bounces: along the normal turned left, after its last strike or
                      ///< correction
  double struck_in_step = 0.0;  ///< N s, `struck` of all substeps so far
  Vec struck_at{0.0, 0.0};      ///< m, where the last of that was
  std::uint32_t row = 0;        ///< among bounces: of the contact among its like
  bool hits = false;            ///< among bounces: is stopped though it doesn't bounce, see hit_speed()
};

/// Two discs, each about its body's centre: the arm is radius times normal, and both are exact in each
/// substep, or, where the two near each other fast, as they meet or pass within it.
struct DiscContact : ContactBase {
  double radius_a = 0.0, radius_b = 0.0;  ///< m
};

/// The face that a normal is of, if it is to turn with it: see TurningFaces.
struct Turner {
  enum class Body : std::uint8_t { none, a, b };
  Body body = Body::none;  ///< whose it is
  double begin = 0.0;      ///< m, where it begins, along the normal turned left, from its centre,
  double end = 0.0;        ///< and ends, behind that
  Vec normal{0.0, 0.0};    ///< of the contact, as the step begins
  Vec shift{0.0, 0.0};     ///< m, to b's image
  double from = 0.0;       ///< rad, the body's turn from which on it is touched
};

/// One point of a manifold. The normal is that of the step's beginning, of its middle (midway.h), or of when
/// the two meet or pass where they near each other fast. Arms turn with their bodies, but a disc's radius
/// points along the normal for ever. Where there is a turner, FaceStand makes normal and arms anew from
/// `first_a` and `first_b`.
struct PointContact : ContactBase {
  Vec arm_a{0.0, 0.0}, arm_b{0.0, 0.0};      ///< m, from the bodies' centres to the contact, in this substep
  Vec first_a{0.0, 0.0}, first_b{0.0, 0.0};  ///< m, what of them turns, as the step begins
  double round_a = 0.0, round_b = 0.0;       ///< m, the radius of a disc, which doesn't
  double gap = 0.0;        ///< m, separation = gap + normal . (position_b + arm_b - position_a - arm_a)
  bool is_second = false;  ///< of one manifold with the point before
  Turner turner;
};

/// How arms turn with their bodies: by the angle (rad) less a twelfth of its cube, at unit length, as longer
/// ones would put energy in.
struct Turn {
  double cosine, sine;

  explicit Turn(double angle) {
    const double quarter = 0.25 * angle * angle, scale = 1.0 / (1.0 + quarter);
    cosine = (1.0 - quarter) * scale, sine = angle * scale;
  }

  Vec operator()(const Vec& v) const { return cosine * v + sine * tangent(v); }
};

/// kg, the mass that bodies a and b show to an impulse that reaches them at those levers (m), how far from
/// their centres its line passes.
inline double effective_mass(const SolverBody& a, const SolverBody& b, double lever_a, double lever_b) {
  return 1.0 / (a.inverse_mass + b.inverse_mass + a.inverse_inertia * lever_a * lever_a +
                b.inverse_inertia * lever_b * lever_b);
}

/// The same to an impulse along `direction` (unit) at those arms (m).
inline double effective_mass(const SolverBody& a, const SolverBody& b, const Vec& arm_a, const Vec& arm_b,
                             const Vec& direction) {
  return effective_mass(a, b, cross(arm_a, direction), cross(arm_b, direction));
}

/// Those that the contact feels at its arms as they are.
inline void set_masses(PointContact& contact, const SolverBody& a, const SolverBody& b) {
  contact.normal_mass = effective_mass(a, b, contact.arm_a, contact.arm_b, contact.normal);
  contact.tangent_mass = effective_mass(a, b, contact.arm_a, contact.arm_b, tangent(contact.normal));
}

}  // namespace throng
