// SPDX-License-Identifier: MIT
#include "sim/recording/frame_blocks.h"

#include <algorithm>
#include <cstring>

#include "sim/recording/fletcher32.h"
#include "sim/recording/h5_write.h"
#include "sim/recording/packed.h"

namespace throng::recording {

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

void FrameBlocks::write(std::span<const std::byte> numbers) {
  grow();
  const std::size_t size = per_chunk_ * body_bytes_;
  for (std::size_t at = 0; at < numbers.size(); at += size) {
    const auto part = numbers.subspan(at, std::min(size, numbers.size() - at));
    chunk_.resize(size + sizeof(std::uint32_t));
    std::fill(std::copy(part.begin(), part.end(), chunk_.begin()), chunk_.end(), std::byte{0});
    const std::uint32_t sum = fletcher32(std::span(chunk_).first(size));
    std::memcpy(chunk_.data() + size, &sum, sizeof sum);
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
