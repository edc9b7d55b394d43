// SPDX-License-Identifier: MIT
#include "tools/bench/convex_peers.h"

#include <CGAL/Gmpq.h>
#include <CGAL/Polytope_distance_d.h>
#include <CGAL/Polytope_distance_d_traits_2.h>
#include <CGAL/Simple_cartesian.h>
#include <box2d/b2_distance.h>

#include <cmath>

#include "tools/bench/single.h"

namespace throng::bench {

using narrowphase::Convex;
using narrowphase::Pose;
using narrowphase::Vec;

struct Box2dDistance::Pairs {
  std::vector<std::vector<b2Vec2>> vertices;  // of each shape
  std::vector<b2DistanceInput> input;         // of each pair
  std::vector<b2SimplexCache> cache;
  std::vector<b2Transform> transforms;  // a and b at each placement
};

Box2dDistance::Box2dDistance(const ConvexPairs& pairs, bool warm)
    : pairs_(std::make_unique<Pairs>()), warm_(warm) {
  for (const Convex& shape : pairs.shapes) {
    auto& vertices = pairs_->vertices.emplace_back();
    for (const Vec& v : shape.vertices) vertices.push_back(single(v));
  }
  const auto proxy = [&](std::uint32_t shape) {
    const auto& vertices = pairs_->vertices[shape];
    b2DistanceProxy p;
    p.Set(vertices.data(), static_cast<int32>(vertices.size()), 0.0f);
    return p;
  };
  for (std::size_t i = 0; i < pairs.pairs(); ++i) {
    b2DistanceInput& input = pairs_->input.emplace_back();
    input.proxyA = proxy(pairs.a[i]), input.proxyB = proxy(pairs.b[i]), input.useRadii = false;
    pairs_->cache.emplace_back().count = 0;
  }
  for (const Placement& p : pairs.placements) {
    pairs_->transforms.push_back(single(p.a));
    pairs_->transforms.push_back(single(p.b));
  }
}

Box2dDistance::~Box2dDistance() = default;

double Box2dDistance::distance(std::size_t pair, std::size_t placement) {
  b2DistanceInput& input = pairs_->input[pair];
  input.transformA = pairs_->transforms[2 * placement];
  input.transformB = pairs_->transforms[2 * placement + 1];
  b2SimplexCache& cache = pairs_->cache[pair];
  if (!warm_) cache.count = 0;
  b2DistanceOutput output;
  b2Distance(&output, &cache, &input);
  return static_cast<double>(output.distance);
}

namespace {

using Exact = CGAL::Gmpq;
using ExactKernel = CGAL::Simple_cartesian<Exact>;
using ExactTraits = CGAL::Polytope_distance_d_traits_2<ExactKernel, Exact, Exact>;

/// About `origin`, so that nothing is rounded.
std::vector<ExactKernel::Point_2> exact(const Convex& shape, const Pose& pose, const Vec& origin) {
  const Exact c = pose.cos, s = pose.sin;
  const Exact x = Exact(pose.position.x()) - Exact(origin.x()),
              y = Exact(pose.position.y()) - Exact(origin.y());
  std::vector<ExactKernel::Point_2> points;
  for (const Vec& v : shape.vertices)
    points.emplace_back(c * Exact(v.x()) - s * Exact(v.y()) + x, s * Exact(v.x()) + c * Exact(v.y()) + y);
  return points;
}

}  // namespace

double cgal_distance(const Convex& a, const Convex& b, const Placement& placement) {
  const auto of_a = exact(a, placement.a, placement.a.position),
             of_b = exact(b, placement.b, placement.a.position);
  const CGAL::Polytope_distance_d<ExactTraits> distance(of_a.begin(), of_a.end(), of_b.begin(), of_b.end());
  return std::sqrt(
      CGAL::to_double(distance.squared_distance_numerator() / distance.squared_distance_denominator()));
}

}  // namespace throng::bench
