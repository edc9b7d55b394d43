// SPDX-License-Identifier: MIT
#include "sim/recording/packed.h"

#include <zlib.h>

#include <cmath>
#include <cstring>
#include <new>
#include <stdexcept>

#include "sim/recording/fletcher32.h"

namespace throng::recording {

namespace {

/// Deflates by runs and Huffman codes alone: longer matches, which cost most of the time, are few in what
/// motion leaves. Returns the bytes written, 0 where that failed.
std::size_t deflate_runs(std::span<const std::byte> from, std::span<std::byte> to) {
  z_stream stream{};
  if (deflateInit2(&stream, 1, Z_DEFLATED, 15, 9, Z_RLE) != Z_OK) return 0;
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<std::byte*>(from.data()));
  stream.avail_in = static_cast<uInt>(from.size());
  stream.next_out = reinterpret_cast<Bytef*>(to.data());
  stream.avail_out = static_cast<uInt>(to.size());
  const bool done = deflate(&stream, Z_FINISH) == Z_STREAM_END;
  const std::size_t size = stream.total_out;
  deflateEnd(&stream);
  return done ? size : 0;
}

std::uint32_t folded(std::uint32_t difference) {
  return difference << 1 ^ (difference >> 31 ? ~std::uint32_t{0} : 0);
}
std::uint32_t unfolded(std::uint32_t stored) {
  return stored >> 1 ^ (stored & 1 ? ~std::uint32_t{0} : 0);
}

/// What frame k is expected to have, from the two before.
std::uint32_t expected(std::size_t order, std::int32_t before, std::int32_t earlier) {
  const auto b = static_cast<std::uint32_t>(before), e = static_cast<std::uint32_t>(earlier);
  return order == 0 ? 0 : order == 1 ? b : 2 * b - e;
}

std::size_t order_of(std::size_t k) {
  return std::min<std::size_t>(k % kKeyEvery, 2);
}

constexpr std::size_t kWidth = sizeof(std::uint32_t);

/// All first bytes, then all second ones, and so on.
void shuffle(std::span<const std::uint32_t> numbers, std::vector<std::byte>& out) {
  const std::size_t n = numbers.size();
  out.resize(kWidth * n);
  for (std::size_t b = 0; b < kWidth; ++b)
    for (std::size_t i = 0; i < n; ++i) out[b * n + i] = static_cast<std::byte>(numbers[i] >> 8 * b);
}

void unshuffle(std::span<const std::byte> bytes, std::span<std::uint32_t> numbers) {
  const std::size_t n = numbers.size();
  for (std::size_t i = 0; i < n; ++i) {
    numbers[i] = 0;
    for (std::size_t b = 0; b < kWidth; ++b)
      numbers[i] |= static_cast<std::uint32_t>(bytes[b * n + i]) << 8 * b;
  }
}

}  // namespace

std::int32_t quantized(double x, double quantum) {
  const double number = std::floor(x / quantum + 0.5);
  if (!(std::abs(number) < 0x1p31)) throw std::range_error("beyond 31 bits");
  return static_cast<std::int32_t>(number);
}

void predict(std::size_t k, std::span<const std::int32_t> now, std::span<const std::int32_t> before,
             std::span<const std::int32_t> earlier, std::span<std::uint32_t> stored) {
  const std::size_t order = order_of(k);
  for (std::size_t i = 0; i < now.size(); ++i)
    stored[i] = folded(static_cast<std::uint32_t>(now[i]) - expected(order, before[i], earlier[i]));
}

void restore(std::size_t k, std::span<const std::uint32_t> stored, std::span<const std::int32_t> before,
             std::span<const std::int32_t> earlier, std::span<std::int32_t> now) {
  const std::size_t order = order_of(k);
  for (std::size_t i = 0; i < now.size(); ++i)
    now[i] = static_cast<std::int32_t>(unfolded(stored[i]) + expected(order, before[i], earlier[i]));
}

void pack(std::span<const std::uint32_t> numbers, std::vector<std::byte>& bytes) {
  thread_local std::vector<std::byte> shuffled;
  shuffle(numbers, shuffled);
  bytes.resize(2 * shuffled.size() + 64);  // far more than deflate ever needs
  const std::size_t size = deflate_runs(shuffled, bytes);
  if (size == 0) throw std::bad_alloc();
  const std::uint32_t sum = fletcher32(std::span(bytes).first(size));
  std::memcpy(bytes.data() + size, &sum, sizeof sum);
  bytes.resize(size + sizeof sum);
}

bool unpack(std::span<const std::byte> bytes, std::span<std::uint32_t> numbers) {
  std::uint32_t sum = 0;
  if (bytes.size() < sizeof sum) return false;
  const auto body = bytes.first(bytes.size() - sizeof sum);
  std::memcpy(&sum, bytes.data() + body.size(), sizeof sum);
  if (sum != fletcher32(body)) return false;
  thread_local std::vector<std::byte> shuffled;
  shuffled.resize(numbers.size_bytes());
  uLongf size = shuffled.size();
  const int status = uncompress(reinterpret_cast<Bytef*>(shuffled.data()), &size,
                                reinterpret_cast<const Bytef*>(body.data()), body.size());
  if (status != Z_OK || size != shuffled.size()) return false;
  unshuffle(shuffled, numbers);
  return true;
}

}  // namespace throng::recording
