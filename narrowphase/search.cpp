// SPDX-License-Identifier: MIT
#include "narrowphase/search.h"

#include "narrowphase/core_separation.h"
#include "narrowphase/gjk.h"
#include "narrowphase/support.h"

namespace throng::narrowphase {

namespace {

ClosestFeatures features(std::size_t vertex, std::size_t edge, bool vertex_of_b) {
  return {static_cast<std::uint32_t>(vertex), static_cast<std::uint32_t>(edge), vertex_of_b, true};
}

/// To the vertex's neighbour that is closer; where that one lies beyond the strip above the edge, it may be farther
/// away, but the edge that leads there isn't: it passes the strip's end lower.
ClosestFeatures to_neighbour(const Look& look, const ClosestFeatures& f) {
  const Side& side = look.side;
  const std::size_t count = side.of_vertex->vertices.size();
  const std::size_t closer = look.around.next_is_closer ? next(f.vertex, count) : previous(f.vertex, count);
  const std::size_t between = look.around.next_is_closer ? f.vertex : closer;
  if (look.probed.at_corner) return features(look.probed.corner, between, !f.vertex_of_b);
  const Convex& y = *side.of_edge;
  const Vec there = side.frame * side.of_vertex->vertices[closer];
  const std::size_t head = next(f.edge, y.vertices.size());
  if (cross(y.normals[f.edge], there - y.vertices[f.edge]) < 0.0)
    return features(f.edge, between, !f.vertex_of_b);
  if (cross(y.normals[f.edge], there - y.vertices[head]) > 0.0) return features(head, between, !f.vertex_of_b);
  return features(closer, f.edge, f.vertex_of_b);
}

/// To closer features, by a neighbour of those looked at. False where there are none.
bool advance(const Look& look, ClosestFeatures& f) {
  if (!look.probed.at_corner && !look.probed.edge_holds) return false;
  if (look.around.next_is_closer || look.around.previous_is_closer)
    f = to_neighbour(look, f);
  else if (!look.probed.edge_holds)
    f.edge = static_cast<std::uint32_t>(look.probed.beyond);
  else
    return false;
  return true;
}

std::optional<Separation> look_and_walk(const Placed& placed, ClosestFeatures& f, SearchStatistics& statistics) {
  const Look look(placed, f);
  if (look.proves()) return answer(placed, look.probed, f.vertex_of_b);
  return walk(placed, look, f, statistics);
}

Separation search_polygons(const Placed& p, bool overlap_likely, ClosestFeatures& f,
                           SearchStatistics& statistics) {
  constexpr std::size_t kFew = 256;  // pairs of vertices, below which all faces cost no more than a search
  const Pose b_in_a = relative(p.pose_a, p.pose_b);
  if (!overlap_likely && p.a.vertices.size() * p.b.vertices.size() > kFew) {
    const Pose a_in_b = inverse(b_in_a);
    const std::size_t edge = support(p.a, b_in_a.position), vertex = support(p.b, a_in_b.position);
    if (const auto found = gjk(p.a, p.b, b_in_a, features(vertex, edge, true))) {
      f = *found;
      if (const auto s = look_and_walk(p, f, statistics)) return *s;
    }
  }
  const Faces faces = widest_faces(p.a, p.b, b_in_a, inverse(b_in_a));
  const Face& widest = faces.widest();
  f = features(widest.vertex, widest.edge, faces.a_is_wider());
  if (widest.separation > 0.0)
    if (const auto s = look_and_walk(p, f, statistics)) return *s;
  ++(widest.separation > 0.0 ? statistics.fallbacks : statistics.depths);
  return in_world(p.a, p.pose_a, p.b, polygon_polygon(p.a, p.b, b_in_a, faces));
}

/// A disc and anything.
Separation search_discs(const Placed& p, bool overlap_likely, ClosestFeatures& f, SearchStatistics& statistics) {
  const bool of_b = p.b.normals.empty();
  const Side side(p, of_b);
  if (!side.of_edge->normals.empty() && !overlap_likely) {
    const Vec centre = side.frame * side.of_vertex->vertices[0];
    f = features(0, support(*side.of_edge, centre), of_b);
    if (const auto s = look_and_walk(p, f, statistics)) return *s;
  }
  ++statistics.depths;
  return separation(p.a, p.pose_a, p.b, p.pose_b);
}

}  // namespace

std::optional<Separation> walk(const Placed& placed, Look look, ClosestFeatures& f,
                               SearchStatistics& statistics) {
  constexpr int kLongest = 32;
  for (int step = 0; step < kLongest; ++step) {
    if (!advance(look, f)) return {};
    ++statistics.steps;
    look = Look(placed, f);
    if (look.proves()) return answer(placed, look.probed, f.vertex_of_b);
  }
  return {};
}

Separation search(const Placed& placed, bool overlap_likely, ClosestFeatures& f, SearchStatistics& statistics) {
  if (!placed.a.normals.empty() && !placed.b.normals.empty())
    return search_polygons(placed, overlap_likely, f, statistics);
  return search_discs(placed, overlap_likely, f, statistics);
}

}  // namespace throng::narrowphase
