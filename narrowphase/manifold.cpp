// SPDX-License-Identifier: MIT
#include "narrowphase/manifold.h"

#include <algorithm>
#include <limits>

#include "narrowphase/core_separation.h"
#include "narrowphase/face.h"
#include "narrowphase/relative.h"
#include "narrowphase/wall.h"

namespace throng::narrowphase {

namespace {

/// What touches what. By places on the shapes, not by who is the reference: the names outlive a change of
/// roles.
enum class Touch : std::uint32_t { vertex_of_a, vertex_of_b, two_vertices, points };

// A feature, from its highest bit: whether b has the reference (1), whether the vertex of the reference is
// its face's head, not its tail (1), what touches what (2), the vertex or edge of a (14) and of b (14).
constexpr std::uint32_t kIndexBits = 14, kIndexMask = (1u << kIndexBits) - 1;
constexpr std::uint32_t kReferenceIsB = 1u << 31, kHead = 1u << 30, kRole = kReferenceIsB | kHead;

Touch touch_of(std::uint32_t feature) {
  return static_cast<Touch>(feature >> 2 * kIndexBits & 3u);
}

std::uint32_t feature(Touch touch, std::size_t of_a, std::size_t of_b, std::uint32_t role) {
  return role | static_cast<std::uint32_t>(touch) << 2 * kIndexBits |
         (static_cast<std::uint32_t>(of_a) & kIndexMask) << kIndexBits |
         (static_cast<std::uint32_t>(of_b) & kIndexMask);
}

/// `head`: the vertex of the reference is its face's head.
std::uint32_t name_of(bool of_b, Touch touch_if_a, std::size_t of_reference, std::size_t of_incident,
                      bool head = false) {
  const std::uint32_t end = head ? kHead : 0;
  if (!of_b) return feature(touch_if_a, of_reference, of_incident, end);
  const Touch touch = touch_if_a == Touch::vertex_of_a   ? Touch::vertex_of_b
                      : touch_if_a == Touch::vertex_of_b ? Touch::vertex_of_a
                                                         : touch_if_a;
  return feature(touch, of_incident, of_reference, kReferenceIsB | end);
}

// Of the ends of a face and of the incident edge over each other.
std::uint32_t name_of_vertex(bool of_b, std::size_t face, std::size_t incident_vertex) {
  return name_of(of_b, Touch::vertex_of_b, face, incident_vertex);
}
std::uint32_t name_above_tail(bool of_b, std::size_t face_tail, std::size_t incident_edge) {
  return name_of(of_b, Touch::vertex_of_a, face_tail, incident_edge);
}
std::uint32_t name_above_head(bool of_b, std::size_t face_head, std::size_t incident_edge) {
  return name_of(of_b, Touch::vertex_of_a, face_head, incident_edge, true);
}

/// Whose face the contact is described on, and the other shape.
struct Roles {
  const Convex& reference;
  const Convex& incident;
  const Pose& frame;  // of the reference in the world
  const Pose incident_in_reference;
  bool reference_is_a;
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

/// The reference face and the incident edge in its frame, which runs against it: the edge's head `p` comes
/// first.
struct Clip {
  const Roles& roles;
  const Face& face;
  FaceFrame frame;
  std::size_t edge, head, face_end;
  Vec p, q;
  double p_along, q_along;

  Clip(const Roles& r, const Face& f)
      : roles(r),
        face(f),
        frame(r.reference, f.edge),
        edge(incident_edge(r.incident, f.vertex, r.incident_in_reference.unrotate(frame.normal))),
        head(next(edge, r.incident.vertices.size())),
        face_end(next(f.edge, r.reference.vertices.size())),
        p(r.incident_in_reference * r.incident.vertices[head]),
        q(r.incident_in_reference * r.incident.vertices[edge]),
        p_along(frame.along(p)),
        q_along(frame.along(q)) {}

