// SPDX-License-Identifier: MIT
#include "sim/contact/block_order.h"

#include <algorithm>

namespace throng {

namespace {
/// So many blocks lie between two that share a body: the processor works on them at the same time, and the
/// later one needn't wait for what the earlier one writes.
constexpr std::uint32_t kApart = 3;
}  // namespace

void BlockOrder::start(std::size_t bodies) {
  if (free_from_.size() != bodies || !filled_.empty()) free_from_.assign(bodies, 0);
  for (Ways& ways : next_open_) ways.clear();
  filled_.clear();
  first_open_ = 0;
}

std::uint32_t BlockOrder::place(std::uint32_t a, bool a_moves, std::uint32_t b, bool b_moves,
                                std::size_t kind) {
  const std::uint32_t after = std::max(a_moves ? free_from_[a] : 0, b_moves ? free_from_[b] : 0);
  const std::uint32_t block = open_from(std::max(after, first_open_), kind);
  if (a_moves) free_from_[a] = block + kApart;
  if (b_moves) free_from_[b] = block + kApart;
  const std::uint32_t lane = filled_[block]++;
  if (filled_[block] == kWidth) next_open_[kind][block] = block + 1;
  while (first_open_ < filled_.size() && filled_[first_open_] == kWidth) ++first_open_;
  return static_cast<std::uint32_t>(block * kWidth + lane);
}

/// The first block from there on that has room for the kind. Ways get shorter as they are walked.
std::uint32_t BlockOrder::open_from(std::uint32_t block, std::size_t kind) {
  Ways& ways = next_open_[kind];
  while (true) {
    while (block >= filled_.size()) add_block(kind);
    const std::uint32_t next = ways[block];
    if (next == block) return block;
    if (next < filled_.size()) ways[block] = ways[next];
    block = next;
  }
}

void BlockOrder::add_block(std::size_t kind) {
  const auto block = static_cast<std::uint32_t>(filled_.size());
  for (std::size_t k = 0; k < kKinds; ++k) next_open_[k].push_back(k == kind ? block : block + 1);
  filled_.push_back(0);
}

}  // namespace throng
