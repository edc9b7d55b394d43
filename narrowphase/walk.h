// SPDX-License-Identifier: MIT
#pragma once

#include <limits>

#include "narrowphase/probe.h"

/// From features to closer ones, until they prove themselves.
namespace throng::narrowphase {

/// Where a walk ended.
struct Walk {
  Separation answer;  ///< only where proven
  bool proven;
  bool seems_to_overlap;  ///< where nothing is proven: it ended behind a face
  int steps;              ///< further features walked over
};

/// Whether features that prove nothing have a neighbour that is closer.
inline bool leads_on(const Look& look) {
  if (!look.at_corner && !look.edge_holds) return false;
  return look.next_is_closer || look.previous_is_closer || !look.edge_holds;
}

/// Closer features than those looked at, where these lead on: by the vertex's neighbour that is closer, else
/// by the edge beyond the corner. Where that neighbour lies beyond the strip above the edge, it may be
/// farther away, but the edge that leads there isn't: it passes the strip's end lower.
inline ClosestFeatures closer_features(const Look& look, const ClosestFeatures& f) {
  const std::uint32_t count = static_cast<std::uint32_t>(look.x->vertices.size());
  const std::uint32_t after = f.vertex + 1 == count ? 0 : f.vertex + 1;
  const std::uint32_t before = (f.vertex == 0 ? count : f.vertex) - 1;
  const std::uint32_t closer = look.next_is_closer ? after : before;
  const std::uint32_t between = look.next_is_closer ? f.vertex : before;
  const double shift = cross(look.inward, look.x->vertices[closer] - look.x->vertices[f.vertex]);
  const bool over_tail = -shift > look.past_tail;
  const bool over_head = -shift < look.past_head;
  const bool neighbour = look.next_is_closer | look.previous_is_closer;
  const bool swap = neighbour & (look.at_corner | over_tail | over_head);
  const std::uint32_t end = static_cast<std::uint32_t>(look.at_corner ? look.corner
                                                       : over_tail    ? f.edge
                                                                      : look.head);
  const std::uint32_t stay = neighbour ? closer : f.vertex;
  const std::uint32_t edge = neighbour ? f.edge : static_cast<std::uint32_t>(look.beyond);
  return {swap ? end : stay, swap ? between : edge, swap != f.vertex_of_b, true};
}

/// From `f` on, which `look` looks at, each step to closer features; `f` is then where it ended.
/// Without proof where it ends in an overlap, or what looks like one, or takes too long. In an overlap the
/// steps may lead round in a circle, but not closer all the way: that ends it. The first steps are free,
/// since rounding may make them seem longer where shapes all but touch.
[[gnu::always_inline]] inline Walk walk(const Placed& placed, ClosestFeatures& f, Look look) {
  constexpr int kLongest = 32, kFree = 4;
  double least = std::numeric_limits<double>::infinity();
  for (int step = 0;; ++step) {
    if (look.proves()) [[likely]]
      return {answer(look, f.vertex_of_b), true, false, step};
    const double squared = look.at_corner ? look.squared : look.height * look.height;
    if (!leads_on(look)) return {{}, false, !look.at_corner, step};
    if (step == kLongest || (step > kFree && squared >= least)) return {{}, false, false, step};
    least = squared;
    f = closer_features(look, f);
    look = Look(placed, f);
  }
}

}  // namespace throng::narrowphase
