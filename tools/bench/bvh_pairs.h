// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <utility>

#include "narrowphase/bvh_edges.h"
#include "narrowphase/bvh_exhaustive.h"
#include "tools/bench/outlines.h"

/// The pairs of polygons that throng bench bvh asks about, and the two answers without any hierarchy.
namespace throng::bench {

using narrowphase::OutlineEdge;
using narrowphase::Pose;

constexpr int kPlaces = 8;  ///< turned poses that a block asks about

struct PolygonPair {
  std::string name;
  std::vector<Ring> a, b;
  std::vector<std::pair<Pose, Pose>> places;
};

inline std::vector<double> radii(const std::string& family, std::size_t n, std::uint64_t seed) {
  if (family == "star") return star_radii(n);
  return family == "gear" ? gear_radii(n) : coast_radii(n, seed);
}

/// The same relative pose up to some thousandths, all of it turned: no box is parallel to an axis.
inline void place(PolygonPair& pair, const Vec& offset, double turn_b, double wobble) {
  for (int i = 0; i < kPlaces; ++i) {
    const Pose world = narrowphase::pose({0.3, -0.2}, 0.7 * i + 0.1);
    const Vec at = offset + 0.5 * wobble * Vec(noise(1, i), noise(2, i));
    pair.places.emplace_back(
        world, narrowphase::pose(world * at, 0.7 * i + 0.1 + turn_b + 0.5 * wobble * noise(3, i)));
  }
}

/// Side by side with a gap of about 1 % of the radius; the same with outlines that cross; or one in a hole
/// of the other's shape, 1e-3 wider all around, turned in its frame: nearest almost everywhere.
inline PolygonPair make_pair(const std::string& family, const std::string& situation, std::size_t n) {
  PolygonPair pair;
  const std::vector<double> own = radii(family, n, 1);
  pair.name = situation + " " + family + " n=" + std::to_string(n);
  pair.a = {around(own)};
  if (situation == "interlocked") {
    pair.b = {turned(around(std::vector<double>(64, 3.0)), 0.4), turned(around(widened(own, 1e-3)), 0.4)};
    place(pair, {0.0, 0.0}, -0.4, family == "star" ? 1e-5 : 1e-4);
    return pair;
  }
  pair.b = {around(radii(family, n, 2))};
  double right = 0.0, left = 0.0;
  const Ring turned_b = turned(pair.b[0], 1.0);
  for (const Vec& v : pair.a[0]) right = std::max(right, v.x());
  for (const Vec& v : turned_b) left = std::min(left, v.x());
  place(pair, {right - left + (situation == "near" ? 0.01 : -0.02), 0.0}, 1.0, 1e-3);
  return pair;
}

/// All edges against all for the least distance, as fast as plain code does it.
inline double brute_distance(const std::vector<OutlineEdge>& a, const std::vector<OutlineEdge>& b,
                             const std::pair<Pose, Pose>& at) {
  const Pose b_in_a = narrowphase::relative(at.first, at.second);
  double squared = std::numeric_limits<double>::infinity();
  for (const OutlineEdge& f : b) {
    const Vec r = b_in_a * f.p, s = b_in_a * f.q;
    for (const OutlineEdge& e : a)
      squared = std::min(squared, narrowphase::nearest_of_edges(e.p, e.q, r, s).squared);
  }
  return std::sqrt(squared);
}

inline double brute_meetings(const std::vector<OutlineEdge>& a, const std::vector<OutlineEdge>& b,
                             const std::pair<Pose, Pose>& at) {
  const Pose b_in_a = narrowphase::relative(at.first, at.second);
  double count = 0.0;
  for (const OutlineEdge& f : b) {
    const Vec r = b_in_a * f.p, s = b_in_a * f.q;
    for (const OutlineEdge& e : a) count += narrowphase::segments_meet(e.p, e.q, r, s);
  }
  return count;
}

}  // namespace throng::bench
