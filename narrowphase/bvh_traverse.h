// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cassert>
#include <vector>

#include "narrowphase/bvh.h"

/// Walks through two hierarchies at once; what stands in the leaves is the caller's. `b_in_a` says where the
/// second stands in the frame of the first.
namespace throng::narrowphase {

/// What a query did.
struct BvhCounters {
  std::size_t nodes = 0;   ///< pairs of volumes compared
  std::size_t leaves = 0;  ///< pairs of leaves whose things were compared
};

/// For who doesn't ask: costs nothing.
struct NoCounters {
  struct Nothing {
    void operator++() {}
  } nodes, leaves;
};

/// Calls `ask(counters)`, with those that cost nothing where none are wanted.
template <class Ask>
auto counting(BvhCounters* counters, Ask ask) {
  if (counters != nullptr) return ask(*counters);
  NoCounters none;
  return ask(none);
}

enum class Order {
  depth_first,  ///< the closer child first
  best_first    ///< of all pairs the one that overlaps most: f = d / (rX + rY), d between centres
};

/// Two nodes, to be compared or opened.
struct NodePair {
  std::uint32_t a, b;
};

/// A stack that no topology overflows.
template <class Item>
class TraversalStack {
 public:
  bool empty() const { return size_ == 0; }
  void push(const Item& item) {
    assert(size_ < items_.size());
    items_[size_++] = item;
  }
  Item pop() { return items_[--size_]; }

