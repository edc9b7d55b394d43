// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "broadphase/neighbours.h"
#include "broadphase/proximity_search.h"
#include "broadphase/team.h"

namespace throng::broadphase {

/// Copies answers, one after the other, to the lists of `rows`, whose places lists.begin tells.
inline void copy_lists(const Answers& from, std::span<const std::uint32_t> rows, NeighbourLists& lists) {
  std::size_t at = 0;
  for (const std::uint32_t row : rows) {
    const std::size_t to = lists.begin[row], n = lists.begin[row + std::size_t{1}] - to;
    std::copy_n(from.row.data() + at, n, lists.row.data() + to);
    std::copy_n(from.distance.data() + at, n, lists.distance.data() + to);
    at += n;
  }
}

/// Finds lists some hundred at a time, in an order that suits the search, and brings them into their own.
class ListChunks {
 public:
  /// Replaces list order[i] of `lists` by answer i, for all i below order.size(), which `order` permutes.
  /// `ask(first, end, answers)` appends answers [first, end) to empty ones; threads call it at once.
  template <class Ask>
  void find(std::span<const std::uint32_t> order, Team& team, NeighbourLists& lists, Ask&& ask);

 private:
  static constexpr std::size_t kChunk = 512;  // lists: enough work to hand over

  std::vector<Answers> answers_;
};

template <class Ask>
void ListChunks::find(std::span<const std::uint32_t> order, Team& team, NeighbourLists& lists, Ask&& ask) {
  const std::size_t n = order.size(), chunks = (n + kChunk - 1) / kChunk;
  if (answers_.size() < chunks) answers_.resize(chunks);
  lists.begin.assign(n + 1, 0);
  team.for_each(chunks, [&](std::size_t i) {
    answers_[i].size = 0;
    answers_[i].count.clear();
    ask(i * kChunk, std::min((i + 1) * kChunk, n), answers_[i]);
    const std::vector<std::uint32_t>& count = answers_[i].count;
    for (std::size_t k = 0; k < count.size(); ++k)
      lists.begin[order[i * kChunk + k] + std::size_t{1}] = count[k];
  });
  for (std::size_t i = 0; i < n; ++i) lists.begin[i + 1] += lists.begin[i];
  lists.row.resize(lists.begin[n]);
  lists.distance.resize(lists.begin[n]);
  team.for_each(chunks, [&](std::size_t i) {
    copy_lists(answers_[i], order.subspan(i * kChunk, std::min(kChunk, n - i * kChunk)), lists);
  });
}

}  // namespace throng::broadphase
