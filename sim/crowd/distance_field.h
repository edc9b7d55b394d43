// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

#include "sim/crowd/barriers.h"
#include "sim/crowd/floor_plan.h"
#include "sim/crowd/inside.h"
#include "sim/crowd/region.h"
#include "sim/prefetch.h"

namespace throng {

/// How far it is to a goal, from everywhere, round all barriers, and which way to go: to the nearest point of
/// the goal, not to its middle. Built once and shared by all who have that goal.
///
/// Fast marching of second order: Sethian, "Fast marching methods" (SIAM Review 1999), from exact distances
/// next to the goal. Ways keep the plan's clearance from barriers; who is nearer to one than that is led as
/// those beside him, and from much nearer away from it.
class DistanceField {
 public:
  /// O(n log n) for n nodes; keeps 4 bytes a node. `plan` and `barriers` must outlive the field.
  DistanceField(const FloorPlan& plan, const Barriers& barriers, const Region& goal);

  /// m, from `p` to the goal; infinite where no way leads there. O(1).
  double distance(const Vec& p) const;

  /// Whether any node but of the goal's own is known. O(n).
  bool leads_from_anywhere() const;

  /// The same as `direction`, of some length above 0, in little time. False where that is no whole answer:
  /// near barriers and in the goal.
  bool slope(const Vec& p, Vec& down) const {
    Cell cell;
    if (!locate(p, cell) || !is_whole(cell.node)) return false;
    down = downhill(cell);
    return down.squaredNorm() > 0.01 * plan_->cell * plan_->cell;
  }

  /// Unit vector along the shortest way; zero in the goal, and where no way leads there. O(1) away from
  /// barriers.
  Vec direction(const Vec& p) const;

  /// Asks for the memory that `direction` will read of `p`.
  void prefetch(const Vec& p) const;

 private:
  struct Cell {
    std::size_t node;  ///< its lower left
    double u, v;       ///< 0 to 1: where in it
  };
  bool locate(const Vec& p, Cell& cell) const;
  float at(std::size_t node) const { return std::abs(distance_[node]); }
  /// Whether the four corners of the cell are known and no barrier crosses it.
  bool is_whole(std::size_t node) const { return !std::signbit(distance_[node]); }
  void mark_broken();
  Vec downhill(const Cell& cell) const;
  /// Calls f(node) for the known ones of the sixteen round the cell.
  template <class F>
  void for_each_known(const Cell& cell, F&& f) const;
  /// Which way the distances fall round `p`, by the nodes that it sees; zero where they don't say.
  Vec fall_of_visible(const Vec& p, const Cell& cell) const;
  /// The node round `p`, at least `nearest` away, over which the goal is nearest, and how far it is that way;
  /// size() where there is none.
  std::size_t nearest_way(const Vec& p, const Cell& cell, double nearest, double& distance) const;

  const FloorPlan* plan_;
  const Barriers* barriers_;
  Inside goal_;
  double per_cell_;  ///< 1/m
  /// m, of the nodes; below zero, or -0, where the cell up and right of the node isn't whole: one place in
  /// memory says both.
  std::vector<float> distance_;
};

inline bool DistanceField::locate(const Vec& p, Cell& cell) const {
  const Vec at = (p - plan_->origin) * per_cell_;
  if (!(at.x() >= 0.0 && at.y() >= 0.0 && at.x() < plan_->columns - 1 && at.y() < plan_->rows - 1))
    return false;
  const auto x = static_cast<int>(at.x()), y = static_cast<int>(at.y());
  cell = {
      static_cast<std::size_t>(y) * static_cast<std::size_t>(plan_->columns) + static_cast<std::size_t>(x),
      at.x() - x, at.y() - y};
  return true;
}

inline Vec DistanceField::downhill(const Cell& cell) const {
  const std::size_t node = cell.node, above = node + static_cast<std::size_t>(plan_->columns);
  const float low[] = {at(node), at(node + 1)}, high[] = {at(above), at(above + 1)};
  return {(1.0 - cell.v) * (low[0] - low[1]) + cell.v * (high[0] - high[1]),
          (1.0 - cell.u) * (low[0] - high[0]) + cell.u * (low[1] - high[1])};
}

inline void DistanceField::prefetch(const Vec& p) const {
  Cell cell;
  if (!locate(p, cell)) return;
  throng::prefetch(&distance_[cell.node]);
  throng::prefetch(&distance_[cell.node + static_cast<std::size_t>(plan_->columns)]);
}

}  // namespace throng
