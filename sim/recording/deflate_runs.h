// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace throng::recording {

/// Replaces `out` by a zlib stream (RFC 1950, RFC 1951) of the bytes: runs of one byte and Huffman codes, a
/// block of its own for each of the parts of `block` bytes. Longer matches, for which other encoders spend
/// their time, are few in what motion leaves: zlib's own Z_RLE finds as many and is five times slower. Any
/// inflate reads it. Expects block > 0. O(bytes); at most bytes + bytes / 8 + 400 a block come out.
void deflate_runs(std::span<const std::byte> bytes, std::size_t block, std::vector<std::byte>& out);

}  // namespace throng::recording
