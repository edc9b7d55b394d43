// SPDX-License-Identifier: MIT
#include "tools/bench/motion_engines.h"

#include <cstdio>

#include "narrowphase/motion/baselines/advance_scalar.h"
#include "narrowphase/motion/baselines/algebraic.h"
#include "narrowphase/motion/baselines/sampled.h"
#include "narrowphase/motion/baselines/swept_hull.h"
#include "narrowphase/motion/check_motion.h"
#include "narrowphase/motion/first_contact_parts.h"
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

Told told(const FirstContact& contact) {
  return {contact.verdict, contact.t_hi, static_cast<std::size_t>(contact.evaluations)};
}

MotionEngine first_contacts(const MotionCase& c) {
  if (c.convex())
    return {"first contact", Promise::exact, true, [&c](std::size_t i) {
              const MotionQuery& q = c.queries[i];
              return told(first_contact(q.a->parts[0], q.motion_a, q.b->parts[0], q.motion_b, 1.0));
            }};
  return {"first contact", Promise::exact, true, [&c](std::size_t i) {
            const MotionQuery& q = c.queries[i];
            return told(first_contact(q.a->bvh, q.motion_a, q.b->bvh, q.motion_b, 1.0).contact);
          }};
}

MotionEngine algebraic(const MotionCase& c) {
  return {"algebraic", Promise::exact, true, [&c](std::size_t i) {
            const MotionQuery& q = c.queries[i];
            return told(algebraic_contact(q.a->parts[0], q.motion_a, q.b->parts[0], q.motion_b, 1.0));
          }};
}

/// As published, up to 1e-6 of the size: it would crawl to more.
MotionEngine advancement(const MotionCase& c, Closing closing) {
  ContactQuestion question;
  question.width = 1e-6;
  return {closing == Closing::scalar ? "scalar advancement" : "directional advancement", Promise::none, true,
          [&c, closing, question](std::size_t i) {
            const MotionQuery& q = c.queries[i];
            return told(
                advance_scalar(q.a->parts[0], q.motion_a, q.b->parts[0], q.motion_b, 1.0, closing, question));
          }};
}

/// The farthest that a point of the solid is from its origin.
double reach(const Solid& solid) {
  double reach = 0.0;
  for (const Convex& part : solid.parts)
    for (const Vec& v : part.vertices) reach = std::max(reach, v.norm() + part.radius);
  return reach;
}

/// Of a query whose samples are `epsilon` of the size apart, each from where the last one's search ended.
Told ask_samples(const MotionQuery& q, double spacing, SampleOrder order) {
  const double rate = gap_rate(q.motion_a, q.motion_b).of(reach(*q.a), reach(*q.b));
  PartsMemory memory;
  const auto hits = [&](double time) {
    return track(q.a->bvh, pose_at(q.motion_a, time), q.b->bvh, pose_at(q.motion_b, time), memory).distance <=
           0.0;
  };
  const SampledAnswer answer = sampled(1.0, sample_steps(rate, 1.0, spacing), order, hits);
  return {answer.hit ? Verdict::hit : Verdict::free, answer.time, static_cast<std::size_t>(answer.samples)};
}

MotionEngine samples(const MotionCase& c, double epsilon, SampleOrder order) {
  char name[48];
  const bool sequential = order == SampleOrder::sequential;
  std::snprintf(name, sizeof name, "sampled %g %s", epsilon, sequential ? "in sequence" : "by bisection");
  return {name, Promise::none, sequential,
          [&c, epsilon, order](std::size_t i) { return ask_samples(c.queries[i], epsilon * c.size, order); }};
}

MotionEngine swept_hull(const MotionCase& c) {
  return {"swept hull", Promise::filter, false, [&c](std::size_t i) {
            const MotionQuery& q = c.queries[i];
            const bool apart =
                swept_hulls_are_apart(q.a->parts[0], q.motion_a, q.b->parts[0], q.motion_b, 1.0);
            return Told{apart ? Verdict::free : Verdict::undecided, 0.0, 1};
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

std::vector<MotionEngine> motion_engines(const MotionCase& c, bool quick) {
  std::vector<MotionEngine> engines{bisection(c), first_contacts(c)};
  if (c.convex()) {
    engines.push_back(algebraic(c));
    engines.push_back(advancement(c, Closing::scalar));
    engines.push_back(advancement(c, Closing::directional));
    engines.push_back(swept_hull(c));
  }
  const double finest = quick || !c.convex() ? 1e-3 : 1e-5;
  for (const double epsilon : {1e-1, 1e-2, 1e-3, 1e-4, 1e-5})
    if (epsilon >= finest)
      for (const SampleOrder order : {SampleOrder::sequential, SampleOrder::bisection})
        engines.push_back(samples(c, epsilon, order));
  if (Box2dImpact::fits(c)) engines.push_back(box2d(c));
  return engines;
}

}  // namespace throng::bench
