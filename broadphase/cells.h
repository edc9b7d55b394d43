// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "broadphase/point.h"

/// The square cells of a uniform grid, and the bucket of a table that each is kept in.
///
/// Where all cells of the bounding box fit into a table in proportion to the items, each has a bucket of its
/// own, row by row. Where they don't, each stretch of a row is hashed to a place, and cells may share a
/// bucket: then `shared` is true and who reads a bucket compares cells. Either way cells that are neighbours
/// in x are neighbours in the table, so a row of cells is one stretch of buckets.
namespace throng::broadphase {

struct Cell {
  std::int64_t x = 0, y = 0;
  friend bool operator==(const Cell&, const Cell&) = default;
};

/// Cells first.x to last_x of one row, which have consecutive buckets.
struct Run {
  Cell first;
  std::int64_t last_x;
  std::size_t bucket, end_bucket;

  bool holds(const Cell& cell) const { return cell.y == first.y && first.x <= cell.x && cell.x <= last_x; }
};

/// Which cells to look at: columns first.x to last.x of rows first.y to last.y, before wrapping round.
struct Range {
  Cell first, last;

  /// In double, since the product may be larger than any integer.
  double count() const {
    return (static_cast<double>(last.x - first.x) + 1.0) * (static_cast<double>(last.y - first.y) + 1.0);
  }
};

class Cells {
 public:
  /// Cells for points in [low, high], or in the period, at least `least_size` wide and larger by a hair: by
  /// so much that two points whose computed distance is at most `least_size` lie in the same or in adjacent
  /// cells, whatever was rounded. The table has at most 4 items + 64 buckets. A side of a periodic domain
  /// that would be one or two cells long is one cell: then no cell is its own neighbour.
  void fit(const Point& low, const Point& high, double least_size, std::size_t items, const Period* period);

  std::size_t buckets() const { return buckets_; }
  bool shared() const { return shared_; }
  bool periodic() const { return periodic_; }
  double width() const { return 1.0 / per_cell_.x(); }  ///< m, of a cell of the unbounded plane
  const Point& per_cell() const { return per_cell_; }   ///< 1/m, along each axis
  std::int64_t columns() const { return columns_; }
  std::int64_t rows() const { return rows_; }

  /// The cell of a point in [low, high].
  Cell cell(const Point& p) const {
    return {std::min(static_cast<std::int64_t>((p.x() - origin_.x()) * per_cell_.x()), columns_ - 1),
            std::min(static_cast<std::int64_t>((p.y() - origin_.y()) * per_cell_.y()), rows_ - 1)};
  }

  /// The bucket of a cell of the grid.
  std::size_t bucket(const Cell& cell) const {
    if (!shared_) return static_cast<std::size_t>(cell.y * stride_ + cell.x);
    return (hash(cell.y, cell.x >> stretch_bits_) & mask_) + (static_cast<std::uint64_t>(cell.x) & mask_);
  }

  /// The cells that hold every point of [low, high] with a computed distance of at most `radius` (m, may be
  /// infinite) to `p`, which may lie anywhere in the plane, but in a periodic domain inside it. False where
  /// there is none.
  bool range(const Point& p, double radius, Range& range) const;

  /// The same for a box.
  bool range(const Point& low, const Point& high, Range& range) const;

  /// Calls `f(run)` for every run of cells that makes up the range, wrapped round where the domain is
  /// periodic.
  template <class F>
  void for_each_run(const Range& range, F&& f) const {
    for (std::int64_t y = range.first.y; y <= range.last.y; ++y)
      for_each_run(wrap(y, rows_), range.first.x, range.last.x, f);
  }

  /// The same for cells first_x to last_x of row y; first_x >= -columns(), last_x < 2 columns(), none twice.
  template <class F>
  void for_each_run(std::int64_t y, std::int64_t first_x, std::int64_t last_x, F&& f) const {
    if (first_x < 0) {
      for_each_stretch(y, first_x + columns_, std::min<std::int64_t>(last_x, -1) + columns_, f);
      first_x = 0;
    }
    for_each_stretch(y, first_x, std::min(last_x, columns_ - 1), f);
    if (last_x >= columns_) for_each_stretch(y, std::max(first_x, columns_) - columns_, last_x - columns_, f);
  }

