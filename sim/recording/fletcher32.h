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

}  // namespace throng::recording
