// SPDX-License-Identifier: MIT
#include "tools/bench/motion_peers.h"

#include <box2d/b2_time_of_impact.h>

#include <algorithm>
#include <deque>
#include <map>

#include "tools/bench/single.h"

namespace throng::bench {

using narrowphase::Convex;
using narrowphase::Motion;
using narrowphase::Vec;

struct Box2dImpact::Inputs {
  std::deque<std::vector<b2Vec2>> vertices;
  std::vector<b2TOIInput> queries;
};

namespace {

constexpr std::size_t kMostVertices = 8;

/// About `origin`, to lose few digits.
b2Sweep sweep(const Motion& motion, const Vec& origin) {
  b2Sweep s;
  s.localCenter.SetZero();
  s.c0 = single(motion.position - origin), s.c = single(motion.position + motion.velocity - origin);
  s.a0 = static_cast<float>(motion.angle), s.a = static_cast<float>(motion.angle + motion.spin);
  s.alpha0 = 0.0f;
  return s;
}

}  // namespace

bool Box2dImpact::fits(const MotionCase& c) {
  return c.convex() && std::ranges::all_of(c.solids, [](const auto& solid) {
           return solid->parts[0].vertices.size() <= kMostVertices && solid->parts[0].radius == 0.0;
         });
}

Box2dImpact::Box2dImpact(const MotionCase& c) : inputs_(std::make_unique<Inputs>()) {
  std::map<const Solid*, b2DistanceProxy> proxies;
  for (const auto& solid : c.solids) {
    std::vector<b2Vec2>& vertices = inputs_->vertices.emplace_back();
    for (const Vec& v : solid->parts[0].vertices) vertices.push_back(single(v));
    proxies[solid.get()].Set(vertices.data(), static_cast<int32>(vertices.size()), b2_polygonRadius);
  }
  for (const MotionQuery& q : c.queries) {
    b2TOIInput& input = inputs_->queries.emplace_back();
    input.proxyA = proxies[q.a], input.proxyB = proxies[q.b];
    input.sweepA = sweep(q.motion_a, q.motion_a.position);
    input.sweepB = sweep(q.motion_b, q.motion_a.position);
    input.tMax = 1.0f;
  }
}

Box2dImpact::~Box2dImpact() = default;

Box2dImpact::Impact Box2dImpact::ask(std::size_t query) const {
  b2TOIOutput output;
  b2TimeOfImpact(&output, &inputs_->queries[query]);
  const bool touching = output.state == b2TOIOutput::e_touching || output.state == b2TOIOutput::e_overlapped;
  const State state = touching                                   ? State::touching
                      : output.state == b2TOIOutput::e_separated ? State::separated
                                                                 : State::failed;
  return {state, static_cast<double>(output.t)};
}

}  // namespace throng::bench
