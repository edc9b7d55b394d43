// SPDX-License-Identifier: MIT
#include "narrowphase/crossing.h"

#include <algorithm>
#include <iterator>
#include <numeric>
#include <set>
#include <vector>

#include "narrowphase/orientation.h"
#include "narrowphase/relative.h"

namespace throng::narrowphase {

namespace {

using Crossing = std::optional<std::pair<std::size_t, std::size_t>>;

/// The edges of closed polygons, ring after ring.
class Edges {
 public:
  void add(std::span<const Vec> ring) {
    const std::size_t first = tails_.size();
    tails_.insert(tails_.end(), ring.begin(), ring.end());
    for (std::size_t i = 0; i < ring.size(); ++i) next_.push_back(first + narrowphase::next(i, ring.size()));
  }

  std::size_t size() const { return tails_.size(); }
  std::size_t next(std::size_t i) const { return next_[i]; }
  const Vec& tail(std::size_t i) const { return tails_[i]; }
  const Vec& head(std::size_t i) const { return tails_[next_[i]]; }
  const Vec& left(std::size_t i) const { return lies_before(tail(i), head(i)) ? tail(i) : head(i); }
  const Vec& right(std::size_t i) const { return lies_before(tail(i), head(i)) ? head(i) : tail(i); }

  bool meet(std::size_t i, std::size_t j) const {
    const bool are_neighbours = next_[i] == j || next_[j] == i;
    return !are_neighbours && segments_meet(tail(i), head(i), tail(j), head(j));
  }
  bool folds_after(std::size_t i) const {
    const std::size_t j = next_[i];
    return orientation(tail(i), head(i), head(j)) == 0 && dot(head(i) - tail(i), head(j) - tail(j)) < 0.0;
  }

 private:
  std::vector<Vec> tails_;
  std::vector<std::size_t> next_;
};

Crossing named(std::size_t i, std::size_t j) {
  return std::minmax(i, j);
}

Crossing find_fold(const Edges& edges) {
  for (std::size_t i = 0; i < edges.size(); ++i)
    if (edges.folds_after(i)) return named(i, edges.next(i));
  return std::nullopt;
}

/// Two vertices in one place.
Crossing find_pinch(const Edges& edges) {
  std::vector<std::size_t> order(edges.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t i, std::size_t j) {
    return edges.tail(i) != edges.tail(j) ? lies_before(edges.tail(i), edges.tail(j)) : i < j;
  });
  for (std::size_t k = 1; k < order.size(); ++k)
    if (edges.tail(order[k - 1]) == edges.tail(order[k])) return named(order[k - 1], order[k]);
  return std::nullopt;
}

/// The edges that a vertical line meets, from below. Their order holds as long as none cross.
class Sweep {
 public:
  explicit Sweep(const Edges& edges) : edges_(edges), status_(Below{edges}), places_(edges.size()) {}

  Crossing begin(std::size_t edge) {
    const auto [place, inserted] = status_.insert(edge);
    places_[edge] = place;
    if (place != status_.begin() && edges_.meet(*std::prev(place), edge))
      return named(*std::prev(place), edge);
    const auto above = std::next(place);
    if (above != status_.end() && edges_.meet(edge, *above)) return named(edge, *above);
    return std::nullopt;
  }

  Crossing end(std::size_t edge) {
    const auto above = status_.erase(places_[edge]);
    if (above == status_.begin() || above == status_.end()) return std::nullopt;
    if (edges_.meet(*std::prev(above), *above)) return named(*std::prev(above), *above);
    return std::nullopt;
  }

 private:
  struct Below {
    const Edges& edges;

    bool operator()(std::size_t i, std::size_t j) const {
      const int side = lies_before(edges.left(j), edges.left(i)) ? -side_of(j, i) : side_of(i, j);
      return side != 0 ? side > 0 : i < j;
    }
    /// Whether edge j, which begins later, lies above edge i (1) or below (-1).
    int side_of(std::size_t i, std::size_t j) const {
      const int side = orientation(edges.left(i), edges.right(i), edges.left(j));
      return side != 0 ? side : orientation(edges.left(i), edges.right(i), edges.right(j));
    }
  };

  const Edges& edges_;
  std::set<std::size_t, Below> status_;
  std::vector<std::set<std::size_t, Below>::iterator> places_;
};

/// Where the sweep meets an edge first or last.
struct Event {
  std::size_t edge;
  bool begins;
};

std::vector<Event> events(const Edges& edges) {
  std::vector<Event> result;
  for (std::size_t i = 0; i < edges.size(); ++i) {
    result.push_back({i, true});
    result.push_back({i, false});
  }
  const auto place = [&](const Event& e) -> const Vec& {
    return e.begins ? edges.left(e.edge) : edges.right(e.edge);
  };
  std::sort(result.begin(), result.end(), [&](const Event& e, const Event& f) {
    if (place(e) != place(f)) return lies_before(place(e), place(f));
    return e.begins != f.begins ? f.begins : e.edge < f.edge;
  });
  return result;
}

Crossing find_meeting(const Edges& edges) {
  if (const Crossing fold = find_fold(edges)) return fold;
  if (const Crossing pinch = find_pinch(edges)) return pinch;
  Sweep sweep(edges);
  for (const Event& event : events(edges))
    if (const Crossing found = event.begins ? sweep.begin(event.edge) : sweep.end(event.edge)) return found;
  return std::nullopt;
}

}  // namespace

bool segments_meet(const Vec& p, const Vec& q, const Vec& r, const Vec& s) {
  const auto apart = [](double a, double b, double c, double d) {
    return std::max(a, b) < std::min(c, d) || std::max(c, d) < std::min(a, b);
  };
  if (apart(p.x(), q.x(), r.x(), s.x()) || apart(p.y(), q.y(), r.y(), s.y())) return false;
  return orientation(p, q, r) * orientation(p, q, s) <= 0 && orientation(r, s, p) * orientation(r, s, q) <= 0;
}

Crossing find_crossing(std::span<const Vec> polygon) {
  Edges edges;
  edges.add(polygon);
  return find_meeting(edges);
}

std::optional<std::pair<RingEdge, RingEdge>> find_crossing(std::span<const std::vector<Vec>> rings) {
  Edges edges;
  std::vector<RingEdge> places;
  for (std::size_t ring = 0; ring < rings.size(); ++ring) {
    edges.add(rings[ring]);
    for (std::size_t edge = 0; edge < rings[ring].size(); ++edge) places.push_back({ring, edge});
  }
  const Crossing found = find_meeting(edges);
  if (!found) return std::nullopt;
  return std::pair(places[found->first], places[found->second]);
}

}  // namespace throng::narrowphase
