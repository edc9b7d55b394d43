// SPDX-License-Identifier: MIT
#include "broadphase/neighbours.h"

#include <algorithm>
#include <cassert>

#include "broadphase/best_few.h"
#include "broadphase/list_chunks.h"
#include "broadphase/proximity_search.h"

namespace throng::broadphase {

namespace {

Question question_of(const Place& place, const Near& near) {
  assert(near.radius >= 0.0);
  return {place.at, place.heading, near.radius, place.except ? *place.except : kNobody};
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

struct NeighbourSearch::Scratch {
  SpatialOrder spatial_order;
  std::vector<std::uint32_t> order;  // of the places: who is asked after whom
  std::vector<std::size_t> leaf;     // of each in that order, where known
  ListChunks chunks;

  void choose_order(const ProximityTree& tree, const Places& places);
  void ask(std::size_t first, std::size_t end, const ProximityTree& tree, const Places& places,
           const Near& near, Answers& answers) const;
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
  Team team(threads);
  scratch.chunks.find(scratch.order, team, lists, [&](std::size_t first, std::size_t end, Answers& answers) {
    scratch.ask(first, end, tree, places, near, answers);
  });
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

void NeighbourSearch::Scratch::ask(std::size_t first, std::size_t end, const ProximityTree& tree,
                                   const Places& places, const Near& near, Answers& answers) const {
  answers.questions.clear();
  for (std::size_t i = first; i < end; ++i) {
    const std::uint32_t place = order[i];
    answers.questions.push_back(
        {places.at[place], places.heading.empty() ? Point(0.0, 0.0) : places.heading[place],
         places.radius.empty() ? near.radius : places.radius[place],
         places.own ? *places.own + std::uint64_t{place} : kNobody, leaf.empty() ? kNoLeaf : leaf[i]});
    assert(answers.questions.back().radius >= 0.0);
  }
  search(tree, near, answers);
}

}  // namespace throng::broadphase
