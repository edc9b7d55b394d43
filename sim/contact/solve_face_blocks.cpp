// SPDX-License-Identifier: MIT
#include "sim/contact/face_blocks.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "sim/contact/solve_face_blocks.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "sim/contact/lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace throng::HWY_NAMESPACE {
namespace {

HWY_INLINE Reals cross(Reals ax, Reals ay, Reals bx, Reals by) {
  return hn::Sub(hn::Mul(ax, by), hn::Mul(ay, bx));
}

/// The two bodies of each lane and the normal between them, while their points are solved.
struct Pair {
  Motion a, b;
  Reals turns_easily_a, turns_easily_b;  ///< 1/(kg m²), inverse moments of inertia
  Reals nx, ny;

  HWY_INLINE Reals velocity_x(const FaceBlock::Point& p, std::size_t k) const {
    return hn::Add(hn::Sub(hn::Sub(b.velocity_x, hn::Mul(b.spin, load(p.arm_by + k))), a.velocity_x),
                   hn::Mul(a.spin, load(p.arm_ay + k)));
  }
  HWY_INLINE Reals velocity_y(const FaceBlock::Point& p, std::size_t k) const {
    return hn::Sub(hn::Sub(hn::Add(b.velocity_y, hn::Mul(b.spin, load(p.arm_bx + k))), a.velocity_y),
                   hn::Mul(a.spin, load(p.arm_ax + k)));
  }

