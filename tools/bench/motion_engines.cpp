// SPDX-License-Identifier: MIT
#include "tools/bench/motion_engines.h"

#include "narrowphase/motion/check_motion.h"
#include "narrowphase/motion/first_contact.h"
#include "tools/bench/motion_peers.h"

namespace throng::bench {

namespace {

using namespace narrowphase;

MotionEngine bisection(const MotionCase& c) {
  const auto scratch = std::make_shared<BisectScratch>();
  return {"bisection", Promise::exact, false, [&c, scratch](std::size_t i) {
            const MotionQuery& q = c.queries[i];
            const PathAnswer answer =
                check_motion(q.a->bvh, q.motion_a, q.b->bvh, q.motion_b, 1.0, {}, *scratch);
            return Told{answer.verdict, answer.from, answer.evaluations};
          }};
}

MotionEngine directional(const MotionCase& c) {
  return {"directional advancement", Promise::exact, true, [&c](std::size_t i) {
            const MotionQuery& q = c.queries[i];
            const FirstContact contact =
                first_contact(q.a->parts[0], q.motion_a, q.b->parts[0], q.motion_b, 1.0);
            return Told{contact.verdict, contact.t_hi, static_cast<std::size_t>(contact.evaluations)};
          }};
}

MotionEngine box2d(const MotionCase& c) {
  const auto impact = std::make_shared<Box2dImpact>(c);
  return {"box2d", Promise::none, true, [impact](std::size_t i) {
            const Box2dImpact::Impact answer = impact->ask(i);
            if (answer.state == Box2dImpact::State::failed) return Told{Verdict::undecided};
            const bool hit = answer.state == Box2dImpact::State::touching;
            return Told{hit ? Verdict::hit : Verdict::free, answer.time};
          }};
}

}  // namespace

std::vector<MotionEngine> motion_engines(const MotionCase& c) {
  std::vector<MotionEngine> engines{bisection(c)};
  if (c.convex()) engines.push_back(directional(c));
  if (Box2dImpact::fits(c)) engines.push_back(box2d(c));
  return engines;
}

}  // namespace throng::bench
