// SPDX-License-Identifier: MIT
#include "sim/recording/deflate_runs.h"

#include <gtest/gtest.h>
#include <zlib.h>

#include <numeric>
#include <random>

#include "sim/recording/huffman.h"

namespace throng::recording {
namespace {

std::vector<std::byte> bytes_of(const std::vector<int>& numbers) {
  std::vector<std::byte> bytes;
  for (int number : numbers) bytes.push_back(static_cast<std::byte>(number));
  return bytes;
}

/// What zlib makes of a stream; more than `most` bytes are an error, as is anything behind the stream.
std::vector<std::byte> inflated(std::vector<std::byte> stream, std::size_t most) {
  std::vector<std::byte> bytes(most + 1);
  uLongf size = bytes.size();
  uLong read = stream.size();
  EXPECT_EQ(uncompress2(reinterpret_cast<Bytef*>(bytes.data()), &size,
                        reinterpret_cast<const Bytef*>(stream.data()), &read),
            Z_OK);
  EXPECT_EQ(read, stream.size());
  bytes.resize(size);
  return bytes;
}

void expect_same(const std::vector<std::byte>& bytes, std::size_t block) {
  std::vector<std::byte> stream;
  deflate_runs(bytes, block, stream);
  ASSERT_EQ(inflated(stream, bytes.size()), bytes) << bytes.size() << " bytes in blocks of " << block;
}

TEST(DeflateRuns, IsReadByZlib) {
  expect_same({}, 7);
  expect_same(bytes_of({5}), 7);
  expect_same(bytes_of({5, 5}), 7);
  expect_same(bytes_of({1, 2, 3, 4, 5, 6, 7, 8, 9}), 3);
  for (std::size_t length :
       {3, 4, 10, 11, 18, 19, 114, 115, 257, 258, 259, 260, 261, 262, 515, 516, 517, 600})
    for (std::size_t block : {1, 2, 3, 4, 100, 258, 1000})
      expect_same(std::vector<std::byte>(length, std::byte{9}), block);
}

/// Every length of a run, at its beginning, within and at the end of what stands beside it.
TEST(DeflateRuns, KnowsEveryLengthOfARun) {
  std::vector<int> numbers;
  for (int length = 1; length <= 300; ++length) {
    numbers.insert(numbers.end(), length, length);
    numbers.push_back(length + 100);
  }
  expect_same(bytes_of(numbers), numbers.size());
}

TEST(DeflateRuns, IsReadByZlibWhateverTheBytes) {
  constexpr unsigned kSeed = 20261121;
  SCOPED_TRACE("seed " + std::to_string(kSeed));
  std::mt19937 random(kSeed);
  std::size_t runs = 0;
  for (int file = 0; file < 3000 && !HasFailure(); ++file) {
    std::vector<int> numbers(random() % 700);
    const unsigned different = 1u << random() % 9, repeats = random() % 5;
    for (std::size_t i = 0; i < numbers.size(); ++i)
      numbers[i] = i > 0 && random() % 5 < repeats ? numbers[i - 1] : static_cast<int>(random() % different);
    for (std::size_t i = 3; i < numbers.size(); ++i)
      runs += numbers[i] == numbers[i - 1] && numbers[i] == numbers[i - 2] && numbers[i] == numbers[i - 3];
    expect_same(bytes_of(numbers), 1 + random() % 800);
  }
  EXPECT_GT(runs, 100'000u) << "the sample has runs";
}

/// What is stored of motion: its lowest bytes are noise, its highest ones are zeros.
TEST(DeflateRuns, IsNoLongerThanWhatZlibsOwnRunsTake) {
  std::mt19937 random(1);
  std::vector<std::byte> bytes;
  for (int plane = 0; plane < 4; ++plane)
    for (int i = 0; i < 20'000; ++i)
      bytes.push_back(static_cast<std::byte>(plane == 0   ? random() % 64 + random() % 64
                                             : plane == 1 ? random() % 50 == 0
                                                          : 0));
  std::vector<std::byte> own, theirs(bytes.size());
  deflate_runs(bytes, 20'000, own);
  z_stream stream{};
  deflateInit2(&stream, 1, Z_DEFLATED, 15, 9, Z_RLE);
  stream.next_in = reinterpret_cast<Bytef*>(bytes.data());
  stream.avail_in = static_cast<uInt>(bytes.size());
  stream.next_out = reinterpret_cast<Bytef*>(theirs.data());
  stream.avail_out = static_cast<uInt>(theirs.size());
  EXPECT_EQ(deflate(&stream, Z_FINISH), Z_STREAM_END);
  EXPECT_LE(own.size(), stream.total_out);
  deflateEnd(&stream);
}

/// 45, 13, 12, 16, 9 and 5 of a hundred take 1, 3, 3, 3, 4 and 4 bits.
TEST(Huffman, IsTheCodeOfTheTextbook) {
  const HuffmanCode<6> code({45, 13, 12, 16, 9, 5}, 15);
  EXPECT_EQ(code.length, (std::array<std::uint8_t, 6>{1, 3, 3, 3, 4, 4}));
  EXPECT_EQ(code.bits, (std::array<std::uint16_t, 6>{0b0, 0b001, 0b101, 0b011, 0b0111, 0b1111}))
      << "0, 100, 101, 110, 1110, 1111, the first bit lowest";
}

TEST(Huffman, LeavesOutWhatDoesNotOccur) {
  EXPECT_EQ(HuffmanCode<3>({0, 7, 0}, 15).length, (std::array<std::uint8_t, 3>{0, 1, 0}));
  EXPECT_EQ(HuffmanCode<3>({1, 0, 1}, 15).length, (std::array<std::uint8_t, 3>{1, 0, 1}));
}

/// Counts that grow like Fibonacci's numbers make the longest codes: 29 bits for 30 of them.
TEST(Huffman, IsNeverLongerThanItMayBe) {
  std::array<std::uint32_t, 30> count{1, 1};
  for (std::size_t i = 2; i < 30; ++i) count[i] = count[i - 1] + count[i - 2];
  EXPECT_EQ(HuffmanCode<30>(count, 40).length[0], 29);
  for (unsigned longest : {15u, 7u, 5u}) {
    const HuffmanCode<30> code(count, longest);
    double share = 0.0;  // of all codes: Kraft's sum
    for (std::uint8_t length : code.length) {
      EXPECT_GE(length, 1);
      EXPECT_LE(length, longest);
      share += 1.0 / (1 << length);
    }
    EXPECT_EQ(share, 1.0);
  }
}

}  // namespace
}  // namespace throng::recording
