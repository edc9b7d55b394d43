// SPDX-License-Identifier: MIT
#include "narrowphase/manifold.h"

#include <algorithm>
#include <limits>

#include "narrowphase/core_separation.h"
#include "narrowphase/face.h"
#include "narrowphase/relative.h"

namespace throng::narrowphase {

namespace {

/// What touches what. By places on the shapes, not by who is the reference: the names outlive a change of
/// roles.
enum class Touch : std::uint32_t { vertex_of_a, vertex_of_b, two_vertices, points };

std::uint32_t feature(Touch touch, std::size_t of_a, std::size_t of_b) {
  constexpr std::size_t kMask = 0x7fff;
  return static_cast<std::uint32_t>(touch) << 30 |
         static_cast<std::uint32_t>((of_a & kMask) << 15 | (of_b & kMask));
}

/// Whose face the contact is described on, and the other shape.
struct Roles {
  const Convex& reference;
  const Convex& incident;
  const Pose& frame;  // of the reference in the world
  const Pose incident_in_reference;
  bool reference_is_a;

  std::uint32_t name(Touch touch_if_a, std::size_t of_reference, std::size_t of_incident) const {
    if (reference_is_a) return feature(touch_if_a, of_reference, of_incident);
    const Touch touch = touch_if_a == Touch::vertex_of_a   ? Touch::vertex_of_b
                        : touch_if_a == Touch::vertex_of_b ? Touch::vertex_of_a
                                                           : touch_if_a;
    return feature(touch, of_incident, of_reference);
  }
};

/// Adds a point whose cores are `gap` apart along `normal`, `base` being on the reference's core. In its
/// frame.
void add(Manifold& m, const Roles& roles, const Vec& base, const Vec& normal, double gap, std::uint32_t name,
         double reach) {
  const double separation = gap - (roles.reference.radius + roles.incident.radius);
  if (separation > reach) return;
  const double middle = 0.5 * (gap + roles.reference.radius - roles.incident.radius);
  m.points[static_cast<std::size_t>(m.count++)] = {roles.frame * (base + middle * normal), separation, name};
}

void set_normal(Manifold& m, const Roles& roles, const Vec& normal) {
  m.normal = roles.frame.rotate(roles.reference_is_a ? normal : -normal);
}

/// An end of the stretch that both edges cover, along the reference face.
struct End {
  double along, gap;
  std::uint32_t name;
};

/// The reference face as a frame: `along` from its first vertex, `height` above it.
struct FaceFrame {
  Vec origin, normal, tangent;
  double length;

