// SPDX-License-Identifier: MIT
#include "narrowphase/face.h"

#include <limits>

#include "narrowphase/relative.h"
#include "narrowphase/scan_face.h"

namespace throng::narrowphase {

namespace {

std::size_t facing_edge(const Convex& a, const Vec& towards) {
  std::size_t best = 0;
  double most = dot(a.normals[0], towards);
  for (std::size_t i = 1; i < a.normals.size(); ++i)
    if (const double d = dot(a.normals[i], towards); d > most) most = d, best = i;
  return best;
}

std::size_t deepest_vertex(const Convex& b, const Vec& normal) {
  std::size_t best = 0;
  double least = dot(normal, b.vertices[0]);
  for (std::size_t j = 1; j < b.vertices.size(); ++j)
    if (const double d = dot(normal, b.vertices[j]); d < least) least = d, best = j;
  return best;
}

/// Goes on from vertex `j` while the edges of b lead down. By the edges, whose differences are exact enough
/// to be trusted, not by heights: a tiny edge can't end the walk before a long one.
std::size_t descend(const Convex& b, const Vec& normal, std::size_t j) {
  const std::size_t count = b.vertices.size();
  for (std::size_t step = 0; step < count; ++step) {
    const std::size_t following = next(j, count);
    if (dot(normal, b.vertices[following] - b.vertices[j]) >= 0.0) break;
    j = following;
  }
  return j;
}

/// Of vertex `vertex` of b from the line of `edge`, whose normal in b's frame is `normal`.
double height(const Convex& a, std::size_t edge, const Convex& b, std::size_t vertex, const Pose& b_in_a,
              const Vec& normal) {
  return dot(normal, b.vertices[vertex]) + dot(a.normals[edge], b_in_a.position - a.vertices[edge]);
}

/// For many vertices: from edge to edge the deepest vertex only moves on.
Face walk(const Convex& a, const Convex& b, const Pose& b_in_a) {
  Face best{-std::numeric_limits<double>::infinity(), 0, 0};
  std::size_t vertex = 0;
  for (std::size_t edge = 0; edge < a.normals.size(); ++edge) {
    const Vec normal = b_in_a.unrotate(a.normals[edge]);
    const bool sharp = edge == 0 || dot(a.normals[edge - 1], a.normals[edge]) <= 0.0;
    vertex = sharp ? deepest_vertex(b, normal) : descend(b, normal, vertex);
    const double separation = height(a, edge, b, vertex, b_in_a, normal);
    if (separation > best.separation) best = {separation, edge, vertex};
  }
  return best;
}

}  // namespace

Face face_at(const Convex& a, std::size_t edge, const Convex& b, const Pose& b_in_a) {
  const Vec normal = b_in_a.unrotate(a.normals[edge]);
  const std::size_t vertex = deepest_vertex(b, normal);
  return {height(a, edge, b, vertex, b_in_a, normal), edge, vertex};
}

std::size_t incident_edge(const Convex& shape, std::size_t deepest, const Vec& normal) {
  const std::size_t before = previous(deepest, shape.vertices.size());
  return dot(shape.normals[before], normal) < dot(shape.normals[deepest], normal) ? before : deepest;
}

Face facing_face(const Convex& a, const Convex& b, const Pose& b_in_a) {
  return face_at(a, facing_edge(a, b_in_a.position), b, b_in_a);
}

Face widest_face(const Convex& a, const Convex& b, const Pose& b_in_a) {
  constexpr std::size_t kFew = 32;  // where the two cost about the same
  return b.vertices.size() <= kFew ? scan_face(a, b, b_in_a) : walk(a, b, b_in_a);
}

Faces widest_faces(const Convex& a, const Convex& b, const Pose& b_in_a, const Pose& a_in_b) {
  return {widest_face(a, b, b_in_a), widest_face(b, a, a_in_b)};
}

}  // namespace throng::narrowphase
