// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <span>

#include "sim/contact_row.h"
#include "sim/recording/frame_hash.h"
#include "sim/recording/observables.h"
#include "sim/recording/row_log.h"
#include "sim/recording/selection.h"

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
  explicit ContactWriter(hid_t group);

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

/// /observables: an element for each.
class ObservableWriter {
 public:
  ObservableWriter() = default;

  /// `link` puts step and time into an element's group.
  template <class Link>
  ObservableWriter(hid_t group, Link link) {
    for (std::size_t i = 0; i < kObservables.size(); ++i) create(group, i, link);
  }

  std::size_t append(const Observables& observables, FrameHash& hash);

  template <class F>
  void for_each_log(F f) {
    for (RowLog& log : logs_) f(log);
  }
  explicit operator bool() const { return static_cast<bool>(logs_[0]); }

 private:
  template <class Link>
  void create(hid_t group, std::size_t i, Link link) {
    const h5::Handle element(H5Gcreate2(group, kObservables[i].name, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
                             H5Gclose, "cannot make a group");
    logs_[i] = RowLog::create<double>(element, "value", kObservables[i].components);
    link(element);
  }

  std::array<RowLog, kObservables.size()> logs_;
};

}  // namespace throng::recording
