// SPDX-License-Identifier: MIT
#include "broadphase/all_pairs.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>

#include "broadphase/pair_kernel.h"

namespace throng::broadphase {

namespace {

constexpr std::size_t kOctaves = 40;  // powers of two that are told apart; what is smaller is taken together
constexpr std::size_t kLeastJob = 4096;  // items: enough work to pay for handing it over

constexpr std::size_t kSample = 2048;  // items from which to tell how crowded cells are
constexpr double kThin = 8.0;  // others in an item's cell: meeting them costs about as much as a second grid

/// The finaliser of SplitMix64 (Steele, Lea, Flood 2014).
std::uint64_t mixed(std::uint64_t z) {
  z = (z + 0x9e3779b97f4a7c15ULL) * 0xbf58476d1ce4e5b9ULL;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
  return z ^ (z >> 31);
}

/// How many powers of two a size lies below the largest: 0 for more than a half of it.
std::size_t octave(double size, double largest) {
  const int exponent = static_cast<int>(std::bit_cast<std::uint64_t>(largest / size) >> 52) - 1023;
  return static_cast<std::size_t>(
      std::clamp(exponent, 0, static_cast<int>(kOctaves) - 1));  // a size of 0 is infinitely far below
}

}  // namespace

void AllPairs::find(std::span<const Point> points, double reach, const Period* period, PairList& found) {
  assert(0.0 <= reach && (!period || reach <= 0.5 * period->size.minCoeff()));
  if (levels_.empty()) levels_.resize(1);
  const Items items{points, reach, {}, {}, period};
  levels_[0].grid.rebuild(items, {}, reach, team_);
  count_ = 1;
  gather(items, found);
}

void AllPairs::find_discs(std::span<const Point> centres, std::span<const double> reach, const Period* period,
                          PairList& found) {
  const Items discs{centres, 0.0, reach, {}, period};
  index(discs, [&](std::size_t row) { return 2.0 * reach[row]; });
  gather(discs, found);
}

void AllPairs::find_discs(std::span<const Point> centres, std::span<const double> reach, const Period* period,
                          HigherRows& found) {
  const Items discs{centres, 0.0, reach, {}, period};
  index(discs, [&](std::size_t row) { return 2.0 * reach[row]; });
  if (count_ == 1 && team_.threads() == 1) return gather_higher(levels_[0].grid, discs, found);
  gather(discs, met_);
  found.assign(met_, centres.size());
}

void AllPairs::find_boxes(std::span<const Eigen::AlignedBox2d> boxes, PairList& found) {
  const Items items{{}, 0.0, {}, boxes, nullptr};
  index(items, [&](std::size_t row) { return boxes[row].sizes().maxCoeff(); });
  gather(items, found);
}

template <class Size>
void AllPairs::index(const Items& items, const Size& size) {
  assert(items.boxes.empty() ? items.points.size() == items.reach.size() : !items.period);
  count_ = choose_levels(items, size);
  if (count_ == 1)
    levels_[0].grid.rebuild(items, {}, levels_[0].size, team_);
  else
    fill_levels(items, size);
}

/// Gives two powers of two a level; and all the rest too once it is thin: then looking among too large cells
/// costs less than looking in a second grid.
template <class Size>
std::size_t AllPairs::choose_levels(const Items& items, const Size& size) {
  const std::size_t n = items.size();
  double largest = 0.0, smallest = n == 0 ? 0.0 : size(0);
  for (std::size_t row = 0; row < n; ++row) {
    largest = std::max(largest, size(row));
    smallest = std::min(smallest, size(row));
  }
  assert(std::isfinite(largest) && smallest >= 0.0);
  if (levels_.empty()) levels_.resize(1);
  levels_[0].size = largest;
  if (2.0 * smallest >= largest) return 1;

  std::array<std::size_t, kOctaves> count{};
  for (std::size_t row = 0; row < n; ++row) ++count[octave(size(row), largest)];
  of_octave_.assign(kOctaves, 0);
  std::uint32_t level = 0;
  std::size_t first = 0;
  bool thin = crowd(items, size, largest, 0) <= kThin;
  for (std::size_t i = 1; i < kOctaves; ++i) {
    if (!thin && count[i] != 0 && i > first + 1) {
      ++level;
      first = i;
      thin = crowd(items, size, largest, i) <= kThin;
    }
    of_octave_[i] = level;
  }
  return level + 1;
}

/// With how many others an item from an octave on shares a cell that suits it, in the mean: by how many
/// pairs of a sample do. Drawn at random, since rows may be in an order that an even sample would follow.
template <class Size>
double AllPairs::crowd(const Items& items, const Size& size, double largest, std::size_t first) {
  const std::size_t n = items.size(), draws = std::min(kSample, n / 4);
  const double cell = std::ldexp(largest, -static_cast<int>(first));
  sample_.clear();
  for (std::size_t i = 0; i < draws; ++i) {
    const std::size_t row = mixed(i) % n;
    if (octave(size(row), largest) < first) continue;
    const Point at = items.place(row) / cell;
    sample_.push_back(mixed(std::bit_cast<std::uint64_t>(std::floor(at.x()) + 0.0) ^
                            mixed(std::bit_cast<std::uint64_t>(std::floor(at.y()) + 0.0))));
  }
  std::sort(sample_.begin(), sample_.end());
  double shared = 0.0;
  for (std::size_t i = 0, begin = 0; i < sample_.size(); ++i) {
    if (sample_[i] != sample_[begin]) begin = i;
    shared += static_cast<double>(i - begin);
  }
  const double drawn = static_cast<double>(draws);
  return draws < 2 ? static_cast<double>(n) : 2.0 * shared * static_cast<double>(n) / (drawn * drawn);
}

template <class Size>
void AllPairs::fill_levels(const Items& items, const Size& size) {
  if (levels_.size() < count_) levels_.resize(count_);
  const double largest = levels_[0].size;
  for (Level& level : levels_) {
    level.size = 0.0;
    level.rows.clear();
  }
  for (std::size_t row = 0; row < items.size(); ++row) {
    Level& level = levels_[of_octave_[octave(size(row), largest)]];
    level.size = std::max(level.size, size(row));
    level.rows.push_back(static_cast<std::uint32_t>(row));
  }
  for (std::size_t i = 0; i < count_; ++i)
    levels_[i].grid.rebuild(items, levels_[i].rows, levels_[i].size, team_);
}

void AllPairs::gather(const Items& items, PairList& found) {
  jobs_.clear();
  for (std::size_t fine = 0; fine < count_; ++fine)
    for (std::size_t coarse = 0; coarse <= fine; ++coarse) add_jobs(fine, coarse);
  const bool alone = team_.threads() == 1;
  found.reset(alone ? 1 : jobs_.size());
  team_.for_each(jobs_.size(), [&](std::size_t i) { run(jobs_[i], items, found.buffer(alone ? 0 : i)); });
}

/// Parts of about equal numbers of items; with one thread one.
void AllPairs::add_jobs(std::size_t fine, std::size_t coarse) {
  const FixedGrid& grid = levels_[fine].grid;
  const std::size_t n = grid.size();
  const std::size_t parts = team_.threads() == 1 ? 1 : std::min(8 * team_.threads(), n / kLeastJob + 1);
  for (std::size_t part = 0; part < parts; ++part) {
    const std::size_t first = n * part / parts, end = n * (part + 1) / parts;
    if (fine == coarse)
      jobs_.push_back({fine, coarse, part == 0 ? 0 : grid.strip_at(first),
                       part + 1 == parts ? grid.strips().size() : grid.strip_at(end)});
    else
      jobs_.push_back({fine, coarse, first, end});
  }
}

void AllPairs::run(const Job& job, const Items& items, PairBuffer& found) const {
  const FixedGrid& fine = levels_[job.fine].grid;
  if (job.fine == job.coarse)
    gather_pairs(fine, items, job.first, job.end, found);
  else
    gather_across(fine, levels_[job.coarse].grid, items, job.first, job.end, found);
}

}  // namespace throng::broadphase
