// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
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

  /// O(log n). The first where there is none.
  std::uint32_t row() const {
    const double least = time();
    std::size_t place = 0;
    for (std::size_t level = levels_.size(); level-- > 0;)
      place = kWidth * place + levels_[level][place].first(least);
    return static_cast<std::uint32_t>(place);
  }

 private:
  static constexpr std::size_t kWidth = 8;

  /// The times of eight rows, or the least ones of eight nodes.
  struct alignas(64) Node {
    double time[kWidth] = {kNever, kNever, kNever, kNever, kNever, kNever, kNever, kNever};  // s

    double least() const {
      const auto of_two = [this](std::size_t i) { return std::min(time[i], time[i + 1]); };
      return std::min(std::min(of_two(0), of_two(2)), std::min(of_two(4), of_two(6)));
    }
    std::size_t first(double wanted) const {
      std::size_t found = 0;
      for (std::size_t i = kWidth; i-- > 0;) found = time[i] == wanted ? i : found;
      return found;
    }
  };

  std::vector<std::vector<Node, HugePages<Node>>> levels_;  // rows first, the root last
};

}  // namespace throng
