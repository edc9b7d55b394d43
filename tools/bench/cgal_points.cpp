// SPDX-License-Identifier: MIT
#include "tools/bench/cgal_points.h"

#include <CGAL/Fuzzy_sphere.h>
#include <CGAL/Kd_tree.h>
#include <CGAL/Orthogonal_k_neighbor_search.h>
#include <CGAL/Search_traits_2.h>
#include <CGAL/Search_traits_adapter.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/property_map.h>

#include <algorithm>
#include <cmath>

namespace throng::bench {

namespace {

constexpr int kBucket = 10;  // points of a leaf, as nanoflann has

using Kernel = CGAL::Simple_cartesian<double>;
using Item = std::pair<Kernel::Point_2, std::uint32_t>;
using Place = CGAL::First_of_pair_property_map<Item>;
using PlaneTraits = CGAL::Search_traits_2<Kernel>;
using Traits = CGAL::Search_traits_adapter<Item, Place, PlaneTraits>;
using Splitter = CGAL::Sliding_midpoint<Traits>;
using KdTree = CGAL::Kd_tree<Traits, Splitter, CGAL::Tag_true, CGAL::Tag_true>;  // with coordinates at hand
using PlaceDistance = CGAL::Distance_adapter<Item, Place, CGAL::Euclidean_distance<PlaneTraits>>;
using Nearest = CGAL::Orthogonal_k_neighbor_search<Traits, PlaceDistance, Splitter, KdTree>;
using Neighbours = std::vector<std::pair<double, std::uint32_t>>;  // squared distance (m²), row

void within(const KdTree& tree, const Item& item, double radius, std::vector<Item>& hits, Neighbours& found) {
  hits.clear();
  tree.search(std::back_inserter(hits), CGAL::Fuzzy_sphere<Traits>(item, radius));
  for (const Item& hit : hits) found.emplace_back(CGAL::squared_distance(item.first, hit.first), hit.second);
  std::ranges::sort(found, {}, &Neighbours::value_type::first);
}

void nearest(const KdTree& tree, const Item& item, std::size_t most, Neighbours& found) {
  const Nearest search(tree, item.first, static_cast<unsigned>(most + 1));
  for (auto it = search.begin(); it != search.end(); ++it) found.emplace_back(it->second, it->first.second);
}

}  // namespace

void cgal_neighbours(const std::vector<broadphase::Point>& points, const broadphase::Near& near,
                     broadphase::NeighbourLists& lists) {
  std::vector<Item> items, hits;
  for (const broadphase::Point& p : points)
    items.emplace_back(Kernel::Point_2(p.x(), p.y()), static_cast<std::uint32_t>(items.size()));
  KdTree tree(items.begin(), items.end(), Splitter(kBucket));
  tree.build();
  lists.begin.assign(1, 0);
  lists.row.clear();
  lists.distance.clear();
  Neighbours found;
  for (const Item& item : items) {
    found.clear();
    if (near.most < points.size())
      nearest(tree, item, near.most, found);
    else
      within(tree, item, near.radius, hits, found);
    for (const auto& [squared, row] : found)
      if (row != item.second) {
        lists.row.push_back(row);
        lists.distance.push_back(std::sqrt(squared));
      }
    lists.begin.push_back(lists.row.size());
  }
}

}  // namespace throng::bench
