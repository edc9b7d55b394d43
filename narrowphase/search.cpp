// SPDX-License-Identifier: MIT
#include "narrowphase/search.h"

#include "narrowphase/core_separation.h"
#include "narrowphase/gjk.h"
#include "narrowphase/support.h"
#include "narrowphase/walk.h"

namespace throng::narrowphase {

namespace {

ClosestFeatures features(std::size_t vertex, std::size_t edge, bool vertex_of_b) {
  return {static_cast<std::uint32_t>(vertex), static_cast<std::uint32_t>(edge), vertex_of_b, true};
}

/// Takes the vertices that reach farthest from centre to centre. Whether they leave a gap there; if not, the
/// two overlap more often than not.
bool leave_gap(const Placed& p, const Pose& b_in_a, const Pose& a_in_b, ClosestFeatures& f) {
  const std::size_t of_a = support(p.a, b_in_a.position), of_b = support(p.b, a_in_b.position);
  f = features(of_b, of_a, true);
  return dot(b_in_a * p.b.vertices[of_b] - p.a.vertices[of_a], b_in_a.position) > 0.0;
}

[[gnu::noinline]] Walk walk(const Placed& p, ClosestFeatures& f, SearchStatistics& statistics) {
  const Walk to = walk(p, f, Look(p, f));
  statistics.steps += to.steps;
  return to;
}

Separation search_polygons(const Placed& p, bool overlap_likely, ClosestFeatures& f,
                           SearchStatistics& statistics) {
  constexpr std::size_t kFew = 64 * 64;  // pairs of vertices, below which a walk costs no more than a search
  const Pose b_in_a = relative(p.pose_a, p.pose_b), a_in_b = inverse(b_in_a);
  if (!overlap_likely && leave_gap(p, b_in_a, a_in_b, f)) {
    if (p.a.vertices.size() * p.b.vertices.size() > kFew)
      if (const auto found = gjk(p.a, p.b, b_in_a, f)) f = *found;
    if (const Walk to = walk(p, f, statistics); to.proven) return to.answer;
  }
  const Faces faces = widest_faces(p.a, p.b, b_in_a, a_in_b);
  const Face& widest = faces.widest();
  f = features(widest.vertex, widest.edge, faces.a_is_wider());
  if (widest.separation > 0.0)
    if (const Walk to = walk(p, f, statistics); to.proven) return to.answer;
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
    if (const Walk to = walk(p, f, statistics); to.proven) return to.answer;
  }
  ++statistics.depths;
  return separation(p.a, p.pose_a, p.b, p.pose_b);
}

}  // namespace

Separation search(const Placed& placed, bool overlap_likely, ClosestFeatures& f,
                  SearchStatistics& statistics) {
  if (!placed.a.normals.empty() && !placed.b.normals.empty())
    return search_polygons(placed, overlap_likely, f, statistics);
  return search_discs(placed, overlap_likely, f, statistics);
}

}  // namespace throng::narrowphase
