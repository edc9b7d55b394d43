// SPDX-License-Identifier: MIT
#include "sim/contact/face_stand.h"

#include <cstddef>

#include "narrowphase/convex.h"
#include "sim/contact/arms.h"

namespace throng {

namespace {

constexpr double kEnd = 1e-6;  // of a face's length: rounding of its ends

bool is_of_a(const PointContact& contact) {
  return contact.turner.body == Turner::Body::a;
}

/// What Turn is but for the cube, to rounding.
Turn exact_turn(double angle) {
  Turn turn(0.0);
  if (angle == 0.0) return turn;
  const narrowphase::Pose pose = narrowphase::pose(Vec(0.0, 0.0), angle);
  turn.cosine = pose.cos, turn.sine = pose.sin;
  return turn;
}

/// What of a face, and of who touches it, turns with their bodies.
struct Turning {
  Vec normal, arm_a, arm_b;
};

/// Once they have turned so far, and are so far from each other.
FaceStand stand(const PointContact& contact, const Turning& from, const Turn& of_a, const Turn& of_b,
                const Vec& between) {
  FaceStand stand;
  stand.normal = (is_of_a(contact) ? of_a : of_b)(from.normal);
  stand.arm_a = of_a(from.arm_a) + contact.round_a * stand.normal;
  stand.arm_b = of_b(from.arm_b) - contact.round_b * stand.normal;
  stand.separation = stand.normal.dot(between + stand.arm_b - stand.arm_a);
  if (is_of_a(contact))
    stand.arm_a = between + stand.arm_b - stand.separation * stand.normal;
  else
    stand.arm_b = stand.arm_a + stand.separation * stand.normal - between;
  return stand;
}

/// m, to b's image that touches a.
Vec between(const PointContact& contact, const SolverBody& a, const SolverBody& b) {
  return b.position + contact.turner.shift - a.position;
}

/// It some time (s) on, if both go on as they move, and turn by that.
FaceStand later(const PointContact& contact, const FaceStand& now, const SolverBody& a, const SolverBody& b,
                double time, const Turn& of_a, const Turn& of_b) {
  const Turning from{now.normal, now.arm_a - contact.round_a * now.normal,
                     now.arm_b + contact.round_b * now.normal};
  return stand(contact, from, of_a, of_b, between(contact, a, b) + time * (b.velocity - a.velocity));
}

/// m, along t, how far b gets from a as a driven face turns by `angle` (rad) and the other goes along with it
/// by a chord, more than at the velocity of now. Of the way between centres alone: how the other turns, as a
/// disc that rolls on the face does, is no matter.
double slides_ahead(const Vec& between, const Vec& t, double angle) {
  return t.dot(between + angle * tangent(between) - turned(between, angle));
}

/// How a face is felt that is driven: a little farther on or back along it, and higher or lower, where it
/// will have moved as far by the end of a substep h (s), along its normal and across, as the two do against
/// each other by then. So who goes along with it goes along a chord and keeps his speed, as impulses are
/// along the normal of now, and it doesn't rub him.
FaceStand led(const PointContact& contact, const FaceStand& now, const SolverBody& a, const SolverBody& b,
              double h) {
  FaceStand felt = now;
  const Vec t = tangent(now.normal);
  const double angle = h * (is_of_a(contact) ? a.spin : b.spin);
  const double speed = PointArms{now.arm_a, now.arm_b, now.normal}.normal_velocity(a, b);
  const FaceStand then = later(contact, now, a, b, h, exact_turn(h * a.spin), exact_turn(h * b.spin));
  const double excess = then.separation - now.separation - h * speed;
  const Vec way = (excess * t - slides_ahead(between(contact, a, b), t, angle) * now.normal) / angle;
  is_of_a(contact) ? felt.arm_a += way : felt.arm_b -= way;
  return felt;
}

/// Of the points at the front, how many are of one face: one or two.
std::size_t of_one_face(std::span<const PointContact> contacts) {
  return contacts.size() > 1 && contacts[1].is_second ? 2 : 1;
}

/// And not left over the face's end.
bool is_touched(const PointContact& contact, const FaceStand& now, const SolverBody& a, const SolverBody& b) {
  const Turner& turner = contact.turner;
  if ((is_of_a(contact) ? a : b).turn * turner.from < turner.from * turner.from) return false;
  const double along = tangent(now.normal).dot(is_of_a(contact) ? now.arm_a : now.arm_b);
  const double slack = kEnd * (turner.end - turner.begin);
  return along > turner.begin - slack && along < turner.end + slack;
}

/// Of the points of one face, which have one turner, or none.
void find_stands_of_face(std::span<const PointContact> face, const SolverBody& a, const SolverBody& b,
                         std::span<FaceStand> stands) {
  bool turns = false;
  if (face[0].turner.body != Turner::Body::none) {
    const Turn of_a = exact_turn(a.turn), of_b = exact_turn(b.turn);
    for (std::size_t i = 0; i < face.size(); ++i) {
      const Turning from{face[i].turner.normal, face[i].first_a, face[i].first_b};
      stands[i] = stand(face[i], from, of_a, of_b, between(face[i], a, b));
      turns |= is_touched(face[i], stands[i], a, b);
    }
  }
  for (FaceStand& stand : stands) stand.turns = turns;
}

}  // namespace

Vec turned(const Vec& v, double angle) {
  return exact_turn(angle)(v);
}

void find_stands(std::span<const PointContact> contacts, const SolverBody& a, const SolverBody& b,
                 std::span<FaceStand> stands) {
  for (std::size_t first = 0, count; first < contacts.size(); first += count) {
    count = of_one_face(contacts.subspan(first));
    find_stands_of_face(contacts.subspan(first, count), a, b, stands.subspan(first, count));
  }
}

FaceStand felt(const PointContact& contact, const FaceStand& now, const SolverBody& a, const SolverBody& b,
               double h) {
  if ((is_of_a(contact) ? a : b).inverse_inertia == 0.0) return led(contact, now, a, b, h);
  const double half = 0.5 * h;
  return later(contact, now, a, b, half, Turn(half * a.spin), Turn(half * b.spin));
}

void turn_to(PointContact& contact, const FaceStand& felt, double separation, const SolverBody& a,
             const SolverBody& b) {
  contact.normal = felt.normal, contact.arm_a = felt.arm_a, contact.arm_b = felt.arm_b;
  contact.gap = separation - felt.normal.dot(b.position + felt.arm_b - a.position - felt.arm_a);
  set_masses(contact, a, b);
}

/// Who bounces off a face meets it as it stands; who hits it, as it is felt: else the sweeps would undo that.
void turn_faces(std::span<PointContact> contacts, std::span<const FaceStand> stands, const SolverBody& a,
                const SolverBody& b, double h) {
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    PointContact& contact = contacts[i];
    const FaceStand& now = stands[i];
    if (!now.turns) continue;
    turn_to(contact, contact.restitution > 0.0 ? now : felt(contact, now, a, b, h), now.separation, a, b);
    contact.separation = now.separation;
  }
}

}  // namespace throng
