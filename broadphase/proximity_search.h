// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "broadphase/neighbours.h"

/// Inside of `neighbours.h`: the search of a tree, for the widest SIMD that the machine has.
namespace throng::broadphase {

constexpr std::uint64_t kNobody = std::numeric_limits<std::uint64_t>::max();  // no row is as large
constexpr std::size_t kNoLeaf = std::numeric_limits<std::size_t>::max();

/// One question.
struct Question {
  Point at, heading;
  double radius;
  std::uint64_t except = kNobody;
  std::size_t leaf = kNoLeaf;  ///< where it is asked, if known: decides speed only
};

/// Questions, and the answers to them, one after the other.
struct Answers {
  std::vector<Question> questions;
  std::vector<std::uint32_t> row;
  std::vector<double> distance;
  std::vector<std::uint32_t> count;  ///< of each question
  std::size_t size = 0;              ///< of `row` and `distance` in use

  std::vector<double> key;  ///< what is found, before it is brought into order
  std::vector<std::uint64_t> who;
  std::vector<Neighbour> best;
  std::vector<std::uint32_t> parents;  ///< of the leaves near some questions
};

/// Appends the answers to all of `answers.questions`, in order.
void search(const ProximityTree& tree, const Near& near, Answers& answers);

/// Calls `call` for all that is found.
void search(const ProximityTree& tree, const Question& question, const Near& near, NeighbourCall call,
            void* context);

/// Fills `best`, which has room for `near.most` > 0; returns how many it found, ascending.
std::size_t search(const ProximityTree& tree, const Question& question, const Near& near, Neighbour* best);

}  // namespace throng::broadphase
