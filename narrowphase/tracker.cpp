// SPDX-License-Identifier: MIT
#include "narrowphase/tracker.h"

#include "narrowphase/search.h"

namespace throng::narrowphase {

namespace {

[[gnu::noinline]] Separation search_anew(const Placed& placed, bool overlap_likely, ClosestFeatures& f,
                                         SearchStatistics* wanted) {
  SearchStatistics unwanted;
  SearchStatistics& statistics = wanted ? *wanted : unwanted;
  ++statistics.cold_starts;
  return search(placed, overlap_likely, f, statistics);
}

[[gnu::noinline]] Separation walk_or_search(const Placed& placed, Look& look, ClosestFeatures& f,
                                            SearchStatistics* wanted) {
  SearchStatistics unwanted;
  if (walk(placed, look, f, wanted ? *wanted : unwanted)) return answer(look, f.vertex_of_b);
  return search_anew(placed, !look.at_corner, f, wanted);
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
  Look reached = look;  // a copy, so that the one above can stay in registers
  return walk_or_search(placed, reached, features, statistics);
}

}  // namespace throng::narrowphase
