// SPDX-License-Identifier: MIT
#include "narrowphase/tracker.h"

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

[[gnu::noinline]] Separation walk_or_search(const Placed& placed, ClosestFeatures& f,
                                            SearchStatistics* statistics) {
  const Walk to = walk(placed, f);
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
