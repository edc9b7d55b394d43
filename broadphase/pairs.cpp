// SPDX-License-Identifier: MIT
#include "broadphase/pairs.h"

#include <algorithm>
#include <cassert>
#include <limits>

namespace throng::broadphase {

namespace {

bool lower_b(const Pair& p, const Pair& q) {
  return p.b < q.b;
}

/// Sorts at most kMost pairs of one row by counting for each `b` how many are lower: no branch depends on
/// them.
template <int kMost>
void sort_by_rank(Pair* begin, int count) {
  std::int32_t b[kMost], rank[kMost] = {};
  std::fill_n(b, kMost, std::numeric_limits<std::int32_t>::max());
  for (int i = 0; i < count; ++i) b[i] = static_cast<std::int32_t>(begin[i].b);  // rows are below 2^31
  for (int j = 0; j < kMost; ++j)
    for (int i = 0; i < kMost; ++i) rank[i] += b[j] < b[i];
  for (int i = 0; i < count; ++i) begin[rank[i]].b = static_cast<std::uint32_t>(b[i]);
}

void sort_by_b(Pair* begin, Pair* end) {
  const auto count = end - begin;
  if (count < 2) return;
  if (count <= 4)
    sort_by_rank<4>(begin, static_cast<int>(count));
  else if (count <= 8)
    sort_by_rank<8>(begin, static_cast<int>(count));
  else if (count <= 16)
    sort_by_rank<16>(begin, static_cast<int>(count));
  else
    std::sort(begin, end, lower_b);
}

}  // namespace

void PairBuffer::grow(std::size_t most) {
  capacity_ = 2 * (count_ + most);
  std::unique_ptr<Pair[]> larger(new Pair[capacity_]);  // not filled with zeros
  std::copy_n(pairs_.get(), count_, larger.get());
  pairs_ = std::move(larger);
}

void PairList::reset(std::size_t buffers) {
  if (buffers_.size() < buffers) buffers_.resize(buffers);
  count_ = buffers;
  for (std::size_t i = 0; i < count_; ++i) buffers_[i].clear();
}

std::size_t PairList::size() const {
  std::size_t sum = 0;
  for (std::size_t i = 0; i < count_; ++i) sum += buffers_[i].size();
  return sum;
}

void PairSorter::sort(const PairList& found, std::size_t rows, std::vector<Pair>& sorted) {
  assert(found.size() < std::numeric_limits<std::uint32_t>::max());
  next_.assign(rows, 0);
  found.for_each([this](const Pair& pair) { ++next_[pair.a]; });
  std::uint32_t sum = 0;
  for (std::uint32_t& next : next_) {
    const std::uint32_t count = next;
    next = sum;
    sum += count;
  }
  sorted.resize(sum);
  found.for_each([&](const Pair& pair) { sorted[next_[pair.a]++] = pair; });
  std::uint32_t begin = 0;
  for (const std::uint32_t end : next_) {
    sort_by_b(sorted.data() + begin, sorted.data() + end);
    begin = end;
  }
}

}  // namespace throng::broadphase
