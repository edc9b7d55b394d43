// SPDX-License-Identifier: MIT
#include "narrowphase/rim.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "narrowphase/half_plane.h"
#include "narrowphase/relative.h"
#include "narrowphase/weld.h"

namespace throng::narrowphase {

namespace {

constexpr double kFlat = 1e-6;      // sine of the least turn that counts
constexpr double kStraight = 1e-2;  // likewise, of the least beyond which the part beyond holds a body alone

/// A directed edge of a part, the solid on its left, between numbered points.
struct DirectedEdge {
  std::uint32_t tail, head;
  std::uint32_t part, edge;
  Vec way;
};

std::vector<DirectedEdge> sides(std::span<const Convex> parts) {
  std::vector<Vec> points;
  for (const Convex& part : parts) points.insert(points.end(), part.vertices.begin(), part.vertices.end());
  const std::vector<std::uint32_t> number = weld(points);
  std::vector<DirectedEdge> result;
  std::size_t first = 0;
  for (std::uint32_t p = 0; p < parts.size(); ++p) {
    const std::vector<Vec>& v = parts[p].vertices;
    for (std::uint32_t e = 0; v.size() > 1 && e < v.size(); ++e) {
      const std::size_t head = next(e, v.size());
      result.push_back({number[first + e], number[first + head], p, e, v[head] - v[e]});
    }
    first += v.size();
  }
  std::ranges::stable_sort(result, {}, &DirectedEdge::tail);
  return result;
}

/// Those that leave that point.
std::span<const DirectedEdge> from(const std::vector<DirectedEdge>& sides, std::uint32_t point) {
  const auto first = std::ranges::lower_bound(sides, point, {}, &DirectedEdge::tail);
  const auto last = std::ranges::upper_bound(sides, point, {}, &DirectedEdge::tail);
  return {first, last};
}

/// Walls are none: their sides are all real, also where two stand in one place.
bool is_solid(const Convex& part) {
  return part.vertices.size() > 2;
}

/// Whether another solid has the same edge the other way round.
bool is_inner(std::span<const Convex> parts, const std::vector<DirectedEdge>& sides,
              const DirectedEdge& side) {
  return is_solid(parts[side.part]) &&
         std::ranges::any_of(from(sides, side.head), [&](const DirectedEdge& other) {
           return other.head == side.tail && other.part != side.part && is_solid(parts[other.part]);
         });
}

/// The angle from `u` to `v`, counter-clockwise, as a number that grows with it from above 0 to 4.
double turn(const Vec& u, const Vec& v) {
  const double s = cross(u, v), c = dot(u, v), whole = std::abs(s) + std::abs(c);
  if (s > 0.0) return 1.0 - c / whole;
  if (s < 0.0) return 3.0 + c / whole;
  return c > 0.0 ? 4.0 : 2.0;
}

/// The edge that bounds the free side together with `side`, beyond its head.
const DirectedEdge* beyond(const std::vector<DirectedEdge>& outline, const DirectedEdge& side) {
  const DirectedEdge* best = nullptr;
  double least = 5.0;
  for (const DirectedEdge& other : from(outline, side.head))
    if (const double angle = turn(-side.way, other.way); angle < least) least = angle, best = &other;
  return best;
}

Turn turn_between(const DirectedEdge& in, const DirectedEdge& out) {
  const double sine = cross(in.way, out.way) / std::sqrt(dot(in.way, in.way) * dot(out.way, out.way));
  if (std::abs(sine) <= kFlat) return dot(in.way, out.way) > 0.0 ? Turn::flat : Turn::convex;
  return sine > 0.0 ? Turn::convex : Turn::concave;
}

/// Whether the part's outline is that of the whole all round.
bool stands_alone(const Convex& part, const Rim& rim) {
  const std::size_t n = rim.size();
  for (std::size_t e = 0; e < n; ++e)
    if (rim[e].inner || rim[e].at_head != Turn::convex || rim[e].after != part.normals[next(e, n)])
      return false;
  return true;
}

/// Whether `d` points between `from` and `to`, counter-clockwise and at most half a turn apart.
bool is_between(const Vec& d, const Vec& from, const Vec& to) {
  return cross(from, d) >= -kFlat && cross(d, to) >= -kFlat && dot(from, d) + dot(d, to) >= -kFlat;
}

/// Whether an outline with these normals on either side of a corner hardly turns there.
bool goes_straight_on(const Vec& one, const Vec& other) {
  return std::abs(cross(one, other)) <= kStraight && dot(one, other) > 0.0;
}

/// A normal at a corner, and the way from there along an edge.
struct Lean {
  Vec normal, along;
  std::size_t edge;
};

/// A corner of a part, as the outline has it on either side.
struct Corner {
  const Convex& part;
  const Rim& rim;
  std::size_t vertex, before, after;  // the edges that meet there

