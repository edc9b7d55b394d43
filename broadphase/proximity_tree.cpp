// SPDX-License-Identifier: MIT
#include "broadphase/proximity_tree.h"

#include <algorithm>
#include <cassert>
#include <limits>

namespace throng::broadphase {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr std::size_t kWidth = ProximityTree::kWidth;

std::size_t parents(std::size_t count) {
  return (count + kWidth - 1) / kWidth;
}

Box child(const ProximityTree::Node& node, std::size_t i) {
  return {Point(node.low_x[i], node.low_y[i]), Point(node.high_x[i], node.high_y[i])};
}

void set_child(ProximityTree::Node& node, std::size_t i, const Box& box) {
  node.low_x[i] = box.isEmpty() ? kInfinity : box.min().x();
  node.low_y[i] = box.isEmpty() ? kInfinity : box.min().y();
  node.high_x[i] = box.isEmpty() ? -kInfinity : box.max().x();
  node.high_y[i] = box.isEmpty() ? -kInfinity : box.max().y();
}

/// Fills `parent`, a row of eight a node, from the values of the leaves' rows upwards.
template <class Rows, class Merge>
void fill_upwards(const ProximityTree& tree, const Rows& leaf, Rows& parent, Merge merge) {
  parent.assign(tree.nodes.size(), {});
  for (std::size_t level = 0; level + 1 < tree.level.size(); ++level) {
    const Rows& below = level == 0 ? leaf : parent;
    const std::size_t first = level == 0 ? 0 : tree.level[level - 1];
    const std::size_t count = level == 0 ? leaf.size() : tree.level[level] - first;
    for (std::size_t i = 0; i < count; ++i) {
      auto& whole = parent[tree.level[level] + i / kWidth].of[i % kWidth];
      for (const auto part : below[first + i].of) whole = merge(whole, part);
    }
  }
}

}  // namespace

void ProximityTree::build(std::span<const Point> points, const Period* in, GroupBits groups) {
  kind = Kind::points;
  place(points, in);
  fill_nodes();
  fill_first_rows();
  fill_groups(groups);
}

void ProximityTree::build(std::span<const Point> centres, std::span<const double> radius, const Period* in,
                          GroupBits groups) {
  assert(centres.size() == radius.size());
  kind = Kind::discs;
  place(centres, in);
  fill_nodes();
  fill_first_rows();
  fill_radii(radius);
  fill_groups(groups);
}

void ProximityTree::build(std::span<const Box> boxes, GroupBits groups) {
  kind = Kind::boxes;
  places_.resize(boxes.size());
  for (std::size_t row = 0; row < boxes.size(); ++row) places_[row] = boxes[row].center();
  place(places_, nullptr);
  leaf_high.assign(leaves.size(), {});
  for (std::size_t i = 0; i < order.size(); ++i) {
    const Box& box = boxes[order[i]];
    leaves[i / kWidth].x[i % kWidth] = box.min().x();
    leaves[i / kWidth].y[i % kWidth] = box.min().y();
    leaf_high[i / kWidth].x[i % kWidth] = box.max().x();
    leaf_high[i / kWidth].y[i % kWidth] = box.max().y();
  }
  fill_nodes();
  fill_first_rows();
  fill_groups(groups);
}

void ProximityTree::place(std::span<const Point> places, const Period* in) {
  assert(places.size() < std::size_t{1} << 31);
  periodic = in != nullptr;
  if (in) period = *in;
  spatial_order_.sort(places, order);
  fill_leaves(places);
}

void ProximityTree::fill_leaves(std::span<const Point> places) {
  leaves.resize(parents(order.size()));
  for (std::size_t i = 0; i < leaves.size() * kWidth; ++i) {
    Leaf& leaf = leaves[i / kWidth];
    const bool used = i < order.size();
    leaf.x[i % kWidth] = used ? places[order[i]].x() : kInfinity;
    leaf.y[i % kWidth] = used ? places[order[i]].y() : kInfinity;
    leaf.row[i % kWidth] = used ? order[i] : 0;
  }
}

void ProximityTree::fill_nodes() {
  level.clear();
  std::size_t count = leaves.size(), sum = 0;
  if (count > 0) do {
      level.push_back(sum);
      sum += count = parents(count);
    } while (count > 1);
  level.push_back(sum);
  nodes.resize(sum);
  const auto leaf_box = [this](std::size_t i) {
    Box box;
    for (std::size_t k = 0; k < kWidth && i * kWidth + k < order.size(); ++k) {
      box.extend(Point(leaves[i].x[k], leaves[i].y[k]));
      if (kind == Kind::boxes) box.extend(Point(leaf_high[i].x[k], leaf_high[i].y[k]));
    }
    return box;
  };
  const auto node_box = [this](std::size_t i) {
    Box box;
    for (std::size_t k = 0; k < kWidth; ++k) box.extend(child(nodes[i], k));
    return box;
  };
  for (std::size_t l = 0; l + 1 < level.size(); ++l)
    for (std::size_t i = level[l]; i < level[l + 1]; ++i)
      for (std::size_t k = 0; k < kWidth; ++k) {
        const std::size_t below = (i - level[l]) * kWidth + k;
        const std::size_t end = l == 0 ? leaves.size() : level[l] - level[l - 1];
        set_child(nodes[i], k,
                  below >= end ? Box()
                  : l == 0     ? leaf_box(below)
                               : node_box(level[l - 1] + below));
      }
}

void ProximityTree::fill_first_rows() {
  first_row.resize(nodes.size());
  for (std::size_t l = 0; l + 1 < level.size(); ++l)
    for (std::size_t i = level[l]; i < level[l + 1]; ++i)
      for (std::size_t k = 0; k < kWidth; ++k) {
        const std::size_t below = (i - level[l]) * kWidth + k;
        std::uint32_t& first = first_row[i].of[k] = std::numeric_limits<std::uint32_t>::max();
        if (l == 0)
          for (std::size_t at = below * kWidth; at < std::min((below + 1) * kWidth, order.size()); ++at)
            first = std::min(first, order[at]);
        else if (below < level[l] - level[l - 1])
          first = *std::ranges::min_element(first_row[level[l - 1] + below].of);
      }
}

void ProximityTree::fill_radii(std::span<const double> radius) {
  leaf_radius.assign(leaves.size(), {});
  for (std::size_t i = 0; i < order.size(); ++i) {
    assert(radius[order[i]] >= 0.0);
    leaf_radius[i / kWidth].of[i % kWidth] = radius[order[i]];
  }
  fill_upwards(*this, leaf_radius, node_radius, [](double a, double b) { return std::max(a, b); });
}

void ProximityTree::fill_groups(GroupBits groups) {
  leaf_groups.clear();
  node_groups.clear();
  if (groups.empty()) return;
  assert(groups.size() == order.size());
  leaf_groups.assign(leaves.size(), {});
  for (std::size_t i = 0; i < order.size(); ++i) leaf_groups[i / kWidth].of[i % kWidth] = groups[order[i]];
  fill_upwards(*this, leaf_groups, node_groups, [](std::uint64_t a, std::uint64_t b) { return a | b; });
}

}  // namespace throng::broadphase
