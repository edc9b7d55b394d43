// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <vector>

#include "sim/crowd/crowd.h"

namespace throng {

/// The places of a queue, counted from 1 at its head.
class QueueLine {
 public:
  explicit QueueLine(const Queue& queue);

  /// How many there are on the line. Expects no more than kMostPlaces.
  std::uint32_t places() const;

  /// m, where a place is; behind the last one all are the last. O(points).
  Vec place(std::uint32_t number) const;

  /// m, the places on the line, in their order. O(points + places).
  std::vector<Vec> all_places() const;

  /// m, from `p` to the nearest point of the line. O(points).
  double distance(const Vec& p) const;

  /// m, the next bend on the way to that place along the line from its point nearest to `p`; nothing where
  /// the line leads there straight on. O(points).
  std::optional<Vec> bend(const Vec& p, std::uint32_t number) const;

  static constexpr double kMostPlaces = 1e6;

 private:
  Vec at(double along) const;
  Vec on(std::size_t i, double along) const;  // of the piece that ends at the i-th point
  double nearest(const Vec& p) const;         // m, along the line

  std::vector<Vec> points_;
  std::vector<double> along_;  // m, from the head to each of them
  double spacing_;
};

}  // namespace throng
