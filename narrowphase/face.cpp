// SPDX-License-Identifier: MIT
#include "narrowphase/face.h"

#include <algorithm>
#include <limits>

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

/// Of vertex `vertex` of b from the line of `edge`, whose normal in b's frame is `normal`.
double height(const Convex& a, std::size_t edge, const Convex& b, std::size_t vertex, const Pose& b_in_a,
              const Vec& normal) {
  return dot(normal, b.vertices[vertex]) + dot(a.normals[edge], b_in_a.position - a.vertices[edge]);
}

/// Four edges at a time: elementwise, so that their width changes no bit.
constexpr std::size_t kLanes = 4;
using Lanes = Eigen::Array<double, kLanes, 1>;

/// How far all of `b` stays before the lines of four edges of `a` from `edge` on; the last edge fills up.
Lanes separations(const Convex& a, const Convex& b, const Pose& b_in_a, std::size_t edge) {
  Lanes x, y, to_b_x, to_b_y;
  for (std::size_t lane = 0; lane < kLanes; ++lane) {
    const std::size_t i = std::min(edge + lane, a.normals.size() - 1);
    const int l = static_cast<int>(lane);
    x[l] = a.normals[i].x(), y[l] = a.normals[i].y();
    to_b_x[l] = b_in_a.position.x() - a.vertices[i].x(), to_b_y[l] = b_in_a.position.y() - a.vertices[i].y();
  }
  const Lanes in_b_x = b_in_a.cos * x + b_in_a.sin * y, in_b_y = b_in_a.cos * y - b_in_a.sin * x;
  Lanes least = Lanes::Constant(std::numeric_limits<double>::infinity());
  for (const Vec& v : b.vertices) least = least.min(in_b_x * v.x() + in_b_y * v.y());
  return least + (x * to_b_x + y * to_b_y);
}

/// For few vertices: all of them for every edge, without a branch to mispredict.
Face scan(const Convex& a, const Convex& b, const Pose& b_in_a) {
  double widest = -std::numeric_limits<double>::infinity();
  std::size_t widest_edge = 0;
  for (std::size_t first = 0; first < a.normals.size(); first += kLanes) {
    const Lanes s = separations(a, b, b_in_a, first);
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      const double separation = s[static_cast<int>(lane)];
      widest_edge = separation > widest ? first + lane : widest_edge;
      widest = separation > widest ? separation : widest;
    }
  }
  return {widest, widest_edge, deepest_vertex(b, b_in_a.unrotate(a.normals[widest_edge]))};
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

Face facing_face(const Convex& a, const Convex& b, const Pose& b_in_a) {
  return face_at(a, facing_edge(a, b_in_a.position), b, b_in_a);
}

Face widest_face(const Convex& a, const Convex& b, const Pose& b_in_a) {
  constexpr std::size_t kFew = 32;  // where the two cost the same
  return b.vertices.size() <= kFew ? scan(a, b, b_in_a) : walk(a, b, b_in_a);
}

Faces widest_faces(const Convex& a, const Convex& b, const Pose& b_in_a, const Pose& a_in_b) {
  return {widest_face(a, b, b_in_a), widest_face(b, a, a_in_b)};
}

}  // namespace throng::narrowphase