 private:
  static std::int64_t wrap(std::int64_t i, std::int64_t count) {
    return i < 0 ? i + count : i < count ? i : i - count;
  }

  /// Where a stretch of a row begins, after the 64-bit finaliser of MurmurHash3 (Appleby 2011).
  static std::uint64_t hash(std::int64_t y, std::int64_t stretch) {
    std::uint64_t h =
        static_cast<std::uint64_t>(y) * 0x9e3779b97f4a7c15ULL + static_cast<std::uint64_t>(stretch);
    h ^= h >> 33;
    h *= 0xff51afd7ed558ccdULL;
    h ^= h >> 33;
    h *= 0xc4ceb9fe1a85ec53ULL;
    return h ^ (h >> 33);
  }

  template <class F>
  void for_each_stretch(std::int64_t y, std::int64_t x, std::int64_t last_x, F& f) const {
    while (x <= last_x) {
      const std::int64_t end = shared_ ? std::min(last_x, x | static_cast<std::int64_t>(mask_)) : last_x;
      const std::size_t first = bucket({x, y});
      f(Run{{x, y}, end, first, first + static_cast<std::size_t>(end - x) + 1});
      x = end + 1;
    }
  }

  bool range(int axis, double low, double high, std::int64_t count, std::int64_t& first,
             std::int64_t& last) const;
  void choose_table(std::size_t items);

  Point origin_{0.0, 0.0}, extent_{0.0, 0.0};  // m
  Point per_cell_{1.0, 1.0};                   // 1/m
  std::int64_t columns_ = 1, rows_ = 1, stride_ = 1;
  std::size_t buckets_ = 1;
  std::uint64_t mask_ = 0;  // of a hashed table: how long a stretch is, less one
  int stretch_bits_ = 0;
  bool periodic_ = false, shared_ = false;
};

inline bool Cells::range(const Point& low, const Point& high, Range& range) const {
  assert(!periodic_);
  return this->range(0, low.x() - origin_.x(), high.x() - origin_.x(), columns_, range.first.x,
                     range.last.x) &&
         this->range(1, low.y() - origin_.y(), high.y() - origin_.y(), rows_, range.first.y, range.last.y);
}

inline bool Cells::range(const Point& p, double radius, Range& range) const {
  Point low, high;
  for (int axis = 0; axis < 2; ++axis) {
    const double at = p[axis] - origin_[axis];
    const double slack =
        8.0 * std::numeric_limits<double>::epsilon() * (std::abs(at) + radius + extent_[axis]);
    low[axis] = at - radius - slack;
    high[axis] = at + radius + slack;
  }
  return this->range(0, low.x(), high.x(), columns_, range.first.x, range.last.x) &&
         this->range(1, low.y(), high.y(), rows_, range.first.y, range.last.y);
}

/// The cells of [low, high], measured from the origin, along one axis.
inline bool Cells::range(int axis, double low, double high, std::int64_t count, std::int64_t& first,
                         std::int64_t& last) const {
  low *= per_cell_[axis];
  high *= per_cell_[axis];
  const double top = static_cast<double>(count - 1);
  if (periodic_ && high - low < top - 1.0) {
    first = static_cast<std::int64_t>(std::floor(low));
    last = static_cast<std::int64_t>(std::floor(high));
    return true;
  }
  first = low <= 0.0 || periodic_ ? 0 : static_cast<std::int64_t>(std::min(low, top));
  last = high >= top || periodic_ ? count - 1 : static_cast<std::int64_t>(std::max(high, 0.0));
  return periodic_ || (low < static_cast<double>(count) && high >= 0.0);
}

}  // namespace throng::broadphase
