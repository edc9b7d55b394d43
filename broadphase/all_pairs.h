// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "broadphase/fixed_grid.h"
#include "broadphase/higher_rows.h"
#include "broadphase/items.h"
#include "broadphase/pairs.h"
#include "broadphase/team.h"

/// All pairs at once, of points within a reach, of discs, of boxes: each pair that is one by the definition
/// in double of `Items::near`, to the last bit, and each once. For a few questions about a few places use
/// `neighbours.h`.
///
/// Items of like size share a grid whose cells suit them, and each asks the grids of the larger ones, as in
/// the hierarchical hash grid (Mirtich 1996; Ericson 2004, "Real-Time Collision Detection", 7.2). Within a
/// grid candidates are told from pairs in fixed point, many at a time.
///
/// The order is that of the grids' cells: it depends on the items alone, for any number of threads and any
/// width of vectors. Who needs ascending rows uses `DiscPairs`.
///
/// Costs O(n (k + l)): k candidates, about three times the pairs, l levels, at most one for every factor of
/// four between the sizes; all that aren't crowded in a level's cells share it. Memory in proportion to n and
/// to the pairs, wherever the items lie; allocates only to grow. Slower, by up to two times: clouds so thin
/// or so scattered that a dense array of cells would not be in proportion to them; by up to ten: periods of
/// fewer than five cells, and reaches below 1e-11 of the extent, where everything is decided in double.
namespace throng::broadphase {

class AllPairs {
 public:
  explicit AllPairs(int threads = 1) : team_(threads) {}

  /// Replaces `found` by all rows a < b of points at most `reach` (m, >= 0) apart; with a period nearest
  /// images, and reach <= half of it.
  void find(std::span<const Point> points, double reach, const Period* period, PairList& found);

  /// Replaces `found` by all rows a < b with |c_a - c_b| <= reach[a] + reach[b] (m, >= 0); with a period
  /// 4 max(reach) <= its shorter side.
  void find_discs(std::span<const Point> centres, std::span<const double> reach, const Period* period,
                  PairList& found);

  /// The same by rows, fewer than 2^32 pairs. Where sizes need one level and there is one thread, each disc
  /// looks all round and keeps the higher rows, for about a third more; else pairs are found in any order and
  /// sorted by their lower row, for about as much again.
  void find_discs(std::span<const Point> centres, std::span<const double> reach, const Period* period,
                  HigherRows& found);

  /// Replaces `found` by all rows a < b of boxes that share a point, be it on the border. A box costs as a
  /// square of its longer side.
  void find_boxes(std::span<const Eigen::AlignedBox2d> boxes, PairList& found);

 private:
  /// Items of like size, in a grid of their own.
  struct Level {
    double size = 0.0;  // m, how wide a pair may be
    std::vector<std::uint32_t> rows;
    FixedGrid grid;
  };
  /// A part of the search: a level's own pairs, or those with a coarser one.
  struct Job {
    std::size_t fine, coarse, first, end;
  };

  template <class Size>
  void index(const Items& items, const Size& size);
  template <class Size>
  std::size_t choose_levels(const Items& items, const Size& size);
  template <class Size>
  double crowd(const Items& items, const Size& size, double largest, std::size_t first);
  template <class Size>
  void fill_levels(const Items& items, const Size& size);
  void gather(const Items& items, PairList& found);
  void add_jobs(std::size_t fine, std::size_t coarse);
  void run(const Job& job, const Items& items, PairBuffer& found) const;

  Team team_;
  std::vector<Level> levels_;  // from coarse to fine; the first count_ are in use
  std::size_t count_ = 0;
  std::vector<std::uint32_t> of_octave_;  // per power of two below the largest size: its level
  std::vector<std::uint64_t> sample_;     // cells of some items
  std::vector<Job> jobs_;
  PairList met_;  // on their way to HigherRows
};

}  // namespace throng::broadphase