  FaceFrame(const Convex& shape, std::size_t edge)
      : origin(shape.vertices[edge]),
        normal(shape.normals[edge]),
        tangent(-normal.y(), normal.x()),
        length(dot(shape.vertices[next(edge, shape.vertices.size())] - origin, tangent)) {}
  double along(const Vec& p) const { return dot(tangent, p - origin); }
  double height(const Vec& p) const { return dot(normal, p - origin); }
};

/// The edge at the deepest vertex that looks most against the face: the index of its first vertex.
std::size_t incident_edge(const Convex& shape, std::size_t vertex, const Vec& normal) {
  const std::size_t before = previous(vertex, shape.vertices.size());
  return dot(shape.normals[before], normal) < dot(shape.normals[vertex], normal) ? before : vertex;
}

/// The single point of two corners that face each other.
void add_corners(Manifold& m, const Roles& roles, std::size_t corner, std::size_t vertex, const Vec& offset,
                 const Vec& fallback, double reach) {
  const Direction d = direction(offset, fallback);
  set_normal(m, roles, d.unit);
  add(m, roles, roles.reference.vertices[corner], d.unit, d.length,
      roles.name(Touch::two_vertices, corner, vertex), reach);
}

/// Clips the incident edge to the reference face and keeps the ends within reach.
Manifold clip(const Roles& roles, const Face& face, double reach) {
  const FaceFrame frame(roles.reference, face.edge);
  const Convex& incident = roles.incident;
  const std::size_t count = incident.vertices.size();
  const std::size_t edge =
      incident_edge(incident, face.vertex, roles.incident_in_reference.unrotate(frame.normal));
  const std::size_t head = next(edge, count);
  const Vec p =
      roles.incident_in_reference * incident.vertices[head];  // the end nearer to the face's beginning
  const Vec q = roles.incident_in_reference * incident.vertices[edge];
  const double p_along = frame.along(p), q_along = frame.along(q);
  const double p_height = frame.height(p), q_height = frame.height(q);
  const double stretch = q_along - p_along;
  const auto height_at = [&](double along) {
    return stretch > 0.0 ? p_height + (q_height - p_height) * ((along - p_along) / stretch) : p_height;
  };
  const std::size_t face_end = next(face.edge, roles.reference.vertices.size());
  const End low = p_along >= 0.0 ? End{p_along, p_height, roles.name(Touch::vertex_of_b, face.edge, head)}
                                 : End{0.0, height_at(0.0), roles.name(Touch::vertex_of_a, face.edge, edge)};
  const End high =
      q_along <= frame.length
          ? End{q_along, q_height, roles.name(Touch::vertex_of_b, face.edge, edge)}
          : End{frame.length, height_at(frame.length), roles.name(Touch::vertex_of_a, face_end, edge)};
  Manifold m;
  const bool covered = low.along <= high.along;

  const double deepest_along = face.vertex == edge ? q_along : p_along;
  if (deepest_along < 0.0 || deepest_along > frame.length) {
    const std::size_t corner = deepest_along < 0.0 ? face.edge : face_end;
    const Vec offset = (face.vertex == edge ? q : p) - roles.reference.vertices[corner];
    const double least = std::min(low.gap, high.gap);
    if (face.separation > 0.0 && (!covered || least * least > dot(offset, offset))) {
      add_corners(m, roles, corner, face.vertex, offset, frame.normal, reach);
      return m;
    }
  }
  set_normal(m, roles, frame.normal);
  if (!covered) {
    const double along = std::clamp(deepest_along, 0.0, frame.length);
    add(m, roles, frame.origin + along * frame.tangent, frame.normal, face.separation,
        roles.name(Touch::vertex_of_b, face.edge, face.vertex), reach);
    return m;
  }
  add(m, roles, frame.origin + low.along * frame.tangent, frame.normal, low.gap, low.name, reach);
  if (high.along > low.along)
    add(m, roles, frame.origin + high.along * frame.tangent, frame.normal, high.gap, high.name, reach);
  return m;
}

bool is_wall(const Convex& shape) {
  return shape.vertices.size() == 2 && shape.radius == 0.0;
}

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

Manifold polygon_manifold(const Convex& a, const Pose& pose_a, const Convex& b, const Pose& pose_b,
                          double reach) {
  const double enough = reach + a.radius + b.radius;
  const Pose b_in_a = relative(pose_a, pose_b);
  const bool wall_a = is_wall(a) && !is_wall(b), wall_b = is_wall(b) && !is_wall(a);
  const Pose a_in_b = inverse(b_in_a);
  const Face of_a = wall_a   ? wall_face(a, b, b_in_a)
                    : wall_b ? body_face(a, b, b_in_a, side(b, a_in_b.position))
                             : widest_face(a, b, b_in_a, enough);
  if (of_a.separation > enough) return {};
  const Face of_b = wall_b   ? wall_face(b, a, a_in_b)
                    : wall_a ? body_face(b, a, a_in_b, of_a.edge)
                             : widest_face(b, a, a_in_b, enough);
  if (of_b.separation > enough) return {};
  if (of_b.separation > of_a.separation) return clip({b, a, pose_b, a_in_b, false}, of_b, reach);
  return clip({a, b, pose_a, b_in_a, true}, of_a, reach);
}

Manifold disc_manifold(const Convex& a, const Pose& pose_a, const Convex& b, const Pose& pose_b,
                       double reach) {
  const Vec offset =
      (pose_b.position - pose_a.position) + (pose_b.rotate(b.vertices[0]) - pose_a.rotate(a.vertices[0]));
  const double enough = reach + a.radius + b.radius;
  const double squared = dot(offset, offset);
  Manifold m;
  if (squared > enough * enough) return m;
  const Direction d = direction(offset, {1.0, 0.0});
  const double separation = d.length - (a.radius + b.radius);
  m.normal = d.unit;
  m.count = 1;
  m.points[0] = {pose_a * a.vertices[0] + (a.radius + 0.5 * separation) * d.unit, separation,
                 feature(Touch::points, 0, 0)};
  return m;
}

/// A polygon or segment and a disc, in the polygon's frame.
Manifold polygon_disc_manifold(const Roles& roles, double reach) {
  const Convex& polygon = roles.reference;
  const Vec centre = roles.incident_in_reference * roles.incident.vertices[0];
  const CoreSeparation core = polygon_disc(polygon, centre);
  Manifold m;
  add(m, roles, core.point, core.normal, core.distance, feature(Touch::points, 0, 0), reach);
  if (m.count > 0) set_normal(m, roles, core.normal);
  return m;
}

}  // namespace

Manifold manifold(const Convex& a, const Pose& pose_a, const Convex& b, const Pose& pose_b, double reach) {
  const bool disc_a = a.vertices.size() == 1, disc_b = b.vertices.size() == 1;
  if (disc_a && disc_b) return disc_manifold(a, pose_a, b, pose_b, reach);
  if (disc_b) return polygon_disc_manifold({a, b, pose_a, relative(pose_a, pose_b), true}, reach);
  if (disc_a) return polygon_disc_manifold({b, a, pose_b, relative(pose_b, pose_a), false}, reach);
  return polygon_manifold(a, pose_a, b, pose_b, reach);
}

}  // namespace throng::narrowphase
