// SPDX-License-Identifier: MIT
#include "broadphase/neighbours.h"

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cassert>

#include "broadphase/best_few.h"
#include "broadphase/proximity_search.h"

namespace throng::broadphase {

namespace {

constexpr std::size_t kChunk = 512;  // questions that are answered together: enough work to hand over

Question question_of(const Place& place, const Near& near) {
  assert(near.radius >= 0.0);
  return {place.at, place.heading, near.radius, place.except ? *place.except : kNobody};
}

/// Calls `f(i)` for every chunk of n questions.
template <class F>
void for_each_chunk(std::size_t n, int threads, F&& f) {
  const std::size_t chunks = (n + kChunk - 1) / kChunk;
  if (threads <= 1 || chunks <= 1) {
    for (std::size_t i = 0; i < chunks; ++i) f(i);
    return;
  }
  tbb::task_arena(threads).execute([&] { tbb::parallel_for(std::size_t{0}, chunks, f); });
}

}  // namespace

void find_near(const ProximityTree& tree, const Place& place, const Near& near,
               std::vector<Neighbour>& neighbours) {
  neighbours.clear();
  if (near.most == 0) return;
  if (near.most < tree.size()) {
    neighbours.resize(near.most);
    neighbours.resize(search(tree, question_of(place, near), near, neighbours.data()));
    return;
  }
  for_each_near(tree, place, near, [&](std::uint32_t row, double distance) {
    neighbours.push_back({row, distance});
  });
  std::sort(neighbours.begin(), neighbours.end(), nearer);
}

void for_each_near(const ProximityTree& tree, const Place& place, const Near& near, NeighbourCall call,
                   void* context) {
  search(tree, question_of(place, near), near, call, context);
}

/// Chunk i holds the answers to questions order[512 i] on.
struct NeighbourSearch::Scratch {
  SpatialOrder spatial_order;
  std::vector<std::uint32_t> order;  // of the places: who is asked after whom
  std::vector<std::size_t> leaf;     // of each in that order, where known
  std::vector<std::vector<Question>> questions;
  std::vector<Answers> answers;

  void choose_order(const ProximityTree& tree, const Places& places);
  void ask(std::size_t chunk, const ProximityTree& tree, const Places& places, const Near& near);
  void count(std::size_t chunk, NeighbourLists& lists) const;
  void copy(std::size_t chunk, NeighbourLists& lists) const;
};

NeighbourSearch::NeighbourSearch() : scratch_(std::make_unique<Scratch>()) {}
NeighbourSearch::~NeighbourSearch() = default;
NeighbourSearch::NeighbourSearch(NeighbourSearch&&) noexcept = default;
NeighbourSearch& NeighbourSearch::operator=(NeighbourSearch&&) noexcept = default;

void NeighbourSearch::find(const ProximityTree& tree, const Places& places, const Near& near,
                           NeighbourLists& lists, int threads) {
  const std::size_t n = places.at.size();
  assert(places.heading.empty() || places.heading.size() == n);
  assert(places.radius.empty() || places.radius.size() == n);
  Scratch& scratch = *scratch_;
  if (near.most == 0) {
    lists.begin.assign(n + 1, 0);
    lists.row.clear();
    lists.distance.clear();
    return;
  }
  scratch.choose_order(tree, places);
  const std::size_t chunks = (n + kChunk - 1) / kChunk;
  if (scratch.answers.size() < chunks) {
    scratch.questions.resize(chunks);
    scratch.answers.resize(chunks);
  }
  lists.begin.assign(n + 1, 0);
  for_each_chunk(n, threads, [&](std::size_t i) {
    scratch.ask(i, tree, places, near);
    scratch.count(i, lists);
  });
  for (std::size_t i = 0; i < n; ++i) lists.begin[i + 1] += lists.begin[i];
  lists.row.resize(lists.begin[n]);
  lists.distance.resize(lists.begin[n]);
  for_each_chunk(n, threads, [&](std::size_t i) { scratch.copy(i, lists); });
}

/// Rows of the tree are asked in the tree's own order, other places along a curve through them.
void NeighbourSearch::Scratch::choose_order(const ProximityTree& tree, const Places& places) {
  leaf.clear();
  if (!places.own) {
    spatial_order.sort(places.at, order);
    return;
  }
  assert(*places.own + places.at.size() <= tree.size());
  order.clear();
  for (std::size_t i = 0; i < tree.order.size(); ++i) {
    const std::size_t place = tree.order[i] - std::size_t{*places.own};  // huge for rows before the first
    if (place >= places.at.size()) continue;
    order.push_back(static_cast<std::uint32_t>(place));
    leaf.push_back(i / ProximityTree::kWidth);
  }
}

void NeighbourSearch::Scratch::ask(std::size_t chunk, const ProximityTree& tree, const Places& places,
                                   const Near& near) {
  std::vector<Question>& list = questions[chunk];
  list.clear();
  const std::size_t begin = chunk * kChunk, end = std::min(begin + kChunk, order.size());
  for (std::size_t i = begin; i < end; ++i) {
    const std::uint32_t place = order[i];
    list.push_back({places.at[place], places.heading.empty() ? Point(0.0, 0.0) : places.heading[place],
                    places.radius.empty() ? near.radius : places.radius[place],
                    places.own ? *places.own + std::uint64_t{place} : kNobody,
                    leaf.empty() ? kNoLeaf : leaf[i]});
    assert(list.back().radius >= 0.0);
  }
  answers[chunk].size = 0;
  answers[chunk].count.clear();
  search(tree, list, near, answers[chunk]);
}

void NeighbourSearch::Scratch::count(std::size_t chunk, NeighbourLists& lists) const {
  const std::vector<std::uint32_t>& counts = answers[chunk].count;
  for (std::size_t i = 0; i < counts.size(); ++i) lists.begin[order[chunk * kChunk + i] + 1] = counts[i];
}

void NeighbourSearch::Scratch::copy(std::size_t chunk, NeighbourLists& lists) const {
  const Answers& from = answers[chunk];
  std::size_t at = 0;
  for (std::size_t i = 0; i < from.count.size(); ++i) {
    const std::size_t to = lists.begin[order[chunk * kChunk + i]], n = from.count[i];
    std::copy_n(from.row.data() + at, n, lists.row.data() + to);
    std::copy_n(from.distance.data() + at, n, lists.distance.data() + to);
    at += n;
  }
}

}  // namespace throng::broadphase