 private:
  std::array<Item, 2 * kDeepestBvh + 2> items_;
  std::size_t size_ = 0;
};

/// The pair's two halves: the larger node is opened, a leaf never.
template <class Volume>
std::array<NodePair, 2> opened(const Bvh<Volume>& a, const Bvh<Volume>& b, const NodePair& pair) {
  const auto &node_a = a.nodes[pair.a], &node_b = b.nodes[pair.b];
  const bool open_a =
      node_a.branch.count == 0 && (node_b.branch.count > 0 || radius(node_a.volume) > radius(node_b.volume));
  if (open_a) return {NodePair{node_a.branch.first, pair.b}, NodePair{node_a.branch.first + 1, pair.b}};
  return {NodePair{pair.a, node_b.branch.first}, NodePair{pair.a, node_b.branch.first + 1}};
}

template <class Volume>
bool are_leaves(const Bvh<Volume>& a, const Bvh<Volume>& b, const NodePair& pair) {
  return a.nodes[pair.a].branch.count > 0 && b.nodes[pair.b].branch.count > 0;
}

/// Calls `stop = leaf(branch of a, branch of b)` for pairs of leaves whose volumes meet, until one returns
/// true; whether one did. No pair that may touch is left out. Allocates nothing.
template <class Volume, int kDim, class Leaf, class Counters>
bool visit_overlaps(const Bvh<Volume>& a, const Bvh<Volume>& b, const Frame<kDim>& b_in_a, Leaf leaf,
                    Counters& counters) {
  TraversalStack<NodePair> stack;
  stack.push({0, 0});
  while (!stack.empty()) {
    const NodePair pair = stack.pop();
    ++counters.nodes;
    if (apart(a.nodes[pair.a].volume, b.nodes[pair.b].volume, b_in_a)) continue;
    if (are_leaves(a, b, pair)) {
      ++counters.leaves;
      if (leaf(a.nodes[pair.a].branch, b.nodes[pair.b].branch)) return true;
      continue;
    }
    const auto halves = opened(a, b, pair);
    stack.push(halves[1]);
    stack.push(halves[0]);
  }
  return false;
}

/// The same, greedily: of all open pairs the one whose volumes are deepest in each other. Allocates its
/// queue.
template <class Volume, int kDim, class Leaf, class Counters>
bool visit_overlaps_best_first(const Bvh<Volume>& a, const Bvh<Volume>& b, const Frame<kDim>& b_in_a,
                               Leaf leaf, Counters& counters) {
  struct Ranked {
    double f;
    NodePair pair;
  };
  const auto behind = [](const Ranked& x, const Ranked& y) {
    if (x.f != y.f) return x.f > y.f;
    return x.pair.a != y.pair.a ? x.pair.a > y.pair.a : x.pair.b > y.pair.b;
  };
  std::vector<Ranked> queue;
  const auto consider = [&](const NodePair& pair) {
    const Volume &of_a = a.nodes[pair.a].volume, &of_b = b.nodes[pair.b].volume;
    ++counters.nodes;
    if (apart(of_a, of_b, b_in_a)) return;
    const double d = (b_in_a.turn * of_b.centre + b_in_a.shift - of_a.centre).norm();
    const double reach = radius(of_a) + radius(of_b);
    queue.push_back({reach > 0.0 ? d / reach : 0.0, pair});
    std::push_heap(queue.begin(), queue.end(), behind);
  };
  consider({0, 0});
  while (!queue.empty()) {
    const NodePair pair = queue.front().pair;
    std::pop_heap(queue.begin(), queue.end(), behind);
    queue.pop_back();
    if (are_leaves(a, b, pair)) {
      ++counters.leaves;
      if (leaf(a.nodes[pair.a].branch, b.nodes[pair.b].branch)) return true;
      continue;
    }
    for (const NodePair& half : opened(a, b, pair)) consider(half);
  }
  return false;
}

/// Below what bound a pair must be opened, when `upper` is known and the answer may be off by
/// `relative_error`.
inline double worth_opening(double upper, double relative_error) {
  return upper > 0.0 ? upper / (1.0 + relative_error) : upper;
}

/// The least of what `upper = leaf(branch of a, branch of b, upper)` finds over all pairs of leaves: depth
/// first, the closer pair first, nothing opened whose bound is not below upper / (1 + relative_error).
/// `upper` comes in as what is already known. Returns a lower bound of the least, `upper` itself where
/// relative_error is 0. Stops where the least is `enough` or less. Allocates nothing.
template <class Volume, int kDim, class Leaf, class Counters>
double minimise(const Bvh<Volume>& a, const Bvh<Volume>& b, const Frame<kDim>& b_in_a, double relative_error,
                double enough, double& upper, Leaf leaf, Counters& counters) {
  struct Bounded {
    double bound;
    NodePair pair;
  };
  double least_skipped = std::numeric_limits<double>::infinity();
  const auto bounded = [&](const NodePair& pair) {
    ++counters.nodes;
    const double enough_to_skip = worth_opening(upper, relative_error);
    return Bounded{bound(a.nodes[pair.a].volume, b.nodes[pair.b].volume, b_in_a, enough_to_skip), pair};
  };
  if (upper <= enough) return upper;
  TraversalStack<Bounded> stack;
  stack.push(bounded({0, 0}));
  while (!stack.empty()) {
    const Bounded top = stack.pop();
    if (top.bound >= worth_opening(upper, relative_error)) {
      least_skipped = std::min(least_skipped, top.bound);
      continue;
    }
    if (are_leaves(a, b, top.pair)) {
      ++counters.leaves;
      upper = leaf(a.nodes[top.pair.a].branch, b.nodes[top.pair.b].branch, upper);
      if (upper <= enough) return upper;
      continue;
    }
    const auto halves = opened(a, b, top.pair);
    const Bounded first = bounded(halves[0]), second = bounded(halves[1]);
    stack.push(first.bound <= second.bound ? second : first);
    stack.push(first.bound <= second.bound ? first : second);
  }
  return std::min(upper, least_skipped);
}

/// The same for a point in the hierarchy's frame, exact and in squares: `squared = leaf(branch, squared)`.
template <class Volume, int kDim, class Leaf, class Counters>
void minimise_to_point(const Bvh<Volume>& tree, const Point<kDim>& point, double& squared, Leaf leaf,
                       Counters& counters) {
  struct Bounded {
    double bound;
    std::uint32_t node;
  };
  constexpr double kRounding = 1.0 - 0x1p-46;
  const auto bounded = [&](std::uint32_t node) {
    ++counters.nodes;
    return Bounded{kRounding * squared_bound(tree.nodes[node].volume, point), node};
  };
  TraversalStack<Bounded> stack;
  stack.push(bounded(0));
  while (!stack.empty()) {
    Bounded top = stack.pop();
    while (top.bound < squared) {
      const Branch branch = tree.nodes[top.node].branch;
      if (branch.count > 0) {
        ++counters.leaves;
        squared = leaf(branch, squared);
        break;
      }
      const Bounded left = bounded(branch.first), right = bounded(branch.first + 1);
      const bool left_first = left.bound <= right.bound;
      stack.push(left_first ? right : left);
      top = left_first ? left : right;
    }
  }
}

}  // namespace throng::narrowphase
