// SPDX-License-Identifier: MIT
#include "broadphase/fixed_grid.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>

namespace throng::broadphase {

namespace {
constexpr std::size_t kLeastPart = 16384;  // items: enough work for a thread
constexpr double kSparse = 1e6;            // cells a point: beyond, some points are far from the others
}  // namespace

void FixedGrid::rebuild(const Items& items, std::span<const std::uint32_t> rows, double cell_size,
                        Team& team) {
  cell_size_ = cell_size;
  size_ = rows.empty() ? items.size() : rows.size();
  assert(size_ < std::size_t{1} << 31);
  if (!rows.empty())
    build(items, rows, team, [&](std::size_t i) -> const Point& { return items.place(rows[i]); });
  else if (!items.boxes.empty())
    build(items, rows, team, [&](std::size_t i) -> const Point& { return items.boxes[i].min(); });
  else
    build(items, rows, team, [&](std::size_t i) -> const Point& { return items.points[i]; });
}

std::uint32_t FixedGrid::fixed_size(const Items& items, std::size_t row) const {
  if (items.reach.empty() && items.boxes.empty()) return 0;
  if (items.boxes.empty()) return low_16_bits(items.reach[row] * per_metre_);
  const Point size = items.boxes[row].sizes() * per_metre_;
  return low_16_bits(size.x()) | low_16_bits(size.y()) << 16;
}

template <class Place>
void FixedGrid::build(const Items& items, std::span<const std::uint32_t> rows, Team& team,
                      const Place& place) {
  const Period* period = items.period;
  parts_ = std::clamp<std::size_t>(size_ / kLeastPart, 1, std::min(team.threads(), kMostParts));
  const Eigen::AlignedBox2d bounds = this->bounds(team, place);
  assert(bounds.min().allFinite() && bounds.max().allFinite());
  assert(!period || size_ == 0 ||
         Eigen::AlignedBox2d(period->origin, period->origin + period->size).contains(bounds));
  cells_.fit(bounds.min(), bounds.max(), cell_size_, size_, period);
  if (cells_.shared() && !period) enlarge_cells(bounds.min(), bounds.max(), place);
  strips_.reset(cells_);
  origin_ = period ? period->origin : bounds.min();
  choose_units(period ? period->size : Point(bounds.sizes()), period);
  choose_buckets(team, place);
  count();
  team.for_each(parts_, [&](std::size_t part) { scatter(items, rows, part); });
}

template <class Place>
Eigen::AlignedBox2d FixedGrid::bounds(Team& team, const Place& place) const {
  if (size_ == 0) return {Point(0.0, 0.0), Point(0.0, 0.0)};
  std::array<Eigen::AlignedBox2d, kMostParts> part_bounds;
  team.for_each(parts_, [&](std::size_t part) {
    Point low = place(begin_of(part)), high = low;
    for (std::size_t i = begin_of(part); i < begin_of(part + 1); ++i) {
      low = low.cwiseMin(place(i));
      high = high.cwiseMax(place(i));
    }
    part_bounds[part] = {low, high};
  });
  for (std::size_t part = 1; part < parts_; ++part) part_bounds[0].extend(part_bounds[part]);
  return part_bounds[0];
}

/// Where points are so few that their cells have no place in an array, tries larger cells, about one a point.
/// They will do if the points are spread over them; if they are crowded in some, the small ones, hashed, are
/// better.
template <class Place>
void FixedGrid::enlarge_cells(const Point& low, const Point& high, const Place& place) {
  const double n = static_cast<double>(size_);
  if (static_cast<double>(cells_.columns()) * static_cast<double>(cells_.rows()) > kSparse * n) return;
  const Point extent = high - low;
  Cells larger;
  larger.fit(low, high, std::max({cell_size_, std::sqrt(extent.prod() / n), extent.maxCoeff() / n}), size_,
             nullptr);
  if (larger.shared()) return;
  start_.assign(static_cast<std::size_t>(larger.columns() * larger.rows()), 0);
  double meetings = 0.0;
  for (std::size_t i = 0; i < size_; ++i) {
    const Cell cell = larger.cell(place(i));
    meetings += start_[static_cast<std::size_t>(cell.y * larger.columns() + cell.x)]++;
  }
  if (meetings <= 2.0 * n) cells_ = larger;
}

/// A coordinate in units is off by half a unit and by two roundings of the offset from the origin, an image's
/// by as much again, and what is computed in double by another rounding of each: along an axis two points are
/// apart by what their units say within one unit, with a period one and a half, and less than 5 epsilon of
/// the extent. Below one unit of rounding the extent is less than 2^51 units, as `fixed` expects. Where a
/// period is so few cells long that a search may meet all of them, fixed point can't tell which image is the
/// nearest.
void FixedGrid::choose_units(const Point& extent, const Period* period) {
  constexpr double kDiagonal = 1.41422;  // above the root of 2
  const double cell = 1.0 / cells_.per_cell().minCoeff();
  per_metre_ = kUnits / cell;
  wrap_x_ = period ? low_16_bits(period->size.x() * per_metre_) : 0;
  wrap_y_ = period ? low_16_bits(period->size.y() * per_metre_) << 16 : 0;
  const double rounding =
      5.0 * std::numeric_limits<double>::epsilon() * per_metre_ * (extent.maxCoeff() + 2.0 * cell);
  const bool narrow = period && std::min(cells_.columns(), cells_.rows()) < 5;
  error_ = kDiagonal * ((period ? 1.5 : 1.0) + rounding);
  const double error_of_sizes = 1.0 + rounding;  // two, each off by half a unit
  slack_ = narrow || !(rounding < 1.0) ? -1 : static_cast<std::int32_t>(error_ + error_of_sizes) + 1;
}

/// A counting sort by bucket, stable: within a bucket rows ascend, for any number of parts. First where each
/// item belongs; new strips are given their place in one thread.
template <class Place>
void FixedGrid::choose_buckets(Team& team, const Place& place) {
  bucket_.resize(size_);
  unsorted_.resize(size_);
  const auto choose = [&](std::size_t first, std::size_t end) {
    for (std::size_t i = first; i < end; ++i) {
      const Point& p = place(i);
      bucket_[i] = strips_.bucket(cells_.cell(p));
      unsorted_[i] = fixed(p);
    }
  };
  const bool dense = strips_.dense();
  if (!dense) choose(0, size_);
  const bool sorted = !dense && 4 * strips_.size() <= size_;  // among fewer nothing would be gained
  if (sorted) strips_.sort();
  if (next_.size() < parts_) next_.resize(parts_);
  team.for_each(parts_, [&](std::size_t part) {
    if (dense) choose(begin_of(part), begin_of(part + 1));
    next_[part].assign(strips_.buckets(), 0);
    for (std::size_t i = begin_of(part); i < begin_of(part + 1); ++i) {
      if (sorted) bucket_[i] = strips_.sorted(bucket_[i]);
      ++next_[part][bucket_[i]];
    }
  });
}

/// From how many each part has in each bucket to where its first goes.
void FixedGrid::count() {
  start_.resize(strips_.buckets() + 1);
  std::uint32_t sum = 0;
  double squares = 0.0;
  for (std::size_t bucket = 0; bucket + 1 < start_.size(); ++bucket) {
    start_[bucket] = sum;
    for (std::size_t part = 0; part < parts_; ++part) {
      const std::uint32_t own = next_[part][bucket];
      next_[part][bucket] = sum;
      sum += own;
    }
    const double own = sum - start_[bucket];
    squares += own * own;
  }
  start_.back() = sum;
  crowd_ = size_ == 0 ? 0.0 : squares / static_cast<double>(size_);
  at_.resize(size_ + kPadding);
  rows_.resize(size_ + kPadding);
  sizes_.resize(size_ + kPadding);
}

void FixedGrid::scatter(const Items& items, std::span<const std::uint32_t> rows, std::size_t part) {
  const bool sized = !items.reach.empty() || !items.boxes.empty();
  std::vector<std::uint32_t>& next = next_[part];
  for (std::size_t i = begin_of(part); i < begin_of(part + 1); ++i) {
    const std::uint32_t to = next[bucket_[i]]++;
    const auto row = rows.empty() ? static_cast<std::uint32_t>(i) : rows[i];
    at_[to] = unsorted_[i];
    rows_[to] = row;
    if (sized) sizes_[to] = fixed_size(items, row);
  }
}

std::size_t FixedGrid::strip_at(std::size_t place) const {
  const std::size_t length = strips_.buckets() / std::max<std::size_t>(strips_.size(), 1);
  std::size_t first = 0, end = strips_.size();
  while (first < end) {
    const std::size_t middle = (first + end) / 2;
    if (start_[middle * length] < place)
      first = middle + 1;
    else
      end = middle;
  }
  return first;
}

Limits FixedGrid::limits(double reach) const {
  constexpr std::int32_t least = std::numeric_limits<std::int32_t>::min();
  constexpr std::int32_t most = std::numeric_limits<std::int32_t>::max();
  if (slack_ < 0) return {least, most};
  const double units = reach * per_metre_, inner = std::max(units - error_, 0.0), outer = units + error_;
  return {static_cast<std::int32_t>(inner * inner), static_cast<std::int32_t>(outer * outer) + 1};
}

}  // namespace throng::broadphase
