// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "sim/recording/frame_blocks.h"
#include "sim/recording/frame_hash.h"
#include "sim/recording/layout.h"
#include "sim/recording/selection.h"

namespace throng::recording {

/// Writes one field of the bodies, in the form that the scene asks for. All functions throw h5::Error.
class FieldWriter {
 public:
  FieldWriter() = default;

  /// Makes the field's dataset, where layout.h wants it. Refers to the selection's ids.
  FieldWriter(hid_t element, RecordField field, const Record& record, const Selection& selection);

  /// Room for the numbers of a frame in the making: those of a body one after the other, by row of the
  /// selection.
  std::vector<double>& values() {
    values_.resize(numbers_);
    return values_;
  }

  /// Adds the frame of a step: these numbers, its own or others. Returns the bytes that it took. Throws
  /// std::runtime_error where one is not finite, or a position beyond what can be quantized: what was written
  /// then is no frame.
  std::size_t append(std::int64_t step, std::span<const double> numbers, FrameHash& hash);

  void flush() { blocks_.flush(); }
  void close() { blocks_.close(); }
  void abandon() { blocks_.abandon(); }
  explicit operator bool() const { return static_cast<bool>(blocks_); }

 private:
  template <class T>
  bool append_numbers(std::span<const T> numbers, FrameHash& hash);
  std::size_t append_quantized(std::int64_t step, std::span<const double> numbers, FrameHash& hash);
  std::string too_far(std::int64_t step, std::span<const double> numbers) const;

  FrameBlocks blocks_;
  std::size_t numbers_ = 0;  // of all bodies
  bool single_ = false;
  double quantum_ = 0.0;  // m; 0: numbers as they are
  std::span<const std::uint32_t> ids_;
  std::vector<double> values_;
  std::vector<float> singles_;
  std::vector<std::int32_t> now_, before_, earlier_;
  std::vector<std::uint32_t> stored_;
};

}  // namespace throng::recording
