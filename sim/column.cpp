// SPDX-License-Identifier: MIT
#include "sim/column.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <vector>

#include "narrowphase/convex.h"
#include "sim/observe.h"

namespace throng {

namespace {

/// m, along a direction.
struct Span {
  double low, high;

  double size() const { return high - low; }
  void join(const Span& other) { low = std::min(low, other.low), high = std::max(high, other.high); }
};

Span span_of(const Scene& scene, std::size_t row, const Vec& direction) {
  const double at = direction.dot(scene.bodies.position[row]), radius = scene.bodies.radius[row];
  const Shape& shape = scene.shapes[scene.bodies.shape[row]];
  if (shape.parts.empty()) return {at - radius, at + radius};
  const narrowphase::Pose pose = narrowphase::pose(scene.bodies.position[row], scene.bodies.angle[row]);
  Span all{at, at};
  for (const narrowphase::Convex& part : shape.parts)
    for (const Vec& vertex : part.vertices) {
      const double corner = direction.dot(pose * vertex);
      all.join({corner - part.radius, corner + part.radius});
    }
  return all;
}

struct Pile {
  Span across, along;       // gravity
  double weight;            // of the lightest
  double widest, thinnest;  // m, of its bodies; height over width, likewise
  double area;              // m², of the boxes round them
  std::size_t bodies = 1;

  void add(const Pile& other) {
    across.join(other.across), along.join(other.along);
    weight += other.weight, area += other.area, bodies += other.bodies;
    widest = std::max(widest, other.widest), thinnest = std::max(thinnest, other.thinnest);
  }

  Column column() const {
    const double load = std::min(2.0 * std::max(weight * widest / across.size(), 1.0), weight);
    const double high = along.size(), mean_width = std::min(area / high, across.size());
    return {load, std::min(load, static_cast<double>(bodies)), high / mean_width, bodies > 1 ? thinnest : 0.0,
            across.size() < 1.5 * widest};
  }
};

/// Each dynamic body as one.
std::vector<Pile> bodies_as_piles(const Scene& scene) {
  const Vec along = scene.gravity.normalized(), across(-along.y(), along.x());
  double lightest = std::numeric_limits<double>::infinity();
  for_dynamic(scene, [&](std::size_t row) { lightest = std::min(lightest, mass(scene, row)); });
  std::vector<Pile> each;
  for_dynamic(scene, [&](std::size_t row) {
    const Span width = span_of(scene, row, across), height = span_of(scene, row, along);
    each.push_back({width, height, mass(scene, row) / lightest, width.size(), height.size() / width.size(),
                    width.size() * height.size()});
  });
  return each;
}

}  // namespace

std::vector<Column> columns(const Scene& scene) {
  std::vector<Pile> piles = bodies_as_piles(scene);
  std::ranges::sort(piles, {}, [](const Pile& one) { return one.across.low; });
  std::size_t count = 1;
  for (const Pile& one : std::span(piles).subspan(1))
    if (one.across.low > piles[count - 1].across.high)
      piles[count++] = one;
    else
      piles[count - 1].add(one);
  std::vector<Column> result;
  for (const Pile& pile : std::span(piles).first(count)) result.push_back(pile.column());
  return result;
}

}  // namespace throng
