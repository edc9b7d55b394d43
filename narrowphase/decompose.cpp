// SPDX-License-Identifier: MIT
#include "narrowphase/decompose.h"

#include <algorithm>
#include <cstdint>
#include <map>
#include <numeric>
#include <tuple>

#include "narrowphase/bridge.h"
#include "narrowphase/orientation.h"
#include "narrowphase/relative.h"

namespace throng::narrowphase {

namespace {

constexpr std::size_t kNone = SIZE_MAX;

/// A side of a part, which lies on its left.
struct HalfEdge {
  std::size_t origin;  // vertex of the polygon
  std::size_t next, previous;
  std::size_t twin;  // of the part across, or kNone on the outline
};

/// Cuts ears off a polygon until a triangle is left; writes the triangles as half-edges. The polygon may run
/// to holes and back, as `bridged` makes it: vertices may share a place.
class EarCutter {
 public:
  explicit EarCutter(std::span<const Vec> polygon) : polygon_(polygon), left_(polygon.size()) {
    const std::size_t count = polygon.size();
    for (std::size_t i = 0; i < count; ++i)
      ring_.push_back({previous(i, count), narrowphase::next(i, count), kNone});
    for (std::size_t i = 0; i < count; ++i) {
      ring_[i].blunt = !is_convex(i);
      if (ring_[i].blunt) blunt_.push_back(i);
    }
    std::sort(blunt_.begin(), blunt_.end(), [&](std::size_t i, std::size_t j) { return x(i) < x(j); });
  }

  /// An ear stays one, and what is none becomes one only when a neighbour goes: each vertex waits to be
  /// looked at again until then.
  std::vector<HalfEdge> cut() {
    std::vector<std::size_t> waiting(left_);
    std::iota(waiting.rbegin(), waiting.rend(), std::size_t{0});
    while (left_ > 3 && !waiting.empty()) {
      const std::size_t i = waiting.back();
      waiting.pop_back();
      if (ring_[i].gone || !is_ear(i)) continue;
      cut_off(i);
      waiting.push_back(ring_[i].next);
      waiting.push_back(ring_[i].previous);
    }
    add_triangle(last_);
    return std::move(edges_);
  }

 private:
  /// A vertex of what is left: its neighbours, and the half-edge beyond the edge to the next one, if that is
  /// a diagonal.
  struct Link {
    std::size_t previous, next, across;
    bool gone = false;
    bool blunt = false;  // turns right or not at all
  };

  double x(std::size_t i) const { return polygon_[i].x(); }

  int turn(std::size_t i, std::size_t j, std::size_t k) const {
    return orientation(polygon_[i], polygon_[j], polygon_[k]);
  }
  bool is_convex(std::size_t i) const { return turn(ring_[i].previous, i, ring_[i].next) > 0; }

  /// No blunt vertex may lie in the ear or on its rim; where any vertex does, a blunt one does. A vertex in
  /// the same place as a corner doesn't count. An edge from it into the ear can't leave it by the two edges
  /// at i, so it ends at another vertex in the ear, which does count.
  bool is_ear(std::size_t i) const {
    const std::size_t a = ring_[i].previous, c = ring_[i].next;
    if (!is_convex(i)) return false;
    const double low = std::min({x(a), x(i), x(c)}), high = std::max({x(a), x(i), x(c)});
    auto v = std::partition_point(blunt_.begin(), blunt_.end(), [&](std::size_t j) { return x(j) < low; });
    for (; v != blunt_.end() && x(*v) <= high; ++v)
      if (ring_[*v].blunt && holds(a, i, c, *v)) return false;
    return true;
  }

  /// Whether v lies in the triangle a-i-c or on its rim, but at no corner.
  bool holds(std::size_t a, std::size_t i, std::size_t c, std::size_t v) const {
    return turn(c, a, v) >= 0 && turn(a, i, v) >= 0 && turn(i, c, v) >= 0 && !share_place(v, a) &&
           !share_place(v, i) && !share_place(v, c);
  }

  bool share_place(std::size_t i, std::size_t j) const { return polygon_[i] == polygon_[j]; }

  /// The triangle at i; returns its half-edge from the next vertex to the previous one.
  std::size_t add_triangle(std::size_t i) {
    const std::size_t a = ring_[i].previous, c = ring_[i].next, first = edges_.size();
    edges_.push_back({a, first + 1, first + 2, ring_[a].across});
    edges_.push_back({i, first + 2, first, ring_[i].across});
    edges_.push_back({c, first, first + 1, ring_[c].next == a ? ring_[c].across : kNone});
    for (std::size_t e = first; e < first + 3; ++e)
      if (edges_[e].twin != kNone) edges_[edges_[e].twin].twin = e;
    return first + 2;
  }

