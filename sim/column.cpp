// SPDX-License-Identifier: MIT
#include "sim/column.h"

#include <algorithm>
#include <cmath>
#include <limits>
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
  Span across, along;  // gravity
  double weight;       // of the lightest
  double widest;       // m, of its bodies
  std::size_t bodies = 1;

  void add(const Pile& other) {
    across.join(other.across), along.join(other.along);
    weight += other.weight, widest = std::max(widest, other.widest), bodies += other.bodies;
  }
  double load() const { return std::min(2.0 * std::max(weight * widest / across.size(), 1.0), weight); }
};

/// Each dynamic body as one.
std::vector<Pile> bodies_as_piles(const Scene& scene) {
  const Vec along = scene.gravity.normalized(), across(-along.y(), along.x());
  double lightest = std::numeric_limits<double>::infinity();
  for_dynamic(scene, [&](std::size_t row) { lightest = std::min(lightest, mass(scene, row)); });
  std::vector<Pile> each;
  for_dynamic(scene, [&](std::size_t row) {
    const Span width = span_of(scene, row, across);
    each.push_back({width, span_of(scene, row, along), mass(scene, row) / lightest, width.size()});
  });
  return each;
}

/// None is over another.
std::vector<Pile> piles(const Scene& scene) {
  std::vector<Pile> each = bodies_as_piles(scene), all;
  std::ranges::sort(each, {}, [](const Pile& one) { return one.across.low; });
  for (const Pile& one : each)
    if (all.empty() || one.across.low > all.back().across.high)
      all.push_back(one);
    else
      all.back().add(one);
  return all;
}

}  // namespace

Column heaviest_column(const Scene& scene) {
  const std::vector<Pile> all = piles(scene);
  const Pile& pile = *std::ranges::max_element(all, {}, &Pile::load);
  const double load = pile.load();
  return {load, std::min(load, static_cast<double>(pile.bodies)), pile.along.size() / pile.across.size(),
          load == pile.weight};
}

}  // namespace throng
