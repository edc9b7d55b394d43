// SPDX-License-Identifier: MIT
#include "narrowphase/tracker.h"

#include <algorithm>

#include "narrowphase/search.h"
#include "narrowphase/walk.h"

namespace throng::narrowphase {

namespace {

[[gnu::noinline]] Separation search_anew(const Placed& placed, bool overlap_likely, ClosestFeatures& f,
                                         SearchStatistics* wanted) {
  SearchStatistics unwanted;
  SearchStatistics& statistics = wanted ? *wanted : unwanted;
  ++statistics.cold_starts;
  return search(placed, overlap_likely, f, statistics);
}

/// Whether a walk would take longer than a search from nothing, by a guess: the vertex is many edges past the
/// end of its edge, or the edge faces the place many edges further on. Few vertices are always near.
bool are_far(const Placed& p, const ClosestFeatures& f, const Look& look) {
  constexpr std::size_t kFew = 64 * 64;  // pairs of vertices
  constexpr double kFar = 16.0;          // edges, of the length and the turn of those at hand
  if (p.a.vertices.size() * p.b.vertices.size() <= kFew) return false;
  if (std::max(-look.past_tail, look.past_head) > kFar * (look.past_tail - look.past_head)) return true;
  if (look.x->normals.empty()) return false;
  const Vec facing = -look.pose_x->unrotate(look.pose_y->rotate(look.y->normals[f.edge]));
  const Vec &before = look.x->normals[previous(f.vertex, look.x->vertices.size())],
            &after = look.x->normals[f.vertex];
  return std::max(cross(facing, before), cross(after, facing)) > kFar * cross(before, after);
}

[[gnu::noinline]] Separation walk_or_search(const Placed& placed, ClosestFeatures& f,
                                            SearchStatistics* statistics) {
  const Look look(placed, f);
  if (are_far(placed, f, look)) return search_anew(placed, false, f, statistics);
  const Walk to = walk(placed, f, look);
  if (statistics) statistics->steps += to.steps;
  if (to.proven) return to.answer;
  return search_anew(placed, to.seems_to_overlap, f, statistics);
}

}  // namespace

Separation track(const Convex& a, const Pose& pose_a, const Convex& b, const Pose& pose_b,
                 ClosestFeatures& features, SearchStatistics* statistics) {
  const Placed placed{a, pose_a, b, pose_b};
  if (!features.known || !exist(features, placed)) [[unlikely]]
    return search_anew(placed, false, features, statistics);
  const Look look(placed, features);
  if (look.proves()) [[likely]]
    return answer(look, features.vertex_of_b);
  return walk_or_search(placed, features, statistics);
}

}  // namespace throng::narrowphase
