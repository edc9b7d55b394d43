// SPDX-License-Identifier: MIT
#include "sim/contact/disc_blocks.h"

#include "sim/contact/fast.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "sim/contact/solve_disc_blocks.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "sim/contact/lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace throng::HWY_NAMESPACE {
namespace {

/// Impulses on both bodies of each lane: along the normal, and across at the arms that discs have. Only what
/// rubs turns them.
HWY_INLINE void apply(Motion& a, Motion& b, const DiscBlock& c, std::size_t k, Reals normal, Reals tangent,
                      bool friction) {
  const Reals nx = load(c.normal_x + k), ny = load(c.normal_y + k);
  const Reals x = hn::Sub(hn::Mul(normal, nx), hn::Mul(tangent, ny));
  const Reals y = hn::Add(hn::Mul(normal, ny), hn::Mul(tangent, nx));
  a.velocity_x = hn::Sub(a.velocity_x, hn::Mul(a.inverse_mass, x));
  a.velocity_y = hn::Sub(a.velocity_y, hn::Mul(a.inverse_mass, y));
  b.velocity_x = hn::Add(b.velocity_x, hn::Mul(b.inverse_mass, x));
  b.velocity_y = hn::Add(b.velocity_y, hn::Mul(b.inverse_mass, y));
  if (!friction) return;
  a.spin = hn::Sub(a.spin, hn::Mul(load(c.turn_a + k), tangent));
  b.spin = hn::Sub(b.spin, hn::Mul(load(c.turn_b + k), tangent));
}

/// The change of the impulses that grants the wish and stops the slip, applied where `pressing`. False where
/// there was no impulse in any lane and is none: then nothing has changed.
HWY_INLINE bool respond(DiscBlock& c, std::size_t k, Motion& a, Motion& b, const WideWish& wish,
                        Mask pressing, bool friction) {
  const Reals nx = load(c.normal_x + k), ny = load(c.normal_y + k);
  const Reals dx = hn::Sub(b.velocity_x, a.velocity_x), dy = hn::Sub(b.velocity_y, a.velocity_y);
  Reals impulse = load(c.normal_impulse + k), tangent = hn::Zero(D());
  const Reals normal = hn::IfThenElseZero(
      pressing, press(impulse, load(c.preload + k), load(c.normal_mass + k), dot(dx, dy, nx, ny), wish));
  if (idle(impulse, load(c.normal_impulse + k))) return false;
  store(hn::IfThenElse(pressing, impulse, load(c.normal_impulse + k)), c.normal_impulse + k);
  if (friction) {
    const Reals turning = dot(a.spin, b.spin, load(c.radius_a + k), load(c.radius_b + k));
    const Reals slip = hn::Sub(hn::Sub(hn::Mul(dy, nx), hn::Mul(dx, ny)), turning);
    Reals across = load(c.tangent_impulse + k);
    tangent = hn::IfThenElseZero(
        pressing, rub(across, load(c.tangent_mass + k), slip, hn::Mul(load(c.friction + k), impulse)));
    store(hn::IfThenElse(pressing, across, load(c.tangent_impulse + k)), c.tangent_impulse + k);
  }
  apply(a, b, c, k, normal, tangent, friction);
  return true;
}

/// Of discs whose centres are (x, y) apart.
HWY_INLINE Reals separation(const DiscBlock& c, std::size_t k, Reals nx, Reals ny, Reals x, Reals y,
                            bool periodic) {
  const Reals width = hn::Add(load(c.radius_a + k), load(c.radius_b + k));
  const Reals offset = periodic ? hn::Sub(load(c.image + k), width) : hn::Neg(width);
  return hn::Add(offset, dot(nx, ny, x, y));
}

/// The way from a's centre to b's.
struct Way {
  Reals x, y;
};

/// As between_ahead() of solve.cpp.
HWY_INLINE Way between_ahead(const DiscBlock& c, std::size_t k, const SolverBody* bodies, const Way& now,
                             double ahead) {
  const D d;
  const Motion a = motion(bodies, c.a + k), b = motion(bodies, c.b + k);
  const Reals vx = hn::Sub(b.velocity_x, a.velocity_x), vy = hn::Sub(b.velocity_y, a.velocity_y);
  const Reals radius_a = load(c.radius_a + k), radius_b = load(c.radius_b + k), zero = hn::Zero(d);
  const Reals reach = hn::Add(radius_a, radius_b);
  const Reals slow = hn::Mul(hn::Set(d, kAheadWay), hn::Min(radius_a, radius_b));
  const Reals excess = hn::Sub(dot(now.x, now.y, now.x, now.y), hn::Mul(reach, reach));
  const Reals nearing = hn::Neg(dot(now.x, now.y, vx, vy)), squared = dot(vx, vy, vx, vy);
  const Mask fast = hn::Gt(hn::Mul(squared, hn::Set(d, ahead * ahead)), hn::Mul(slow, slow));
  const Mask nears = hn::And(fast, hn::And(hn::Gt(excess, zero), hn::Gt(nearing, zero)));
  if (hn::AllFalse(d, nears)) return now;
  const Reals discriminant = hn::Sub(hn::Mul(nearing, nearing), hn::Mul(squared, excess));
  const Reals root = hn::Sqrt(hn::Max(discriminant, zero));
  const Mask meets = hn::Gt(root, zero);
  const Reals time =
      hn::Div(hn::IfThenElse(meets, excess, nearing), hn::IfThenElse(meets, hn::Add(nearing, root), squared));
  const Reals until = hn::IfThenElseZero(nears, hn::Min(time, hn::Set(d, ahead)));
  return {hn::IfThenElse(nears, hn::Add(now.x, hn::Mul(until, vx)), now.x),
          hn::IfThenElse(nears, hn::Add(now.y, hn::Mul(until, vy)), now.y)};
}

HWY_INLINE void prepare(DiscBlock& c, std::size_t k, const SolverBody* bodies, const Vec* period,
                        double ahead) {
  const D d;
  const Place a = place(bodies, c.a + k), b = place(bodies, c.b + k);
  const Reals x = hn::Sub(b.x, a.x), y = hn::Sub(b.y, a.y);
  const Reals near_x = period ? nearest(x, period->x()) : x, near_y = period ? nearest(y, period->y()) : y;
  Way then{near_x, near_y};
  if (ahead > 0.0) then = between_ahead(c, k, bodies, then, ahead);
  const Reals distance = hn::Sqrt(dot(then.x, then.y, then.x, then.y));
  const Mask same = hn::Not(hn::Gt(distance, hn::Zero(d)));
  const Reals nx = hn::IfThenElse(same, hn::Set(d, 1.0), hn::Div(then.x, distance));
  const Reals ny = hn::IfThenZeroElse(same, hn::Div(then.y, distance));
  store(nx, c.normal_x + k), store(ny, c.normal_y + k);
  if (period) store(dot(nx, ny, hn::Sub(near_x, x), hn::Sub(near_y, y)), c.image + k);
  store(separation(c, k, nx, ny, x, y, period), c.separation + k);
}

/// Who looks ahead must see all as they are before any starts.
void prepare_and_start(std::span<DiscBlock> blocks, SolverBody* bodies, const Vec* period, double ahead) {
  if (ahead > 0.0)
    for_each_part(blocks, bodies,
                  [=](DiscBlock& c, std::size_t k) HWY_ATTR { prepare(c, k, bodies, period, ahead); });
  for_each_part(blocks, bodies, [=](DiscBlock& c, std::size_t k) HWY_ATTR {
    if (!(ahead > 0.0)) prepare(c, k, bodies, period, 0.0);
    const Reals impulse = load(c.normal_impulse + k);
    const Mask pressing = hn::Gt(impulse, hn::Zero(D()));
    if (hn::AllFalse(D(), pressing)) return;
    Motion a = motion(bodies, c.a + k), b = motion(bodies, c.b + k);
    apply(a, b, c, k, hn::IfThenElseZero(pressing, impulse),
          hn::IfThenElseZero(pressing, load(c.tangent_impulse + k)), true);
    keep(a, bodies, c.a + k), keep(b, bodies, c.b + k);
  });
}

void push_apart(std::span<DiscBlock> blocks, SolverBody* bodies, const SolverSettings& settings) {
  const Pusher pusher(settings);
  const Mask all = hn::FirstN(D(), kLanes);
  for_each_part(
      blocks, bodies, settings.backward,
      [=, friction = settings.friction](DiscBlock& c, std::size_t k) HWY_ATTR {
        Motion a = motion(bodies, c.a + k), b = motion(bodies, c.b + k);
        if (!respond(c, k, a, b, pusher.wish(load(c.separation + k), load(c.preload + k)), all, friction))
          return;
        keep(a, bodies, c.a + k), keep(b, bodies, c.b + k);
      });
}

void relax(std::span<DiscBlock> blocks, SolverBody* bodies, const SolverSettings& settings, bool periodic) {
  const Reals rate = hn::Set(D(), 1.0 / settings.h), ajar = hn::Set(D(), settings.ajar),
              nothing = hn::Set(D(), settings.nothing());
  for_each_part(blocks, bodies, settings.backward,
                [=, friction = settings.friction](DiscBlock& c, std::size_t k) HWY_ATTR {
                  const D d;
                  const Mask pressing = hn::Ne(load(c.normal_impulse + k), hn::Zero(d));
                  if (hn::AllFalse(d, pressing)) return;
                  const Place at_a = place(bodies, c.a + k), at_b = place(bodies, c.b + k);
                  const Reals s = separation(c, k, load(c.normal_x + k), load(c.normal_y + k),
                                             hn::Sub(at_b.x, at_a.x), hn::Sub(at_b.y, at_a.y), periodic);
                  const Mask apart = is_apart(s, load(c.preload + k), ajar);
                  const WideWish wish{hn::IfThenElseZero(apart, hn::Mul(s, rate)), nothing, hn::Set(d, 1.0),
                                      hn::Zero(d)};
                  Motion a = motion(bodies, c.a + k), b = motion(bodies, c.b + k);
                  respond(c, k, a, b, wish, pressing, friction);
                  keep(a, bodies, c.a + k), keep(b, bodies, c.b + k);
                });
}

void learn(std::span<DiscBlock> blocks, const SolverBody* bodies, const Learning& learning) {
  for_each_part(blocks, bodies, [=](DiscBlock& c, std::size_t k) HWY_ATTR {
    const Mask slow = is_slow(motion(bodies, c.a + k), motion(bodies, c.b + k), learning);
    store(learnt(learning, load(c.preload + k), load(c.normal_impulse + k), load(c.normal_mass + k), slow),
          c.preload + k);
  });
}

}  // namespace
}  // namespace throng::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace throng {

