// SPDX-License-Identifier: MIT
#include "narrowphase/tracker.h"

#include "narrowphase/search.h"

namespace throng::narrowphase {

namespace {

[[gnu::noinline]] Separation walk_or_search(const Placed& placed, const Look& look, ClosestFeatures& f,
                                            SearchStatistics* wanted) {
  SearchStatistics unwanted;
  SearchStatistics& statistics = wanted ? *wanted : unwanted;
  if (const auto s = walk(placed, look, f, statistics)) return *s;
  const Probe overlap = probe(Side(placed, f.vertex_of_b), f.vertex, f.edge);
  ++statistics.cold_starts;
  return search(placed, !overlap.at_corner, f, statistics);
}

[[gnu::noinline]] Separation cold(const Placed& placed, ClosestFeatures& f, SearchStatistics* wanted) {
  SearchStatistics unwanted;
  SearchStatistics& statistics = wanted ? *wanted : unwanted;
  ++statistics.cold_starts;
  return search(placed, false, f, statistics);
}

}  // namespace

Separation track(const Convex& a, const Pose& pose_a, const Convex& b, const Pose& pose_b,
                 ClosestFeatures& features, SearchStatistics* statistics) {
  const Placed placed{a, pose_a, b, pose_b};
  if (!features.known || !exist(features, placed)) [[unlikely]]
    return cold(placed, features, statistics);
  const Look look(placed, features);
  if (look.proves()) return answer(placed, look.probed, features.vertex_of_b);
  return walk_or_search(placed, look, features, statistics);
}

}  // namespace throng::narrowphase
