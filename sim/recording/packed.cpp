// SPDX-License-Identifier: MIT
#include "sim/recording/packed.h"

#include <zlib.h>

#include <algorithm>
#include <cassert>
#include <charconv>
#include <cmath>
#include <cstring>
#include <stdexcept>
#include <string>

#include "sim/recording/deflate_runs.h"
#include "sim/recording/fletcher32.h"

namespace throng::recording {

namespace {

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
constexpr std::size_t kLeastBlock = 2048;  // bytes for which a code of their own pays

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

/// The next whole number below, where that has 31 bits: in two instructions, where std::floor is a call.
std::int32_t whole(double x) {
  const auto towards_zero = static_cast<std::int32_t>(x);
  return towards_zero - (static_cast<double>(towards_zero) > x);
}
bool has_31_bits(double x) {
  return x >= -0x1p31 + 1.0 && x < 0x1p31;
}

}  // namespace

std::int32_t quantized(double x, double quantum) {
  const double number = x / quantum + 0.5;
  if (!has_31_bits(number)) throw std::range_error("beyond 31 bits");
  return whole(number);
}

void quantize(std::span<const double> from, double quantum, std::span<std::int32_t> to) {
  assert(to.size() >= from.size());
  bool fits = true;
  for (double x : from) fits &= has_31_bits(x / quantum + 0.5);
  if (!fits) throw std::range_error("beyond 31 bits");
  for (std::size_t i = 0; i < from.size(); ++i) to[i] = whole(from[i] / quantum + 0.5);
}

double least_quantum(double farthest) {
  const double exact = farthest / (0x1p31 - 2.0);
  if (!(exact > 0.0)) return 0.0;
  char text[32];  // d.de-xx
  char* const end = std::to_chars(text, text + sizeof text, exact, std::chars_format::scientific, 1).ptr;
  double rounded = 0.0;
  std::from_chars(text, end, rounded);
  if (rounded >= exact) return rounded;
  const std::string up =
      std::to_string(10 * (text[0] - '0') + (text[2] - '0') + 1) + std::string(text + 3, end);
  std::from_chars(up.data(), up.data() + up.size(), rounded);
  return rounded / 10.0;
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
  deflate_runs(shuffled, std::max(numbers.size(), kLeastBlock), bytes);
  const std::uint32_t sum = fletcher32(bytes);
  bytes.resize(bytes.size() + sizeof sum);
  std::memcpy(bytes.data() + bytes.size() - sizeof sum, &sum, sizeof sum);
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
