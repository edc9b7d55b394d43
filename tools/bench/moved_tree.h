// SPDX-License-Identifier: MIT
#pragma once

#include <box2d/b2_dynamic_tree.h>

#include <Eigen/Geometry>
#include <span>
#include <vector>

#include "broadphase/pairs.h"

namespace throng::bench {

/// Box2D's tree as Box2D keeps it: built once, its boxes moved where they leave their margin. They are in
/// float, a hair larger; what the tree finds is then tested in double.
class MovedTree {
 public:
  explicit MovedTree(std::span<const Eigen::AlignedBox2d> boxes);

  /// Moves the boxes to `boxes`, as many as there were, and replaces `pairs` by all that share a point.
  void find(std::span<const Eigen::AlignedBox2d> boxes, std::vector<broadphase::Pair>& pairs);

 private:
  b2DynamicTree tree_;
  std::vector<int32> proxies_;
};

}  // namespace throng::bench
