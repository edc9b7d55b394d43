// SPDX-License-Identifier: MIT
#include "narrowphase/bvh_outline.h"

#include <limits>
#include <tuple>

#include "narrowphase/bvh_containment-inl.h"
#include "narrowphase/bvh_edges.h"

namespace throng::narrowphase {

namespace {

template <class Volume>
PlacedOutlines<Volume> placed(const Outline<Volume>& a, const Pose& pose_a, const Outline<Volume>& b,
                              const Pose& pose_b) {
  const Pose b_in_a = relative(pose_a, pose_b);
  return {a, b, b_in_a, frame(b_in_a, a.tree.reach + b.tree.reach)};
}

/// An order of placed outlines that doesn't know which one the caller named first.
template <class Volume>
bool precedes(const Outline<Volume>& a, const Pose& pose_a, const Outline<Volume>& b, const Pose& pose_b) {
  const auto key = [](const Outline<Volume>& shape, const Pose& p) {
    return std::tuple(shape.edges.size(), p.position.x(), p.position.y(), p.cos, p.sin);
  };
  if (key(a, pose_a) != key(b, pose_b)) return key(a, pose_a) < key(b, pose_b);
  const auto before = [](const OutlineEdge& e, const OutlineEdge& f) {
    return std::tuple(e.p.x(), e.p.y()) < std::tuple(f.p.x(), f.p.y());
  };
  return std::lexicographical_compare(a.edges.begin(), a.edges.end(), b.edges.begin(), b.edges.end(), before);
}

/// The nearest pair of edges so far, as places.
struct NearestEdges {
  double squared = std::numeric_limits<double>::infinity();
  std::uint32_t a = 0, b = 0;

