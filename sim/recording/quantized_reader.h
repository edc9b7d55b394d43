// SPDX-License-Identifier: MIT
#pragma once

#include <limits>
#include <span>
#include <vector>

#include "sim/recording/frame_hash.h"
#include "sim/recording/h5_read.h"

namespace throng::recording {

/// Reads quantized positions: any sample from the key frame before it, the next one after it at once. All
/// functions throw h5::Error.
class QuantizedReader {
 public:
  QuantizedReader() = default;

  /// Expects the group to be `quantized` of layout.h.
  QuantizedReader(const h5::File& file, hid_t group, std::size_t bodies);

  double quantum() const { return quantum_; }  ///< m; 0: there are none
  std::size_t samples() const { return set_.dims[0]; }

  /// Sample k < samples(): x and y of each body, m. O(bodies), at most kKeyEvery times.
  void read(std::size_t k, std::vector<double>& numbers, FrameHash& hash);

 private:
  void next(std::size_t k);

  h5::Dataset set_;
  double quantum_ = 0.0;
  static constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();
  std::size_t at_ = kNone;  // the sample that now_ is
  std::vector<std::int32_t> now_, before_;
  std::vector<std::uint32_t> stored_;
};

}  // namespace throng::recording
