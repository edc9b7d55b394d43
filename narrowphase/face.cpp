// SPDX-License-Identifier: MIT
#include "narrowphase/face.h"

#include "narrowphase/relative.h"

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

}  // namespace

Face widest_face(const Convex& a, const Convex& b, const Pose& b_in_a, double enough) {
  const std::size_t count = a.normals.size();
  std::size_t edge = facing_edge(a, b_in_a.position);
  Vec normal = b_in_a.unrotate(a.normals[edge]);
  std::size_t vertex = deepest_vertex(b, normal);
  Face best{-std::numeric_limits<double>::infinity(), edge, vertex};
  for (std::size_t step = 0; step < count; ++step) {
    const double separation =
        dot(normal, b.vertices[vertex]) + dot(a.normals[edge], b_in_a.position - a.vertices[edge]);
    if (separation > best.separation) best = {separation, edge, vertex};
    if (separation > enough) return best;
    const std::size_t following = next(edge, count);
    const bool sharp = dot(a.normals[edge], a.normals[following]) <= 0.0;
    edge = following;
    normal = b_in_a.unrotate(a.normals[edge]);
    vertex = sharp ? deepest_vertex(b, normal) : descend(b, normal, vertex);
  }
  return best;
}

}  // namespace throng::narrowphase
