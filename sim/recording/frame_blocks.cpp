// SPDX-License-Identifier: MIT
#include "sim/recording/frame_blocks.h"

#include <algorithm>
#include <cstring>

#include "sim/recording/fletcher32.h"
#include "sim/recording/h5_write.h"
#include "sim/recording/packed.h"

namespace throng::recording {

namespace {

constexpr std::size_t kPiece = 8192;  // bytes

}  // namespace

FrameBlocks::FrameBlocks(hid_t at, const char* name, hid_t type, const Form& form)
    : form_(form), body_bytes_(H5Tget_size(type) * form.columns) {
  per_chunk_ = std::clamp<hsize_t>(form.bodies, 1, form.most_per_chunk);
  std::vector<hsize_t> dims{1, form.bodies}, chunk{1, per_chunk_};
  if (form.columns > 1) dims.push_back(form.columns), chunk.push_back(form.columns);
  set_ = h5::create_growing(at, name, type, dims, chunk,
                            form.packed ? h5::Filters::packed : h5::Filters::fletcher32, form.sparse);
}

void FrameBlocks::grow() {
  const hsize_t dims[] = {++frames_, form_.bodies, form_.columns};
  h5::check(H5Dset_extent(set_, dims), "cannot add a frame");
}

void FrameBlocks::write_chunk(hsize_t first_body) {
  const hsize_t place[] = {frames_ - 1, first_body, 0};
  h5::check(H5Dwrite_chunk(set_, H5P_DEFAULT, 0, place, chunk_.size(), chunk_.data()),
            "cannot write a frame");
}

/// Numbers, zeros behind them, and the checksum of all that.
void FrameBlocks::fill_chunk(std::span<const std::byte> part, const See& see) {
  Fletcher32 sum;
  for (std::size_t at = 0; at < part.size(); at += kPiece) {
    const auto piece = part.subspan(at, std::min(kPiece, part.size() - at));
    std::memcpy(chunk_.data() + at, piece.data(), piece.size());  // first: nothing else fetches as fast
    see(piece);
    sum.add(piece);
  }
  const auto rest = std::span(chunk_).first(chunk_.size() - sizeof(std::uint32_t)).subspan(part.size());
  std::ranges::fill(rest, std::byte{0});
  sum.add(rest);
  const std::uint32_t value = sum.value();
  std::memcpy(chunk_.data() + chunk_.size() - sizeof value, &value, sizeof value);
}

void FrameBlocks::write(std::span<const std::byte> numbers, const See& see) {
  grow();
  const std::size_t size = per_chunk_ * body_bytes_;
  chunk_.resize(size + sizeof(std::uint32_t));
  for (std::size_t at = 0; at < numbers.size(); at += size) {
    fill_chunk(numbers.subspan(at, std::min(size, numbers.size() - at)), see);
    write_chunk(at / body_bytes_);
  }
}

std::size_t FrameBlocks::write_packed(std::span<const std::uint32_t> numbers) {
  grow();
  const std::size_t size = per_chunk_ * form_.columns;
  std::size_t bytes = 0;
  for (std::size_t at = 0; at < numbers.size(); at += size) {
    const auto part = numbers.subspan(at, std::min(size, numbers.size() - at));
    whole_chunk_.assign(size, 0);
    std::ranges::copy(part, whole_chunk_.begin());
    pack(whole_chunk_, chunk_);
    write_chunk(at / form_.columns);
    bytes += chunk_.size();
  }
  return bytes;
}

void FrameBlocks::flush() {
  h5::check(H5Dflush(set_), "cannot write a frame");
}

}  // namespace throng::recording
