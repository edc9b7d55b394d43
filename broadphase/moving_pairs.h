// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "broadphase/disc_pairs.h"
#include "broadphase/team.h"

/// Which discs may touch, step after step, where they move little between steps: a neighbour list with a
/// margin (Verlet 1967), kept until some disc has moved or grown by as much. The answers are those of
/// `DiscPairs`, to the last bit: each pair of the list is decided anew in double, and nothing outside it can
/// have come near.
namespace throng::broadphase {

class MovingPairs {
 public:
  explicit MovingPairs(Team& team) : team_(team) {}  ///< shares out the work

  /// As `DiscPairs::find`. Expects the same rows to be the same discs as in the last call; where their
  /// number, the period or `movable` differ, starts anew. O(n + pairs of the list) while the list holds: its
  /// margin is 15 % of the mean reach, so it gains where discs move by less than 2 % of it a step. Where a
  /// list has not held for four calls, goes without one for a while. Allocates only to grow.
  void find(std::span<const Point> centres, std::span<const double> reach, const Period* period,
            std::vector<Pair>& pairs, std::span<const std::uint8_t> movable = {});

  /// Pairs among which those of the last call's answer are, ascending; empty where it was found without a
  /// list.
  std::span<const Pair> list() const { return reach_.empty() ? std::span<const Pair>() : list_; }

  /// Whether the last call was answered from the list of an earlier one.
  bool reused() const { return reused_; }

 private:
  bool holds(std::span<const Point> centres, std::span<const double> reach, const Period* period) const;
  void renew(std::span<const Point> centres, std::span<const double> reach, const Period* period,
             std::span<const std::uint8_t> movable);
  void select(std::span<const Point> centres, std::span<const double> reach, const Period* period,
              std::vector<Pair>& pairs);

  Team& team_;
  DiscPairs search_;
  std::vector<Pair> list_;     // ascending: all that are near for the reaches below
  std::vector<Point> centre_;  // m, as the list was made
  std::vector<double> reach_;  // m, with the margin
  std::vector<std::uint8_t> movable_;
  Period period_;
  bool periodic_ = false, reused_ = false;
  std::vector<std::size_t> kept_;  // of each range of the list
  int age_ = 0;                    // calls that the list has answered
  int wait_ = 0;                   // calls to go without a list
};

}  // namespace throng::broadphase
