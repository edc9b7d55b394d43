// SPDX-License-Identifier: MIT
#include "sim/recording/quantized_reader.h"

#include <algorithm>
#include <utility>

#include "sim/recording/packed.h"

namespace throng::recording {

QuantizedReader::QuantizedReader(const h5::File& file, hid_t group, std::size_t bodies)
    : set_(h5::open_dataset<std::uint32_t>(file, group, "position", {std::nullopt, bodies, 2},
                                           h5::Storage::packed)),
      quantum_(h5::read_attribute<double>(group, "quantum")),
      now_(2 * bodies),
      before_(2 * bodies),
      stored_(2 * bodies) {
  if (!(quantum_ >= 1e-9 && quantum_ <= 1e3)) throw h5::Error("quantum is out of range");
  if (h5::read_attribute<std::int64_t>(group, "key_every") != static_cast<std::int64_t>(kKeyEvery))
    throw h5::Error("key_every is unknown");
  if (set_.chunk.size() != 3 || set_.chunk[0] != 1 || set_.chunk[1] == 0 ||
      set_.chunk[1] > std::max<std::size_t>(1, bodies) || set_.chunk[2] != 2)
    throw h5::Error("position is not stored frame by frame");
}

void QuantizedReader::next(std::size_t k) {
  at_ = kNone;
  h5::read_packed_row(set_, k, stored_);
  restore(k, stored_, now_, before_, before_);
  std::swap(now_, before_);
  at_ = k;
}

void QuantizedReader::read(std::size_t k, std::vector<double>& numbers, FrameHash& hash) {
  const std::size_t key = k - k % kKeyEvery;
  if (at_ != k)
    for (std::size_t i = at_ != kNone && at_ >= key && at_ < k ? at_ + 1 : key; i <= k; ++i) next(i);
  hash.add(std::as_bytes(std::span(now_)));
  numbers.resize(now_.size());
  for (std::size_t i = 0; i < now_.size(); ++i) numbers[i] = now_[i] * quantum_;
}

}  // namespace throng::recording
