// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "sim/event_driven/huge_pages.h"

namespace throng {

/// Which row is due first? A tree of the least times (a tournament: Knuth, TAOCP 3, 5.4.1) with eight
/// children a node, as many as a cache line holds. Of equal times the lowest row.
class Soonest {
 public:
  static constexpr double kNever = std::numeric_limits<double>::infinity();

  explicit Soonest(std::size_t rows) {
    do {
      const std::size_t nodes = (rows + kWidth - 1) / kWidth;
      levels_.emplace_back(std::max<std::size_t>(nodes, 1));
      rows = nodes;
    } while (rows > 1);
  }

  /// O(log n) at most; ends where a level's least time stays: for far times after two levels or so.
  void set(std::uint32_t row, double time) {
    std::size_t place = row;
    for (auto& level : levels_) {
      Node& node = level[place / kWidth];
      const double before = node.least();
      node.time[place % kWidth] = time;
      time = node.least();
      if (time == before) return;
      place /= kWidth;
    }
  }

  double time() const { return levels_.back()[0].least(); }

  struct Two {
    std::uint32_t row;    ///< of the least time; the first where there is none
    std::uint32_t after;  ///< of the least but one; any where there is none
  };

  /// Who is due first, and who after him. O(log n).
  Two rows() const {
    const double least = time();
    double later = kNever;
    std::size_t place = 0, after = 0, below = 0;
    for (std::size_t level = levels_.size(); level-- > 0;) {
      const Node& node = levels_[level][place];
      const unsigned child = node.first(least);
      const double second = node.second();
      const bool sooner = second < later;
      place *= kWidth;
      later = sooner ? second : later;
      after = sooner ? place + node.first(second, 1u << child) : after;
      below = sooner ? level : below;
      place += child;
    }
    while (below-- > 0) after = kWidth * after + levels_[below][after].first(later);
    return {static_cast<std::uint32_t>(place), static_cast<std::uint32_t>(after)};
  }

  /// Sends for what set() needs of the row.
  void fetch(std::uint32_t row) const { __builtin_prefetch(&levels_[0][row / kWidth], 1); }

 private:
  static constexpr std::size_t kWidth = 8;

  /// The times of eight rows, or the least ones of eight nodes.
  struct alignas(64) Node {
    double time[kWidth] = {kNever, kNever, kNever, kNever, kNever, kNever, kNever, kNever};  // s

    double least() const {
      const auto of_two = [this](std::size_t i) { return std::min(time[i], time[i + 1]); };
      return std::min(std::min(of_two(0), of_two(2)), std::min(of_two(4), of_two(6)));
    }
    /// The least but one.
    double second() const {
      double low = std::min(time[0], time[1]), high = std::max(time[0], time[1]);
      for (std::size_t i = 2; i < kWidth; ++i) {
        high = std::min(high, std::max(low, time[i]));
        low = std::min(low, time[i]);
      }
      return high;
    }
    /// The first that is due by `most`, and none of `others`, bits.
    unsigned first(double most, unsigned others = 0) const {
      unsigned soon = 0;
      for (std::size_t i = 0; i < kWidth; ++i) soon |= unsigned{time[i] <= most} << i;
      return static_cast<unsigned>(std::countr_zero(soon & ~others));
    }
  };

  std::vector<std::vector<Node, HugePages<Node>>> levels_;  // rows first, the root last
};

}  // namespace throng
