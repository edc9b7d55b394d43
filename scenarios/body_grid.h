// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstdint>
#include <map>
#include <vector>

#include "sim/scene.h"

namespace throng::scenarios {

/// Who stands near a place, while bodies of any mixture of sizes are added one by one: a hashed grid for each
/// power of two of the radius, so that a boulder among grains costs the grains nothing. (broadphase's grid is
/// rebuilt whole, with one reach for all.) In a periodic domain a body near a border is added at its images
/// too, as seen from inside the domain.
class BodyGrid {
 public:
  /// `reach` (m): the farthest that `visit_near` will be asked to look. Expects about `count` bodies.
  BodyGrid(const Domain& domain, double reach, std::size_t count);

  /// Adds a body. O(1), O(4) next to the corner of a periodic domain.
  void add(std::uint32_t row, const Vec& position, double radius);

  /// Calls visit(row, image position, radius) for each body whose bounding disc comes closer than `reach` to
  /// `position`, until one call returns true. The order depends on the bodies and their order alone. O(bodies
  /// near).
  template <class Visit>
  bool visit_near(const Vec& position, double reach, Visit&& visit) const;

 private:
  struct Item {
    Vec position;
    double radius, cell;  ///< m
    std::int64_t x, y;    ///< its cell
    std::uint32_t row, next;
  };
  struct Level {
    double cell = 0.0, largest = 0.0;  ///< m: side of a cell, radius of its largest body
    std::vector<std::uint32_t> items;
  };
  static constexpr std::uint32_t kNone = 0xFFFFFFFF;

  void add_image(std::uint32_t row, const Vec& position, double radius);
  std::size_t bucket(double cell, std::int64_t x, std::int64_t y) const;

  static bool stands_in(const Item& item, double cell, std::int64_t x, std::int64_t y) {
    return item.x == x && item.y == y && item.cell == cell;
  }

  template <class Visit>
  bool visit_item(const Item& item, const Vec& position, double reach, Visit& visit) const {
    const double sum = reach + item.radius;
    return (item.position - position).squaredNorm() < sum * sum &&
           visit(item.row, item.position, item.radius);
  }

  template <class Visit>
  bool visit_level(const Level& level, const Vec& position, double reach, Visit& visit) const;

  Domain domain_;
  double reach_;
  std::vector<std::uint32_t> heads_;
  std::vector<Item> items_;
  std::map<int, Level> levels_;  ///< by exponent of the radius
};

template <class Visit>
bool BodyGrid::visit_near(const Vec& position, double reach, Visit&& visit) const {
  for (const auto& [exponent, level] : levels_)
    if (visit_level(level, position, reach, visit)) return true;
  return false;
}

template <class Visit>
bool BodyGrid::visit_level(const Level& level, const Vec& position, double reach, Visit& visit) const {
  const double far = reach + level.largest;
  const double x0 = std::floor((position.x() - far) / level.cell),
               x1 = std::floor((position.x() + far) / level.cell);
  const double y0 = std::floor((position.y() - far) / level.cell),
               y1 = std::floor((position.y() + far) / level.cell);
  if ((x1 - x0 + 1) * (y1 - y0 + 1) > static_cast<double>(level.items.size())) {
    for (std::uint32_t item : level.items)
      if (visit_item(items_[item], position, reach, visit)) return true;
    return false;
  }
  for (auto y = static_cast<std::int64_t>(y0); y <= static_cast<std::int64_t>(y1); ++y)
    for (auto x = static_cast<std::int64_t>(x0); x <= static_cast<std::int64_t>(x1); ++x)
      for (std::uint32_t item = heads_[bucket(level.cell, x, y)]; item != kNone; item = items_[item].next)
        if (stands_in(items_[item], level.cell, x, y) && visit_item(items_[item], position, reach, visit))
          return true;
  return false;
}

}  // namespace throng::scenarios
