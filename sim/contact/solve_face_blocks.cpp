// SPDX-License-Identifier: MIT
#include "sim/contact/face_blocks.h"

#include "sim/contact/fast.h"

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

  /// How far a turn as the bodies' takes the arms' ends apart, along the normal and to first order.
  HWY_INLINE Reals risen(const FaceBlock::Point& p, std::size_t k, const Place& at_a,
                         const Place& at_b) const {
    return hn::Sub(hn::Mul(cross(load(p.arm_bx + k), load(p.arm_by + k), nx, ny), at_b.turn),
                   hn::Mul(cross(load(p.arm_ax + k), load(p.arm_ay + k), nx, ny), at_a.turn));
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

/// As in contact.h.
struct Turn {
  Reals cosine, sine;

  explicit HWY_INLINE Turn(Reals angle) {
    const Reals one = hn::Set(D(), 1.0);
    const Reals quarter = hn::Mul(hn::Mul(hn::Set(D(), 0.25), angle), angle);
    const Reals scale = hn::Div(one, hn::Add(one, quarter));
    cosine = hn::Mul(hn::Sub(one, quarter), scale), sine = hn::Mul(angle, scale);
  }

  HWY_INLINE Reals x(Reals x, Reals y) const { return hn::Sub(hn::Mul(cosine, x), hn::Mul(sine, y)); }
  HWY_INLINE Reals y(Reals x, Reals y) const { return hn::Add(hn::Mul(cosine, y), hn::Mul(sine, x)); }
};

/// What the points of a face share in `start`.
struct Poses {
  Turn a, b;
  Place at_a, at_b;
  Reals round_ax, round_ay, round_bx, round_by;  ///< m, what doesn't turn of the arms
  Mask far;                                      ///< where one of them has turned far

  HWY_INLINE Poses(const FaceBlock& c, std::size_t k, const Pair& pair, const Place& place_a,
                   const Place& place_b)
      : a(place_a.turn), b(place_b.turn), at_a(place_a), at_b(place_b) {
    const Reals on_a = load(c.round_a + k), on_b = load(c.round_b + k);
    round_ax = hn::Mul(on_a, pair.nx), round_ay = hn::Mul(on_a, pair.ny);
    round_bx = hn::Mul(on_b, pair.nx), round_by = hn::Mul(on_b, pair.ny);
    far = hn::Gt(hn::Max(hn::Abs(at_a.turn), hn::Abs(at_b.turn)), hn::Set(D(), kFarTurn));
  }

  HWY_INLINE void place_arms(FaceBlock::Point& p, std::size_t k) const {
    const Reals ax = load(p.first_ax + k), ay = load(p.first_ay + k);
    const Reals bx = load(p.first_bx + k), by = load(p.first_by + k);
    store(hn::Add(a.x(ax, ay), round_ax), p.arm_ax + k), store(hn::Add(a.y(ax, ay), round_ay), p.arm_ay + k);
    store(hn::Sub(b.x(bx, by), round_bx), p.arm_bx + k), store(hn::Sub(b.y(bx, by), round_by), p.arm_by + k);
  }
};

/// The mass that is felt along (x, y), as in contact.h.
HWY_INLINE Reals effective_mass(const FaceBlock::Point& p, std::size_t k, const Pair& pair, Reals x,
                                Reals y) {
  const Reals turn_a = cross(load(p.arm_ax + k), load(p.arm_ay + k), x, y);
  const Reals turn_b = cross(load(p.arm_bx + k), load(p.arm_by + k), x, y);
  const Reals inverse = hn::Add(hn::Add(pair.a.inverse_mass, pair.b.inverse_mass),
                                hn::Mul(hn::Mul(pair.turns_easily_a, turn_a), turn_a));
  return hn::Div(hn::Set(D(), 1.0), hn::Add(inverse, hn::Mul(hn::Mul(pair.turns_easily_b, turn_b), turn_b)));
}

/// Where there is a point.
HWY_INLINE void feel_again(FaceBlock::Point& p, std::size_t k, const Pair& pair, Mask turned) {
  const Mask far = hn::And(turned, hn::Gt(load(p.normal_mass + k), hn::Zero(D())));
  const Reals normal = effective_mass(p, k, pair, pair.nx, pair.ny);
  const Reals tangent = effective_mass(p, k, pair, hn::Neg(pair.ny), pair.nx);
  store(hn::IfThenElse(far, normal, load(p.normal_mass + k)), p.normal_mass + k);
  store(hn::IfThenElse(far, tangent, load(p.tangent_mass + k)), p.tangent_mass + k);
}

/// Arms and offset at the bodies' present positions, and what the last sweep left, once more.
HWY_INLINE void start(FaceBlock::Point& p, std::size_t k, Pair& pair, const Poses& poses) {
  const Place &a = poses.at_a, &b = poses.at_b;
  poses.place_arms(p, k);
  if (!hn::AllFalse(D(), poses.far)) feel_again(p, k, pair, poses.far);
  const Reals offset =
      hn::Add(load(p.gap + k), dot(pair.nx, pair.ny, hn::Sub(load(p.arm_bx + k), load(p.arm_ax + k)),
                                   hn::Sub(load(p.arm_by + k), load(p.arm_ay + k))));
  store(hn::Sub(offset, pair.risen(p, k, a, b)), p.offset + k);
  store(hn::Add(offset, dot(pair.nx, pair.ny, hn::Sub(b.x, a.x), hn::Sub(b.y, a.y))), p.separation + k);
  const Reals impulse = load(p.normal_impulse + k);
  const Mask pressing = hn::Gt(impulse, hn::Zero(D()));
  const Reals normal = hn::IfThenElseZero(pressing, impulse);
  const Reals tangent = hn::IfThenElseZero(pressing, load(p.tangent_impulse + k));
  pair.apply(p, k, hn::Sub(hn::Mul(normal, pair.nx), hn::Mul(tangent, pair.ny)),
             hn::Add(hn::Mul(normal, pair.ny), hn::Mul(tangent, pair.nx)));
}

void prepare_and_start(FaceSequence blocks, SolverBody* bodies) {
  for_each_part(blocks, bodies, [=](FaceBlock& c, std::size_t k) HWY_ATTR {
    const Place a = place(bodies, c.a + k), b = place(bodies, c.b + k);
    Pair bound = pair(c, k, bodies, a, b);
    const Poses poses(c, k, bound, a, b);
    for (FaceBlock::Point& point : std::span(c.points, c.count)) start(point, k, bound, poses);
    keep(bound, c, k, bodies);
  });
}

void push_apart(FaceSequence blocks, SolverBody* bodies, const SolverSettings& settings) {
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

void relax(FaceSequence blocks, SolverBody* bodies, const SolverSettings& settings) {
  const Reals rate = hn::Set(D(), 1.0 / settings.h), ajar = hn::Set(D(), settings.ajar),
              nothing = hn::Set(D(), settings.nothing());
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
      const Reals separation = hn::Add(hn::Add(load(point.offset + k), way), bound.risen(point, k, a, b));
      const Mask apart = is_apart(separation, load(point.preload + k), ajar);
      const WideWish wish{hn::IfThenElseZero(apart, hn::Mul(separation, rate)), nothing, hn::Set(d, 1.0),
                          hn::Zero(d)};
      changed |= respond(point, k, bound, load(c.friction + k), wish, pressing, friction);
    }
    if (changed) keep(bound, c, k, bodies);
  });
}

