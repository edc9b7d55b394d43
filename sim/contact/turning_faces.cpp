// SPDX-License-Identifier: MIT
#include "sim/contact/turning_faces.h"

#include <algorithm>

#include "sim/contact/arms.h"

namespace throng {

namespace {

constexpr double kEnd = 1e-6;  // of a face's length: rounding of its ends

bool is_of_a(const PointContact& face) {
  return face.turner.body == Turner::Body::a;
}

/// It some time (s) later, if it goes on as it moves.
SolverBody later(SolverBody body, double time) {
  body.position += time * body.velocity, body.turn += time * body.spin;
  return body;
}

/// How they stand now, before a face that is driven, felt a little farther on or back along it: where it will
/// have moved as far by the end of a substep h (s), along its normal, as the two come nearer by then. So who
/// goes along with it goes along a chord and keeps his speed, as impulses are along the normal of now.
FaceStand led(const PointContact& face, const SolverBody& a, const SolverBody& b, double h) {
  FaceStand stand(face, a, b);
  const double speed = PointArms{stand.arm_a, stand.arm_b, stand.normal}.normal_velocity(a, b);
  const double excess = FaceStand(face, later(a, h), later(b, h)).separation - stand.separation - h * speed;
  const Vec way = excess / (h * (is_of_a(face) ? a.spin : -b.spin)) * tangent(stand.normal);
  (is_of_a(face) ? stand.arm_a : stand.arm_b) += way;
  return stand;
}

/// How it is felt in a substep h (s) that begins now. Who is free gives way: he feels it as both will stand
/// halfway.
FaceStand felt(const PointContact& face, const SolverBody& a, const SolverBody& b, double h) {
  if ((is_of_a(face) ? a : b).inverse_inertia == 0.0) return led(face, a, b, h);
  return FaceStand(face, later(a, 0.5 * h), later(b, 0.5 * h));
}

/// `face` with that separation (m), felt like that.
PointContact placed(const PointContact& face, double separation, const FaceStand& felt, const SolverBody& a,
                    const SolverBody& b) {
  PointContact now = face;
  now.normal = felt.normal, now.arm_a = felt.arm_a, now.arm_b = felt.arm_b;
  now.first_a = Turn(-a.turn)(felt.arm_a - face.round_a * felt.normal);
  now.first_b = Turn(-b.turn)(felt.arm_b + face.round_b * felt.normal);
  now.gap = separation - felt.normal.dot(b.position + felt.arm_b - a.position - felt.arm_a);
  now.normal_mass = effective_mass(a, b, felt.arm_a, felt.arm_b, felt.normal);
  now.tangent_mass = effective_mass(a, b, felt.arm_a, felt.arm_b, tangent(felt.normal));
  return now;
}

}  // namespace

FaceStand::FaceStand(const PointContact& face, const SolverBody& a, const SolverBody& b)
    : normal(Turn(is_of_a(face) ? a.turn : b.turn)(face.turner.normal)),
      arm_a(Turn(a.turn)(face.first_a) + face.round_a * normal),
      arm_b(Turn(b.turn)(face.first_b) - face.round_b * normal) {
  const Vec between = b.position + face.turner.shift - a.position;
  separation = normal.dot(between + arm_b - arm_a);
  if (is_of_a(face))
    arm_a = between + arm_b - separation * normal;
  else
    arm_b = arm_a + separation * normal - between;
}

bool turns_now(const PointContact& face, const FaceStand& stand, const SolverBody& a, const SolverBody& b) {
  const Turner& turner = face.turner;
  if ((is_of_a(face) ? a : b).turn * turner.from < turner.from * turner.from) return false;
  const double along = tangent(stand.normal).dot(is_of_a(face) ? stand.arm_a : stand.arm_b);
  const double slack = kEnd * (turner.end - turner.begin);
  return along > turner.begin - slack && along < turner.end + slack;
}

void TurningFaces::add(std::size_t first, std::span<const PointContact> points) {
  Face& face = faces_.emplace_back(Face{first, points.size(), {}});
  std::ranges::copy(points, face.points.begin());
}

void TurningFaces::turn(FaceBlocks& blocks, BodyRows<const SolverBody> bodies, double h,
                        Workers& workers) const {
  workers.for_ranges(faces_.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) turn(faces_[i], blocks, bodies, h);
  });
}

void TurningFaces::turn(const Face& face, FaceBlocks& blocks, BodyRows<const SolverBody> bodies, double h) {
  const SolverBody &a = bodies[face.points[0].a], &b = bodies[face.points[0].b];
  std::array<PointContact, 2> points;
  bool turns = false;
  for (std::size_t p = 0; p < face.count; ++p) {
    const FaceStand now(face.points[p], a, b);
    turns |= turns_now(face.points[p], now, a, b);
    points[p] = placed(face.points[p], now.separation, felt(face.points[p], a, b, h), a, b);
  }
  if (turns) blocks.place(face.first, std::span(points).first(face.count));
}

}  // namespace throng
