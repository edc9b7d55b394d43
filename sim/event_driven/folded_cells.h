// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <span>
#include <vector>

#include "sim/colliders.h"
#include "sim/event_driven/huge_pages.h"
#include "sim/prefetch.h"
#include "sim/scene.h"

namespace throng {

/// A cell of the plane.
struct Cell {
  std::array<std::int64_t, 2> at{};  ///< column, row
};

/// Squares of the plane, each with the discs whose centres are in it, folded onto a table of columns and
/// rows: cells a whole table apart share their list. In a domain that repeats the table is one period;
/// elsewhere a list may hold discs from far away, which costs a look and nothing else.
class FoldedCells {
 public:
  static constexpr std::uint32_t kNobody = UINT32_MAX;
  static constexpr std::size_t kCrowded = SIZE_MAX, kMostAtOnce = 64;

  /// For n discs within `around`, or within the domain where it has borders; edges of `least` (m) or more.
  /// Expects that a domain that repeats measures three times that. O(n).
  FoldedCells(const Domain& domain, const Eigen::AlignedBox2d& around, double least, std::size_t n);

  Cell cell_of(const Vec& place) const;

  /// m, the coordinate at which column or row `index` begins.
  double border(int axis, std::int64_t index) const {
    return origin_[axis] + static_cast<double>(index) * edge_[axis];
  }
  double edge(int axis) const { return edge_[axis]; }  ///< m
  std::int64_t count(int axis) const { return count_[axis]; }

  /// Place in the table.
  std::size_t slot(const Cell& cell) const {
    return static_cast<std::size_t>(fold(1, cell.at[1]) * count_[0] + fold(0, cell.at[0]));
  }
  std::size_t slots() const { return first_.size(); }

  void add(std::uint32_t disc, std::size_t slot);
  void remove(std::uint32_t disc, std::size_t slot);

  /// Calls visit(slot, x, y) for the cells from `first` to `last` away from `cell`, at most one, where x and
  /// y say how many tables lie between: -1, 0 or 1.
  template <class Visit>
  void for_each_near(const Cell& cell, const std::array<int, 2>& first, const std::array<int, 2>& last,
                     Visit visit) const {
    const std::int64_t column = fold(0, cell.at[0]), row = fold(1, cell.at[1]);
    for (int dy = first[1]; dy <= last[1]; ++dy) {
      const int y = table(1, row + dy);
      for (int dx = first[0]; dx <= last[0]; ++dx) {
        const int x = table(0, column + dx);
        visit(static_cast<std::size_t>((row + dy - y * count_[1]) * count_[0] + column + dx - x * count_[0]),
              x, y);
      }
    }
  }

  /// Whether all cells one away from it are in its own table.
  bool inside(const Cell& cell) const {
    return cell.at[0] > 0 && cell.at[0] < count_[0] - 1 && cell.at[1] > 0 && cell.at[1] < count_[1] - 1;
  }

  /// Sends for the lists round a cell that is inside.
  void fetch(const Cell& cell) const {
    if (!inside(cell)) return;
    for (const std::int64_t row : {-1, 0, 1}) {
      const Slot* const middle = &first_[slot({{cell.at[0], cell.at[1] + row}})];
      prefetch(middle - 1), prefetch(middle + 1);
    }
  }

  /// Writes a cell's list to `list` from row `count` on, and returns how many are in there then. Grows it
  /// where there is no room.
  std::size_t copy(std::size_t slot, std::vector<std::uint32_t>& list, std::size_t count) const {
    if (count + kFirst > list.size()) list.resize(2 * count + kFirst);
    const Slot& first = first_[slot];
    std::copy(first.disc.begin(), first.disc.end(), list.begin() + static_cast<std::ptrdiff_t>(count));
    count += std::min<std::size_t>(first.count, kFirst);
    if (first.count <= kFirst) [[likely]]
      return count;
    for (std::uint32_t disc = more_[slot]; disc != kNobody; disc = next_[disc]) {
      if (count == list.size()) list.resize(2 * count);
      list[count++] = disc;
    }
    return count;
  }

  /// The same of all cells from `first` to `last` away from one that is inside, without branches that nobody
  /// can foresee. Expects room for kMostAtOnce in the list. Returns kCrowded where a cell holds so many that
  /// they must be copied one by one.
  std::size_t copy_near(const Cell& cell, const std::array<int, 2>& first, const std::array<int, 2>& last,
                        std::uint32_t* list) const {
    std::size_t count = 0;
    std::uint32_t all = 0;
    const auto take = [&](const Slot& slot) {
      std::memcpy(list + count, &slot, sizeof(Slot));
      count += slot.count & kFirst, all |= slot.count;  // of a crowded one so many as there is room for
    };
    const bool wide = first[0] != last[0];
    for (int dy = first[1]; dy <= last[1]; ++dy) {
      const Slot* const slot =
          &first_[static_cast<std::size_t>((cell.at[1] + dy) * count_[0] + cell.at[0] + first[0])];
      take(slot[0]);
      if (wide) take(slot[1]), take(slot[2]);
    }
    return all <= kFirst ? count : kCrowded;
  }

  /// Lists each obstacle in the cells from which a disc of `reach` (m) can touch it.
  void list(const Obstacles& obstacles, double reach);
  std::span<const std::uint32_t> obstacles(std::size_t slot) const;

 private:
  std::int64_t fold(int axis, std::int64_t index) const {
    if (index >= 0 && index < count_[axis]) [[likely]]
      return index;
    const std::int64_t rest = index % count_[axis];
    return rest < 0 ? rest + count_[axis] : rest;
  }
  int table(int axis, std::int64_t index) const { return index < 0 ? -1 : index < count_[axis] ? 0 : 1; }
  template <class Visit>
  void for_each_slot(const Eigen::AlignedBox2d& box, Visit visit) const;

  static constexpr std::size_t kFirst = 3;  // 2^k - 1

  struct Slot {
    std::array<std::uint32_t, kFirst> disc;
    std::uint32_t count;  // of all in the cell
  };

  Vec origin_;                                ///< m
  std::array<double, 2> edge_;                ///< m
  std::array<std::int64_t, 2> count_;         ///< columns and rows of the table
  std::vector<Slot, HugePages<Slot>> first_;  ///< of each slot its first discs
  std::vector<std::uint32_t> more_;           ///< of each slot the next one, where that is full
  std::vector<std::uint32_t> next_;           ///< of each disc who follows it there
  std::vector<std::uint32_t> begin_;     ///< of each slot in obstacle_, and the end; empty without obstacles
  std::vector<std::uint32_t> obstacle_;  ///< rows of the obstacles
};

}  // namespace throng