/// A face with room for two points may have one, of which the second has no mass.
void learn(FaceSequence blocks, const SolverBody* bodies, const Learning& learning) {
  for_each_part(blocks, bodies, [=](FaceBlock& c, std::size_t k) HWY_ATTR {
    const D d;
    const Mask slow = is_slow(motion(bodies, c.a + k), motion(bodies, c.b + k), learning);
    FaceBlock::Point &first = c.points[0], &second = c.points[1];
    const Reals mass = load(first.normal_mass + k), load_1 = load(first.normal_impulse + k);
    if (c.count < 2) {
      store(learnt(learning, load(first.preload + k), load_1, mass, slow), first.preload + k);
      return;
    }
    const Mask alone = hn::Eq(load(second.normal_mass + k), hn::Zero(d));
    const Reals load_2 = load(second.normal_impulse + k);
    const Reals both = hn::Mul(hn::Set(d, 0.5), hn::Add(load_1, load_2));
    const Reals preload = learnt(learning, hn::Max(load(first.preload + k), load(second.preload + k)),
                                 hn::IfThenElse(alone, load_1, both), mass, slow);
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

void prepare_and_start(FaceSequence blocks, BodyRows<SolverBody> bodies) {
  if (!blocks.empty()) HWY_DYNAMIC_DISPATCH(prepare_and_start)(blocks, bodies.by_slot().data());
}
void push_apart(FaceSequence blocks, BodyRows<SolverBody> bodies, const SolverSettings& settings) {
  if (!blocks.empty()) HWY_DYNAMIC_DISPATCH(push_apart)(blocks, bodies.by_slot().data(), settings);
}
void relax(FaceSequence blocks, BodyRows<SolverBody> bodies, const SolverSettings& settings) {
  if (!blocks.empty()) HWY_DYNAMIC_DISPATCH(relax)(blocks, bodies.by_slot().data(), settings);
}
void learn(FaceSequence blocks, BodyRows<const SolverBody> bodies, const Learning& learning) {
  if (!blocks.empty()) HWY_DYNAMIC_DISPATCH(learn)(blocks, bodies.by_slot().data(), learning);
}

}  // namespace throng
#endif
