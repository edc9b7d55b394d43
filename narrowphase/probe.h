// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstddef>

#include "narrowphase/closest.h"
#include "narrowphase/distance.h"
#include "narrowphase/relative.h"

/// One look at a vertex of one shape and an edge of another: how far apart they are, and whether this is the
/// distance of the two shapes.
///
/// What decides is chosen here by index and address, not by jumps: over many pairs, each with features of its
/// own, jumps would be mispredicted as often as not.
namespace throng::narrowphase {

/// Two shapes and where they stand.
struct Placed {
  const Convex& a;
  const Pose& pose_a;
  const Convex& b;
  const Pose& pose_b;
};

/// `v` along a unit vector and along that vector turned left: its two coordinates in the vector's frame.
inline Vec along(const Vec& unit, const Vec& v) {
  return v.x() * Vec{unit.x(), -unit.y()} + v.y() * Vec{unit.y(), unit.x()};
}

struct Look {
  const Convex *x, *y;  ///< the shape of the vertex, and that of the edge
  const Pose *pose_x, *pose_y;
  Vec arm;      ///< m, in the world's directions, from x's origin to the vertex
  Vec vertex;   ///< m, in the frame of y
  Vec offset;   ///< to the vertex from the end of the edge beyond which it lies (m), else the edge's unit
                ///< normal
  Vec outward;  ///< the same in the world's directions
  Vec inward;   ///< and in those of x
  double past_tail, past_head;  ///< m, of the vertex along the edge, from its two ends
  double height;                ///< m, of the vertex above the edge's line
  double squared;      ///< m², the offset's length at a corner; must be large enough to keep its digits
  bool at_corner;      ///< the vertex lies beyond an end of the edge
  std::size_t head;    ///< of the edge
  std::size_t corner;  ///< that end; else any
  std::size_t beyond;  ///< the edge after the corner
  bool edge_holds;     ///< all of y lies behind, up to rounding: none of its edges is closer to the vertex
  bool next_is_closer, previous_is_closer;  ///< neighbours of the vertex
  bool vertex_holds;                        ///< all of x lies before the vertex

  [[gnu::always_inline]] Look(const Placed& p, const ClosestFeatures& f)
      : x(f.vertex_of_b ? &p.b : &p.a),
        y(f.vertex_of_b ? &p.a : &p.b),
        pose_x(f.vertex_of_b ? &p.pose_b : &p.pose_a),
        pose_y(f.vertex_of_b ? &p.pose_a : &p.pose_b) {
    look_at_edge(f.vertex, f.edge);
    look_at_vertex(f.vertex);
  }

  /// Whether nothing is closer.
  bool proves() const { return edge_holds & vertex_holds; }

 private:
  /// Below which the height of a vertex there means nothing.
  static double rounding(const Vec& v) { return 0x1p-52 * (std::abs(v.x()) + std::abs(v.y())); }

  [[gnu::always_inline]] void look_at_edge(std::size_t vertex_of_x, std::size_t edge) {
    arm = pose_x->rotate(x->vertices[vertex_of_x]);
    vertex = pose_y->unrotate(arm + (pose_x->position - pose_y->position));
    const std::size_t count = y->vertices.size();
    head = next(edge, count);
    const Vec& normal = y->normals[edge];
    const Vec from_tail = vertex - y->vertices[edge], from_head = vertex - y->vertices[head];
    height = dot(normal, from_tail);
    past_tail = cross(normal, from_tail), past_head = cross(normal, from_head);
    if (past_tail < 0.0)
      look_at_corner(from_tail, edge, previous(edge, count), 1.0);
    else if (past_head > 0.0)
      look_at_corner(from_head, head, head, -1.0);
    else
      offset = normal, at_corner = false, edge_holds = height > -rounding(vertex);
  }

  /// The vertex lies beyond an end of the edge, where another one begins: counter-clockwise from it if `turn`
  /// is -1.
  [[gnu::always_inline]] void look_at_corner(const Vec& from_corner, std::size_t end, std::size_t other_edge,
                                             double turn) {
    offset = from_corner, at_corner = true, corner = end, beyond = other_edge;
    // The offset must be between the normals of the two edges. Where these are all but parallel, the far side
    // is between them too, up to rounding: hence the heights.
    const Vec& other = y->normals[other_edge];
    const bool between = turn * cross(other, offset) >= 0.0;
    const bool near_side = dot(other, offset) >= 0.0 || height >= 0.0;
    squared = dot(offset, offset);
    edge_holds = between && near_side && squared > 0x1p-960;
  }

  [[gnu::always_inline]] void look_at_vertex(std::size_t vertex_of_x) {
    outward = pose_y->rotate(offset);
    next_is_closer = previous_is_closer = false, vertex_holds = true;
    if (x->normals.empty()) return;
    inward = pose_x->unrotate(outward);
    const Vec &before = x->normals[previous(vertex_of_x, x->vertices.size())],
              &after = x->normals[vertex_of_x];
    next_is_closer = cross(after, inward) < 0.0;
    previous_is_closer = cross(before, inward) > 0.0;
    vertex_holds = !next_is_closer & !previous_is_closer & (dot(before + after, inward) <= 0.0);
  }
};

/// Whether both shapes have the features.
inline bool exist(const ClosestFeatures& f, const Placed& p) {
  const Convex &of_vertex = f.vertex_of_b ? p.b : p.a, &of_edge = f.vertex_of_b ? p.a : p.b;
  return f.vertex < of_vertex.vertices.size() && f.edge < of_edge.normals.size();
}

/// The answer that a look has proven, in the world.
inline Separation answer(const Look& look, bool vertex_of_b) {
  const double length = look.at_corner ? std::sqrt(look.squared) : 1.0;
  const double core = look.at_corner ? length : look.height;
  const Vec towards_x = look.at_corner ? Vec{look.outward / length} : look.outward;
  const double distance = core - (look.x->radius + look.y->radius);
  const Vec on_x = (look.pose_x->position + look.arm) - look.x->radius * towards_x;
  const Vec on_y = on_x - distance * towards_x;
  if (vertex_of_b) return {distance, towards_x, on_y, on_x};
  return {distance, -towards_x, on_x, on_y};
}

}  // namespace throng::narrowphase
