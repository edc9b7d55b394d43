// SPDX-License-Identifier: MIT
#pragma once

#include <compare>
#include <cstdint>
#include <utility>
#include <vector>

#include "broadphase/cells.h"

/// The rows of a grid's cells, cut into strips, of which only those that hold points need memory.
///
/// Where all cells of the bounding box are in proportion to the points, a strip is a row of it. Else a strip
/// is kCells long, and a hash table knows those that are there: one far away costs as much as one nearby.
namespace throng::broadphase {

class Strips {
 public:
  static constexpr int kBits = 5;
  static constexpr std::int64_t kCells = 1 << kBits;
  static constexpr std::uint32_t kNone = 0xffffffff;

  /// The strips of one row of cells that a strip touches: the bucket of the nearest cell of each, in the
  /// middle that of the first; or kNone.
  struct Beside {
    std::uint32_t west = kNone, middle = kNone, east = kNone;
    bool is_beyond = false;  ///< the row lies beyond the grid: what there is of it are images across the seam
  };

  /// A strip: its first bucket, and how many cells it has.
  struct Strip {
    std::uint32_t first, cells;
    bool is_west_end, is_east_end;  ///< of its row: what there is beyond are images across the seam
  };

  /// Starts anew for cells that were fitted to points.
  void reset(const Cells& cells);

  /// The bucket of a cell; gives its strip a place if it has none.
  std::uint32_t bucket(const Cell& cell) {
    if (dense_) return static_cast<std::uint32_t>(cell.y * columns_ + cell.x);
    return add({cell.y, cell.x >> kBits}) << kBits | static_cast<std::uint32_t>(cell.x & (kCells - 1));
  }

  /// Brings strips that were asked for in any order into that of their rows, so that what is near in the
  /// plane is near in memory. O(s log s), s strips. Until the next reset(), `sorted` says where each bucket
  /// went.
  void sort();
  std::uint32_t sorted(std::uint32_t bucket) const {
    return place_[bucket >> kBits] << kBits | (bucket & static_cast<std::uint32_t>(kCells - 1));
  }

  bool dense() const { return dense_; }
  std::size_t size() const { return dense_ ? static_cast<std::size_t>(rows_) : keys_.size(); }
  std::size_t buckets() const {
    return dense_ ? static_cast<std::size_t>(rows_ * columns_) : keys_.size() * kCells;
  }
  Strip strip(std::size_t i) const;

  /// In the row of strip `i`, 0; in the one south of it, where y is larger, 1; or in that north of it, -1.
  Beside beside(std::size_t i, int southward) const;

  /// Calls `f(bucket, end_bucket, column, row)` for stretches of buckets that make up a range of cells,
  /// wrapped round where the domain is periodic: then `column` or `row`, before wrapping, says so.
  template <class F>
  void for_each_stretch(const Range& range, F&& f) const;

 private:
  struct Key {
    std::int64_t y, x;  ///< x in strips
    friend auto operator<=>(const Key&, const Key&) = default;
  };

  /// The first slot to look at. Golden ratio and another odd number: rows and columns go apart, and the high
  /// bits of the product depend on all of both.
  std::size_t slot_of(const Key& key) const {
    const auto y = static_cast<std::uint64_t>(key.y), x = static_cast<std::uint64_t>(key.x);
    return ((y * 0xd6e8feb86659fd93ULL ^ x) * 0x9e3779b97f4a7c15ULL) >> slot_shift_;
  }

  std::uint32_t add(const Key& key) {
    for (std::size_t slot = slot_of(key);; slot = (slot + 1) & (slots_.size() - 1)) {
      const std::uint32_t strip = slots_[slot];
      if (strip == kNone) return append(key, slot);
      if (keys_[strip] == key) return strip;
    }
  }
  std::uint32_t append(const Key& key, std::size_t slot);
  std::uint32_t find(const Key& key) const;
  std::uint32_t first_bucket(std::int64_t y, std::int64_t x) const;
  Key key(std::size_t strip) const;
  std::int64_t last_of_row() const { return dense_ ? 0 : (columns_ - 1) >> kBits; }
  std::uint32_t cells(std::int64_t x) const;
  void grow();

  bool dense_ = true, periodic_ = false;
  std::int64_t columns_ = 1, rows_ = 1;
  std::vector<Key> keys_;  // of the strips, in the order in which points asked, or sorted
  std::vector<std::pair<Key, std::uint32_t>> order_;  // while they are being sorted
  std::vector<std::uint32_t> place_;                  // where each went
  int slot_shift_ = 0;                                // from 64 bits to as many as number the slots
  std::vector<std::uint32_t> slots_;                  // open addressing: a strip, or kNone
};

template <class F>
void Strips::for_each_stretch(const Range& range, F&& f) const {
  const auto wrapped = [](std::int64_t i, std::int64_t count) {
    return i < 0 ? i + count : i < count ? i : i - count;
  };
  for (std::int64_t y = range.first.y; y <= range.last.y; ++y) {
    for (std::int64_t x = range.first.x; x <= range.last.x;) {
      const std::int64_t column = wrapped(x, columns_), row = wrapped(y, rows_);
      const std::int64_t strip_end = dense_ ? columns_ : std::min((column | (kCells - 1)) + 1, columns_);
      const std::int64_t cells = std::min(strip_end - column, range.last.x + 1 - x);
      const std::uint32_t strip = first_bucket(row, column >> kBits);
      if (strip != kNone) {
        const auto bucket = strip + static_cast<std::uint32_t>(dense_ ? column : column & (kCells - 1));
        f(bucket, bucket + static_cast<std::uint32_t>(cells), x, y);
      }
      x += cells;
    }
  }
}

}  // namespace throng::broadphase
