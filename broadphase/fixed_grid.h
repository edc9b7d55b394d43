// SPDX-License-Identifier: MIT
#pragma once

#include <bit>
#include <cstdint>
#include <span>
#include <vector>

#include "broadphase/cells.h"
#include "broadphase/items.h"
#include "broadphase/strips.h"
#include "broadphase/team.h"

/// Points in the order of their cells, in fixed point, 8 bytes each: what a search for all pairs walks over.
///
/// A cell is at most kUnits long, and x and y are kept modulo 2^16 of these units. Points of cells that touch
/// are less than 2^15 units apart along either axis, so differences of 16 bits are right without a look at
/// the cell, and dx^2 + dy^2 fits into 31 bits: one subtraction and one multiply-and-add for as many points
/// as a vector has lanes of 32 bits. What fixed point can't tell is decided in double, by `Items::near`.
namespace throng::broadphase {

constexpr double kUnits = 16000.0;  // 2 (2 kUnits)^2 < 2^31

/// How far a squared distance, in units, tells whether two are near: below `sure` they are, from `far` on
/// they are not.
struct Limits {
  std::int32_t sure, far;
};

class FixedGrid {
 public:
  /// Indexes the items, or those of `rows` alone where it isn't empty, in cells as of `Cells::fit`.
  /// `cell_size` (m) is at least as wide as any pair: reach, twice the largest disc's, the largest box's
  /// side. O(n); allocates only to grow.
  void rebuild(const Items& items, std::span<const std::uint32_t> rows, double cell_size, Team& team);

  const Cells& cells() const { return cells_; }
  const Strips& strips() const { return strips_; }
  std::size_t size() const { return size_; }
  double cell_size() const { return cell_size_; }  ///< m, as asked for
  double crowd() const { return crowd_; }          ///< how many items an item's cell holds, in the mean

  /// The first strip of which all items stand at `place` or behind it.
  std::size_t strip_at(std::size_t place) const;

  /// Per bucket, and one more: the first place of its items.
  const std::uint32_t* start() const { return start_.data(); }

  /// By bucket, then row, with kPadding more that may be read.
  const std::uint32_t* at() const { return at_.data(); }        ///< units: x, and y << 16
  const std::uint32_t* sizes() const { return sizes_.data(); }  ///< units: reach, or width and height << 16
  const std::uint32_t* rows() const { return rows_.data(); }

  /// A place as at().
  std::uint32_t fixed(const Point& p) const {
    return low_16_bits((p.x() - origin_.x()) * per_metre_) | low_16_bits((p.y() - origin_.y()) * per_metre_)
                                                                 << 16;
  }
  std::uint32_t fixed_size(const Items& items, std::size_t row) const;

  /// What distance in units means where points are near that are `reach` (m) apart.
  Limits limits(double reach) const;
  std::int32_t slack() const { return slack_; }     ///< units; negative where they tell nothing
  std::uint32_t wrap_x() const { return wrap_x_; }  ///< the period, as at()
  std::uint32_t wrap_y() const { return wrap_y_; }

  static constexpr std::size_t kPadding = 16;

 private:
  /// The integer nearest to `value`, modulo 2^16, for |value| < 2^51: the low bits of the sum's mantissa.
  static std::uint32_t low_16_bits(double value) {
    return static_cast<std::uint32_t>(std::bit_cast<std::uint64_t>(value + 0x1.8p52)) & 0xffff;
  }
  template <class Place>
  void build(const Items& items, std::span<const std::uint32_t> rows, Team& team, const Place& place);
  template <class Place>
  Eigen::AlignedBox2d bounds(Team& team, const Place& place) const;
  template <class Place>
  void enlarge_cells(const Point& low, const Point& high, const Place& place);
  void choose_units(const Point& extent, const Period* period);
  template <class Place>
  void choose_buckets(Team& team, const Place& place);
  void count();
  void scatter(const Items& items, std::span<const std::uint32_t> rows, std::size_t part);
  std::size_t begin_of(std::size_t part) const { return size_ * part / parts_; }

  static constexpr std::size_t kMostParts = 64;

  Cells cells_;
  Strips strips_;
  std::size_t size_ = 0;
  std::size_t parts_ = 1;  // of the items, in their order: one a thread
  double cell_size_ = 0.0, crowd_ = 0.0;
  Point origin_{0.0, 0.0};                 // m
  double per_metre_ = 1.0;                 // units
  std::uint32_t wrap_x_ = 0, wrap_y_ = 0;  // units
  double error_ = 0.0;                     // units, at most, of a distance
  std::int32_t slack_ = 0;                 // more than the error of a distance less two sizes
  std::vector<std::uint32_t> start_;
  std::vector<std::uint32_t> bucket_, unsorted_;  // per item: where it belongs, and at()
  std::vector<std::vector<std::uint32_t>> next_;  // per part and bucket: how many, then where the next goes
  std::vector<std::uint32_t> at_, sizes_, rows_;
};

}  // namespace throng::broadphase
