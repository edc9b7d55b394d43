// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace throng::recording {

/// The checksum that HDF5's filter fletcher32 puts behind a chunk, little-endian: Fletcher's sums modulo
/// 65535 (Fletcher 1982) of big-endian words of 16 bits, neither of them 0 but for zeros alone. A lone last
/// byte is the high half of a word.
std::uint32_t fletcher32(std::span<const std::byte> bytes);

/// The same of what comes in pieces, each but the last of whole words; fastest where multiples of 32 bytes.
class Fletcher32 {
 public:
  void add(std::span<const std::byte> piece);
  std::uint32_t value() const;

 private:
  std::uint64_t first_ = 0, second_ = 0;  // of little-endian words
};

}  // namespace throng::recording
