// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstddef>

#include "narrowphase/closest.h"
#include "narrowphase/distance.h"
#include "narrowphase/relative.h"

/// One look at a vertex of one shape and an edge of another: how far apart they are, and whether this is the
/// distance of the two shapes.
namespace throng::narrowphase {

/// Two shapes and where they stand.
struct Placed {
  const Convex& a;
  const Pose& pose_a;
  const Convex& b;
  const Pose& pose_b;
};

/// The shape that the vertex belongs to, the one that the edge belongs to, and the first in the second's frame.
struct Side {
  const Convex* of_vertex;
  const Convex* of_edge;
  Pose frame;

  Side(const Placed& p, bool vertex_of_b)
      : of_vertex(vertex_of_b ? &p.b : &p.a),
        of_edge(vertex_of_b ? &p.a : &p.b),
        frame(vertex_of_b ? relative(p.pose_a, p.pose_b) : relative(p.pose_b, p.pose_a)) {}
};

/// In the frame of the edge's shape.
struct Probe {
  Vec vertex;          ///< m, where it is
  Vec offset;          ///< to the vertex from the corner before which it lies (m), else the edge's unit normal
  double height;       ///< m, of the vertex above the edge's line
  bool at_corner;      ///< the vertex lies beyond an end of the edge
  std::size_t corner;  ///< that end; else any
  std::size_t beyond;  ///< the edge after the corner
  bool edge_holds;     ///< all of the edge's shape lies behind: no other edge is closer to the vertex
};

inline Probe probe(const Side& side, std::size_t vertex, std::size_t edge) {
  const Convex& y = *side.of_edge;
  const std::size_t head = next(edge, y.vertices.size());
  const Vec normal = y.normals[edge];
  Probe p;
  p.vertex = side.frame * side.of_vertex->vertices[vertex];
  const Vec from_tail = p.vertex - y.vertices[edge];
  const bool before_tail = cross(normal, from_tail) < 0.0;
  const bool past_head = cross(normal, p.vertex - y.vertices[head]) > 0.0;
  p.height = dot(normal, from_tail);
  p.at_corner = before_tail | past_head;
  p.corner = before_tail ? edge : head;
  p.beyond = before_tail ? previous(edge, y.vertices.size()) : head;
  const Vec offsets[] = {normal, p.vertex - y.vertices[p.corner]};
  p.offset = offsets[p.at_corner];
  // At a corner the offset must be between the normals of its two edges. Where these are all but parallel, the
  // far side is between them too, up to rounding: hence the heights.
  const Vec& other = y.normals[p.beyond];
  const double turn = cross(other, p.offset);
  const bool between = (before_tail ? turn >= 0.0 : turn <= 0.0) &
                       ((dot(other, p.offset) >= 0.0) | (p.height >= 0.0));
  p.edge_holds = p.at_corner ? between : p.height > 0.0;
  return p;
}

/// Whether all of the vertex's shape lies before the vertex, and where not: which neighbour is closer.
struct Neighbours {
  bool next_is_closer = false, previous_is_closer = false;
  bool vertex_holds = true;  ///< false too where the vertex is on the far side of its shape
};

inline Neighbours neighbours(const Side& side, std::size_t vertex, const Vec& offset) {
  const Convex& x = *side.of_vertex;
  if (x.normals.empty()) return {};
  const Vec in_x = side.frame.unrotate(offset);
  const Vec &before = x.normals[previous(vertex, x.vertices.size())], &after = x.normals[vertex];
  const bool to_next = cross(after, in_x) < 0.0, to_previous = cross(before, in_x) > 0.0;
  const bool near_side = (dot(before, in_x) <= 0.0) | (dot(after, in_x) <= 0.0);
const bool holds = !to_next & !to_previous & near_side;
  return {to_next, to_previous, holds};
}

/// A probe with its proof.
struct Look {
  Side side;
  Probe probed;
  Neighbours around;

  Look(const Placed& placed, const ClosestFeatures& f)
      : side(placed, f.vertex_of_b),
        probed(probe(side, f.vertex, f.edge)),
        around(neighbours(side, f.vertex, probed.offset)) {}

  /// Whether nothing is closer, and the gap wide enough for its square to keep its digits.
  bool proves() const {
    return probed.edge_holds & around.vertex_holds & (dot(probed.offset, probed.offset) > 0x1p-960);
  }
};

/// Whether both shapes have the features.
inline bool exist(const ClosestFeatures& f, const Placed& p) {
  const Convex &of_vertex = f.vertex_of_b ? p.b : p.a, &of_edge = f.vertex_of_b ? p.a : p.b;
  return (f.vertex < of_vertex.vertices.size()) & (f.edge < of_edge.normals.size());
}

/// The answer that a probe has proven, in the world. Expects an offset whose square keeps its digits.
inline Separation answer(const Placed& placed, const Probe& p, bool vertex_of_b) {
  const Pose& pose = vertex_of_b ? placed.pose_a : placed.pose_b;
  const double length = std::sqrt(dot(p.offset, p.offset));
  const double core = p.at_corner ? length : p.height;
  const Vec unit = p.at_corner ? Vec{p.offset.x() / length, p.offset.y() / length} : p.offset;
  const double distance = core - (placed.a.radius + placed.b.radius);
  const Vec normal = pose.rotate(unit);
  const Vec point =
      pose * (p.vertex - (core - (vertex_of_b ? placed.a.radius : placed.b.radius)) * unit);
  const Vec other = point + distance * normal;
  if (vertex_of_b) return {distance, normal, point, other};
  return {distance, -normal, other, point};
}

}  // namespace throng::narrowphase
