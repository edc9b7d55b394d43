// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "sim/recording/h5.h"
#include "sim/recording/layout.h"

namespace throng::recording {

/// A dataset of small rows that grows at each commit. It carries no checksum: its last chunk is rewritten as
/// it fills. A frame's hash covers its rows. All functions throw h5::Error.
class RowLog {
 public:
  RowLog() = default;

  /// Makes the dataset: one number a row, or `columns` of them, and so many rows a chunk.
  template <class T>
  static RowLog create(hid_t at, const char* name, hsize_t columns = 1, hsize_t chunk = kRowChunk);

  void add(std::span<const std::byte> rows);
  template <class T>
  void add(const T& row) {
    add(std::as_bytes(std::span(&row, 1)));
  }

  void commit();  ///< writes what was added, and flushes it
  void close() { set_.close("cannot close the file"); }
  void abandon() { set_.abandon(); }

  explicit operator bool() const { return set_ >= 0; }
  hid_t set() const { return set_; }
  std::span<const std::byte> pending() const { return pending_; }

 private:
  h5::Handle set_, type_;
  hsize_t columns_ = 1, committed_ = 0;
  std::size_t row_bytes_ = 0;
  std::vector<std::byte> pending_;
};

}  // namespace throng::recording
