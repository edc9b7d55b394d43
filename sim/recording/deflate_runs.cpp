// SPDX-License-Identifier: MIT
#include "sim/recording/deflate_runs.h"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cstdint>
#include <cstring>

#include "sim/recording/huffman.h"

namespace throng::recording {

namespace {

constexpr std::size_t kLongest = 258, kShortest = 3;  // bytes of a run, after the first
constexpr std::uint16_t kEnd = 256;
constexpr std::size_t kSymbols = 286, kLengths = 19;
/// In which order the lengths of the code of code lengths stand (RFC 1951, 3.2.7).
constexpr std::array<std::uint8_t, kLengths> kOrder{16, 17, 18, 0, 8,  7, 9,  6, 10, 5,
                                                    11, 4,  12, 3, 13, 2, 14, 1, 15};

/// A literal, or a run: a symbol from 257 on and its further bits.
struct Token {
  std::uint16_t symbol;
  std::uint8_t bits, extra;
};

/// What a run of so many bytes is (RFC 1951, 3.2.5), by length.
std::array<Token, kLongest + 1> make_runs() {
  std::array<Token, kLongest + 1> runs{};
  std::size_t length = kShortest;
  for (std::uint16_t symbol = 257; symbol < 285; ++symbol) {
    const auto bits = static_cast<std::uint8_t>(symbol < 265 ? 0 : (symbol - 261) / 4);
    for (unsigned extra = 0; extra < 1u << bits && length < kLongest; ++extra)
      runs[length++] = {symbol, bits, static_cast<std::uint8_t>(extra)};
  }
  runs[kLongest] = {285, 0, 0};
  return runs;
}

/// How many bytes from `at` on are that before it.
std::size_t run_at(std::span<const std::byte> bytes, std::size_t at) {
  const std::size_t most = std::min(kLongest, bytes.size() - at);
  std::size_t length = 0;
  while (length < most && bytes[at + length] == bytes[at - 1]) ++length;
  return length;
}

/// The block's tokens, without its end.
void tokenise(std::span<const std::byte> bytes, std::vector<Token>& tokens) {
  static const auto runs = make_runs();
  tokens.clear();
  for (std::size_t at = 0; at < bytes.size();) {
    const std::size_t run = at > 0 && bytes[at] == bytes[at - 1] ? run_at(bytes, at) : 0;
    if (run >= kShortest)
      tokens.push_back(runs[run]), at += run;
    else
      tokens.push_back({static_cast<std::uint8_t>(bytes[at++]), 0, 0});
  }
}

/// Bits from the lowest on, to memory that has room for them.
class BitWriter {
 public:
  explicit BitWriter(std::byte* to) : to_(to) {}
  void put(std::uint32_t value, unsigned count) {
    bits_ |= std::uint64_t{value} << held_;
    held_ += count;
    if (held_ < 32) return;
    const auto word = static_cast<std::uint32_t>(bits_);
    std::memcpy(to_, &word, sizeof word);
    to_ += sizeof word, bits_ >>= 32, held_ -= 32;
  }
  /// Up to the next whole byte. Returns where it ends.
  std::byte* finish() {
    for (; held_ > 0; held_ -= std::min(held_, 8u), bits_ >>= 8) *to_++ = static_cast<std::byte>(bits_);
    return to_;
  }

 private:
  std::byte* to_;
  std::uint64_t bits_ = 0;
  unsigned held_ = 0;
};

/// The head of a dynamic block: lengths of literals and runs, and of the one distance, 1.
void put_lengths(const HuffmanCode<kSymbols>& code, BitWriter& out) {
  std::array<std::uint8_t, kSymbols + 1> lengths{};
  std::ranges::copy(code.length, lengths.begin());
  lengths[kSymbols] = 1;
  std::array<std::uint32_t, kLengths> count{};
  for (std::uint8_t length : lengths) ++count[length];
  const HuffmanCode<kLengths> code_of_lengths(count, 7);
  out.put(kSymbols - 257, 5), out.put(0, 5), out.put(kLengths - 4, 4);
  for (std::uint8_t symbol : kOrder) out.put(code_of_lengths.length[symbol], 3);
  for (std::uint8_t length : lengths) out.put(code_of_lengths.bits[length], code_of_lengths.length[length]);
}

void put_block(std::span<const Token> tokens, bool last, BitWriter& out) {
  std::array<std::uint32_t, kSymbols> count{};
  for (const Token& token : tokens) ++count[token.symbol];
  ++count[kEnd];
  const HuffmanCode<kSymbols> code(count, 15);
  out.put(last ? 1 : 0, 1), out.put(2, 2);
  put_lengths(code, out);
  for (const Token& token : tokens) {
    out.put(code.bits[token.symbol], code.length[token.symbol]);
    if (token.symbol > kEnd) out.put(token.extra, token.bits + 1u);  // and the distance, whose code is 0
  }
  out.put(code.bits[kEnd], code.length[kEnd]);
}

}  // namespace

void deflate_runs(std::span<const std::byte> bytes, std::size_t block, std::vector<std::byte>& out) {
  assert(block > 0);
  thread_local std::vector<Token> tokens;
  const std::size_t blocks = bytes.size() / block + 1;
  out.resize(2 * bytes.size() + 400 * blocks);
  BitWriter bits(out.data());
  bits.put(0x0178, 16);  // zlib's head: deflate, a window of 32 kB, the fastest
  for (std::size_t at = 0; at == 0 || at < bytes.size(); at += block) {
    const auto part = bytes.subspan(at, std::min(block, bytes.size() - at));
    tokenise(part, tokens);
    put_block(tokens, at + part.size() == bytes.size(), bits);
  }
  std::byte* end = bits.finish();
  const auto sum = adler32(1, reinterpret_cast<const Bytef*>(bytes.data()), static_cast<uInt>(bytes.size()));
  for (int shift = 24; shift >= 0; shift -= 8) *end++ = static_cast<std::byte>(sum >> shift);
  out.resize(static_cast<std::size_t>(end - out.data()));
}

}  // namespace throng::recording
