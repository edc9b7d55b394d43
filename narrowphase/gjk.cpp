// SPDX-License-Identifier: MIT
#include "narrowphase/gjk.h"

#include "narrowphase/support.h"

namespace throng::narrowphase {

namespace {

/// A vertex of each, and the way from the first to the second in a's frame.
struct Difference {
  std::size_t a, b;
  Vec way;

  bool joins(const Difference& other) const { return a == other.a && b == other.b; }
};

/// One difference, or two between whose ways the shortest lies.
struct Simplex {
  Difference first, second;
  bool is_pair;

  /// Along the shortest way; its length doesn't matter.
  Vec direction() const {
    if (!is_pair) return first.way;
    const Vec along = second.way - first.way;
    const Vec across{-along.y(), along.x()};
    return dot(across, first.way) >= 0.0 ? across : Vec(-across);
  }
};

/// Whether the point of the segment p-q nearest to the origin lies before q, so that p counts.
bool counts(const Vec& p, const Vec& q) {
  return dot(q, q - p) > 0.0;
}

/// The simplex of the shortest way after `added` has come, which is shorter than all before along some
/// direction; none where the ways surround the origin.
std::optional<Simplex> reduced(const Simplex& s, const Difference& added) {
  const Vec& w = added.way;
  const auto with = [&](const Difference& other) {
    return counts(other.way, w) ? Simplex{added, other, true} : Simplex{added, added, false};
  };
  if (!s.is_pair) return with(s.first);
  const Vec to_first = s.first.way - w, to_second = s.second.way - w;
  const double area = cross(to_first, to_second);
  const double beyond_first = cross(to_first, -w), beyond_second = cross(-w, to_second);
  const bool outside_first = area > 0.0 ? beyond_first < 0.0 : beyond_first > 0.0;
  const bool outside_second = area > 0.0 ? beyond_second < 0.0 : beyond_second > 0.0;
  if (outside_first && counts(s.first.way, w)) return Simplex{added, s.first, true};
  if (outside_second && counts(s.second.way, w)) return Simplex{added, s.second, true};
  if (!outside_first && !outside_second) return {};
  return Simplex{added, added, false};
}

std::uint32_t edge_between(std::size_t i, std::size_t j, std::size_t count) {
  return static_cast<std::uint32_t>(next(j, count) == i ? j : i);
}

ClosestFeatures features(const Simplex& s, const Convex& a, const Convex& b) {
  if (s.first.a == s.second.a && s.is_pair)
    return {static_cast<std::uint32_t>(s.first.a), edge_between(s.first.b, s.second.b, b.vertices.size()),
            false, true};
  return {static_cast<std::uint32_t>(s.first.b), edge_between(s.first.a, s.second.a, a.vertices.size()), true,
          true};
}

}  // namespace

std::optional<ClosestFeatures> gjk(const Convex& a, const Convex& b, const Pose& b_in_a,
                                   const ClosestFeatures& from) {
  constexpr int kMostSteps = 64;
  const auto difference = [&](std::size_t i, std::size_t j) {
    return Difference{i, j, b_in_a * b.vertices[j] - a.vertices[i]};
  };
  const Difference start =
      from.vertex_of_b ? difference(from.edge, from.vertex) : difference(from.vertex, from.edge);
  Simplex simplex{start, start, false};
  for (int step = 0; step < kMostSteps; ++step) {
    const Vec along = simplex.direction();
    const Difference found = difference(support(a, along), support(b, b_in_a.unrotate(-along)));
    if (found.joins(simplex.first) || found.joins(simplex.second)) break;
    const std::optional<Simplex> smaller = reduced(simplex, found);
    if (!smaller) return {};
    simplex = *smaller;
  }
  return features(simplex, a, b);
}

}  // namespace throng::narrowphase
