// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <utility>
#include <vector>

#include "sim/contact_row.h"
#include "sim/recording/frame_hash.h"
#include "sim/recording/h5_write.h"
#include "sim/recording/observables.h"
#include "sim/recording/row_log.h"
#include "sim/recording/selection.h"
#include "sim/sensing/sensor.h"

/// What a recording samples beside the bodies' own fields. All functions throw h5::Error.
namespace throng::recording {

/// Steps and times of the frames that hold something.
class RateRows {
 public:
  RateRows() = default;
  explicit RateRows(hid_t group);

  void append(std::int64_t step, double time);

  template <class F>
  void for_each_log(F f) {
    f(step_), f(time_);
  }

 private:
  RowLog step_, time_;
};

/// /throng/contacts: rows end to end, and where those of each sample begin.
class ContactWriter {
 public:
  ContactWriter() = default;
  ContactWriter(hid_t group, std::size_t bodies);

  /// Adds a sample. Returns the bytes that it took.
  std::size_t append(std::span<const ContactRow> rows, FrameHash& hash);

  template <class F>
  void for_each_log(F f) {
    f(offset_), f(a_), f(b_), f(impulse_), f(point_);
  }
  explicit operator bool() const { return static_cast<bool>(a_); }

 private:
  RowLog offset_, a_, b_, impulse_, point_;
  std::uint64_t rows_ = 0;
};

/// /throng/sensors/K: what one sensor found, rows end to end, and where those of each sample begin.
class SensedWriter {
 public:
  SensedWriter(hid_t group, int every);

  int every() const { return every_; }  ///< steps

  /// Adds a sample. Returns the bytes that it took.
  std::size_t append(const Sensed& sensed, FrameHash& hash);

  template <class F>
  void for_each_log(F f) {
    f(offset_), f(who_), f(count_), f(whom_offset_), f(whom_);
  }

 private:
  int every_;
  RowLog offset_, who_, count_, whom_offset_, whom_;
  std::uint64_t rows_ = 0, whom_rows_ = 0;
};

/// /observables: an element for each.
class ObservableWriter {
 public:
  ObservableWriter() = default;

  /// `link` puts step and time into an element's group.
  template <class Link>
  ObservableWriter(hid_t group, std::vector<Observable> observables, Link link)
      : observables_(std::move(observables)) {
    for (const Observable& observable : observables_) create(group, observable, link);
  }

  std::size_t append(const Observables& observables, FrameHash& hash);

  template <class F>
  void for_each_log(F f) {
    for (RowLog& log : logs_) f(log);
  }
  explicit operator bool() const { return !logs_.empty(); }

 private:
  template <class Link>
  void create(hid_t group, const Observable& observable, Link link) {
    const h5::Handle element = h5::create_groups(group, observable.name.c_str());
    logs_.push_back(RowLog::create<double>(element, "value", observable.components));
    if (observable.up_to > 0.0) h5::write_attribute(element, "up_to", observable.up_to);
    link(element);
  }

  std::vector<Observable> observables_;
  std::vector<RowLog> logs_;
};

}  // namespace throng::recording
