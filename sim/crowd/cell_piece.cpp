// SPDX-License-Identifier: MIT
#include "sim/crowd/cell_piece.h"

#include <algorithm>

namespace throng {

namespace {

constexpr double kNarrowest = 1e-9;  // of the cell's size: narrower is no way from one trapezoid to the next

double area(std::span<const Vec> ring) {
  double twice = 0.0;
  for (std::size_t i = 0; i < ring.size(); ++i) twice += cross(ring[i], ring[(i + 1) % ring.size()]);
  return 0.5 * twice;
}

/// Cuts the segment down to what of it is in the convex cell; false where nothing is: Cyrus and Beck,
/// "Generalized two- and three-dimensional clipping" (Computers & Graphics 1978).
bool clip(std::span<const Vec> cell, Vec& a, Vec& b) {
  double from = 0.0, to = 1.0;
  for (std::size_t i = 0; i < cell.size(); ++i) {
    const Vec along = cell[(i + 1) % cell.size()] - cell[i];
    const double at_a = cross(along, a - cell[i]), at_b = cross(along, b - cell[i]);
    if (at_a < 0.0 && at_b < 0.0) return false;
    if (at_a < 0.0) from = std::max(from, at_a / (at_a - at_b));
    if (at_b < 0.0) to = std::min(to, at_a / (at_a - at_b));
  }
  if (!(from < to)) return false;
  const Vec way = b - a;
  b = to < 1.0 ? Vec(a + to * way) : b;
  a = from > 0.0 ? Vec(a + from * way) : a;
  return true;
}

}  // namespace

CellPiece::Edges::Edges(const Region& region) : holds(region) {
  std::vector<broadphase::Extent> extents;
  for (const std::vector<Vec>& ring : region.rings)
    for (std::size_t i = 0; i < ring.size(); ++i) {
      ends.emplace_back(ring[i], ring[(i + 1) % ring.size()]);
      extents.push_back(broadphase::Extent::of_segment(ends.back().first, ends.back().second));
    }
  index.build(extents);
}

CellPiece::CellPiece(const Region& floor, const Region& area) : floor_(floor), area_(area) {}

CellPiece::Sizes CellPiece::sizes(std::span<const Vec> cell, const Vec& agent) {
  lines_.clear(), trapezoids_.clear(), heights_.clear();
  add_lines(floor_, Kind::floor, cell, agent);
  add_lines(area_, Kind::area, cell, agent);
  add_crossings();
  if (lines_.empty()) return {area(cell), area_.holds(agent) ? area(cell) : 0.0};
  for (std::size_t i = 0; i < cell.size(); ++i) add_line(cell[i], cell[(i + 1) % cell.size()], Kind::cell);
  std::ranges::sort(heights_);
  rounding_ = kNarrowest * (heights_.back() - heights_.front());
  std::size_t below = 0;
  for (std::size_t i = 1; i < heights_.size(); ++i) {
    if (!(heights_[i - 1] < heights_[i])) continue;
    const std::size_t first = trapezoids_.size();
    cut(heights_[i - 1], heights_[i], agent);
    join_along(first);
    join_across(below, first);
    below = first;
  }
  return sum();
}

void CellPiece::add_lines(const Edges& edges, Kind kind, std::span<const Vec> cell, const Vec& agent) {
  Eigen::AlignedBox2d box;
  for (const Vec& corner : cell) box.extend(corner + agent);
  edges.index.for_each_near(box, [&](std::uint32_t row) {
    Vec a = edges.ends[row].first - agent, b = edges.ends[row].second - agent;
    if (clip(cell, a, b)) add_line(a, b, kind);
  });
}

void CellPiece::add_line(const Vec& a, const Vec& b, Kind kind) {
  heights_.push_back(a.y()), heights_.push_back(b.y());
  lines_.push_back(a.y() < b.y() ? Line{a, b, kind} : Line{b, a, kind});
}

/// The heights at which edges of the area cross those of the floor.
void CellPiece::add_crossings() {
  for (const Line& one : lines_)
    for (const Line& other : lines_) {
      if (one.kind != Kind::floor || other.kind != Kind::area) continue;
      const Vec along = one.high - one.low, across = other.high - other.low;
      const double low = cross(along, other.low - one.low), high = cross(along, other.high - one.low);
      if (low * high >= 0.0 ||
          cross(across, one.low - other.low) * cross(across, one.high - other.low) >= 0.0)
        continue;
      heights_.push_back(other.low.y() + low / (low - high) * across.y());
    }
}

/// Makes the trapezoids between these heights, from left to right.
void CellPiece::cut(double low, double high, const Vec& agent) {
  const double middle = low + 0.5 * (high - low);
  between_.clear();
  for (const Line& line : lines_)
    if (line.low.y() <= low && line.high.y() >= high) between_.push_back(line);
  std::ranges::stable_sort(between_, {}, [&](const Line& line) { return line.x(middle); });
  const std::size_t first = trapezoids_.size();
  for (std::size_t i = 1; i < between_.size(); ++i) {
    const Line &left = between_[i - 1], &right = between_[i];
    trapezoids_.push_back({low,
                           high,
                           {left.x(low), left.x(high)},
                           {right.x(low), right.x(high)},
                           right.kind,
                           false,
                           false,
                           trapezoids_.size()});
  }
  tell(first, floor_, Kind::floor, &Trapezoid::on_floor, agent);
  tell(first, area_, Kind::area, &Trapezoid::in_area, agent);
}

/// Asks it of the middle of the widest, farthest from all lines; each line of that kind turns it round.
void CellPiece::tell(std::size_t first, const Edges& edges, Kind side, bool Trapezoid::*is_in,
                     const Vec& agent) {
  if (first == trapezoids_.size()) return;
  const auto widest =
      std::max_element(trapezoids_.begin() + static_cast<std::ptrdiff_t>(first), trapezoids_.end(),
                       [](const Trapezoid& a, const Trapezoid& b) { return a.width() < b.width(); });
  const Vec middle(0.25 * (widest->left[0] + widest->left[1] + widest->right[0] + widest->right[1]),
                   0.5 * (widest->low + widest->high));
  const auto from = static_cast<std::size_t>(widest - trapezoids_.begin());
  trapezoids_[from].*is_in = edges.holds(agent + middle);
  for (std::size_t i = from; i > first; --i)
    trapezoids_[i - 1].*is_in = trapezoids_[i].*is_in != (trapezoids_[i - 1].side == side);
  for (std::size_t i = from + 1; i < trapezoids_.size(); ++i)
    trapezoids_[i].*is_in = trapezoids_[i - 1].*is_in != (trapezoids_[i - 1].side == side);
}

/// Those side by side: an edge of the area parts none.
void CellPiece::join_along(std::size_t first) {
  for (std::size_t i = first + 1; i < trapezoids_.size(); ++i)
    if (trapezoids_[i - 1].side != Kind::floor) join(i - 1, i);
}

/// Those above on those below.
void CellPiece::join_across(std::size_t below, std::size_t first) {
  for (std::size_t i = below; i < first; ++i)
    for (std::size_t k = first; k < trapezoids_.size(); ++k) {
      const Trapezoid &low = trapezoids_[i], &high = trapezoids_[k];
      const double shared = std::min(low.right[1], high.right[0]) - std::max(low.left[1], high.left[0]);
      if (low.on_floor && high.on_floor && shared > rounding_) join(i, k);
    }
}

void CellPiece::join(std::size_t one, std::size_t other) {
  trapezoids_[root(other)].joined = root(one);
}

std::size_t CellPiece::root(std::size_t one) const {
  while (trapezoids_[one].joined != one) one = trapezoids_[one].joined;
  return one;
}

/// Of all that are joined to one on the floor that holds the agent, at the origin.
CellPiece::Sizes CellPiece::sum() const {
  std::size_t its = trapezoids_.size();
  for (std::size_t i = 0; i < trapezoids_.size(); ++i) {
    const Trapezoid& one = trapezoids_[i];
    if (!one.on_floor || one.low > 0.0 || one.high < 0.0) continue;
    const double t = -one.low / (one.high - one.low);
    if (one.left[0] + t * (one.left[1] - one.left[0]) <= rounding_ &&
        one.right[0] + t * (one.right[1] - one.right[0]) >= -rounding_)
      its = root(i);
  }
  Sizes sizes{0.0, 0.0};
  for (std::size_t i = 0; i < trapezoids_.size() && its < trapezoids_.size(); ++i) {
    if (root(i) != its || !trapezoids_[i].on_floor) continue;
    sizes.whole += trapezoids_[i].size();
    if (trapezoids_[i].in_area) sizes.in_area += trapezoids_[i].size();
  }
  return sizes;
}

}  // namespace throng
