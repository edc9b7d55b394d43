// SPDX-License-Identifier: MIT
#include "narrowphase/search.h"

#include <optional>

#include "narrowphase/core_separation.h"
#include "narrowphase/gjk.h"
#include "narrowphase/support.h"

namespace throng::narrowphase {

namespace {

ClosestFeatures features(std::size_t vertex, std::size_t edge, bool vertex_of_b) {
  return {static_cast<std::uint32_t>(vertex), static_cast<std::uint32_t>(edge), vertex_of_b, true};
}

/// To the vertex's neighbour that is closer; where that one lies beyond the strip above the edge, it may be
/// farther away, but the edge that leads there isn't: it passes the strip's end lower.
ClosestFeatures to_neighbour(const Look& look, const ClosestFeatures& f) {
  const std::size_t count = look.x->vertices.size();
  const std::size_t closer = look.next_is_closer ? next(f.vertex, count) : previous(f.vertex, count);
  const std::size_t between = look.next_is_closer ? f.vertex : closer;
  if (look.at_corner) return features(look.corner, between, !f.vertex_of_b);
  const Vec &tail = look.y->vertices[f.edge], &normal = look.y->normals[f.edge];
  const std::size_t head = next(f.edge, look.y->vertices.size());
  const Vec there =
      look.vertex +
      look.pose_y->unrotate(look.pose_x->rotate(look.x->vertices[closer] - look.x->vertices[f.vertex]));
  if (cross(normal, there - tail) < 0.0) return features(f.edge, between, !f.vertex_of_b);
  if (cross(normal, there - look.y->vertices[head]) > 0.0) return features(head, between, !f.vertex_of_b);
  return features(closer, f.edge, f.vertex_of_b);
}

/// To closer features, by a neighbour of those looked at. False where there are none.
bool advance(const Look& look, ClosestFeatures& f) {
  if (!look.at_corner && !look.edge_holds) return false;
  if (look.next_is_closer || look.previous_is_closer)
    f = to_neighbour(look, f);
  else if (!look.edge_holds)
    f.edge = static_cast<std::uint32_t>(look.beyond);
  else
    return false;
  return true;
}

std::optional<Separation> look_and_walk(const Placed& placed, ClosestFeatures& f,
                                        SearchStatistics& statistics) {
  Look look(placed, f);
  if (look.proves() || walk(placed, look, f, statistics)) return answer(look, f.vertex_of_b);
  return {};
}

/// Takes the vertices that reach farthest from centre to centre. Whether they leave a gap there; if not, the
/// two overlap more often than not.
bool leave_gap(const Placed& p, const Pose& b_in_a, const Pose& a_in_b, ClosestFeatures& f) {
  const std::size_t of_a = support(p.a, b_in_a.position), of_b = support(p.b, a_in_b.position);
  f = features(of_b, of_a, true);
  return dot(b_in_a * p.b.vertices[of_b] - p.a.vertices[of_a], b_in_a.position) > 0.0;
}

Separation search_polygons(const Placed& p, bool overlap_likely, ClosestFeatures& f,
                           SearchStatistics& statistics) {
  constexpr std::size_t kFew = 64 * 64;  // pairs of vertices, below which a walk costs no more than a search
  const Pose b_in_a = relative(p.pose_a, p.pose_b), a_in_b = inverse(b_in_a);
  if (!overlap_likely && leave_gap(p, b_in_a, a_in_b, f)) {
    if (p.a.vertices.size() * p.b.vertices.size() > kFew)
      if (const auto found = gjk(p.a, p.b, b_in_a, f)) f = *found;
    if (const auto s = look_and_walk(p, f, statistics)) return *s;
  }
  const Faces faces = widest_faces(p.a, p.b, b_in_a, a_in_b);
  const Face& widest = faces.widest();
  f = features(widest.vertex, widest.edge, faces.a_is_wider());
  if (widest.separation > 0.0)
    if (const auto s = look_and_walk(p, f, statistics)) return *s;
  ++(widest.separation > 0.0 ? statistics.fallbacks : statistics.depths);
  return in_world(p.a, p.pose_a, p.b, polygon_polygon(p.a, p.b, b_in_a, faces));
}

/// A disc and anything.
Separation search_discs(const Placed& p, bool overlap_likely, ClosestFeatures& f,
                        SearchStatistics& statistics) {
  const bool of_b = p.b.normals.empty();
  const Convex &disc = of_b ? p.b : p.a, &other = of_b ? p.a : p.b;
  if (!other.normals.empty() && !overlap_likely) {
    const Vec centre = relative(of_b ? p.pose_a : p.pose_b, of_b ? p.pose_b : p.pose_a) * disc.vertices[0];
    f = features(0, support(other, centre), of_b);
    if (const auto s = look_and_walk(p, f, statistics)) return *s;
  }
  ++statistics.depths;
  return separation(p.a, p.pose_a, p.b, p.pose_b);
}

}  // namespace

bool walk(const Placed& placed, Look& look, ClosestFeatures& f, SearchStatistics& statistics) {
  constexpr int kLongest = 32;
  for (int step = 0; step < kLongest && advance(look, f); ++step) {
    ++statistics.steps;
    look = Look(placed, f);
    if (look.proves()) return true;
  }
  return false;
}

Separation search(const Placed& placed, bool overlap_likely, ClosestFeatures& f,
                  SearchStatistics& statistics) {
  if (!placed.a.normals.empty() && !placed.b.normals.empty())
    return search_polygons(placed, overlap_likely, f, statistics);
  return search_discs(placed, overlap_likely, f, statistics);
}

}  // namespace throng::narrowphase
