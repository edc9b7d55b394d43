// SPDX-License-Identifier: MIT
#include "sim/event_driven/soonest.h"

#include <algorithm>

namespace throng {

namespace {

constexpr std::size_t kSample = 1000;  // rows, at least, that say how long an epoch is to be
constexpr double kOfEpoch = 0.75;      // of the rows are due in it
constexpr double kOfDay = 2.0;         // rows are due on a day
constexpr std::size_t kAhead = 12;     // entries before it is needed, what a row says is sent for

}  // namespace

Soonest::Soonest(std::size_t rows) : due_(rows, kNever), days_(kDays) {}

/// Into the room of those that were due, if any.
void Soonest::insert(const Entry& entry) {
  const auto first = soon_.begin() + static_cast<std::ptrdiff_t>(first_);
  const auto place = std::upper_bound(first, soon_.end(), entry);
  if (first_ == 0) {
    soon_.insert(place, entry);
    return;
  }
  std::move(first, place, first - 1);
  *(place - 1) = entry;
  --first_;
}

/// Begins days until enough events are in sight.
void Soonest::look_ahead() {
  soon_.erase(soon_.begin(), soon_.begin() + static_cast<std::ptrdiff_t>(first_));
  erased_ += first_, first_ = 0;
  while (soon_.size() < kInSight) {
    if (static_cast<double>(begun_) < days_of_epoch_)
      begin_day();
    else if (!soon_.empty() || !begin_epoch())  // who is in sight is due before all others
      return;
  }
}

/// What is due on it comes after all that is in sight.
void Soonest::begin_day() {
  if (begun_ % kDays == 0) open_page();
  std::vector<Entry>& day = days_[begun_++ % kDays];
  const auto sorted = static_cast<std::ptrdiff_t>(soon_.size());
  for (const Entry& entry : day)
    if (!is_left(entry)) soon_.push_back(entry);
  day.clear();
  std::sort(soon_.begin() + sorted, soon_.end());
  for (const Entry& entry : days_[begun_ % kDays]) fetch(entry.row);
}

void Soonest::open_page() {
  std::vector<Entry>& page = pages_[begun_ / kDays];
  for (std::size_t i = 0; i < page.size(); ++i) {
    if (i + kAhead < page.size()) fetch(page[i + kAhead].row);
    if (const Entry& entry = page[i]; !is_left(entry))
      days_[static_cast<std::size_t>(day_of(entry.time)) % kDays].push_back(entry);
  }
  page.clear();
}

/// False where no row is due.
bool Soonest::begin_epoch() {
  double least = kNever;
  for (const double time : due_) least = std::min(least, time);
  if (least == kNever) return false;
  choose_epoch(least);
  begun_ = 0;
  for (std::size_t row = 0; row < due_.size(); ++row)
    if (const double day = day_of(due_[row]); day < days_of_epoch_)
      put({due_[row], static_cast<std::uint32_t>(row)}, static_cast<std::size_t>(day));
  return true;
}

/// From the time that is due first.
void Soonest::choose_epoch(double least) {
  const std::size_t step = std::max<std::size_t>(due_.size() / kSample, 1);
  sample_.clear();
  for (std::size_t row = 0; row < due_.size(); row += step)
    if (due_[row] < kNever) sample_.push_back(due_[row]);
  if (sample_.empty()) sample_.push_back(least);
  const double within = kOfEpoch * static_cast<double>(sample_.size());
  const auto last = sample_.begin() + static_cast<std::ptrdiff_t>(within);
  std::nth_element(sample_.begin(), last, sample_.end());
  const double days = within * static_cast<double>(step) / kOfDay;
  const std::size_t pages = static_cast<std::size_t>(days) / kDays + 1;
  if (pages_.size() < pages) pages_.resize(pages);
  begin_ = least, days_of_epoch_ = static_cast<double>(pages * kDays);
  const double span = *last > least ? *last - least : 1.0;  // s; all on one day: any will do
  days_per_second_ = std::min(days_of_epoch_ / span, std::numeric_limits<double>::max());
}

}  // namespace throng
