// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "broadphase/cells.h"
#include "broadphase/point.h"

/// What of the things that stand still is near a box: bodies by their boxes, walls by their segments. Built
/// once, asked often. For things that move use `AllPairs`.
namespace throng::broadphase {

using Box = Eigen::AlignedBox2d;

/// A thing that stands still: a box, or a segment.
struct Extent {
  Point a, b;  ///< m: the box from its lower left to its upper right corner, or the segment from end to end
  bool is_segment = false;

  static Extent of(const Box& box) { return {box.min(), box.max(), false}; }
  static Extent of_segment(const Point& a, const Point& b) { return {a, b, true}; }
  Box box() const { return is_segment ? Box(Point(a.cwiseMin(b)), Point(a.cwiseMax(b))) : Box(a, b); }
};

/// Whether an extent and a box share a point, be it on the border. A segment that misses the box by no more
/// than rounding may count too; one that touches it always does.
bool touches(const Extent& extent, const Box& box);

class BoxIndex {
 public:
  /// Indexes a copy of `extents`. `query_size` (m) is how wide the boxes are that will mostly be asked about;
  /// it decides speed, never answers; 0 stands for "as wide as the extents". Expects fewer than 2^31 finite
  /// extents. O((n + entries) log(extent / query_size)). There are at most 16 n + 4096 entries of 4 bytes: a
  /// segment has one for each cell that it comes near, a box for each that it covers; a few that would need
  /// more than 1024 are kept aside.
  void build(std::span<const Extent> extents, double query_size = 0.0);

  /// Calls `f(row)` for every extent that touches `box`, ascending, each once. O(found + k), k = entries of
  /// the box's cells; O(n) for a box many times wider than a cell. Allocates nothing.
  template <class F>
  void for_each_near(const Box& box, F&& f) const;

  std::size_t size() const { return extents_.size(); }
  std::size_t entries() const { return rows_.size(); }
  double cell_size() const { return cell_size_; }  ///< m, as chosen

 private:
  static constexpr std::size_t kMostCells = 32;  // looked at one by one; for more all extents are looked at

  /// What is left to visit of some lists of rows, each ascending.
  struct Lists {
    std::array<const std::uint32_t*, kMostCells + 1> next, end;
    std::size_t count = 0;
    void add(const std::uint32_t* from, const std::uint32_t* to);
    bool pop(std::uint32_t& row);
  };

  double choose_cell_size(double query_size);
  void fill_cells(double entries);
  template <class F>
  void for_each_bucket(const Extent& extent, F&& f) const;

  std::vector<Extent> extents_;
  Box bounds_;  // m, of all extents
  double cell_size_ = 0.0;
  Cells cells_;
  std::vector<std::uint32_t> start_;  // per bucket, and one more: where its rows begin
  std::vector<std::uint32_t> rows_;   // by bucket, ascending in each
  std::vector<std::uint32_t> large_;  // those that are in no cell, ascending
};

inline void BoxIndex::Lists::add(const std::uint32_t* from, const std::uint32_t* to) {
  if (from == to) return;
  next[count] = from;
  end[count++] = to;
}

/// Takes the smallest row off all lists that begin with it. False where all are empty.
inline bool BoxIndex::Lists::pop(std::uint32_t& row) {
  if (count == 0) return false;
  row = *next[0];
  for (std::size_t i = 1; i < count; ++i) row = std::min(row, *next[i]);
  for (std::size_t i = 0; i < count;) {
    while (next[i] != end[i] && *next[i] == row) ++next[i];
    if (next[i] == end[i]) {
      --count;
      next[i] = next[count];
      end[i] = end[count];
    } else {
      ++i;
    }
  }
  return true;
}

template <class F>
void BoxIndex::for_each_near(const Box& box, F&& f) const {
  if (!bounds_.intersects(box)) return;
  Range range;
  Lists lists;
  if (cells_.range(box.min(), box.max(), range)) {
    if (range.count() > static_cast<double>(kMostCells)) {
      for (std::uint32_t row = 0; row < extents_.size(); ++row)
        if (touches(extents_[row], box)) f(row);
      return;
    }
    cells_.for_each_run(range, [&](const Run& run) {
      if (start_[run.bucket] == start_[run.end_bucket]) return;
      for (std::size_t bucket = run.bucket; bucket < run.end_bucket; ++bucket)
        lists.add(rows_.data() + start_[bucket], rows_.data() + start_[bucket + 1]);
    });
  }
  lists.add(large_.data(), large_.data() + large_.size());
  std::uint32_t row;
  while (lists.pop(row))
    if (touches(extents_[row], box)) f(row);
}

}  // namespace throng::broadphase
