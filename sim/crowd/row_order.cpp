// SPDX-License-Identifier: MIT
#include "sim/crowd/row_order.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace throng {

namespace {

/// Calls f(array, row) for each array of the state that has a row per agent, with that of the first.
template <class F>
void for_each_agents_array(State& state, std::size_t first, F f) {
  f(state.id, first), f(state.position, first), f(state.velocity, first);
  f(state.angle, first), f(state.spin, first);
  for_each_agent_array(state.crowd, [&](auto& all) { f(all, std::size_t{0}); });
}

void close_gaps(State& state, std::size_t first, std::span<const std::uint8_t> leaves) {
  for_each_agents_array(state, first, [&](auto& all, std::size_t from) {
    std::size_t row = 0;
    const auto is_gone = [&](const auto&) { return leaves[row++] != 0; };
    all.erase(std::remove_if(all.begin() + static_cast<std::ptrdiff_t>(from), all.end(), is_gone), all.end());
  });
}

void fill_gaps(State& state, std::size_t first, std::span<const std::uint8_t> leaves) {
  std::vector<std::pair<std::size_t, std::size_t>> moves;  // where to, and whence
  std::size_t end = leaves.size();
  for (std::size_t row = 0; row < end; ++row) {
    if (leaves[row] == 0) continue;
    do --end;
    while (end > row && leaves[end] != 0);
    if (end > row) moves.emplace_back(row, end);
  }
  for_each_agents_array(state, first, [&](auto& all, std::size_t from) {
    for (const auto& [to, whence] : moves) all[from + to] = all[from + whence];
    all.resize(from + end);
  });
}

bool is_for_all(const Goal& goal) {
  return goal.phases.empty();
}

bool is_for_all(const Leg& leg) {
  return leg.kind == Leg::Kind::pass && leg.capacity.empty();
}

/// Whether anything follows from who has which row.
bool heeds_rows(const Crowd& crowd) {
  return !crowd.measures.empty() ||
         !std::ranges::all_of(crowd.goals, [](const Goal& goal) { return is_for_all(goal); }) ||
         !std::ranges::all_of(crowd.groups, [](const AgentGroup& group) {
           return std::ranges::all_of(group.journey, [](const Leg& leg) { return is_for_all(leg); });
         });
}

}  // namespace

bool rows_follow(const Crowd& crowd) {
  const auto appears = [](const AgentGroup& group) { return group.entrance && group.count > 0; };
  if (crowd.size() < kSome || std::ranges::any_of(crowd.groups, appears)) return false;
  return crowd.size() >= kMany || !heeds_rows(crowd);
}

void remove_agents(State& state, std::size_t first, std::span<const std::uint8_t> leaves, bool in_order) {
  in_order ? close_gaps(state, first, leaves) : fill_gaps(state, first, leaves);
}

void reorder_agents(State& state, std::size_t first, std::span<const std::uint32_t> order, Workers& workers) {
  for_each_agents_array(state, first, [&](auto& all, std::size_t from) {
    const auto were = std::vector(all.begin() + static_cast<std::ptrdiff_t>(from), all.end());
    workers.for_ranges(order.size(), [&](std::size_t begin, std::size_t end) {
      for (std::size_t k = begin; k < end; ++k) all[from + k] = were[order[k]];
    });
  });
}

}  // namespace throng
