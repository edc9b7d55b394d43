// SPDX-License-Identifier: MIT
#include "tools/bench/pair_peers.h"

#include <box2d/b2_dynamic_tree.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <nanoflann.hpp>

#include "tools/bench/dataset.h"

namespace throng::bench {

namespace {

using broadphase::Pair;
using broadphase::Point;

/// The squared distance at which two rows of a cloud still are a pair.
double most(const Cloud& cloud, std::size_t i, std::size_t j) {
  const double reach = cloud.radii.empty() ? cloud.reach : cloud.radii[i] + cloud.radii[j];
  return reach * reach;
}

/// As nanoflann wants its results' keeper: it is told of points nearer than worstDist().
struct Keeper {
  const Cloud& cloud;
  std::vector<Pair>& pairs;
  std::uint32_t row;
  double worst;
  double worstDist() const { return worst; }
  bool full() const { return true; }
  std::size_t size() const { return pairs.size(); }
  bool addPoint(double squared, std::uint32_t other) {
    if (row < other && squared <= most(cloud, row, other)) pairs.push_back({row, other});
    return true;
  }
};

struct TreeQuery {
  const Cloud& cloud;
  const b2DynamicTree& tree;
  std::vector<Pair>& pairs;
  std::uint32_t row;
  bool QueryCallback(int32 proxy) {
    const auto other = static_cast<std::uint32_t>(reinterpret_cast<std::uintptr_t>(tree.GetUserData(proxy)));
    if (row < other && (cloud.points[row] - cloud.points[other]).squaredNorm() <= most(cloud, row, other))
      pairs.push_back({row, other});
    return true;
  }
};

b2AABB box(const Point& p, double half) {
  constexpr float up = std::numeric_limits<float>::infinity();
  b2AABB box;
  box.lowerBound.Set(std::nextafter(static_cast<float>(p.x() - half), -up),
                     std::nextafter(static_cast<float>(p.y() - half), -up));
  box.upperBound.Set(std::nextafter(static_cast<float>(p.x() + half), up),
                     std::nextafter(static_cast<float>(p.y() + half), up));
  return box;
}

}  // namespace

void find_with_nanoflann(const Cloud& cloud, std::vector<Pair>& pairs) {
  using Metric = nanoflann::L2_Simple_Adaptor<double, Dataset, double, std::uint32_t>;
  using Tree = nanoflann::KDTreeSingleIndexAdaptor<Metric, Dataset, 2, std::uint32_t>;
  const Dataset dataset{cloud.points};
  const Tree tree(2, dataset);
  const double widest = cloud.radii.empty() ? 0.0 : *std::max_element(cloud.radii.begin(), cloud.radii.end());
  pairs.clear();
  for (std::uint32_t row = 0; row < cloud.points.size(); ++row) {
    const double reach = cloud.radii.empty() ? cloud.reach : cloud.radii[row] + widest;
    Keeper keeper{cloud, pairs, row, std::nextafter(reach * reach, 2.0 * reach * reach)};
    tree.findNeighbors(keeper, cloud.points[row].data(), nanoflann::SearchParams());
  }
}

void find_with_box2d_tree(const Cloud& cloud, std::vector<Pair>& pairs) {
  b2DynamicTree tree;
  const auto half = [&](std::size_t row) {
    return cloud.radii.empty() ? 0.5 * cloud.reach : cloud.radii[row];
  };
  for (std::size_t row = 0; row < cloud.points.size(); ++row)
    tree.CreateProxy(box(cloud.points[row], half(row)), reinterpret_cast<void*>(row));
  pairs.clear();
  for (std::uint32_t row = 0; row < cloud.points.size(); ++row) {
    TreeQuery query{cloud, tree, pairs, row};
    tree.Query(&query, box(cloud.points[row], half(row)));
  }
}

}  // namespace throng::bench
