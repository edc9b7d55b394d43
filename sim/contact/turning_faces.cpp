// SPDX-License-Identifier: MIT
#include "sim/contact/turning_faces.h"

#include <algorithm>

#include "sim/contact/face_stand.h"

namespace throng {

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
  std::array<FaceStand, 2> stands;
  find_stands(std::span(face.points).first(face.count), a, b, std::span(stands).first(face.count));
  if (!stands[0].turns) return;
  std::array<PointContact, 2> points = face.points;
  for (std::size_t i = 0; i < face.count; ++i) {
    PointContact& contact = points[i];
    turn_to(contact, felt(contact, stands[i], a, b, h), stands[i].separation, a, b);
    contact.first_a = Turn(-a.turn)(contact.arm_a - contact.round_a * contact.normal);
    contact.first_b = Turn(-b.turn)(contact.arm_b + contact.round_b * contact.normal);
  }
  blocks.place(face.first, std::span(points).first(face.count));
}

}  // namespace throng
