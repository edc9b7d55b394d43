// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <functional>
#include <limits>
#include <vector>

#include "tools/bench/rows.h"

/// How the engines of `throng bench motion` are asked and timed: some answer a thousand queries while others
/// are at their first.
namespace throng::bench {

inline constexpr double kAllOfThem = std::numeric_limits<double>::infinity();  ///< s, that asking may take

/// Calls `ask` with 0, 1, ... until `queries` are answered, or one at least and `seconds` have passed.
template <class Ask>
void ask_in_turn(std::size_t queries, double seconds, const Ask& ask) {
  const std::chrono::duration<double> affordable(seconds);
  const auto begin = std::chrono::steady_clock::now();
  for (std::size_t i = 0; i < queries; ++i) {
    ask(i);
    if (std::chrono::steady_clock::now() - begin > affordable) break;
  }
}

/// Answers one query, by a number of its answer.
using AskOne = std::function<double(std::size_t query)>;

/// Times each row's engine on the first `work` queries, which it has answered, in `blocks` interleaved
/// blocks. Expects the first row to have answered all. Who has answered fewer is compared with the first on
/// these alone: its ratio is to that, and `error` says which share was `asked`, and the `first_ns` of them.
void time_rows(std::vector<Row>& rows, const std::vector<AskOne>& engines, int blocks);

}  // namespace throng::bench
