// SPDX-License-Identifier: MIT
#include "narrowphase/support.h"

namespace throng::narrowphase {

namespace {

std::size_t scan(const Convex& shape, const Vec& direction) {
  std::size_t best = 0;
  double most = dot(direction, shape.vertices[0]);
  for (std::size_t i = 1; i < shape.vertices.size(); ++i) {
    const double d = dot(direction, shape.vertices[i]);
    best = d > most ? i : best;
    most = d > most ? d : most;
  }
  return best;
}

/// Whether `v` is more than half a turn past `base`, counter-clockwise.
bool is_past_half(const Vec& base, const Vec& v) {
  const double turn = cross(base, v);
  return turn < 0.0 || (turn == 0.0 && dot(base, v) < 0.0);
}

/// The last edge whose normal is not past `direction`, counter-clockwise from the first edge's.
std::size_t last_edge_before(const Convex& shape, const Vec& direction) {
  const Vec& base = shape.normals[0];
  const bool far = is_past_half(base, direction);
  std::size_t low = 0, high = shape.normals.size();
  while (high - low > 1) {
    const std::size_t middle = low + (high - low) / 2;
    const Vec& normal = shape.normals[middle];
    const bool is_far = is_past_half(base, normal);
    const bool past = is_far != far ? is_far : cross(normal, direction) < 0.0;
    (past ? high : low) = middle;
  }
  return low;
}

}  // namespace

std::size_t support(const Convex& shape, const Vec& direction) {
  constexpr std::size_t kFew = 32;
  const std::size_t count = shape.vertices.size();
  return count <= kFew ? scan(shape, direction) : next(last_edge_before(shape, direction), count);
}

}  // namespace throng::narrowphase
