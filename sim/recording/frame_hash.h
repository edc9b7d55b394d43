// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string_view>

/// The checksums of a trajectory file. They catch damage and mistakes, not malice.
namespace throng::recording {

/// 64 bits over the bytes and their number: words of 8 bytes (the last padded with zeros) dealt to four
/// lanes, each stepped as in XXH64 (Collet 2012), so that any change of one word changes the result. About 8
/// bytes a ns.
std::uint64_t hash_bytes(std::span<const std::byte> bytes);

/// hash_bytes of what comes in pieces, each but the last a multiple of 32 bytes long.
class BytesHash {
 public:
  void add(std::span<const std::byte> piece);
  std::uint64_t value() const;

 private:
  std::array<std::uint64_t, 4> lane_ = start();
  std::uint64_t size_ = 0;  // bytes

  static std::array<std::uint64_t, 4> start();
};

inline std::uint64_t text_hash(std::string_view text) {
  return hash_bytes(std::as_bytes(std::span(text)));
}

/// The hash of a list of hashes, so far `chain`; appending goes on where it stopped. Never 0.
inline constexpr std::uint64_t kEmptyChain = 0x7468726f6e67ULL;
std::uint64_t chain_hash(std::span<const std::uint64_t> hashes, std::uint64_t chain = kEmptyChain);

/// The running hash of a frame: starts with the row's numbers, then takes each stored field in the order of
/// layout.h.
class FrameHash {
 public:
  FrameHash(std::int64_t step, double time, std::uint64_t state_hash);
  void add(std::span<const std::byte> field);
  void add(const BytesHash& field);
  std::uint64_t value() const;  ///< never 0

 private:
  std::uint64_t hash_;
};

}  // namespace throng::recording
