// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

/// Positions as whole multiples of a quantum, packed: how they go into a file and come back.
namespace throng::recording {

/// From one key frame to the next: what a reader must at most unpack to show one frame.
inline constexpr std::size_t kKeyEvery = 16;

/// The whole number nearest to x / quantum, halves up. Throws std::range_error where it is beyond 31 bits.
std::int32_t quantized(double x, double quantum);

/// The same of each of them, into the first places of `to`, which stays as it is where one throws. Expects
/// to.size() >= from.size().
void quantize(std::span<const double> from, double quantum, std::span<std::int32_t> to);

/// The least quantum, rounded up to two digits, that will do for places up to `farthest` (m) from 0.
double least_quantum(double farthest);

/// What is stored of frame `k`: of a key frame (k a multiple of kKeyEvery) its numbers, of the next one by
/// how much they grew, of all others by how much that growth grew, modulo 2^32. A sign is folded into the
/// lowest bit, so that what is small has zeros in front: 2 d where d >= 0, else -2 d - 1. A body that goes on
/// as it went takes some bits then.
void predict(std::size_t k, std::span<const std::int32_t> now, std::span<const std::int32_t> before,
             std::span<const std::int32_t> earlier, std::span<std::uint32_t> stored);

/// The way back. `now` may be `earlier`.
void restore(std::size_t k, std::span<const std::uint32_t> stored, std::span<const std::int32_t> before,
             std::span<const std::int32_t> earlier, std::span<std::int32_t> now);

/// Bytes as HDF5's filters shuffle, deflate (RFC 1950) and fletcher32 leave them, one after the other.
void pack(std::span<const std::uint32_t> numbers, std::vector<std::byte>& bytes);

/// The way back, into exactly as many numbers: no crafted bytes take more. Returns false where the bytes are
/// not what pack makes of so many.
bool unpack(std::span<const std::byte> bytes, std::span<std::uint32_t> numbers);

}  // namespace throng::recording
