// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "narrowphase/bvh_traverse.h"

/// Polygons of up to millions of edges, each a solid with its outline in a hierarchy. For a few parts
/// `nearest_parts.h` is simpler.
namespace throng::narrowphase {

/// From `p` to `q`, in the shape's frame.
struct OutlineEdge {
  Vec p, q;             ///< m
  std::uint32_t index;  ///< among all edges as given, ring after ring
};

/// The rings' edges in order, each from a vertex to the next.
std::vector<OutlineEdge> outline_edges(std::span<const std::vector<Vec>> rings);

/// `Volume`: Ball<2>, Box<2>, OrientedBox<2> or BoxAndBall<2>. Boxes are the quickest to build and to ask for
/// points, oriented ones for what is long and near; see `throng bench bvh`.
template <class Volume>
struct Outline {
  Bvh<Volume> tree;
  std::vector<OutlineEdge> edges;  ///< leaf by leaf
  Vec start;                       ///< m, the outer ring's first vertex
};

/// A polygon's outline and its holes', each a closed ring of three vertices or more; the first is the outer
/// one. Expects rings that are simple and don't meet each other; inside is where the even-odd rule says.
template <class Volume>
Outline<Volume> outline(std::span<const std::vector<Vec>> rings, const BvhConfig& config = {});

/// Where a pair's last answer was: keep one per pair and pass it again. Any value is right, a near one is
/// fast.
struct OutlineCache {
  std::uint32_t a = 0, b = 0;  ///< places in `edges`
};

struct OutlineQuestion {
  double relative_error = 0.0;    ///< upper <= (1 + relative_error) * lower is enough, where apart
  OutlineCache* cache = nullptr;  ///< read and written
  BvhCounters* counters = nullptr;
};

/// Of two solids. Apart: 0 < lower <= distance <= upper = |point_b - point_a|. Touching, crossing or one in
/// the other: upper <= 0 is minus how deep the deepest vertex lies in the other solid, a lower bound of the
/// penetration depth, and the points show that depth; a translation by -lower surely parts the two.
struct OutlineProximity {
  double lower, upper;   ///< m, signed
  Vec point_a, point_b;  ///< m, world, on the outlines; where the two overlap one is the deepest vertex
  std::uint32_t edge_a, edge_b;  ///< an edge of each that has the point
};

/// Swapping a and b swaps the answer, to the bit. Edges are compared in one frame, b's vertices rounded once:
/// crossing and containment are exact for these. Of several nearest places it is always the same one.
/// Allocates nothing; time grows with the number of edges about as near as the nearest.
template <class Volume>
OutlineProximity proximity(const Outline<Volume>& a, const Pose& pose_a, const Outline<Volume>& b,
                           const Pose& pose_b, const OutlineQuestion& question = {});

struct CollisionQuestion {
  Order order = Order::depth_first;
  OutlineCache* cache = nullptr;  ///< read, and written where edges meet
  BvhCounters* counters = nullptr;
};

/// Whether the two solids share a point: at the first pair of edges that meet, the last step's before all
/// others, or by containment.
template <class Volume>
bool collide(const Outline<Volume>& a, const Pose& pose_a, const Outline<Volume>& b, const Pose& pose_b,
             const CollisionQuestion& question = {});

/// Replaces `meetings` by all pairs of edges (their indices) that share a point, ascending.
template <class Volume>
void find_meetings(const Outline<Volume>& a, const Pose& pose_a, const Outline<Volume>& b, const Pose& pose_b,
                   std::vector<std::pair<std::uint32_t, std::uint32_t>>& meetings,
                   BvhCounters* counters = nullptr);

/// The nearest place of an outline.
struct OutlinePoint {
  double distance;     ///< m, never negative: to the outline, also from inside
  Vec point;           ///< m, in the shape's frame
  std::uint32_t edge;  ///< its index
};

/// From a point in the shape's frame; `cache`, if given, starts at its a and is written.
template <class Volume>
OutlinePoint nearest(const Outline<Volume>& shape, const Vec& point, OutlineCache* cache = nullptr,
                     BvhCounters* counters = nullptr);

/// Whether the solid holds a point of its frame: exact; on the outline it may go either way.
template <class Volume>
bool contains(const Outline<Volume>& shape, const Vec& point);

}  // namespace throng::narrowphase
