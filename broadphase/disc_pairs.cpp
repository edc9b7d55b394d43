// SPDX-License-Identifier: MIT
#include "broadphase/disc_pairs.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cmath>

namespace throng::broadphase {

namespace {

constexpr int kOctaves = 40;  // powers of two that are told apart; what is smaller is taken together

/// How many powers of two a reach lies below the largest: 0 for more than a half of it.
std::size_t octave(double reach, double largest) {
  const int exponent = static_cast<int>(std::bit_cast<std::uint64_t>(largest / reach) >> 52) - 1023;
  return static_cast<std::size_t>(
      std::clamp(exponent, 0, kOctaves - 1));  // a reach of 0 is infinitely far below
}

void drop_unmovable(std::span<const std::uint8_t> movable, PairBuffer& found) {
  Pair* out = found.pairs().data();
  for (const Pair& pair : found.pairs()) {
    *out = pair;
    out += (movable[pair.a] | movable[pair.b]) != 0;
  }
  found.keep(out);
}

}  // namespace

void DiscPairs::find(std::span<const Point> centres, std::span<const double> reach, const Period* period,
                     std::vector<Pair>& pairs, std::span<const std::uint8_t> movable) {
  assert(centres.size() == reach.size() && (movable.empty() || movable.size() == reach.size()));
  found_.clear();
  count_ = choose_levels(reach);
  if (count_ == 1) {
    grid_.rebuild(centres, 2.0 * levels_[0].reach, period);
    grid_.gather_pairs(reach, found_);
  } else {
    fill_levels(centres, reach, period);
    for (std::size_t fine = 0; fine < count_; ++fine) {
      gather_within(levels_[fine]);
      for (std::size_t coarse = 0; coarse < fine; ++coarse) gather_between(levels_[fine], levels_[coarse]);
    }
  }
  if (!movable.empty()) drop_unmovable(movable, found_);
  sorter_.sort(found_.pairs(), centres.size(), pairs);
}

/// Gives each power of two a level. Two neighbouring ones share it where the smaller discs are the fewer:
/// then looking among too large cells costs less than looking in a second grid.
std::size_t DiscPairs::choose_levels(std::span<const double> reach) {
  double largest = 0.0, smallest = reach.empty() ? 0.0 : reach[0];
  for (const double r : reach) {
    largest = std::max(largest, r);
    smallest = std::min(smallest, r);
  }
  assert(std::isfinite(largest) && smallest >= 0.0);
  if (levels_.empty()) levels_.resize(1);
  levels_[0].reach = largest;
  if (2.0 * smallest >= largest) return 1;

  std::array<std::size_t, kOctaves> count{};
  for (const double r : reach) ++count[octave(r, largest)];
  of_octave_.assign(kOctaves, 0);
  std::uint32_t level = 0;
  for (std::size_t i = 1, first = 0; i < kOctaves; ++i) {
    const bool joins = count[i] == 0 || (i == first + 1 && count[i] <= count[first]);
    if (!joins) {
      ++level;
      first = i;
    }
    of_octave_[i] = level;
  }
  return level + 1;
}

void DiscPairs::fill_levels(std::span<const Point> centres, std::span<const double> reach,
                            const Period* period) {
  if (levels_.size() < count_) levels_.resize(count_);
  const double largest = levels_[0].reach;
  for (Level& level : levels_) {
    level.reach = 0.0;
    level.rows.clear();
    level.centres.clear();
    level.reaches.clear();
  }
  for (std::size_t row = 0; row < reach.size(); ++row) {
    Level& level = levels_[of_octave_[octave(reach[row], largest)]];
    level.reach = std::max(level.reach, reach[row]);
    level.rows.push_back(static_cast<std::uint32_t>(row));
    level.centres.push_back(centres[row]);
    level.reaches.push_back(reach[row]);
  }
  for (std::size_t i = 0; i < count_; ++i)
    levels_[i].grid.rebuild(levels_[i].centres, 2.0 * levels_[i].reach, period);
}

void DiscPairs::gather_within(Level& level) {
  local_.clear();
  level.grid.gather_pairs(level.reaches, local_);
  for (const Pair& pair : local_.pairs()) found_.add(level.rows[pair.a], level.rows[pair.b]);
}

void DiscPairs::gather_between(const Level& fine, const Level& coarse) {
  const auto places = fine.grid.sorted_rows();
  for (std::size_t i = 0; i < places.size(); ++i) {
    const std::uint32_t row = fine.rows[places[i]];
    const double reach = fine.reaches[places[i]];
    coarse.grid.for_each_near(fine.grid.sorted_points()[i], reach + coarse.reach,
                              [&](std::uint32_t other, double squared) {
                                const double most = reach + coarse.reaches[other];
                                if (squared <= most * most) found_.add(row, coarse.rows[other]);
                              });
  }
}

}  // namespace throng::broadphase
