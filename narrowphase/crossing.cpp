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

/// From left to right, and upwards on one vertical: as if the plane leaned by an infinitesimal angle.
bool lies_before(const Vec& p, const Vec& q) {
  return p.x() != q.x() ? p.x() < q.x() : p.y() < q.y();
}

/// The edges of a closed polygon.
struct Outline {
  std::span<const Vec> polygon;

  const Vec& tail(std::size_t i) const { return polygon[i]; }
  const Vec& head(std::size_t i) const { return polygon[next(i, polygon.size())]; }
  const Vec& left(std::size_t i) const { return lies_before(tail(i), head(i)) ? tail(i) : head(i); }
  const Vec& right(std::size_t i) const { return lies_before(tail(i), head(i)) ? head(i) : tail(i); }

  bool are_neighbours(std::size_t i, std::size_t j) const {
    return next(i, polygon.size()) == j || next(j, polygon.size()) == i;
  }
  bool meet(std::size_t i, std::size_t j) const {
    return !are_neighbours(i, j) && segments_meet(tail(i), head(i), tail(j), head(j));
  }
  bool folds_after(std::size_t i) const {
    const std::size_t j = next(i, polygon.size());
    return orientation(tail(i), head(i), head(j)) == 0 && dot(head(i) - tail(i), head(j) - tail(j)) < 0.0;
  }
};

Crossing named(std::size_t i, std::size_t j) {
  return std::minmax(i, j);
}

Crossing find_fold(const Outline& outline) {
  const std::size_t count = outline.polygon.size();
  for (std::size_t i = 0; i < count; ++i)
    if (outline.folds_after(i)) return named(i, next(i, count));
  return std::nullopt;
}

/// Two vertices in one place.
Crossing find_pinch(const Outline& outline) {
  std::vector<std::size_t> order(outline.polygon.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t i, std::size_t j) {
    return outline.tail(i) != outline.tail(j) ? lies_before(outline.tail(i), outline.tail(j)) : i < j;
  });
  for (std::size_t k = 1; k < order.size(); ++k)
    if (outline.tail(order[k - 1]) == outline.tail(order[k])) return named(order[k - 1], order[k]);
  return std::nullopt;
}

/// The edges that a vertical line meets, from below. Their order holds as long as none cross.
class Sweep {
 public:
  explicit Sweep(const Outline& outline)
      : outline_(outline), status_(Below{outline}), places_(outline.polygon.size()) {}

  Crossing begin(std::size_t edge) {
    const auto [place, inserted] = status_.insert(edge);
    places_[edge] = place;
    if (place != status_.begin() && outline_.meet(*std::prev(place), edge))
      return named(*std::prev(place), edge);
    const auto above = std::next(place);
    if (above != status_.end() && outline_.meet(edge, *above)) return named(edge, *above);
    return std::nullopt;
  }

  Crossing end(std::size_t edge) {
    const auto above = status_.erase(places_[edge]);
    if (above == status_.begin() || above == status_.end()) return std::nullopt;
    if (outline_.meet(*std::prev(above), *above)) return named(*std::prev(above), *above);
    return std::nullopt;
  }

 private:
  struct Below {
    Outline outline;

    bool operator()(std::size_t i, std::size_t j) const {
      const int side = lies_before(outline.left(j), outline.left(i)) ? -side_of(j, i) : side_of(i, j);
      return side != 0 ? side > 0 : i < j;
    }
    /// Whether edge j, which begins later, lies above edge i (1) or below (-1).
    int side_of(std::size_t i, std::size_t j) const {
      const int side = orientation(outline.left(i), outline.right(i), outline.left(j));
      return side != 0 ? side : orientation(outline.left(i), outline.right(i), outline.right(j));
    }
  };

  const Outline& outline_;
  std::set<std::size_t, Below> status_;
  std::vector<std::set<std::size_t, Below>::iterator> places_;
};

/// Where the sweep meets an edge first or last.
struct Event {
  std::size_t edge;
  bool begins;
};

std::vector<Event> events(const Outline& outline) {
  std::vector<Event> result;
  for (std::size_t i = 0; i < outline.polygon.size(); ++i) {
    result.push_back({i, true});
    result.push_back({i, false});
  }
  const auto place = [&](const Event& e) -> const Vec& {
    return e.begins ? outline.left(e.edge) : outline.right(e.edge);
  };
  std::sort(result.begin(), result.end(), [&](const Event& e, const Event& f) {
    if (place(e) != place(f)) return lies_before(place(e), place(f));
    return e.begins != f.begins ? f.begins : e.edge < f.edge;
  });
  return result;
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
  const Outline outline{polygon};
  if (const Crossing fold = find_fold(outline)) return fold;
  if (const Crossing pinch = find_pinch(outline)) return pinch;
  Sweep sweep(outline);
  for (const Event& event : events(outline))
    if (const Crossing found = event.begins ? sweep.begin(event.edge) : sweep.end(event.edge)) return found;
  return std::nullopt;
}

}  // namespace throng::narrowphase
