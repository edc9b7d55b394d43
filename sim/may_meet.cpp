// SPDX-License-Identifier: MIT
#include "sim/may_meet.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "broadphase/box_index.h"

namespace throng {

namespace {

using Box = Surroundings::Box;

/// m, in which those stay who push each other: whoever of them gets all that all have.
double stirred(const Scene& scene, const std::vector<bool>& who) {
  const double fall = scene.gravity.norm() * scene.time.until;
  double energy = 0.0, lightest = std::numeric_limits<double>::infinity();
  for (std::size_t row = 0; row < who.size(); ++row) {
    if (!who[row]) continue;
    const double turns = std::abs(scene.bodies.spin[row]) * scene.bodies.radius[row];
    const double speed = scene.bodies.velocity[row].norm() + turns + fall;
    energy += mass(scene, row) * speed * speed;
    lightest = std::min(lightest, mass(scene, row));
  }
  return std::sqrt(energy / lightest) * scene.time.until;
}

Box around(const std::vector<LoneWay>& ways, const std::vector<bool>& who, double more) {
  Box box;
  for (std::size_t row = 0; row < who.size(); ++row)
    if (who[row]) box.extend(ways[row].reach);
  return Box(box.min().array() - more, box.max().array() + more);
}

}  // namespace

std::vector<bool> may_meet(const Scene& scene, const std::vector<LoneWay>& ways) {
  std::vector<std::uint32_t> rows;
  std::vector<broadphase::Extent> extents;
  for_dynamic(scene, [&](std::size_t row) {
    rows.push_back(static_cast<std::uint32_t>(row));
    extents.push_back(broadphase::Extent::of(ways[row].reach));
  });
  broadphase::BoxIndex index;
  index.build(extents);
  std::vector<bool> meets(scene.bodies.size(), false);
  if (rows.size() < 2) return meets;
  const auto leaves = [&](const Box& box) {
    const Domain& domain = scene.domain;
    return domain.kind == DomainKind::periodic && !Box(domain.min, domain.max).contains(box);
  };
  const auto may_all_meet = [&] {
    for (const std::uint32_t row : rows) meets[row] = true;
    return meets;
  };
  for (const std::uint32_t row : rows)
    if (leaves(ways[row].reach)) return may_all_meet();
  for (const std::uint32_t row : rows)
    if (!meets[row])
      index.for_each_near(ways[row].reach, [&](std::uint32_t other) {
        if (rows[other] != row) meets[row] = meets[rows[other]] = true;
      });
  for (bool more = std::ranges::count(meets, true) > 0; more;) {
    more = false;
    const Box box = around(ways, meets, stirred(scene, meets));
    if (leaves(box)) return may_all_meet();
    for (const std::uint32_t row : rows)
      if (!meets[row] && box.intersects(ways[row].reach)) meets[row] = more = true;
  }
  return meets;
}

}  // namespace throng
