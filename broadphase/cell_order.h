// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "broadphase/cells.h"
#include "broadphase/point.h"
#include "broadphase/team.h"

namespace throng::broadphase {

/// Points in the order of their cells, in double: what a search for the lists of all of them walks over.
class CellOrder {
 public:
  /// Sorts the points into cells at least `radius` (m) wide, each with a place in an array. False where that
  /// doesn't suit them: where it would hold many times more cells than points, or cells made larger to avoid
  /// this would be crowded. O(n); allocates only to grow.
  bool rebuild(std::span<const Point> points, double radius, const Period* period, Team& team);

  const Cells& cells() const { return cells_; }
  std::size_t size() const { return row_.size() - kPadding; }

  /// The places of a cell's points go from start()[bucket] to start()[bucket + 1].
  const std::uint32_t* start() const { return start_.data(); }
  const std::uint32_t* row() const { return row_.data(); }  ///< ascending in each cell; padded, as x and y
  const double* x() const { return x_.data(); }             ///< m
  const double* y() const { return y_.data(); }

  static constexpr std::size_t kPadding = 8;  ///< behind the last place, may be read

 private:
  bool choose_cells(std::span<const Point> points, double radius, const Period* period);
  bool count(std::span<const Point> points, bool enlarged);

  Cells cells_;
  std::vector<std::uint32_t> start_, bucket_;
  std::vector<std::uint32_t> row_ = std::vector<std::uint32_t>(kPadding);
  std::vector<double> x_, y_;
};

}  // namespace throng::broadphase