  double gap_at(double along) const {
    const double from = frame.height(p), to = frame.height(q);
    return from + (to - from) * ((along - p_along) / (q_along - p_along));
  }
  End low() const {
    if (p_along >= 0.0) return {p_along, frame.height(p), name_of_vertex(of_b(), face.edge, head)};
    return {0.0, gap_at(0.0), name_above_tail(of_b(), face.edge, edge)};
  }
  End high() const {
    if (q_along <= frame.length) return {q_along, frame.height(q), name_of_vertex(of_b(), face.edge, edge)};
    return {frame.length, gap_at(frame.length), name_above_head(of_b(), face_end, edge)};
  }
  /// The deepest vertex, where the two share no more than a point along the face.
  End deepest() const {
    return {std::clamp(deepest_along(), 0.0, frame.length), face.separation,
            name_of_vertex(of_b(), face.edge, face.vertex)};
  }
  bool of_b() const { return !roles.reference_is_a; }
  /// Whether the two share more than a point along the face.
  bool covers() const { return q_along > p_along && q_along > 0.0 && p_along < frame.length; }
  double deepest_along() const { return face.vertex == edge ? q_along : p_along; }
};

/// Two corners that face each other.
struct Corners {
  std::size_t of_reference, of_incident;
  bool head;  // of the reference face
  Vec offset;
};

/// The end of the face beyond which the deepest vertex lies, and the nearer end of the incident edge.
Corners corners(const Clip& c) {
  const std::size_t corner = c.deepest_along() < 0.0 ? c.face.edge : c.face_end;
  const Vec to_p = c.p - c.roles.reference.vertices[corner], to_q = c.q - c.roles.reference.vertices[corner];
  const bool head = corner == c.face_end;
  return dot(to_p, to_p) < dot(to_q, to_q) ? Corners{corner, c.head, head, to_p}
                                           : Corners{corner, c.edge, head, to_q};
}

Manifold corner_manifold(const Roles& roles, const Corners& c, const Vec& fallback, double reach) {
  const Direction d = direction(c.offset, fallback);
  Manifold m;
  add(m, roles, roles.reference.vertices[c.of_reference], d.unit, d.length,
      name_of(!roles.reference_is_a, Touch::two_vertices, c.of_reference, c.of_incident, c.head), reach);
  set_normal(m, roles, d.unit);
  return m;
}

/// Clips the incident edge to the reference face and keeps the ends within reach. Where the cores are apart
/// and nearest at two corners, these are the contact instead.
Manifold clip(const Roles& roles, const Face& face, double reach) {
  const Clip c(roles, face);
  const double deepest = c.deepest_along();
  const bool covers = c.covers();
  if (face.separation > 0.0 && (deepest < 0.0 || deepest > c.frame.length)) {
    const Corners facing = corners(c);
    const double least =
        covers ? std::min(c.low().gap, c.high().gap) : std::numeric_limits<double>::infinity();
    if (least * least > dot(facing.offset, facing.offset))
      return corner_manifold(roles, facing, c.frame.normal, reach);
  }
  Manifold m;
  const auto add_end = [&](const End& end) {
    add(m, roles, c.frame.origin + end.along * c.frame.tangent, c.frame.normal, end.gap, end.name, reach);
  };
  if (covers) {
    add_end(c.low());
    add_end(c.high());
  } else {
    add_end(c.deepest());
  }
  set_normal(m, roles, c.frame.normal);
  return m;
}

double edge_length(const Convex& shape, std::size_t edge) {
  return (shape.vertices[next(edge, shape.vertices.size())] - shape.vertices[edge]).norm();
}

/// On the reference's face `edge`, which was the last manifold's; empty where `widest`, a face of `owner`, is
/// wider by much, or where this one leaves out the deepest place.
Manifold kept_manifold(const Roles& roles, std::size_t edge, const Face& widest, const Convex& owner,
                       double reach) {
  if (edge >= roles.reference.normals.size()) return {};
  const Face face = face_at(roles.reference, edge, roles.incident, roles.incident_in_reference);
  const double much =
      kMuchWider * std::min(edge_length(roles.reference, edge), edge_length(owner, widest.edge));
  if (widest.separation > face.separation + much) return {};
  const Manifold m = clip(roles, face, reach);
  const double radii = roles.reference.radius + roles.incident.radius;
  return m.count > 0 && least_separation(m) + radii <= widest.separation + much ? m : Manifold{};
}

Manifold polygon_manifold(const Convex& a, const Pose& pose_a, const Convex& b, const Pose& pose_b,
                          double reach, const Reference& kept) {
  const double enough = reach + a.radius + b.radius;
  const Pose b_in_a = relative(pose_a, pose_b);
  // A pair that has a reference most likely touches: it is searched for its widest face at once, others only
  // if the face that looks at the other shape leaves them within reach.
  if (!kept.known && facing_face(a, b, b_in_a).separation > enough) return {};
  const Pose a_in_b = inverse(b_in_a);
  Face of_a = widest_face(a, b, b_in_a);
  if (of_a.separation > enough) return {};
  Face of_b = widest_face(b, a, a_in_b);
  if (of_b.separation > enough) return {};
  const double widest = std::max(of_a.separation, of_b.separation);
  const bool wall_a = is_wall(a), wall_b = is_wall(b);
  if (widest <= 0.0 && wall_a && !wall_b) take_sides(of_a, of_b, a, b, b_in_a, a_in_b);
  if (widest <= 0.0 && wall_b && !wall_a) take_sides(of_b, of_a, b, a, a_in_b, b_in_a);
  const bool b_is_wider = of_b.separation > of_a.separation;
  const Face& wider = b_is_wider ? of_b : of_a;
  if (kept.known && !wall_a && !wall_b && (kept.of_b != b_is_wider || kept.edge != wider.edge)) {
    const Roles roles = kept.of_b ? Roles{b, a, pose_b, a_in_b, false} : Roles{a, b, pose_a, b_in_a, true};
    const Manifold m = kept_manifold(roles, kept.edge, wider, b_is_wider ? b : a, reach);
    if (m.count > 0) return m;
  }
  if (b_is_wider) return clip({b, a, pose_b, a_in_b, false}, of_b, reach);
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
                 feature(Touch::points, 0, 0, 0)};
  return m;
}

/// A polygon or segment and a disc, in the polygon's frame.
Manifold polygon_disc_manifold(const Roles& roles, double reach) {
  const Convex& polygon = roles.reference;
  const Vec centre = roles.incident_in_reference * roles.incident.vertices[0];
  const double enough = reach + polygon.radius + roles.incident.radius;
  const CoreSeparation core = polygon_disc(polygon, centre, enough);
  Manifold m;
  if (core.distance > enough) return m;
  add(m, roles, core.point, core.normal, core.distance, feature(Touch::points, 0, 0, 0), reach);
  if (m.count > 0) set_normal(m, roles, core.normal);
  return m;
}

}  // namespace

Manifold manifold(const Convex& a, const Pose& pose_a, const Convex& b, const Pose& pose_b, double reach,
                  const Reference& kept) {
  const bool disc_a = a.vertices.size() == 1, disc_b = b.vertices.size() == 1;
  if (disc_a && disc_b) return disc_manifold(a, pose_a, b, pose_b, reach);
  if (disc_b) return polygon_disc_manifold({a, b, pose_a, relative(pose_a, pose_b), true}, reach);
  if (disc_a) return polygon_disc_manifold({b, a, pose_b, relative(pose_b, pose_a), false}, reach);
  return polygon_manifold(a, pose_a, b, pose_b, reach, kept);
}

Manifold manifold_on_face(const Convex& part, const Pose& part_pose, std::size_t edge, const Convex& body,
                          const Pose& body_pose, double reach, bool part_is_b) {
  if (body.vertices.size() == 1) return {};
  const Roles roles{part, body, part_pose, relative(part_pose, body_pose), !part_is_b};
  const Face face = face_at(part, edge, body, roles.incident_in_reference);
  const Clip c(roles, face);
  if (!c.covers()) return {};
  Manifold m;
  for (const End& end : {c.low(), c.high()})
    add(m, roles, c.frame.origin + end.along * c.frame.tangent, c.frame.normal, end.gap, end.name, reach);
  m.normal = part_pose.rotate(c.frame.normal);
  return m;
}

Reference reference(std::uint32_t feature, const Convex& a, const Convex& b) {
  if (touch_of(feature) == Touch::points) return {};
  const bool of_b = feature & kReferenceIsB;
  const std::uint32_t place = (of_b ? feature : feature >> kIndexBits) & kIndexMask;
  const std::size_t edge = feature & kHead ? previous(place, (of_b ? b : a).vertices.size()) : place;
  return {static_cast<std::uint32_t>(edge), of_b, true};
}

std::array<std::uint32_t, 4> end_names(const Convex& reference, std::size_t edge, const Convex& incident,
                                       std::size_t incident_edge, bool of_b) {
  const std::size_t head = next(incident_edge, incident.vertices.size());
  const std::size_t face_end = next(edge, reference.vertices.size());
  return {name_of_vertex(of_b, edge, head), name_of_vertex(of_b, edge, incident_edge),
          name_above_tail(of_b, edge, incident_edge), name_above_head(of_b, face_end, incident_edge)};
}

bool is_on_face(std::uint32_t feature) {
  return touch_of(feature) == Touch::vertex_of_a || touch_of(feature) == Touch::vertex_of_b;
}

bool reference_is_b(std::uint32_t feature) {
  return feature & kReferenceIsB;
}

std::uint32_t without_reference(std::uint32_t feature) {
  return feature & ~kRole;
}

}  // namespace throng::narrowphase
