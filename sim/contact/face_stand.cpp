// SPDX-License-Identifier: MIT
#include "sim/contact/face_stand.h"

#include <algorithm>

#include "narrowphase/convex.h"
#include "sim/contact/arms.h"

namespace throng {

namespace {

constexpr double kEnd = 1e-6;  // of a face's length: rounding of its ends

bool is_of_a(const PointContact& contact) {
  return contact.turner.body == Turner::Body::a;
}

/// It some time (s) later, if it goes on as it moves.
SolverBody later(SolverBody body, double time) {
  body.position += time * body.velocity, body.turn += time * body.spin;
  return body;
}

/// m, along t, how far b's point gets from a's in that time (s), if both go on as they move, more than at the
/// velocity of now.
double slides_ahead(const FaceStand& now, const Vec& t, const SolverBody& a, const SolverBody& b,
                    double time) {
  const Vec way = time * (b.velocity - a.velocity) + turned(now.arm_b, time * b.spin) - now.arm_b -
                  turned(now.arm_a, time * a.spin) + now.arm_a;
  return t.dot(way - time * PointArms{now.arm_a, now.arm_b, now.normal}.velocity(a, b));
}

/// How they stand now, before a face that is driven, felt a little farther on or back along it, and higher or
/// lower: where it will have moved as far by the end of a substep h (s), along its normal and across, as the
/// two do against each other by then. So who goes along with it goes along a chord and keeps his speed, as
/// impulses are along the normal of now, and it doesn't rub him.
FaceStand led(const PointContact& contact, const SolverBody& a, const SolverBody& b, double h) {
  FaceStand stand(contact, a, b);
  const Vec t = tangent(stand.normal);
  const double speed = PointArms{stand.arm_a, stand.arm_b, stand.normal}.normal_velocity(a, b);
  const double excess =
      FaceStand(contact, later(a, h), later(b, h)).separation - stand.separation - h * speed;
  const double slide = slides_ahead(stand, t, a, b, h);
  const Vec way = (excess * t - slide * stand.normal) / (h * (is_of_a(contact) ? a.spin : -b.spin));
  (is_of_a(contact) ? stand.arm_a : stand.arm_b) += way;
  return stand;
}

/// The one or two points of the face that is at the front.
std::span<PointContact> first_face(std::span<PointContact> contacts) {
  return contacts.first(contacts.size() > 1 && contacts[1].is_second ? 2 : 1);
}

bool is_touched(const PointContact& contact, const SolverBody& a, const SolverBody& b) {
  const Turner& turner = contact.turner;
  if ((is_of_a(contact) ? a : b).turn * turner.from < turner.from * turner.from) return false;
  const FaceStand now(contact, a, b);
  const double along = tangent(now.normal).dot(is_of_a(contact) ? now.arm_a : now.arm_b);
  const double slack = kEnd * (turner.end - turner.begin);
  return along > turner.begin - slack && along < turner.end + slack;
}

}  // namespace

Vec turned(const Vec& v, double angle) {
  return narrowphase::pose(Vec(0.0, 0.0), angle).rotate(v);
}

FaceStand::FaceStand(const PointContact& contact, const SolverBody& a, const SolverBody& b)
    : normal(turned(contact.turner.normal, is_of_a(contact) ? a.turn : b.turn)),
      arm_a(turned(contact.first_a, a.turn) + contact.round_a * normal),
      arm_b(turned(contact.first_b, b.turn) - contact.round_b * normal) {
  const Vec between = b.position + contact.turner.shift - a.position;
  separation = normal.dot(between + arm_b - arm_a);
  if (is_of_a(contact))
    arm_a = between + arm_b - separation * normal;
  else
    arm_b = arm_a + separation * normal - between;
}

bool turns_now(std::span<const PointContact> face, const SolverBody& a, const SolverBody& b) {
  return std::ranges::any_of(face, [&](const PointContact& contact) { return is_touched(contact, a, b); });
}

FaceStand felt(const PointContact& contact, const SolverBody& a, const SolverBody& b, double h) {
  if ((is_of_a(contact) ? a : b).inverse_inertia == 0.0) return led(contact, a, b, h);
  return FaceStand(contact, later(a, 0.5 * h), later(b, 0.5 * h));
}

void turn_to(PointContact& contact, const FaceStand& felt, double separation, const SolverBody& a,
             const SolverBody& b) {
  contact.normal = felt.normal, contact.arm_a = felt.arm_a, contact.arm_b = felt.arm_b;
  contact.gap = separation - felt.normal.dot(b.position + felt.arm_b - a.position - felt.arm_a);
  contact.normal_mass = effective_mass(a, b, felt.arm_a, felt.arm_b, felt.normal);
  contact.tangent_mass = effective_mass(a, b, felt.arm_a, felt.arm_b, tangent(felt.normal));
}

/// Who bounces off a face meets it as it stands; who hits it, as it is felt: else the sweeps would undo that.
void turn_faces(std::span<PointContact> contacts, BodyRows<const SolverBody> bodies, double ahead) {
  for (std::span<PointContact> face; !contacts.empty(); contacts = contacts.subspan(face.size())) {
    face = first_face(contacts);
    const SolverBody &a = bodies[face[0].a], &b = bodies[face[0].b];
    if (face[0].turner.body == Turner::Body::none || !turns_now(face, a, b)) continue;
    for (PointContact& contact : face) {
      const FaceStand now(contact, a, b);
      turn_to(contact, contact.restitution > 0.0 ? now : felt(contact, a, b, ahead), now.separation, a, b);
      contact.separation = now.separation;
    }
  }
}

}  // namespace throng
