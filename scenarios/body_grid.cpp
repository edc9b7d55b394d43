// SPDX-License-Identifier: MIT
#include "scenarios/body_grid.h"

#include <bit>

namespace throng::scenarios {

BodyGrid::BodyGrid(const Domain& domain, double reach, std::size_t count)
    : domain_(domain), reach_(reach), heads_(std::bit_ceil(2 * count + 16), kNone) {
  items_.reserve(count);
}

std::size_t BodyGrid::bucket(double cell, std::int64_t x, std::int64_t y) const {
  std::uint64_t h = std::bit_cast<std::uint64_t>(cell);
  h = (h ^ static_cast<std::uint64_t>(x)) * 0x9E3779B97F4A7C15ULL;
  h = (h ^ (h >> 32) ^ static_cast<std::uint64_t>(y)) * 0xD6E8FEB86659FD93ULL;
  return (h ^ (h >> 32)) & (heads_.size() - 1);
}

void BodyGrid::add(std::uint32_t row, const Vec& position, double radius) {
  add_image(row, position, radius);
  if (domain_.kind != DomainKind::periodic) return;
  const Vec size = domain_.max - domain_.min;
  for (int i = -1; i <= 1; ++i)
    for (int j = -1; j <= 1; ++j) {
      const Vec image = position + Vec(i * size.x(), j * size.y());
      const Vec outside = (domain_.min - image).cwiseMax(image - domain_.max).cwiseMax(0.0);
      if ((i != 0 || j != 0) && outside.norm() <= reach_ + radius) add_image(row, image, radius);
    }
}

void BodyGrid::add_image(std::uint32_t row, const Vec& position, double radius) {
  int exponent = 0;
  std::frexp(radius, &exponent);
  Level& level = levels_[exponent];
  level.cell = std::ldexp(2.0, exponent);
  level.largest = std::fmax(level.largest, radius);
  const auto x = static_cast<std::int64_t>(std::floor(position.x() / level.cell));
  const auto y = static_cast<std::int64_t>(std::floor(position.y() / level.cell));
  std::uint32_t& head = heads_[bucket(level.cell, x, y)];
  const auto item = static_cast<std::uint32_t>(items_.size());
  items_.push_back({position, radius, level.cell, x, y, row, head});
  level.items.push_back(item);
  head = item;
}

}  // namespace throng::scenarios
