// SPDX-License-Identifier: MIT
#include "sim/recording/frame_hash.h"

#include <bit>
#include <cassert>
#include <cstring>

namespace throng::recording {

namespace {

constexpr std::uint64_t kPrime1 = 0x9E3779B185EBCA87ULL, kPrime2 = 0xC2B2AE3D27D4EB4FULL;

std::uint64_t mix(std::uint64_t hash, std::uint64_t word) {
  return std::rotl(hash + word * kPrime2, 31) * kPrime1;
}

std::uint64_t word_at(std::span<const std::byte> bytes, std::size_t at) {
  std::uint64_t word = 0;
  std::memcpy(&word, bytes.data() + at, std::min<std::size_t>(8, bytes.size() - at));
  return word;
}

}  // namespace

std::array<std::uint64_t, 4> BytesHash::start() {
  return {kPrime1 + kPrime2, kPrime2, 0, 0 - kPrime1};
}

/// The lanes are variables of their own: in an array compilers leave them in memory, at 40 % of the speed.
void BytesHash::add(std::span<const std::byte> bytes) {
  static_assert(std::endian::native == std::endian::little);
  assert(size_ % sizeof lane_ == 0);
  auto [a, b, c, d] = lane_;
  std::size_t at = 0;
  for (; at + 32 <= bytes.size(); at += 32) {
    std::array<std::uint64_t, 4> words;
    std::memcpy(words.data(), bytes.data() + at, sizeof words);
    a = mix(a, words[0]), b = mix(b, words[1]), c = mix(c, words[2]), d = mix(d, words[3]);
  }
  lane_ = {a, b, c, d};
  for (std::size_t i = 0; at < bytes.size(); at += 8, ++i) lane_[i] = mix(lane_[i], word_at(bytes, at));
  size_ += bytes.size();
}

std::uint64_t BytesHash::value() const {
  std::uint64_t hash = size_;
  for (std::uint64_t lane : lane_) hash = mix(hash ^ (hash >> 29), lane);
  return hash ^ (hash >> 32);
}

std::uint64_t hash_bytes(std::span<const std::byte> bytes) {
  BytesHash hash;
  hash.add(bytes);
  return hash.value();
}

std::uint64_t chain_hash(std::span<const std::uint64_t> hashes, std::uint64_t chain) {
  for (std::uint64_t hash : hashes) {
    chain = mix(chain ^ (chain >> 29), hash);
    if (chain == 0) chain = 1;
  }
  return chain;
}

FrameHash::FrameHash(std::int64_t step, double time, std::uint64_t state_hash)
    : hash_(mix(mix(mix(kPrime1, static_cast<std::uint64_t>(step)), std::bit_cast<std::uint64_t>(time)),
                state_hash)) {}

void FrameHash::add(const BytesHash& field) {
  hash_ = mix(hash_ ^ (hash_ >> 29), field.value());
}

void FrameHash::add(std::span<const std::byte> field) {
  BytesHash hash;
  hash.add(field);
  add(hash);
}

std::uint64_t FrameHash::value() const {
  return hash_ == 0 ? 1 : hash_;
}

}  // namespace throng::recording
