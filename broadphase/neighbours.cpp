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

/// Replaces `list` by all within `radius`, as met.
void gather_within(const PointGrid& grid, const Point& p, double radius, std::optional<std::uint32_t> except,
                   std::vector<Neighbour>& list) {
  list.clear();
  grid.for_each_near(p, radius, [&](std::uint32_t row, double squared) {
    if (row != except) list.push_back({row, std::sqrt(squared)});
  });
}

/// How many of a list are surely nearer than anything farther than `radius`, whatever was rounded.
std::size_t count_inside(const std::vector<Neighbour>& list, double radius) {
  const double inside = radius * (1.0 - 4.0 * std::numeric_limits<double>::epsilon());
  return static_cast<std::size_t>(
      std::count_if(list.begin(), list.end(), [=](const Neighbour& n) { return n.distance < inside; }));
}

}  // namespace

/// Where few are wanted the radius starts at a cell and doubles until it holds enough.
void find_near(const PointGrid& grid, const Point& p, const Near& near, std::vector<Neighbour>& neighbours,
               std::optional<std::uint32_t> except) {
  assert(near.radius >= 0.0);
  const bool few = near.most < grid.size();
  double radius = few && grid.cell_size() > 0.0 ? std::min(grid.cell_size(), near.radius) : near.radius;
  gather_within(grid, p, radius, except, neighbours);
  while (radius < near.radius && count_inside(neighbours, radius) < near.most) {
    // Far outside the points, or among few, the next ring may be astronomically many cells away: go there at
    // once.
    radius = radius > 1e3 * grid.cell_size() ? near.radius : std::min(2.0 * radius, near.radius);
    gather_within(grid, p, radius, except, neighbours);
  }
  if (neighbours.size() > near.most) {
    const auto end = neighbours.begin() + static_cast<std::ptrdiff_t>(near.most);
    std::nth_element(neighbours.begin(), end, neighbours.end(), nearer);
    neighbours.resize(near.most);
  }
  std::sort(neighbours.begin(), neighbours.end(), nearer);
}

}  // namespace throng::broadphase
