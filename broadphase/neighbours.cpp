// SPDX-License-Identifier: MIT
#include "broadphase/neighbours.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace throng::broadphase {

namespace {

bool nearer(const Neighbour& a, const Neighbour& b) {
  return a.distance != b.distance ? a.distance < b.distance : a.row < b.row;
}

/// Appends all within `radius` to `list`, as met.
void append_within(const PointGrid& grid, const Point& p, double radius, std::optional<std::uint32_t> except,
                   std::vector<Neighbour>& list) {
  grid.for_each_near(p, radius, [&](std::uint32_t row, double squared) {
    if (row != except) list.push_back({row, std::sqrt(squared)});
  });
}

/// How many of a list, from `begin`, are surely nearer than anything farther than `radius`, whatever was
/// rounded.
std::size_t count_inside(const std::vector<Neighbour>& list, std::size_t begin, double radius) {
  const double inside = radius * (1.0 - 4.0 * std::numeric_limits<double>::epsilon());
  return static_cast<std::size_t>(std::count_if(list.begin() + static_cast<std::ptrdiff_t>(begin), list.end(),
                                                [=](const Neighbour& n) { return n.distance < inside; }));
}

/// Appends the neighbours of one point. Where few are wanted the radius starts at a cell and doubles until it
/// holds enough.
void append_near(const PointGrid& grid, const Point& p, const Near& near, std::optional<std::uint32_t> except,
                 std::vector<Neighbour>& list) {
  const std::size_t begin = list.size();
  const bool few = near.most < grid.size();
  double radius = few && grid.cell_size() > 0.0 ? std::min(grid.cell_size(), near.radius) : near.radius;
  append_within(grid, p, radius, except, list);
  while (radius < near.radius && count_inside(list, begin, radius) < near.most) {
    // Far outside the points, or among few, the next ring may be astronomically many cells away: go there at
    // once.
    radius = radius > 1e3 * grid.cell_size() ? near.radius : std::min(2.0 * radius, near.radius);
    list.resize(begin);
    append_within(grid, p, radius, except, list);
  }
  const auto first = list.begin() + static_cast<std::ptrdiff_t>(begin);
  if (list.size() - begin > near.most) {
    const auto end = first + static_cast<std::ptrdiff_t>(near.most);
    std::nth_element(first, end, list.end(), nearer);
    list.resize(begin + near.most);
  }
  std::sort(list.begin() + static_cast<std::ptrdiff_t>(begin), list.end(), nearer);
}

}  // namespace

void find_near(const PointGrid& grid, const Point& p, const Near& near, std::vector<Neighbour>& neighbours,
               std::optional<std::uint32_t> except) {
  assert(near.radius >= 0.0);
  neighbours.clear();
  append_near(grid, p, near, except, neighbours);
}

void find_all_near(const PointGrid& grid, std::span<const Point> points, const Near& near,
                   NeighbourLists& lists) {
  assert(points.size() == grid.size() && near.radius >= 0.0);
  lists.first.assign(1, 0);
  lists.all.clear();
  for (std::uint32_t row = 0; row < points.size(); ++row) {
    append_near(grid, points[row], near, row, lists.all);
    lists.first.push_back(lists.all.size());
  }
}

}  // namespace throng::broadphase
