// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <vector>

/// The checksums of an HDF5 file, and how to make them fit after a change, as whoever means harm can.
namespace throng::fuzz {

struct ChecksummedBlock {
  enum class Kind { metadata, values } kind;  ///< by Jenkins' lookup3 or by fletcher32
  std::size_t begin, size;                    ///< bytes, without the sum, which follows them
};

/// The superblock, all blocks of metadata and all chunks of datasets in the file at `path`. Expects a whole
/// file in the latest format, filtered by fletcher32 at most.
std::vector<ChecksummedBlock> checksummed_blocks(const std::string& path,
                                                 const std::vector<std::uint8_t>& bytes);

/// Makes the sums of all blocks fit what stands there now.
void mend(const std::vector<ChecksummedBlock>& blocks, std::vector<std::uint8_t>& bytes);

}  // namespace throng::fuzz
