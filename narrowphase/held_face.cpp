// SPDX-License-Identifier: MIT
#include "narrowphase/held_face.h"

#include <algorithm>
#include <limits>

#include "narrowphase/face.h"
#include "narrowphase/relative.h"
#include "narrowphase/wall.h"

namespace throng::narrowphase {

namespace {

double farthest_vertex(const Convex& shape) {
  double most = 0.0;
  for (const Vec& v : shape.vertices) most = std::max(most, dot(v, v));
  return std::sqrt(most);
}

/// The widest of all edges of `a` but one.
double widest_but(const Convex& a, std::size_t left_out, const Convex& b, const Pose& b_in_a) {
  double widest = -std::numeric_limits<double>::infinity();
  for (std::size_t edge = 0; edge < a.normals.size(); ++edge)
    if (edge != left_out) widest = std::max(widest, face_at(a, edge, b, b_in_a).separation);
  return widest;
}

/// How much higher above a face all other vertices of `b` are than the lower end of its edge.
double room_above(const Convex& b, std::size_t edge, const Vec& normal) {
  const std::size_t head = next(edge, b.vertices.size());
  const double lower = std::min(dot(normal, b.vertices[edge]), dot(normal, b.vertices[head]));
  double room = std::numeric_limits<double>::infinity();
  for (std::size_t j = 0; j < b.vertices.size(); ++j)
    if (j != edge && j != head) room = std::min(room, dot(normal, b.vertices[j]) - lower);
  return room;
}

/// How much more the edge looks against a face than its neighbours do.
double room_beside(const Convex& b, std::size_t edge, const Vec& normal) {
  const std::size_t count = b.normals.size();
  const double beside =
      std::min(dot(b.normals[previous(edge, count)], normal), dot(b.normals[next(edge, count)], normal));
  return beside - dot(b.normals[edge], normal);
}

/// Two values that each change by what is moved meet after half of their difference.
void hold_face(HeldFace& held, const Convex& reference, const Convex& other, const Pose& other_in_reference) {
  const Face face = face_at(reference, held.reference, other, other_in_reference);
  const Vec normal = other_in_reference.unrotate(reference.normals[held.reference]);
  held.incident = incident_edge(other, face.vertex, normal);
  const double widest = std::max(widest_but(reference, held.reference, other, other_in_reference),
                                 widest_but(other, held.incident, reference, inverse(other_in_reference)));
  held.most = 0.5 * std::min({face.separation - widest, room_above(other, held.incident, normal),
                              held.lever * room_beside(other, held.incident, normal)}) -
              kHeldRounding * held.lever;
  if (held.most > 0.0) held.kind = HeldFace::Kind::face;
}

void hold_apart(HeldFace& held, const Convex& a, const Convex& b) {
  const Faces faces = widest_faces(a, b, held.b_in_a, inverse(held.b_in_a));
  held.most = faces.widest().separation - kHeldRounding * held.lever;
  if (held.most > 0.0) held.kind = HeldFace::Kind::apart;
}

}  // namespace

HeldFace hold(const Convex& a, const Convex& b, const Pose& b_in_a, const Manifold& m) {
  HeldFace held;
  held.b_in_a = b_in_a;
  held.lever = farthest_vertex(a) + farthest_vertex(b) + length(b_in_a.position);
  if (is_wall(a) || is_wall(b)) return held;
  if (m.count == 0) {
    hold_apart(held, a, b);
    return held;
  }
  if (!is_on_face(m.points[0].feature)) return held;
  const Reference reference = narrowphase::reference(m.points[0].feature, a, b);
  held.of_b = reference.of_b, held.reference = reference.edge;
  if (held.of_b)
    hold_face(held, b, a, inverse(b_in_a));
  else
    hold_face(held, a, b, b_in_a);
  return held;
}

double movement(const HeldFace& held, const Pose& b_in_a) {
  const Vec way = b_in_a.position - held.b_in_a.position;
  const Vec turn{b_in_a.cos - held.b_in_a.cos, b_in_a.sin - held.b_in_a.sin};
  return std::sqrt(dot(way, way)) + held.lever * std::sqrt(dot(turn, turn));
}

}  // namespace throng::narrowphase
