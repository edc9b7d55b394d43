// SPDX-License-Identifier: MIT
#include "broadphase/higher_rows.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "broadphase/higher_rows.cpp"
#include <hwy/cache_control.h>
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <algorithm>
#include <cassert>
#include <limits>

#include "broadphase/row_network-inl.h"

HWY_BEFORE_NAMESPACE();
namespace throng::broadphase::HWY_NAMESPACE {

static_assert(RowNetwork::kMost <= HigherRows::kRoom);

/// Writes the pairs of one row after the other.
Pair* write_rows(HigherRows& higher, std::size_t first, std::size_t end, const RowNetwork& network,
                 Pair* out) {
  for (std::size_t row = first; row < end; ++row) {
    const auto own = static_cast<std::uint32_t>(row);
    const std::uint32_t count = higher.of[row].count;
    std::uint32_t* const list = higher.rows.all().data() + higher.of[row].begin;
    if (count <= RowNetwork::kMost) {
      network.write(own, list, count, out);
    } else {
      std::sort(list, list + count);
      std::transform(list, list + count, out, [own](std::uint32_t b) { return Pair{own, b}; });
    }
    out += count;
  }
  return out;
}

/// Writes all pairs, ascending, and up to RowNetwork::kMost of rubbish behind; returns behind the last.
Pair* write_ascending(HigherRows& higher, Pair* out) {
  constexpr std::size_t kAhead = 16;  // rows, from when a list is fetched from memory until it is sorted
  const RowNetwork network;
  const std::uint32_t* const rows = higher.rows.all().data();
  const HigherRows::List* const lists = higher.of.data();
  const std::size_t n = higher.of.size();
  std::size_t row = 0;
  for (; row + kTogether <= n; row += kTogether) {
    std::uint32_t longest = 0;
    for (std::size_t i = row; i < row + kTogether; ++i) {
      longest = std::max(longest, lists[i].count);
      const HigherRows::List& soon = lists[std::min(i + kAhead, n - 1)];
      hwy::Prefetch(rows + soon.begin);
      hwy::Prefetch(rows + soon.begin + soon.count);
    }
    out = longest <= RowNetwork::kLanes ? network.write_short(row, lists + row, longest, rows, out)
                                        : write_rows(higher, row, row + kTogether, network, out);
  }
  return write_rows(higher, row, n, network, out);
}

}  // namespace throng::broadphase::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace throng::broadphase {

HWY_EXPORT(write_ascending);

void HigherRows::assign(const PairList& found, std::size_t n) {
  assert(found.size() < std::numeric_limits<std::uint32_t>::max());
  of.assign(n, {0, 0});
  found.for_each([this](const Pair& pair) { ++of[pair.a].begin; });
  std::uint32_t sum = 0;
  for (List& list : of) {
    const std::uint32_t count = list.begin;
    list.begin = sum;
    sum += count;
  }
  rows.clear();
  std::uint32_t* const to = rows.room(sum);
  found.for_each([this, to](const Pair& pair) {
    List& list = of[pair.a];
    to[list.begin + list.count++] = pair.b;
  });
  rows.keep(to + sum);
}

void HigherRows::keep_movable(std::span<const std::uint8_t> movable) {
  std::uint32_t* const all = rows.all().data();
  assert(movable.size() == of.size());
  for (std::size_t row = 0; row < of.size(); ++row) {
    if (movable[row]) continue;
    std::uint32_t* const begin = all + of[row].begin;
    const auto* const end = std::remove_if(begin, begin + of[row].count, [&](auto b) { return !movable[b]; });
    of[row].count = static_cast<std::uint32_t>(end - begin);
  }
}

void HigherRows::write(std::vector<Pair>& pairs) {
  std::size_t count = 0;
  for (const List& list : of) count += list.count;
  rows.room(kRoom);
  pairs.resize(count + kRoom);
  const Pair* const end = HWY_DYNAMIC_DISPATCH(write_ascending)(*this, pairs.data());
  pairs.resize(static_cast<std::size_t>(end - pairs.data()));
}

}  // namespace throng::broadphase
#endif