  HWY_INLINE void apply(const FaceBlock::Point& p, std::size_t k, Reals x, Reals y) {
    a.velocity_x = hn::Sub(a.velocity_x, hn::Mul(a.inverse_mass, x));
    a.velocity_y = hn::Sub(a.velocity_y, hn::Mul(a.inverse_mass, y));
    a.spin = hn::Sub(a.spin, hn::Mul(turns_easily_a, cross(load(p.arm_ax + k), load(p.arm_ay + k), x, y)));
    b.velocity_x = hn::Add(b.velocity_x, hn::Mul(b.inverse_mass, x));
    b.velocity_y = hn::Add(b.velocity_y, hn::Mul(b.inverse_mass, y));
    b.spin = hn::Add(b.spin, hn::Mul(turns_easily_b, cross(load(p.arm_bx + k), load(p.arm_by + k), x, y)));
  }
};

HWY_INLINE Pair pair(const FaceBlock& c, std::size_t k, const SolverBody* bodies, const Place& a,
                     const Place& b) {
  return {motion(bodies, c.a + k), motion(bodies, c.b + k), a.inverse_inertia,
          b.inverse_inertia,       load(c.normal_x + k),    load(c.normal_y + k)};
}

HWY_INLINE void keep(const Pair& pair, const FaceBlock& c, std::size_t k, SolverBody* bodies) {
  keep(pair.a, bodies, c.a + k), keep(pair.b, bodies, c.b + k);
}

/// The change of one point's impulses that grants the wish, then stops the slip; applied where `pressing`.
/// False where there was no impulse in any lane and is none: then nothing has changed.
HWY_INLINE bool respond(FaceBlock::Point& p, std::size_t k, Pair& pair, Reals rough, const WideWish& wish,
                        Mask pressing, bool friction) {
  Reals impulse = load(p.normal_impulse + k);
  const Reals speed = dot(pair.velocity_x(p, k), pair.velocity_y(p, k), pair.nx, pair.ny);
  const Reals normal =
      hn::IfThenElseZero(pressing, press(impulse, load(p.preload + k), load(p.normal_mass + k), speed, wish));
  if (idle(impulse, load(p.normal_impulse + k))) return false;
  store(hn::IfThenElse(pressing, impulse, load(p.normal_impulse + k)), p.normal_impulse + k);
  pair.apply(p, k, hn::Mul(normal, pair.nx), hn::Mul(normal, pair.ny));
  if (!friction) return true;
  Reals across = load(p.tangent_impulse + k);
  const Reals slip =
      hn::Sub(hn::Mul(pair.velocity_y(p, k), pair.nx), hn::Mul(pair.velocity_x(p, k), pair.ny));
  const Reals tangent =
      hn::IfThenElseZero(pressing, rub(across, load(p.tangent_mass + k), slip, hn::Mul(rough, impulse)));
  store(hn::IfThenElse(pressing, across, load(p.tangent_impulse + k)), p.tangent_impulse + k);
  pair.apply(p, k, hn::Neg(hn::Mul(tangent, pair.ny)), hn::Mul(tangent, pair.nx));
  return true;
}

/// The vector after a turn by a small angle, as in solve.cpp.
HWY_INLINE void turn(Reals x, Reals y, Reals angle, double* turned_x, double* turned_y) {
  const Reals shrink = hn::Mul(hn::Mul(hn::Set(D(), 0.5), angle), angle);
  store(hn::Sub(hn::Sub(x, hn::Mul(angle, y)), hn::Mul(shrink, x)), turned_x);
  store(hn::Sub(hn::Add(y, hn::Mul(angle, x)), hn::Mul(shrink, y)), turned_y);
}

/// Arms and offset at the bodies' present positions, and what the last sweep left, once more.
HWY_INLINE void start(FaceBlock::Point& p, std::size_t k, const FaceBlock& c, Pair& pair, const Place& a,
                      const Place& b) {
  turn(load(p.first_ax + k), load(p.first_ay + k), hn::Mul(load(c.turns_a + k), a.turn), p.arm_ax + k,
       p.arm_ay + k);
  turn(load(p.first_bx + k), load(p.first_by + k), hn::Mul(load(c.turns_b + k), b.turn), p.arm_bx + k,
       p.arm_by + k);
  const Reals offset =
      hn::Add(load(p.gap + k), dot(pair.nx, pair.ny, hn::Sub(load(p.arm_bx + k), load(p.arm_ax + k)),
                                   hn::Sub(load(p.arm_by + k), load(p.arm_ay + k))));
  store(offset, p.offset + k);
  store(hn::Add(offset, dot(pair.nx, pair.ny, hn::Sub(b.x, a.x), hn::Sub(b.y, a.y))), p.separation + k);
  const Reals impulse = load(p.normal_impulse + k);
  const Mask pressing = hn::Gt(impulse, hn::Zero(D()));
  const Reals normal = hn::IfThenElseZero(pressing, impulse);
  const Reals tangent = hn::IfThenElseZero(pressing, load(p.tangent_impulse + k));
  pair.apply(p, k, hn::Sub(hn::Mul(normal, pair.nx), hn::Mul(tangent, pair.ny)),
             hn::Add(hn::Mul(normal, pair.ny), hn::Mul(tangent, pair.nx)));
}

void prepare_and_start(std::span<FaceBlock> blocks, SolverBody* bodies) {
  for_each_part(blocks, bodies, [=](FaceBlock& c, std::size_t k) HWY_ATTR {
    const Place a = place(bodies, c.a + k), b = place(bodies, c.b + k);
    Pair bound = pair(c, k, bodies, a, b);
    for (FaceBlock::Point& point : std::span(c.points, c.count)) start(point, k, c, bound, a, b);
    keep(bound, c, k, bodies);
  });
}

void push_apart(std::span<FaceBlock> blocks, SolverBody* bodies, const SolverSettings& settings) {
  const Pusher pusher(settings);
  const Mask all = hn::FirstN(D(), kLanes);
  const bool friction = settings.friction, backward = settings.backward;
  for_each_part(blocks, bodies, settings.backward, [=](FaceBlock& c, std::size_t k) HWY_ATTR {
    Pair bound = pair(c, k, bodies, place(bodies, c.a + k), place(bodies, c.b + k));
    bool changed = false;
    for (std::size_t i = 0; i < c.count; ++i) {
      FaceBlock::Point& point = c.points[backward ? c.count - 1 - i : i];
      const WideWish wish = pusher.wish(load(point.separation + k), load(point.preload + k));
      changed |= respond(point, k, bound, load(c.friction + k), wish, all, friction);
    }
    if (changed) keep(bound, c, k, bodies);
  });
}

void relax(std::span<FaceBlock> blocks, SolverBody* bodies, const SolverSettings& settings) {
  const Reals rate = hn::Set(D(), 1.0 / settings.h), ajar = hn::Set(D(), settings.ajar);
  const bool friction = settings.friction, backward = settings.backward;
  for_each_part(blocks, bodies, settings.backward, [=](FaceBlock& c, std::size_t k) HWY_ATTR {
    const D d;
    const Place a = place(bodies, c.a + k), b = place(bodies, c.b + k);
    Pair bound = pair(c, k, bodies, a, b);
    const Reals way = dot(bound.nx, bound.ny, hn::Sub(b.x, a.x), hn::Sub(b.y, a.y));
    bool changed = false;
    for (std::size_t i = 0; i < c.count; ++i) {
      FaceBlock::Point& point = c.points[backward ? c.count - 1 - i : i];
      const Mask pressing = hn::Ne(load(point.normal_impulse + k), hn::Zero(d));
      const Reals separation = hn::Add(load(point.offset + k), way);
      const Mask apart = is_apart(separation, load(point.preload + k), ajar);
      const WideWish wish{hn::IfThenElseZero(apart, hn::Mul(separation, rate)), hn::Set(d, 1.0), hn::Zero(d)};
      changed |= respond(point, k, bound, load(c.friction + k), wish, pressing, friction);
    }
    if (changed) keep(bound, c, k, bodies);
  });
}

void learn(std::span<FaceBlock> blocks, const SolverBody* bodies, const Learning& learning) {
  for_each_part(blocks, bodies, [=](FaceBlock& c, std::size_t k) HWY_ATTR {
    const Mask slow = is_slow(motion(bodies, c.a + k), motion(bodies, c.b + k), learning);
    FaceBlock::Point &first = c.points[0], &second = c.points[1];
    const Reals mass = load(first.normal_mass + k), load_1 = load(first.normal_impulse + k);
    if (c.count < 2) {
      store(learnt(learning, load(first.preload + k), load_1, mass, slow), first.preload + k);
      return;
    }
    const Reals load_2 = load(second.normal_impulse + k);
    const Reals preload = learnt(learning, hn::Max(load(first.preload + k), load(second.preload + k)),
                                 hn::Mul(hn::Set(D(), 0.5), hn::Add(load_1, load_2)), mass, slow);
    store(hn::Min(preload, load_1), first.preload + k), store(hn::Min(preload, load_2), second.preload + k);
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

void prepare_and_start(std::span<FaceBlock> blocks, std::span<SolverBody> bodies) {
  HWY_DYNAMIC_DISPATCH(prepare_and_start)(blocks, bodies.data());
}
void push_apart(std::span<FaceBlock> blocks, std::span<SolverBody> bodies, const SolverSettings& settings) {
  HWY_DYNAMIC_DISPATCH(push_apart)(blocks, bodies.data(), settings);
}
void relax(std::span<FaceBlock> blocks, std::span<SolverBody> bodies, const SolverSettings& settings) {
  HWY_DYNAMIC_DISPATCH(relax)(blocks, bodies.data(), settings);
}
void learn(std::span<FaceBlock> blocks, std::span<const SolverBody> bodies, const Learning& learning) {
  HWY_DYNAMIC_DISPATCH(learn)(blocks, bodies.data(), learning);
}

}  // namespace throng
#endif
