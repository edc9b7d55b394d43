// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "sim/workers.h"

namespace throng {

/// Numbers 0 to n - 1 in buckets, those of each bucket ascending (counting sort).
class Buckets {
 public:
  /// Number i goes into bucket of[i], below `buckets`. O(n + buckets); allocates only to grow.
  void sort(std::span<const std::uint8_t> of, std::size_t buckets, Workers& workers);

  std::span<const std::uint32_t> operator[](std::size_t bucket) const {
    return std::span(numbers_).subspan(begin_[bucket], begin_[bucket + 1] - begin_[bucket]);
  }

 private:
  std::vector<std::uint32_t> numbers_;
  std::vector<std::uint32_t> begin_;  // of each bucket, and the end
  std::vector<std::uint32_t> next_;   // of each part of the numbers and each bucket: where its next one goes
};

}  // namespace throng