namespace {
HWY_EXPORT(prepare_and_start);
HWY_EXPORT(push_apart);
HWY_EXPORT(relax);
HWY_EXPORT(learn);
}  // namespace

void prepare_and_start(std::span<DiscBlock> blocks, BodyRows<SolverBody> bodies, const Vec* period,
                       double ahead) {
  if (!blocks.empty())
    HWY_DYNAMIC_DISPATCH(prepare_and_start)(blocks, bodies.by_slot().data(), period, ahead);
}
void push_apart(std::span<DiscBlock> blocks, BodyRows<SolverBody> bodies, const SolverSettings& settings) {
  if (!blocks.empty()) HWY_DYNAMIC_DISPATCH(push_apart)(blocks, bodies.by_slot().data(), settings);
}
void relax(std::span<DiscBlock> blocks, BodyRows<SolverBody> bodies, const SolverSettings& settings,
           bool periodic) {
  if (!blocks.empty()) HWY_DYNAMIC_DISPATCH(relax)(blocks, bodies.by_slot().data(), settings, periodic);
}
void learn(std::span<DiscBlock> blocks, BodyRows<const SolverBody> bodies, const Learning& learning) {
  if (!blocks.empty()) HWY_DYNAMIC_DISPATCH(learn)(blocks, bodies.by_slot().data(), learning);
}

}  // namespace throng
#endif
