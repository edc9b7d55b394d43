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

/// Sorts the few pairs of one row by insertion, the many of a crowded one as anybody would.
void sort_by_b(Pair* begin, Pair* end) {
  if (end - begin > 24) {
    std::sort(begin, end, lower_b);
    return;
  }
  for (Pair* next = begin + 1; next < end; ++next) {
    const Pair pair = *next;
    Pair* place = next;
    for (; place != begin && pair.b < place[-1].b; --place) *place = place[-1];
    *place = pair;
  }
}

}  // namespace

void PairSorter::sort(std::span<const Pair> found, std::size_t rows, std::vector<Pair>& sorted) {
  assert(found.size() < std::numeric_limits<std::uint32_t>::max());
  next_.assign(rows, 0);
  for (const Pair& pair : found) ++next_[pair.a];
  std::uint32_t sum = 0;
  for (std::uint32_t& next : next_) {
    const std::uint32_t count = next;
    next = sum;
    sum += count;
  }
  sorted.resize(found.size());
  for (const Pair& pair : found) sorted[next_[pair.a]++] = pair;
  std::uint32_t begin = 0;
  for (const std::uint32_t end : next_) {
    if (end - begin > 1) sort_by_b(sorted.data() + begin, sorted.data() + end);
    begin = end;
  }
}

}  // namespace throng::broadphase
