// SPDX-License-Identifier: MIT
#include "tests/fuzz/h5_sums.h"

#include <hdf5.h>

#include <cstring>
#include <span>
#include <string_view>

#include "sim/recording/fletcher32.h"
#include "tests/fuzz/fuzz.h"

extern "C" std::uint32_t H5_checksum_metadata(const void* data, std::size_t size, std::uint32_t start);

namespace throng::fuzz {

namespace {

using Bytes = std::vector<std::uint8_t>;
using Kind = ChecksummedBlock::Kind;

constexpr std::size_t kSum = 4, kSuperblock = 44, kMostMetadata = 8192;  // bytes

std::uint32_t sum(const ChecksummedBlock& block, const Bytes& bytes) {
  if (block.kind == Kind::metadata) return H5_checksum_metadata(&bytes[block.begin], block.size, 0);
  return recording::fletcher32(std::as_bytes(std::span(bytes).subspan(block.begin, block.size)));
}

bool fits(const ChecksummedBlock& block, const Bytes& bytes) {
  std::uint32_t stored;
  std::memcpy(&stored, &bytes[block.begin + block.size], kSum);
  return stored == sum(block, bytes);
}

/// What is called by one of HDF5's names and has a sum that fits at some length.
void find_metadata(const Bytes& bytes, std::vector<ChecksummedBlock>& blocks) {
  constexpr std::string_view names = "OHDROCHKEAHDEAIBEASBEADBFAHDFADBBTHDBTINBTLFFRHPFHDBFHIB";
  for (std::size_t at = kSuperblock; at + 8 < bytes.size(); ++at) {
    const std::size_t name = names.find(std::string_view(reinterpret_cast<const char*>(&bytes[at]), 4));
    if (name == names.npos || name % 4 != 0) continue;
    for (std::size_t size = 8; size < kMostMetadata && at + size + kSum <= bytes.size(); ++size)
      if (const ChecksummedBlock block{Kind::metadata, at, size}; fits(block, bytes)) {
        blocks.push_back(block);
        break;
      }
  }
}

void find_chunks(hid_t set, const Bytes& bytes, std::vector<ChecksummedBlock>& blocks) {
  hsize_t count = 0, offset[H5S_MAX_RANK], size = 0;
  haddr_t begin = 0;
  unsigned unfiltered = 0;
  const hid_t space = H5Dget_space(set);
  if (H5Dget_num_chunks(set, space, &count) < 0) count = 0;  // in one piece
  for (hsize_t i = 0; i < count; ++i) {
    if (H5Dget_chunk_info(set, space, i, offset, &unfiltered, &begin, &size) < 0 || size <= kSum) continue;
    const ChecksummedBlock block{Kind::values, begin, size - kSum};
    if (fits(block, bytes)) blocks.push_back(block);
  }
  H5Sclose(space);
}

struct Search {
  const Bytes& bytes;
  std::vector<ChecksummedBlock>& blocks;
};

herr_t visit(hid_t file, const char* name, const H5O_info_t* info, void* data) {
  const auto& [bytes, blocks] = *static_cast<Search*>(data);
  if (info->type != H5O_TYPE_DATASET) return 0;
  const hid_t set = H5Dopen2(file, name, H5P_DEFAULT);
  find_chunks(set, bytes, blocks);
  H5Dclose(set);
  return 0;
}

}  // namespace

std::vector<ChecksummedBlock> checksummed_blocks(const std::string& path, const Bytes& bytes) {
  std::vector<ChecksummedBlock> blocks{{Kind::metadata, 0, kSuperblock}};
  find_metadata(bytes, blocks);
  Search search{bytes, blocks};
  const hid_t file = H5Fopen(path.c_str(), H5F_ACC_RDONLY | H5F_ACC_SWMR_READ, H5P_DEFAULT);
  expect(file >= 0, "the sample opens");
  H5Ovisit2(file, H5_INDEX_NAME, H5_ITER_NATIVE, visit, &search, H5O_INFO_BASIC);
  H5Fclose(file);
  return blocks;
}

void mend(const std::vector<ChecksummedBlock>& blocks, Bytes& bytes) {
  for (const ChecksummedBlock& block : blocks) {
    const std::uint32_t right = sum(block, bytes);
    std::memcpy(&bytes[block.begin + block.size], &right, kSum);
  }
}

}  // namespace throng::fuzz
