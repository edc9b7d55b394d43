// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "sim/crowd/barriers.h"
#include "sim/crowd/crowd.h"

namespace throng {

/// The places of a queue, counted from 1 at its head.
class QueueLine {
 public:
  explicit QueueLine(const Queue& queue);

  /// How many there are on the line.
  std::uint32_t places() const;

  /// m, where a place is; behind the last one all are the last. O(points).
  Vec place(std::uint32_t number) const;

  /// m, from `p` to the nearest point of the line. O(points).
  double distance(const Vec& p) const;

  /// Where to walk straight on from `p` to get to that place without leaving the line where it bends: the
  /// place itself where no barrier hides it, else the next bend on the way there. O(points).
  Vec towards(const Vec& p, std::uint32_t number, const Barriers& barriers) const;

 private:
  Vec at(double along) const;
  double nearest(const Vec& p) const;  // m, along the line

  std::vector<Vec> points_;
  std::vector<double> along_;  // m, from the head to each of them
  double spacing_;
};

}  // namespace throng