  Corner(const Convex& p, const Rim& r, std::size_t v)
      : part(p), rim(r), vertex(v), before(previous(v, r.size())), after(v) {}

  bool admits(const Vec& d) const {
    const RimEdge &in = rim[before], &out = rim[after];
    return (!in.inner && in.at_head == Turn::convex && is_between(d, part.normals[before], in.after)) ||
           (!out.inner && out.at_tail == Turn::convex && is_between(d, out.before, part.normals[after]));
  }

  /// Whether the outline turns back from the edge, and not by little, to one with that normal.
  bool is_hollow(std::size_t edge, Turn turn, const Vec& other) const {
    return !rim[edge].inner && turn == Turn::concave && !goes_straight_on(part.normals[edge], other);
  }

  /// The face that bounds the hollow of the outline in which `centre` is; or, if it has sunk into a solid
  /// behind one of the hollow's two faces, that towards which `d` leans; or none.
  const Vec* hollow_face(const Vec& d, const Vec& centre) const {
    const Vec way = centre - part.vertices[vertex];
    const auto is_in = [&](std::size_t edge, Turn turn, const Vec& other, bool solid) {
      const Vec& own = part.normals[edge];
      if (!is_hollow(edge, turn, other)) return false;
      const bool before_own = dot(own, way) >= 0.0, before_other = dot(other, way) >= 0.0;
      const bool leans = solid && dot(own, d) > std::max(dot(other, d), 0.0);
      return leans ? before_own || before_other : before_own && before_other;
    };
    const RimEdge &in = rim[before], &out = rim[after];
    if (is_in(before, in.at_head, in.after, in.solid_after)) return &part.normals[before];
    if (is_in(after, out.at_tail, out.before, out.solid_before)) return &part.normals[after];
    return nullptr;
  }