  void consider(double s, std::uint32_t i, std::uint32_t j) {
    if (s < squared) squared = s, a = i, b = j;
  }
};

template <class Volume>
EdgePairPoints compare(const PlacedOutlines<Volume>& p, std::uint32_t i, std::uint32_t j) {
  const OutlineEdge &e = p.a.edges[i], &f = p.b.edges[j];
  return nearest_of_edges(e.p, e.q, p.b_in_a * f.p, p.b_in_a * f.q);
}

template <class Volume>
bool meet(const PlacedOutlines<Volume>& p, std::uint32_t i, std::uint32_t j) {
  const OutlineEdge &e = p.a.edges[i], &f = p.b.edges[j];
  return segments_meet(e.p, e.q, p.b_in_a * f.p, p.b_in_a * f.q);
}

OutlineCache swapped(const OutlineCache& cache) {
  return {cache.b, cache.a};
}

/// The same place, or where there is none the last one.
template <class Volume>
OutlineCache within(const OutlineCache& cache, const PlacedOutlines<Volume>& p) {
  return {std::min(cache.a, static_cast<std::uint32_t>(p.a.edges.size() - 1)),
          std::min(cache.b, static_cast<std::uint32_t>(p.b.edges.size() - 1))};
}

template <class Volume, class Counters>
double find_nearest(const PlacedOutlines<Volume>& p, double relative_error, NearestEdges& best,
                    Counters& counters) {
  best.consider(compare(p, best.a, best.b).squared, best.a, best.b);
  double upper = std::sqrt(best.squared);
  const auto leaf = [&](const Branch& of_a, const Branch& of_b, double) {
    for (std::uint32_t j = of_b.first; j < of_b.first + of_b.count; ++j) {
      const Vec r = p.b_in_a * p.b.edges[j].p, s = p.b_in_a * p.b.edges[j].q;
      for (std::uint32_t i = of_a.first; i < of_a.first + of_a.count; ++i)
        best.consider(nearest_of_edges(p.a.edges[i].p, p.a.edges[i].q, r, s).squared, i, j);
    }
    return std::sqrt(best.squared);
  };
  return minimise(p.a.tree, p.b.tree, p.frame, relative_error, 0.0, upper, leaf, counters);
}

template <class Volume, class Visit, class Counters>
bool visit_meetings(const PlacedOutlines<Volume>& p, Order order, Visit visit, Counters& counters) {
  const auto leaf = [&](const Branch& of_a, const Branch& of_b) {
    for (std::uint32_t j = of_b.first; j < of_b.first + of_b.count; ++j) {
      const Vec r = p.b_in_a * p.b.edges[j].p, s = p.b_in_a * p.b.edges[j].q;
      for (std::uint32_t i = of_a.first; i < of_a.first + of_a.count; ++i)
        if (segments_meet(p.a.edges[i].p, p.a.edges[i].q, r, s) && visit(i, j)) return true;
    }
    return false;
  };
  return order == Order::depth_first ? visit_overlaps(p.a.tree, p.b.tree, p.frame, leaf, counters)
                                     : visit_overlaps_best_first(p.a.tree, p.b.tree, p.frame, leaf, counters);
}

/// Of two that collide, in a's frame.
template <class Volume>
OutlineProximity overlapping(const PlacedOutlines<Volume>& p, const NearestEdges& nearest_edges) {
  const double parted = std::min(0.0, bound(p.a.tree.root(), p.b.tree.root(), p.frame));
  const Pose a_in_b = inverse(p.b_in_a);
  const Deepest of_b = deepest_vertex(p.a, p.b, p.b_in_a, p.frame.slack);
  const Deepest of_a = deepest_vertex(p.b, p.a, a_in_b, p.frame.slack);
  if (of_b.found && of_b.depth >= of_a.depth)
    return {std::min(parted, -of_b.depth), -of_b.depth, of_b.on_outline, of_b.at, p.a.edges[of_b.edge].index,
            p.b.edges[of_b.vertex].index};
  if (of_a.found)
    return {std::min(parted, -of_a.depth),
            -of_a.depth,
            p.b_in_a * of_a.at,
            p.b_in_a * of_a.on_outline,
            p.a.edges[of_a.vertex].index,
            p.b.edges[of_a.edge].index};
  const EdgePairPoints points = compare(p, nearest_edges.a, nearest_edges.b);
  return {parted,
          0.0,
          points.on_a,
          points.on_a,
          p.a.edges[nearest_edges.a].index,
          p.b.edges[nearest_edges.b].index};
}

template <class Volume, class Counters>
OutlineProximity ordered(const Outline<Volume>& a, const Pose& pose_a, const Outline<Volume>& b,
                         const Pose& pose_b, double relative_error, OutlineCache& cache, Counters& counters) {
  const PlacedOutlines<Volume> p = placed(a, pose_a, b, pose_b);
  const OutlineCache last = within(cache, p);
  NearestEdges best{std::numeric_limits<double>::infinity(), last.a, last.b};
  const double lower = find_nearest(p, relative_error, best, counters);
  cache = {best.a, best.b};
  OutlineProximity result;
  if (best.squared == 0.0 || one_holds_the_other(p)) {
    result = overlapping(p, best);
  } else {
    const EdgePairPoints points = compare(p, best.a, best.b);
    const double upper = std::sqrt(best.squared);
    result = {std::min(lower, upper), upper, points.on_a, points.on_b, a.edges[best.a].index,
              b.edges[best.b].index};
  }
  result.point_a = pose_a * result.point_a;
  result.point_b = pose_a * result.point_b;
  return result;
}

}  // namespace

std::vector<OutlineEdge> outline_edges(std::span<const std::vector<Vec>> rings) {
  std::vector<OutlineEdge> edges;
  for (const std::vector<Vec>& ring : rings)
    for (std::size_t i = 0; i < ring.size(); ++i)
      edges.push_back({ring[i], ring[next(i, ring.size())], static_cast<std::uint32_t>(edges.size())});
  return edges;
}

template <class Volume>
Outline<Volume> outline(std::span<const std::vector<Vec>> rings, const BvhConfig& config) {
  const std::vector<OutlineEdge> given = outline_edges(rings);
  std::vector<Thing<2>> things;
  things.reserve(given.size());
  for (const OutlineEdge& edge : given)
    things.push_back({edge.p.cwiseMin(edge.q), edge.p.cwiseMax(edge.q), 0.0});
  const auto append = [&](std::uint32_t i, Points<2>& points) {
    points.push_back(given[i].p);
    points.push_back(given[i].q);
  };
  Outline<Volume> result{build_bvh<Volume>(things, append, config), {}, rings[0][0]};
  result.edges.reserve(given.size());
  for (const std::uint32_t i : result.tree.order) result.edges.push_back(given[i]);
  return result;
}

template <class Volume>
OutlineProximity proximity(const Outline<Volume>& a, const Pose& pose_a, const Outline<Volume>& b,
                           const Pose& pose_b, const OutlineQuestion& question) {
  OutlineCache own;
  OutlineCache& cache = question.cache != nullptr ? *question.cache : own;
  return counting(question.counters, [&](auto& counters) -> OutlineProximity {
    if (!precedes(b, pose_b, a, pose_a))
      return ordered(a, pose_a, b, pose_b, question.relative_error, cache, counters);
    OutlineCache other = swapped(cache);
    const OutlineProximity s = ordered(b, pose_b, a, pose_a, question.relative_error, other, counters);
    cache = swapped(other);
    return {s.lower, s.upper, s.point_b, s.point_a, s.edge_b, s.edge_a};
  });
}

template <class Volume>
bool collide(const Outline<Volume>& a, const Pose& pose_a, const Outline<Volume>& b, const Pose& pose_b,
             const CollisionQuestion& question) {
  const bool swap = precedes(b, pose_b, a, pose_a);
  const PlacedOutlines<Volume> p = swap ? placed(b, pose_b, a, pose_a) : placed(a, pose_a, b, pose_b);
  OutlineCache own;
  OutlineCache& cache = question.cache != nullptr ? *question.cache : own;
  const OutlineCache last = within(swap ? swapped(cache) : cache, p);
  if (question.cache != nullptr && meet(p, last.a, last.b)) return true;
  const auto stop = [&](std::uint32_t i, std::uint32_t j) {
    cache = swap ? OutlineCache{j, i} : OutlineCache{i, j};
    return true;
  };
  return counting(question.counters, [&](auto& c) { return visit_meetings(p, question.order, stop, c); }) ||
         one_holds_the_other(p);
}

template <class Volume>
void find_meetings(const Outline<Volume>& a, const Pose& pose_a, const Outline<Volume>& b, const Pose& pose_b,
                   std::vector<std::pair<std::uint32_t, std::uint32_t>>& meetings, BvhCounters* counters) {
  meetings.clear();
  const bool swap = precedes(b, pose_b, a, pose_a);
  const PlacedOutlines<Volume> p = swap ? placed(b, pose_b, a, pose_a) : placed(a, pose_a, b, pose_b);
  const auto keep = [&](std::uint32_t i, std::uint32_t j) {
    const std::uint32_t first = p.a.edges[i].index, second = p.b.edges[j].index;
    swap ? meetings.emplace_back(second, first) : meetings.emplace_back(first, second);
    return false;
  };
  counting(counters, [&](auto& c) { return visit_meetings(p, Order::depth_first, keep, c); });
  std::sort(meetings.begin(), meetings.end());
}

template <class Volume>
OutlinePoint nearest(const Outline<Volume>& shape, const Vec& point, OutlineCache* cache,
                     BvhCounters* counters) {
  const auto compare_with = [&](std::uint32_t i) {
    return nearest_on_edge(point, shape.edges[i].p, shape.edges[i].q).squared;
  };
  std::uint32_t best = cache != nullptr && cache->a < shape.edges.size() ? cache->a : 0;
  double squared = compare_with(best);
  const auto leaf = [&](const Branch& branch, double least) {
    for (std::uint32_t i = branch.first; i < branch.first + branch.count; ++i)
      if (const double s = compare_with(i); s < least) best = i, least = s;
    return least;
  };
  counting(counters, [&](auto& c) { minimise_to_point(shape.tree, Point<2>(point), squared, leaf, c); });
  if (cache != nullptr) cache->a = best;
  const OutlineEdge& edge = shape.edges[best];
  return {std::sqrt(squared), nearest_on_edge(point, edge.p, edge.q).point, edge.index};
}

template <class Volume>
bool contains(const Outline<Volume>& shape, const Vec& point) {
  return holds(shape, Pose{}, at_rest(shape), point);
}

#define THRONG_OUTLINE(VOLUME)                                                                          \
  template Outline<VOLUME> outline<VOLUME>(std::span<const std::vector<Vec>>, const BvhConfig&);        \
  template OutlineProximity proximity(const Outline<VOLUME>&, const Pose&, const Outline<VOLUME>&,      \
                                      const Pose&, const OutlineQuestion&);                             \
  template bool collide(const Outline<VOLUME>&, const Pose&, const Outline<VOLUME>&, const Pose&,       \
                        const CollisionQuestion&);                                                      \
  template void find_meetings(const Outline<VOLUME>&, const Pose&, const Outline<VOLUME>&, const Pose&, \
                              std::vector<std::pair<std::uint32_t, std::uint32_t>>&, BvhCounters*);     \
  template OutlinePoint nearest(const Outline<VOLUME>&, const Vec&, OutlineCache*, BvhCounters*);       \
  template bool contains(const Outline<VOLUME>&, const Vec&);
THRONG_OUTLINE(Ball<2>)
THRONG_OUTLINE(Box<2>)
THRONG_OUTLINE(OrientedBox<2>)
THRONG_OUTLINE(BoxAndBall<2>)
#undef THRONG_OUTLINE

}  // namespace throng::narrowphase
