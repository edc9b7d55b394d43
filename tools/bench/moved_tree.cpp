// SPDX-License-Identifier: MIT
#include "tools/bench/moved_tree.h"

#include <cmath>
#include <limits>

namespace throng::bench {

namespace {

using Eigen::AlignedBox2d;

b2AABB around(const AlignedBox2d& box) {
  constexpr float kUp = std::numeric_limits<float>::infinity();
  const auto below = [](double x) { return std::nextafter(static_cast<float>(x), -kUp); };
  const auto above = [](double x) { return std::nextafter(static_cast<float>(x), kUp); };
  b2AABB result;
  result.lowerBound.Set(below(box.min().x()), below(box.min().y()));
  result.upperBound.Set(above(box.max().x()), above(box.max().y()));
  return result;
}

struct Query {
  const b2DynamicTree& tree;
  std::span<const AlignedBox2d> boxes;
  std::uint32_t row;
  std::vector<broadphase::Pair>& pairs;
  bool QueryCallback(int32 proxy) {
    const auto other = static_cast<std::uint32_t>(reinterpret_cast<std::uintptr_t>(tree.GetUserData(proxy)));
    if (row < other && boxes[row].intersects(boxes[other])) pairs.push_back({row, other});
    return true;
  }
};

}  // namespace

MovedTree::MovedTree(std::span<const AlignedBox2d> boxes) {
  for (std::size_t row = 0; row < boxes.size(); ++row)
    proxies_.push_back(tree_.CreateProxy(around(boxes[row]), reinterpret_cast<void*>(row)));
}

void MovedTree::find(std::span<const AlignedBox2d> boxes, std::vector<broadphase::Pair>& pairs) {
  for (std::size_t row = 0; row < boxes.size(); ++row)
    tree_.MoveProxy(proxies_[row], around(boxes[row]), b2Vec2_zero);
  pairs.clear();
  for (std::uint32_t row = 0; row < boxes.size(); ++row) {
    Query query{tree_, boxes, row, pairs};
    tree_.Query(&query, around(boxes[row]));
  }
}

}  // namespace throng::bench