  /// The normal of the outline that is nearest to `d`, of those before which `centre` is, and the edge of the
  /// part from which the outline has it; none where nothing but hollows is.
  std::optional<Lean> nearest(const Vec& d, const Vec& centre) const {
    std::optional<Lean> best;
    const auto offer = [&](const Vec& normal, const Vec& along, std::size_t edge) {
      if (dot(normal, centre - part.vertices[vertex]) < 0.0) return;
      if (!best || dot(normal, d) > dot(best->normal, d)) best = Lean{normal, along, edge};
    };
    const RimEdge &in = rim[before], &out = rim[after];
    const Vec& here = part.vertices[vertex];
    if (!in.inner && !is_hollow(before, in.at_head, in.after)) {
      const Vec along = part.vertices[before] - here;
      offer(part.normals[before], along, before), offer(in.after, along, before);
    }
    if (!out.inner && !is_hollow(after, out.at_tail, out.before)) {
      const Vec along = part.vertices[next(after, rim.size())] - here;
      offer(part.normals[after], along, after), offer(out.before, along, after);
    }
    return best;
  }
};

/// The vertex of the part that lies farthest along `d`, near `point` where an edge does; in the part's frame.
std::size_t support(const Convex& part, const Vec& d, const Vec& point) {
  const auto is_farther = [&](const Vec& v, const Vec& best) {
    const Vec way = v - best;
    const double along = dot(d, way), slack = kFlat * std::sqrt(dot(way, way));
    if (std::abs(along) > slack) return along > 0.0;
    return dot(v - point, v - point) < dot(best - point, best - point);
  };
  std::size_t best = 0;
  for (std::size_t i = 1; i < part.vertices.size(); ++i)
    if (is_farther(part.vertices[i], part.vertices[best])) best = i;
  return best;
}

/// Whether `d` is the normal of an edge of the part that bounds the whole.
bool is_face(const Convex& part, const Rim& rim, const Vec& d) {
  for (std::size_t e = 0; e < rim.size(); ++e)
    if (!rim[e].inner && std::abs(cross(part.normals[e], d)) <= kFlat && dot(part.normals[e], d) > 0.0)
      return true;
  return false;
}

/// The body against all that lies behind a face of the part.
Manifold face_contact(const PlacedConvex& part, const Vec& vertex, const Vec& normal,
                      const PlacedConvex& body, double reach) {
  const Vec out = part.pose.rotate(normal);
  const HalfPlane free{part.pose * vertex + part.shape.radius * out, out};
  Manifold m = manifold(body.shape, body.pose, free, reach);
  m.normal = -m.normal;
  return m;
}

/// Whether the body's deepest vertex behind a line through `vertex` stands on the edge's side of it: else it
/// is for the part beyond to hold. In the part's frame.
bool is_over(const Convex& body, const Pose& body_in_part, const Vec& vertex, const Lean& lean) {
  const Vec down = body_in_part.unrotate(lean.normal), along = body_in_part.unrotate(lean.along);
  double lowest = std::numeric_limits<double>::infinity(), most = 0.0, farthest = 0.0;
  for (const Vec& v : body.vertices) farthest = std::max(farthest, dot(v, v));
  const double slack = kFlat * std::sqrt(farthest);
  for (const Vec& v : body.vertices) {
    const double height = dot(down, v);
    if (height > lowest + slack) continue;
    most = height < lowest - slack ? dot(along, v) : std::max(most, dot(along, v));
    lowest = std::min(lowest, height);
  }
  return most + dot(lean.along, body_in_part.position - vertex) >=
         -slack * std::sqrt(dot(lean.along, lean.along));
}

}  // namespace

std::vector<Rim> rims(std::span<const Convex> parts) {
  std::vector<DirectedEdge> all = sides(parts), outline;
  std::vector<Rim> result(parts.size());
  for (const DirectedEdge& side : all) {
    Rim& rim = result[side.part];
    rim.resize(parts[side.part].normals.size());
    rim[side.edge].inner = is_inner(parts, all, side);
    if (!rim[side.edge].inner) outline.push_back(side);
  }
  for (const DirectedEdge& side : outline) {
    const DirectedEdge* other = beyond(outline, side);
    if (!other) continue;
    RimEdge &in = result[side.part][side.edge], &out = result[other->part][other->edge];
    in.at_head = out.at_tail = turn_between(side, *other);
    in.after = parts[other->part].normals[other->edge];
    out.before = parts[side.part].normals[side.edge];
    in.solid_after = out.solid_before = is_solid(parts[side.part]) && is_solid(parts[other->part]);
  }
  for (std::size_t i = 0; i < parts.size(); ++i)
    if (stands_alone(parts[i], result[i])) result[i].clear();
  return result;
}

bool bends_gently(const Convex& part, const Rim& rim) {
  for (std::size_t e = 0; e < rim.size(); ++e) {
    const RimEdge& edge = rim[e];
    if (edge.inner) continue;
    if (edge.at_head != Turn::flat && goes_straight_on(part.normals[e], edge.after)) return true;
    if (edge.at_tail != Turn::flat && goes_straight_on(part.normals[e], edge.before)) return true;
  }
  return false;
}

Manifold on_outline(const Manifold& m, const PlacedConvex& part, const Rim& rim, const PlacedConvex& body,
                    double reach, bool part_is_b) {
  if (m.count == 0) return m;
  const Vec d = part.pose.unrotate(m.normal);
  if (is_face(part.shape, rim, d)) return m;
  const ManifoldPoint& point = m.points[m.count == 2 && m.points[1].separation < m.points[0].separation];
  const Pose from_world = inverse(part.pose);
  const Corner corner(part.shape, rim, support(part.shape, d, from_world * point.point));
  if (corner.admits(d)) return m;
  const Vec& vertex = part.shape.vertices[corner.vertex];
  const Vec centre = from_world * body.pose.position;
  if (const Vec* face = corner.hollow_face(d, centre)) return face_contact(part, vertex, *face, body, reach);
  const std::optional<Lean> lean = corner.nearest(d, centre);
  if (lean && body.shape.vertices.size() > 1 &&
      goes_straight_on(lean->normal, part.shape.normals[lean->edge]))
    return manifold_on_face(part.shape, part.pose, lean->edge, body.shape, body.pose, reach, part_is_b);
  if (!lean || !is_over(body.shape, relative(part.pose, body.pose), vertex, *lean)) return {};
  return face_contact(part, vertex, lean->normal, body, reach);
}

}  // namespace throng::narrowphase
