// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "broadphase/box_index.h"
#include "sim/crowd/inside.h"

namespace throng {

/// What of an agent's cell it can stand on: the piece of floor in the cell that holds the agent, without
/// those behind walls. By vertical cuts through all corners in the cell, and the trapezoids between them.
class CellPiece {
 public:
  CellPiece(const Region& floor, const Region& area);

  struct Sizes {
    double whole, in_area;  ///< m², of the piece, and of what of it is in the area
  };

  /// Of a convex cell, counter-clockwise, given about the agent (m). Nothing where the agent is off the
  /// floor, which is asked only where an edge is near. O(c) where no edge is near, else O((c + e)² + e c), c
  /// = corners of the cell, e = edges of floor and area near it.
  Sizes sizes(std::span<const Vec> cell, const Vec& agent);

 private:
  enum class Kind { cell, floor, area };
  struct Line {
    Vec low, high;  ///< m, about the agent, by y
    Kind kind;
    double x(double y) const { return low.x() + (y - low.y()) / (high.y() - low.y()) * (high.x() - low.x()); }
  };
  /// Between two neighbouring lines and two neighbouring heights.
  struct Trapezoid {
    double low, high;          ///< m, of y
    double left[2], right[2];  ///< m, of x there
    Kind side;                 ///< of its right line
    bool on_floor = false, in_area = false;
    std::size_t joined;  ///< to which one, up to one that is to itself

    double width() const { return 0.5 * (right[0] - left[0] + right[1] - left[1]); }
    double size() const { return width() * (high - low); }
  };
  struct Edges {
    explicit Edges(const Region& region);
    std::vector<std::pair<Vec, Vec>> ends;  // m
    broadphase::BoxIndex index;
    Inside holds;
  };

  void add_lines(const Edges& edges, Kind kind, std::span<const Vec> cell, const Vec& agent);
  void add_line(const Vec& a, const Vec& b, Kind kind);
  void add_crossings();
  void cut(double low, double high, const Vec& agent);
  void tell(std::size_t first, const Edges& edges, Kind side, bool Trapezoid::*is_in, const Vec& agent);
  void join_along(std::size_t first);
  void join_across(std::size_t below, std::size_t first);
  void join(std::size_t one, std::size_t other);
  std::size_t root(std::size_t one) const;
  Sizes sum() const;

  Edges floor_, area_;
  double rounding_ = 0.0;  // m
  std::vector<Line> lines_, between_;
  std::vector<double> heights_;  // m
  std::vector<Trapezoid> trapezoids_;
};

}  // namespace throng
