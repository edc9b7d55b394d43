// SPDX-License-Identifier: MIT
#include "narrowphase/wall.h"

#include <limits>

#include "narrowphase/relative.h"

namespace throng::narrowphase {

namespace {

/// The side of a wall on which a body's centre stands, as the wall's edge that looks there.
std::size_t side(const Convex& wall, const Vec& centre) {
  return dot(wall.normals[0], centre - wall.vertices[0]) >= 0.0 ? 0 : 1;
}

/// The face of `wall` towards the body's centre, and the vertex of the body deepest behind it.
Face wall_face(const Convex& wall, const Convex& body, const Pose& body_in_wall) {
  const std::size_t edge = side(wall, body_in_wall.position);
  const Vec normal = body_in_wall.unrotate(wall.normals[edge]);
  Face face{std::numeric_limits<double>::infinity(), edge, 0};
  for (std::size_t j = 0; j < body.vertices.size(); ++j)
    if (const double height = dot(normal, body.vertices[j]); height < face.separation)
      face = {height, edge, j};
  face.separation += dot(wall.normals[edge], body_in_wall.position - wall.vertices[0]);
  return face;
}

/// The widest face of a body against a wall, of those that don't push it across: its normal leans against the
/// wall's side by at most 60 degrees.
Face body_face(const Convex& body, const Convex& wall, const Pose& wall_in_body, std::size_t wall_side) {
  const Vec wrong = wall_in_body.rotate(wall.normals[wall_side]);
  const Vec ends[] = {wall_in_body * wall.vertices[0], wall_in_body * wall.vertices[1]};
  Face best{-std::numeric_limits<double>::infinity(), 0, 0};
  for (std::size_t i = 0; i < body.vertices.size(); ++i) {
    if (dot(body.normals[i], wrong) > 0.5) continue;
    const double heights[] = {dot(body.normals[i], ends[0] - body.vertices[i]),
                              dot(body.normals[i], ends[1] - body.vertices[i])};
    const std::size_t lower = heights[1] < heights[0] ? 1 : 0;
    if (heights[lower] > best.separation) best = {heights[lower], i, lower};
  }
  return best;
}

/// Whether the point lies over the edge, not beyond one of its ends.
bool covers(const Convex& shape, std::size_t edge, const Vec& point) {
  const Vec& tail = shape.vertices[edge];
  const Vec& head = shape.vertices[next(edge, shape.vertices.size())];
  return dot(point - tail, head - tail) >= 0.0 && dot(point - head, tail - head) >= 0.0;
}

}  // namespace

void take_sides(Face& of_wall, Face& of_body, const Convex& wall, const Convex& body,
                const Pose& body_in_wall, const Pose& wall_in_body) {
  const Face on_wall = wall_face(wall, body, body_in_wall);
  const Face on_body = body_face(body, wall, wall_in_body, on_wall.edge);
  const bool pushes = on_body.separation > on_wall.separation
                          ? covers(body, on_body.edge, wall_in_body * wall.vertices[on_body.vertex])
                          : covers(wall, on_wall.edge, body_in_wall * body.vertices[on_wall.vertex]);
  if (pushes) of_wall = on_wall, of_body = on_body;
}

}  // namespace throng::narrowphase
