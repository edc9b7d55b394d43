// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "sim/event_driven/huge_pages.h"
#include "sim/prefetch.h"

namespace throng {

/// Which row is due first? A calendar (Brown, Comm. ACM 31, 1220, 1988) of an epoch: its days stand in pages,
/// of which the open one is sorted into days, and what is due on days that have begun is in order. A row that
/// gets another time leaves an entry behind, which is passed over. Of equal times the lowest row comes first.
class Soonest {
 public:
  static constexpr double kNever = std::numeric_limits<double>::infinity();

  explicit Soonest(std::size_t rows);

  /// O(1), mostly: O(k) where k are due on a day, which two or so are but where times are very uneven.
  void set(std::uint32_t row, double time) {
    due_[row] = time;
    const double day = day_of(time);
    if (day < days_of_epoch_) put({time, row}, day > 0.0 ? static_cast<std::size_t>(day) : 0);
  }

  /// s, the least of all. O(1), and after about as many events as there are rows O(rows).
  double time() {
    while (first_ < soon_.size() && is_left(soon_[first_])) ++first_;
    if (soon_.size() - first_ < kInSight) look_ahead();
    return soon_.empty() ? kNever : soon_[first_].time;
  }

  /// Whose that is. Expects that time() was asked after the last set(), and isn't kNever.
  std::uint32_t row() const { return soon_[first_].row; }

  /// Whose the entry is that stands `entries` behind: for less than kInSight most likely who will be due, or
  /// who was to be and got another time. Expects as row().
  std::uint32_t row_after(std::size_t entries) const {
    return soon_[std::min(first_ + entries, soon_.size() - 1)].row;
  }

  /// How many entries stood before row()'s, since the beginning.
  std::size_t passed() const { return erased_ + first_; }

  /// Sends for what set() needs of the row.
  void fetch(std::uint32_t row) const { prefetch(&due_[row]); }

 private:
  static constexpr std::size_t kDays = 1024;   // of a page
  static constexpr std::size_t kInSight = 12;  // events that are in order, at least, while there are as many

  struct Entry {
    double time;  // s
    std::uint32_t row;

    bool operator<(const Entry& other) const {
      return time < other.time || (time == other.time && row < other.row);
    }
  };

  double day_of(double time) const { return (time - begin_) * days_per_second_; }
  bool is_left(const Entry& entry) const { return due_[entry.row] != entry.time; }

  void put(const Entry& entry, std::size_t day) {
    if (day < begun_)
      insert(entry);
    else if (day / kDays < (begun_ + kDays - 1) / kDays)
      days_[day % kDays].push_back(entry);
    else
      pages_[day / kDays].push_back(entry);
  }
  void insert(const Entry& entry);
  void look_ahead();
  void begin_day();
  void open_page();
  bool begin_epoch();
  void choose_epoch(double least);

  std::vector<double, HugePages<double>> due_;    // s, of each row
  double begin_ = 0.0, days_per_second_ = 0.0;    // s, 1/s: of the epoch
  double days_of_epoch_ = 0.0;                    // what is due later waits for another one
  std::size_t begun_ = 0;                         // days
  std::vector<std::vector<Entry>> pages_, days_;  // those that are due on days to come; of the open page
  std::vector<Entry> soon_;                       // on days that have begun; ascending from first_ on
  std::size_t first_ = 0, erased_ = 0;
  std::vector<double> sample_;  // s
};

}  // namespace throng
