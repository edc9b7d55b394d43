// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "sim/recording/h5.h"

namespace throng::recording {

/// A dataset [frame, body] or [frame, body, x and y] whose frames are written once each, in whole chunks,
/// past HDF5's own pipeline, which copies each chunk once more to put its checksum behind it. All functions
/// throw h5::Error.
class FrameBlocks {
 public:
  struct Form {
    hsize_t bodies, columns;  ///< 1 or 2 numbers a body
    hsize_t most_per_chunk;   ///< bodies
    bool packed = false;      ///< by shuffle and deflate, of 4-byte numbers
    bool sparse = false;      ///< frames hold few of the bodies
  };

  FrameBlocks() = default;
  FrameBlocks(hid_t at, const char* name, hid_t type, const Form& form);

  /// Sees numbers piece by piece on their way, while they are in the nearest cache: pieces of whole numbers,
  /// each but the last a multiple of 32 bytes long.
  using See = std::function<void(std::span<const std::byte> piece)>;

  /// Writes the next frame: the numbers of the first bodies. Chunks that hold none of these stay unallocated.
  /// Expects a form that isn't packed.
  void write(std::span<const std::byte> numbers, const See& see);

  /// Writes the next frame of a packed form: the numbers of all bodies. Returns the bytes that it took.
  std::size_t write_packed(std::span<const std::uint32_t> numbers);

  void flush();
  void close() { set_.close("cannot close the file"); }
  void abandon() { set_.abandon(); }

  explicit operator bool() const { return set_ >= 0; }
  hid_t set() const { return set_; }
  std::size_t frames() const { return frames_; }

 private:
  void grow();
  void fill_chunk(std::span<const std::byte> part, const See& see);
  void write_chunk(hsize_t first_body);

  h5::Handle set_;
  Form form_{};
  hsize_t per_chunk_ = 1, frames_ = 0;
  std::size_t body_bytes_ = 0;
  std::vector<std::byte> chunk_;            // the one being written, with its checksum
  std::vector<std::uint32_t> whole_chunk_;  // numbers of a packed chunk, padded with zeros
};

}  // namespace throng::recording