  void cut_off(std::size_t i) {
    const std::size_t a = ring_[i].previous, c = ring_[i].next;
    const std::size_t diagonal = add_triangle(i);
    ring_[a].next = c, ring_[c].previous = a, ring_[a].across = diagonal, ring_[i].gone = true;
    --left_;
    last_ = a;
    for (const std::size_t v : {a, c}) ring_[v].blunt = !is_convex(v);
  }

  std::span<const Vec> polygon_;
  std::vector<Link> ring_;
  std::vector<std::size_t> blunt_;  // vertices that were blunt at first, from left to right
  std::vector<HalfEdge> edges_;
  std::size_t left_;
  std::size_t last_ = 0;  // a vertex that is still there
};

/// Takes out the diagonals without which all corners stay strictly convex.
class Merger {
 public:
  Merger(std::span<const Vec> polygon, std::vector<HalfEdge> edges)
      : polygon_(polygon), edges_(std::move(edges)), gone_(edges_.size()) {}

  void merge() {
    for (std::size_t e = 0; e < edges_.size(); ++e)
      if (edges_[e].twin != kNone && e < edges_[e].twin && convex_without(e) &&
          convex_without(edges_[e].twin))
        take_out(e);
  }

  std::vector<Convex> parts(double radius) const {
    std::vector<Convex> result;
    std::vector<bool> seen = gone_;
    for (std::size_t start = 0; start < edges_.size(); ++start) {
      std::vector<Vec> loop;
      for (std::size_t e = start; !seen[e]; e = edges_[e].next) {
        loop.push_back(polygon_[edges_[e].origin]);
        seen[e] = true;
      }
      if (!loop.empty()) result.push_back(convex(std::move(loop), radius));
    }
    return result;
  }

 private:
  /// Whether the corner at the diagonal's origin stays convex.
  bool convex_without(std::size_t e) const {
    const HalfEdge& before = edges_[edges_[e].previous];
    const HalfEdge& after = edges_[edges_[edges_[e].twin].next];
    return orientation(polygon_[before.origin], polygon_[edges_[e].origin],
                       polygon_[edges_[after.next].origin]) > 0;
  }

  void take_out(std::size_t e) {
    const HalfEdge here = edges_[e], there = edges_[here.twin];
    edges_[here.previous].next = there.next, edges_[there.next].previous = here.previous;
    edges_[there.previous].next = here.next, edges_[here.next].previous = there.previous;
    gone_[e] = gone_[here.twin] = true;
  }

  std::span<const Vec> polygon_;
  std::vector<HalfEdge> edges_;
  std::vector<bool> gone_;
};

/// Makes the two sides of each bridge twins: they alone run both ways between two places.
void join_bridges(std::span<const Vec> polygon, std::vector<HalfEdge>& edges) {
  using Place = std::tuple<double, double, double, double>;
  const auto place = [&](std::size_t from, std::size_t to) -> Place {
    const Vec &p = polygon[edges[from].origin], &q = polygon[edges[to].origin];
    return {p.x(), p.y(), q.x(), q.y()};
  };
  std::map<Place, std::size_t> open;  // by the way back
  for (std::size_t e = 0; e < edges.size(); ++e)
    if (edges[e].twin == kNone) open.emplace(place(edges[e].next, e), e);
  for (std::size_t e = 0; e < edges.size(); ++e) {
    if (edges[e].twin != kNone) continue;
    const auto other = open.find(place(e, edges[e].next));
    if (other != open.end()) edges[e].twin = other->second;
  }
}

std::vector<Convex> merged(std::span<const Vec> polygon, std::vector<HalfEdge> triangles, double radius) {
  Merger merger(polygon, std::move(triangles));
  merger.merge();
  return merger.parts(radius);
}

}  // namespace

std::vector<Convex> decompose(std::span<const Vec> polygon, double radius) {
  return merged(polygon, EarCutter(polygon).cut(), radius);
}

std::vector<Convex> decompose(std::span<const std::vector<Vec>> rings, double radius) {
  const std::vector<Vec> line = bridged(rings);
  std::vector<HalfEdge> triangles = EarCutter(line).cut();
  join_bridges(line, triangles);
  return merged(line, std::move(triangles), radius);
}

}  // namespace throng::narrowphase
