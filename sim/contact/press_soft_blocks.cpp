// SPDX-License-Identifier: MIT
#include "sim/contact/soft_blocks.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "sim/contact/press_soft_blocks.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "sim/contact/lanes-inl.h"
#include "sim/contact/soft_law-inl.h"

HWY_BEFORE_NAMESPACE();
namespace throng::HWY_NAMESPACE {
namespace {

/// Adds four numbers of each lane to those of its body, lane after lane: bodies may be the same.
HWY_INLINE void add_to(SoftPush& push, const double* four) {
  const hn::CappedTag<double, 4> d;
  double* sum = reinterpret_cast<double*>(&push);
  for (std::size_t i = 0; i < 4; i += hn::MaxLanes(d))
    hn::Store(hn::Add(hn::Load(d, sum + i), hn::Load(d, four + i)), d, sum + i);
}

HWY_INLINE void push(const SoftBlock& c, std::size_t k, WideNormal n, const WideMotion& moves,
                     const WideForce& force, SoftPush* pushes) {
  const Reals x = dot(force.normal, force.tangent, n.x, hn::Neg(n.y));
  const Reals y = dot(force.normal, force.tangent, n.y, n.x), none = hn::Zero(D());
  const Reals on_a = hn::Add(hn::Mul(moves.arm_a, force.tangent), force.torque);
  const Reals on_b = hn::Sub(hn::Mul(moves.arm_b, force.tangent), force.torque);
  alignas(64) double a[4 * kLanes], b[4 * kLanes];
  hn::StoreInterleaved4(hn::Neg(x), hn::Neg(y), hn::Neg(on_a), none, D(), a);
  hn::StoreInterleaved4(x, y, hn::Neg(on_b), none, D(), b);
  for (std::size_t lane = 0; lane < kLanes; ++lane)
    add_to(pushes[c.a[k + lane]], a + 4 * lane), add_to(pushes[c.b[k + lane]], b + 4 * lane);
}

/// The springs as the last substep ended: `a` and `b` move as then.
HWY_INLINE WideSprings springs_after(const SoftBlock& c, std::size_t k, const SoftLaw& law, double h,
                                     const Four& a, const Four& b) {
  const WideMotion moves =
      motion_of(c, k, {load(c.normal_x + k), load(c.normal_y + k)}, load(c.depth + k), a, b);
  return stretched(load_springs(c, k, law.rolls), moves, time_after(moves, wide(0.5 * h)), law.rolls);
}

/// What there is of springs as the substep begins, stretched until its middle.
HWY_INLINE WideSprings springs_before(const SoftBlock& c, std::size_t k, const SoftLaw& law,
                                      const SoftSubstep& now, const WideMotion& moves, const Four& a,
                                      const Four& b) {
  const Mask known = hn::Ne(load(c.touching + k), hn::Zero(D()));
  WideSprings springs = now.first ? load_springs(c, k, law.rolls) : springs_after(c, k, law, now.h, a, b);
  springs = {hn::IfThenElseZero(known, springs.slip), hn::IfThenElseZero(known, springs.roll)};
  const Reals span = hn::IfThenElse(known, wide(0.5 * now.h), wide(now.past));
  return stretched(springs, moves, time_before(moves, span), law.rolls);
}

/// The ways from a to b.
HWY_INLINE WideNormal between(const SoftBlock& c, const SoftShifts* shifts, std::size_t k,
                              const SolverBody* bodies) {
  const Place a = place(bodies, c.a + k), b = place(bodies, c.b + k);
  const Reals x = hn::Sub(b.x, a.x), y = hn::Sub(b.y, a.y);
  if (shifts == nullptr) return {x, y};
  return {hn::Add(x, load(shifts->x + k)), hn::Add(y, load(shifts->y + k))};
}

void note_deep(const SoftBlock& c, std::size_t k, SoftSqueeze& squeeze) {
  for (std::size_t i = k; i < k + kLanes; ++i) {
    const double most = SoftSqueeze::kMost * std::min(c.radius_a[i], c.radius_b[i]);
    if (c.touching[i] != 0.0 && c.depth[i] > most) squeeze.note(c.a[i], c.b[i], c.depth[i]);
  }
}

template <bool kHertz>
HWY_INLINE void press_part(SoftBlock& c, const SoftShifts* shifts, std::size_t k, const SoftLaw& law,
                           const SoftSubstep& now, SoftSqueeze& squeeze) {
  const D d;
  const Reals zero = hn::Zero(d), radius_a = load(c.radius_a + k), radius_b = load(c.radius_b + k);
  const WideNormal way = between(c, shifts, k, now.bodies.data());
  const Reals distance2 = dot(way.x, way.y, way.x, way.y);
  const Reals reach = hn::Add(radius_a, radius_b), seen = hn::Add(reach, wide(now.fringe));
  const Mask near = hn::Lt(distance2, hn::Mul(seen, seen));
  if (hn::AllFalse(d, near)) return store(zero, c.touching + k);
  const Reals distance = hn::Sqrt(distance2), depth = hn::Sub(reach, distance);
  const Mask apart = hn::And(near, hn::Gt(distance, zero));  // far ones may be nowhere: not into the sums
  const WideNormal n{hn::IfThenElse(apart, hn::Div(way.x, distance), wide(1.0)),
                     hn::IfThenElseZero(apart, hn::Div(way.y, distance))};
  const Four a = gather(now.bodies.data(), c.a + k, 0), b = gather(now.bodies.data(), c.b + k, 0);
  const WideMotion moves = motion_of(c, k, n, depth, a, b);
  const Reals ahead = hn::Abs(hn::Mul(wide(0.5 * now.h), moves.closing));
  const Mask touching = hn::And(near, hn::Gt(hn::Add(depth, ahead), zero));
  if (hn::AllFalse(d, touching)) return store(zero, c.touching + k);
  WideSprings springs = springs_before(c, k, law, now, moves, a, b);
  store_springs(springs, c, k, law.rolls);
  store(hn::IfThenElseZero(touching, wide(1.0)), c.touching + k);
  store(n.x, c.normal_x + k), store(n.y, c.normal_y + k), store(depth, c.depth + k);
  push(c, k, n, moves, force_of<kHertz>(c, k, law, moves, touching, now.h, springs), now.pushes.data());
  const Reals most = hn::Mul(wide(SoftSqueeze::kMost), hn::Min(radius_a, radius_b));
  if (!hn::AllFalse(d, hn::And(touching, hn::Gt(depth, most)))) note_deep(c, k, squeeze);
}

template <bool kHertz>
HWY_INLINE void press_part_again(SoftBlock& c, std::size_t k, const SoftLaw& law, const SoftSubstep& now) {
  const Mask touching = hn::Ne(load(c.touching + k), hn::Zero(D()));
  if (hn::AllFalse(D(), touching)) return;
  const double* speeds = reinterpret_cast<const double*>(now.speeds.data());
  const Four a = gather<4>(speeds, c.a + k), b = gather<4>(speeds, c.b + k);
  const WideNormal n{load(c.normal_x + k), load(c.normal_y + k)};
  const WideMotion moves = motion_of(c, k, n, load(c.depth + k), a, b);
  WideSprings springs = load_springs(c, k, law.rolls);
  const WideForce force = force_of<kHertz>(c, k, law, moves, touching, now.h, springs);
  store_springs(springs, c, k, law.rolls);
  if (now.last) store(force.normal, c.force + k);
  push(c, k, n, moves, force, now.pushes.data());
}

template <bool kHertz>
void press_all(std::span<SoftBlock> blocks, std::span<const SoftShifts> shifts, const SoftLaw& law,
               const SoftSubstep& now, SoftSqueeze& squeeze) {
  for (std::size_t i = 0; i < blocks.size(); ++i)
    for (std::size_t k = 0; k < BlockOrder::kWidth; k += kLanes)
      press_part<kHertz>(blocks[i], shifts.empty() ? nullptr : &shifts[i], k, law, now, squeeze);
}

template <bool kHertz>
void press_all_again(std::span<SoftBlock> blocks, const SoftLaw& law, const SoftSubstep& now) {
  for (SoftBlock& block : blocks)
    for (std::size_t k = 0; k < BlockOrder::kWidth; k += kLanes) press_part_again<kHertz>(block, k, law, now);
}

void press_soft(std::span<SoftBlock> blocks, std::span<const SoftShifts> shifts, const SoftLaw& law,
                const SoftSubstep& now, SoftSqueeze& squeeze) {
  law.hertz ? press_all<true>(blocks, shifts, law, now, squeeze)
            : press_all<false>(blocks, shifts, law, now, squeeze);
}

void press_soft_again(std::span<SoftBlock> blocks, const SoftLaw& law, const SoftSubstep& now) {
  law.hertz ? press_all_again<true>(blocks, law, now) : press_all_again<false>(blocks, law, now);
}

void stretch_soft(std::span<SoftBlock> blocks, const SoftLaw& law, const SoftSubstep& now) {
  for (SoftBlock& c : blocks)
    for (std::size_t k = 0; k < BlockOrder::kWidth; k += kLanes) {
      const Four a = gather(now.bodies.data(), c.a + k, 0), b = gather(now.bodies.data(), c.b + k, 0);
      const WideSprings springs = springs_after(c, k, law, now.h, a, b);
      store_springs(springs, c, k, law.rolls);
    }
}

}  // namespace
}  // namespace throng::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace throng {

namespace {
HWY_EXPORT(press_soft);
HWY_EXPORT(press_soft_again);
HWY_EXPORT(stretch_soft);
}  // namespace

void press_soft(std::span<SoftBlock> blocks, std::span<const SoftShifts> shifts, const SoftLaw& law,
                const SoftSubstep& now, SoftSqueeze& squeeze) {
  HWY_DYNAMIC_DISPATCH(press_soft)(blocks, shifts, law, now, squeeze);
}
void press_soft_again(std::span<SoftBlock> blocks, const SoftLaw& law, const SoftSubstep& now) {
  HWY_DYNAMIC_DISPATCH(press_soft_again)(blocks, law, now);
}
void stretch_soft(std::span<SoftBlock> blocks, const SoftLaw& law, const SoftSubstep& now) {
  HWY_DYNAMIC_DISPATCH(stretch_soft)(blocks, law, now);
}

}  // namespace throng
#endif
