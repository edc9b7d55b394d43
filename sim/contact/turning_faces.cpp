// SPDX-License-Identifier: MIT
#include "sim/contact/turning_faces.h"

#include <algorithm>
#include <cmath>

namespace throng {

namespace {

/// The two half a substep h (s) later, if they go on as they move.
SolverBody halfway(SolverBody body, double h) {
  body.position += 0.5 * h * body.velocity, body.turn += 0.5 * h * body.spin;
  return body;
}

/// Of bodies as they stand: the turner's arm ends below the other's point.
struct Stand {
  Vec normal, arm_a, arm_b;
  double separation;  // m

  Stand(const PointContact& face, const Vec& shift, const SolverBody& a, const SolverBody& b) {
    const bool of_a = face.turner == Turner::a;
    normal = Turn(of_a ? a.turn : b.turn)(face.normal);
    arm_a = Turn(a.turn)(face.first_a) + face.round_a * normal;
    arm_b = Turn(b.turn)(face.first_b) - face.round_b * normal;
    const Vec between = b.position + shift - a.position;
    separation = normal.dot(between + arm_b - arm_a);
    if (of_a)
      arm_a = between + arm_b - separation * normal;
    else
      arm_b = arm_a + separation * normal - between;
  }
};

/// `face` as far apart as the two are, and felt as it will be halfway through the substep: who goes along
/// with it goes along a chord.
PointContact placed(const PointContact& face, const Vec& shift, const SolverBody& a, const SolverBody& b,
                    double h) {
  const double separation = Stand(face, shift, a, b).separation;
  const Stand then(face, shift, halfway(a, h), halfway(b, h));
  PointContact now = face;
  now.normal = then.normal, now.arm_a = then.arm_a, now.arm_b = then.arm_b;
  now.first_a = Turn(-a.turn)(then.arm_a - face.round_a * then.normal);
  now.first_b = Turn(-b.turn)(then.arm_b + face.round_b * then.normal);
  now.gap = separation - then.normal.dot(b.position + then.arm_b - a.position - then.arm_a);
  now.normal_mass = effective_mass(a, b, then.arm_a, then.arm_b, then.normal);
  now.tangent_mass = effective_mass(a, b, then.arm_a, then.arm_b, tangent(then.normal));
  return now;
}

}  // namespace

void TurningFaces::add(std::size_t first, std::span<const PointContact> points, const Vec& shift, double when,
                       BodyRows<const SolverBody> bodies) {
  Face& face = faces_.emplace_back(Face{first, points.size(), {}, shift, 0.0});
  const SolverBody& turner = bodies[points[0].turner == Turner::a ? points[0].a : points[0].b];
  face.from = when * turner.spin;
  std::ranges::copy(points, face.points.begin());
  for (PointContact& point : face.points) point.normal = Turn(-face.from)(point.normal);
}

void TurningFaces::turn(FaceBlocks& blocks, BodyRows<const SolverBody> bodies, double h,
                        Workers& workers) const {
  workers.for_ranges(faces_.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) turn(faces_[i], blocks, bodies, h);
  });
}

void TurningFaces::turn(const Face& face, FaceBlocks& blocks, BodyRows<const SolverBody> bodies, double h) {
  const SolverBody &a = bodies[face.points[0].a], &b = bodies[face.points[0].b];
  if (std::abs((face.points[0].turner == Turner::a ? a : b).turn) < std::abs(face.from)) return;
  std::array<PointContact, 2> points;
  for (std::size_t p = 0; p < face.count; ++p) points[p] = placed(face.points[p], face.shift, a, b, h);
  blocks.place(face.first, std::span(points).first(face.count));
}

}  // namespace throng
