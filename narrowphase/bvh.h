// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include "narrowphase/bvh_fit.h"

/// Bounding volume hierarchies: built once a shape, top down, and shared by all bodies that have it.
namespace throng::narrowphase {

/// How a set of things is split in two.
enum class Split {
  middle,  ///< at the midpoint of the longest side of their centres' box
  sah      ///< where the surface area heuristic, in the plane the half-perimeter, expects the least work
};

struct BvhConfig {
  Split split = Split::sah;
  std::uint32_t leaf = 4;  ///< most things in a leaf
};

/// What the hierarchy is built over: a thing's points and by how much it is rounded.
template <int kDim>
struct Thing {
  Point<kDim> low, high;  ///< m, its box without the rounding
  double margin = 0.0;    ///< m
};

/// A place in the tree. An inner node's children stand at `first` and `first + 1`; a leaf holds `count`
/// things from `first` on.
struct Branch {
  std::uint32_t first = 0, count = 0;  ///< count 0: inner
};

/// The tree without volumes: root at 0, children behind their parents.
struct Topology {
  std::vector<Branch> branches;
  std::vector<std::uint32_t> order;  ///< of the things, leaf by leaf
};

/// The deepest that any topology goes: below half of it halves are equal in number.
constexpr std::size_t kDeepestBvh = 128;

/// Binned in 16 over the centres' box (Wald 2007), things of equal centre are halved by number. O(n log n),
/// without recursion; expects 1 to 2^31 things.
template <int kDim>
Topology split(const std::vector<Thing<kDim>>& things, const BvhConfig& config);

template <class Volume>
struct Bvh {
  struct Node {
    Volume volume;
    Branch branch;
    double far = 0.0;  ///< m, from the origin no point of it is farther
  };
  std::vector<Node> nodes;
  std::vector<std::uint32_t> order;  ///< leaf by leaf, which thing
  double reach = 0.0;                ///< m, the largest sum of a thing's coordinates' sizes

  const Volume& root() const { return nodes[0].volume; }
};

/// The hierarchy over `things`, of which `append_points(i, points)` gives the points of thing i. O(n log n);
/// each node fits its own points, in the plane the hull of its children's.
template <class Volume, class AppendPoints>
Bvh<Volume> build_bvh(const std::vector<Thing<Volume::kDimension>>& things, AppendPoints append_points,
                      const BvhConfig& config = {}) {
  constexpr int kDim = Volume::kDimension;
  Topology topology = split<kDim>(things, config);
  Bvh<Volume> tree;
  tree.nodes.resize(topology.branches.size());
  std::vector<Points<kDim>> points(tree.nodes.size());
  std::vector<double> margins(tree.nodes.size(), 0.0);
  for (std::size_t i = tree.nodes.size(); i-- > 0;) {
    const Branch branch = topology.branches[i];
    if (branch.count > 0)
      for (std::size_t k = branch.first; k < branch.first + branch.count; ++k) {
        append_points(topology.order[k], points[i]);
        margins[i] = std::max(margins[i], things[topology.order[k]].margin);
      }
    else
      for (std::size_t child : {branch.first, branch.first + 1}) {
        points[i].insert(points[i].end(), points[child].begin(), points[child].end());
        Points<kDim>().swap(points[child]);
        margins[i] = std::max(margins[i], margins[child]);
      }
    reduce_to_hull<kDim>(points[i]);
    tree.nodes[i].branch = branch;
    enclose(points[i], tree.nodes[i].volume);
    grow(tree.nodes[i].volume, margins[i]);
    for (const Point<kDim>& p : points[i]) tree.nodes[i].far = std::max(tree.nodes[i].far, p.norm());
    tree.nodes[i].far = (1.0 + 0x1p-50) * (tree.nodes[i].far + margins[i]);
  }
  for (const Point<kDim>& p : points[0])
    tree.reach = std::max(tree.reach, p.template lpNorm<1>() + kDim * margins[0]);
  for (typename Bvh<Volume>::Node& node : tree.nodes) grow(node.volume, 0x1p-47 * tree.reach);
  tree.order = std::move(topology.order);
  return tree;
}

}  // namespace throng::narrowphase
