// SPDX-License-Identifier: MIT
// The law of soft contacts in lanes: what soft_law.h does, operation by operation. Included once for each
// width of vectors.
#if defined(THRONG_CONTACT_SOFT_LAW_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef THRONG_CONTACT_SOFT_LAW_INL
#undef THRONG_CONTACT_SOFT_LAW_INL
#else
#define THRONG_CONTACT_SOFT_LAW_INL
#endif

#include <hwy/highway.h>

#include <cstddef>

#include "sim/contact/lanes-inl.h"
#include "sim/contact/soft_blocks.h"

HWY_BEFORE_NAMESPACE();
namespace throng::HWY_NAMESPACE {
namespace {

HWY_INLINE Reals wide(double x) {
  return hn::Set(D(), x);
}
HWY_INLINE Reals half_of(Reals x) {
  return hn::Mul(wide(0.5), x);
}
HWY_INLINE Reals above_zero(Reals x) {
  return hn::Max(x, hn::Zero(D()));
}

/// As SoftMotion, and the arms of the two.
struct WideMotion {
  Reals depth, closing, sliding, rolling, arm_a, arm_b;
};

struct WideNormal {
  Reals x, y;
};

struct WidePair {
  Reals stiffness, damping;
};

struct WideSprings {
  Reals slip, roll;  // nothing rolls: not looked at, as memory is what blocks take
};

HWY_INLINE WideSprings load_springs(const SoftBlock& c, std::size_t k, bool rolls) {
  return {load(c.slip + k), rolls ? load(c.roll + k) : hn::Zero(D())};
}

HWY_INLINE void store_springs(const WideSprings& springs, SoftBlock& c, std::size_t k, bool rolls) {
  store(springs.slip, c.slip + k);
  if (rolls) store(springs.roll, c.roll + k);
}

struct WideForce {
  Reals normal, tangent, torque;
};

/// As SoftMean.
struct WideMean {
  Reals normal, share, stiffness, damping;
};

/// `a` and `b` begin with velocity_x, velocity_y and spin.
HWY_INLINE WideMotion motion_of(const SoftBlock& c, std::size_t k, WideNormal n, Reals depth, const Four& a,
                                const Four& b) {
  const Reals in = half_of(above_zero(depth));
  const Reals arm_a = hn::Sub(load(c.radius_a + k), in), arm_b = hn::Sub(load(c.radius_b + k), in);
  const Reals x = hn::Sub(b.first, a.first), y = hn::Sub(b.second, a.second);
  const Reals turned = dot(arm_a, arm_b, a.third, b.third);
  return {depth,
          hn::Neg(dot(x, y, n.x, n.y)),
          hn::Sub(dot(x, y, hn::Neg(n.y), n.x), turned),
          hn::Sub(b.third, a.third),
          arm_a,
          arm_b};
}

/// As LinearLaw::mean(), where depth and half the way add up to more than nothing; elsewhere without a
/// meaning.
HWY_INLINE WideMean linear_mean(const WidePair& pair, Reals depth, Reals closing, double h) {
  const Reals way = hn::Abs(hn::Mul(wide(0.5 * h), closing)), most = hn::Add(depth, way);
  const Reals full = dot(pair.stiffness, pair.damping, depth, closing);
  const Mask whole = hn::Ge(depth, way);
  if (hn::AllTrue(D(), whole)) return {full, wide(1.0), pair.stiffness, pair.damping};
  const Reals share = hn::Div(half_of(most), way);
  const Reals partly = hn::Mul(share, dot(half_of(pair.stiffness), pair.damping, most, closing));
  return {hn::IfThenElse(whole, full, partly), hn::IfThenElse(whole, wide(1.0), share), pair.stiffness,
          pair.damping};
}

HWY_INLINE Reals elastic_work(Reals depth) {
  return hn::Mul(hn::Mul(depth, depth), hn::Sqrt(depth));
}
HWY_INLINE Reals viscous_drag(Reals depth) {
  return hn::Mul(depth, hn::Sqrt(hn::Sqrt(depth)));
}

/// As HertzLaw::mean(), there as well.
HWY_INLINE WideMean hertz_mean(const WidePair& pair, Reals depth, Reals closing, double h) {
  const Reals way = hn::Abs(hn::Mul(wide(0.5 * h), closing)), most = hn::Add(depth, way);
  const Reals root = hn::Sqrt(above_zero(depth)), fourth = hn::Sqrt(root);
  const Reals stiffness = hn::Mul(hn::Mul(wide(1.5), pair.stiffness), root);
  const Reals damping = hn::Mul(pair.damping, fourth);
  const Reals middle = hn::Add(hn::Mul(hn::Mul(pair.stiffness, depth), root), hn::Mul(damping, closing));
  const Mask straight = hn::Lt(way, hn::Mul(wide(HertzLaw::kStraight), depth));
  if (hn::AllTrue(D(), straight)) return {middle, wide(1.0), stiffness, damping};
  const Reals least = above_zero(hn::Sub(depth, way)), size = hn::Mul(wide(2.0), way);
  const Reals elastic = hn::Mul(wide(0.4), hn::Sub(elastic_work(most), elastic_work(least)));
  const Reals viscous = hn::Mul(wide(0.8), hn::Sub(viscous_drag(most), viscous_drag(least)));
  const Reals bent = hn::Div(
      hn::Add(hn::Mul(pair.stiffness, elastic), hn::Mul(hn::Mul(pair.damping, closing), viscous)), size);
  return {hn::IfThenElse(straight, middle, bent),
          hn::IfThenElse(straight, wide(1.0), hn::Div(hn::Sub(most, least), size)), stiffness, damping};
}

/// As soft_hold().
HWY_INLINE Reals hold(Reals stiffness, Reals damping, Reals share, Reals most, Reals rate, Reals& spring) {
  const Reals force = hn::Mul(hn::Neg(share), dot(stiffness, damping, spring, rate));
  const Mask held = hn::Le(hn::Abs(force), most);
  if (hn::AllTrue(D(), held)) return force;
  const Reals most_of_it = hn::CopySign(most, force);
  const Reals kept = hn::Div(hn::Neg(hn::Add(hn::Div(most_of_it, share), hn::Mul(damping, rate))), stiffness);
  const Mask springy = hn::Gt(stiffness, hn::Zero(D()));
  spring = hn::IfThenElse(hn::AndNot(held, springy), kept, spring);
  return hn::IfThenElse(held, force, most_of_it);
}

/// As soft_force(), where `touching`; elsewhere there is none, and what becomes of the springs has no
/// meaning.
template <bool kHertz>
HWY_INLINE WideForce force_of(const SoftBlock& c, std::size_t k, const SoftLaw& law, const WideMotion& moves,
                              Mask touching, double h, WideSprings& springs) {
  const WidePair pair{load(c.stiffness + k), load(c.damping + k)};
  const WideMean mean = kHertz ? hertz_mean(pair, moves.depth, moves.closing, h)
                               : linear_mean(pair, moves.depth, moves.closing, h);
  const Reals most_in = hn::Add(moves.depth, hn::Abs(hn::Mul(wide(0.5 * h), moves.closing)));
  const Mask in = hn::And(hn::Gt(most_in, hn::Zero(D())), hn::Gt(mean.share, hn::Zero(D())));
  const Mask acts = hn::And(touching, in);
  const Reals pressing = above_zero(mean.normal);
  const Reals stiffness = hn::Mul(wide(law.tangential.stiffness), mean.stiffness);
  const Reals damping = hn::Mul(wide(law.tangential.damping), mean.damping);
  WideSprings after = springs;
  const Reals tangent = hold(stiffness, damping, mean.share, hn::Mul(load(c.friction + k), pressing),
                             moves.sliding, after.slip);
  WideForce force{hn::IfThenElseZero(acts, mean.normal), hn::IfThenElseZero(acts, tangent), hn::Zero(D())};
  if (law.rolls) {
    const Reals radius = load(c.roll_radius + k), radius2 = hn::Mul(radius, radius);
    const Reals most = hn::Mul(hn::Mul(load(c.rolling + k), radius), pressing);
    force.torque = hn::IfThenElseZero(acts, hold(hn::Mul(stiffness, radius2), hn::Mul(damping, radius2),
                                                 mean.share, most, moves.rolling, after.roll));
  }
  springs = {hn::IfThenElse(acts, after.slip, springs.slip), hn::IfThenElse(acts, after.roll, springs.roll)};
  return force;
}

/// As contact_time_before().
HWY_INLINE Reals time_before(const WideMotion& moves, Reals span) {
  const Mask came = hn::Gt(hn::Mul(moves.closing, span), moves.depth);
  const Reals time =
      hn::AllFalse(D(), came) ? span : hn::IfThenElse(came, hn::Div(moves.depth, moves.closing), span);
  return hn::IfThenElseZero(hn::Gt(moves.depth, hn::Zero(D())), time);
}

/// As contact_time_after().
HWY_INLINE Reals time_after(const WideMotion& moves, Reals span) {
  const Mask in = hn::Gt(moves.depth, hn::Zero(D()));
  if (hn::AllTrue(D(), in)) return span;
  const Mask comes = hn::Gt(hn::Mul(moves.closing, span), hn::Neg(moves.depth));
  const Reals late = hn::IfThenElseZero(comes, hn::Add(span, hn::Div(moves.depth, moves.closing)));
  return hn::IfThenElse(in, span, late);
}

HWY_INLINE WideSprings stretched(const WideSprings& springs, const WideMotion& moves, Reals time,
                                 bool rolls) {
  return {hn::Add(springs.slip, hn::Mul(time, moves.sliding)),
          rolls ? hn::Add(springs.roll, hn::Mul(time, moves.rolling)) : springs.roll};
}

}  // namespace
}  // namespace throng::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
