// SPDX-License-Identifier: MIT
#include "sim/event_driven/soonest_meeting.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "sim/event_driven/soonest_meeting.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <algorithm>
#include <limits>

#include "sim/contact/lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace throng::HWY_NAMESPACE {
namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();

/// When those in `rows` meet the looker (s); never: infinite.
HWY_INLINE Reals times(const Flying* discs, const std::uint32_t* rows, const Vec& shift, const Vec* pull,
                       const Looker& looker) {
  const D d;
  const Reals zero = hn::Zero(d);
  const double* const numbers = reinterpret_cast<const double*>(discs);
  const Four m = gather<8>(numbers, rows), more = gather<8>(numbers + 4, rows);
  const Reals flown = hn::Sub(hn::Set(d, looker.now), more.first);
  Reals vx = m.third, vy = m.fourth;
  Reals x, y;
  if (pull) {
    const Reals half = hn::Mul(hn::Set(d, 0.5), flown);
    x = hn::Add(m.first, hn::Mul(flown, hn::Add(vx, hn::Mul(half, hn::Set(d, pull->x())))));
    y = hn::Add(m.second, hn::Mul(flown, hn::Add(vy, hn::Mul(half, hn::Set(d, pull->y())))));
    vx = hn::Add(vx, hn::Mul(flown, hn::Set(d, pull->x()))),
    vy = hn::Add(vy, hn::Mul(flown, hn::Set(d, pull->y())));
  } else {
    x = hn::Add(m.first, hn::Mul(flown, vx)), y = hn::Add(m.second, hn::Mul(flown, vy));
  }
  x = hn::Sub(hn::Add(x, hn::Set(d, shift.x())), hn::Set(d, looker.position.x()));
  y = hn::Sub(hn::Add(y, hn::Set(d, shift.y())), hn::Set(d, looker.position.y()));
  vx = hn::Sub(vx, hn::Set(d, looker.velocity.x())), vy = hn::Sub(vy, hn::Set(d, looker.velocity.y()));
  const Reals reach = hn::Add(hn::Set(d, looker.radius), more.second);
  const Reals excess = hn::Sub(dot(x, y, x, y), hn::Mul(reach, reach));
  const Reals nearing = hn::Neg(dot(x, y, vx, vy));
  const Reals root = hn::Sub(hn::Mul(nearing, nearing), hn::Mul(dot(vx, vy, vx, vy), excess));
  const Mask meets = hn::And(hn::Gt(nearing, zero), hn::Ge(root, zero));
  const Reals time = hn::Div(hn::Max(zero, excess), hn::Add(nearing, hn::Sqrt(root)));
  return hn::IfThenElse(meets, hn::Add(hn::Set(d, looker.now), time), hn::Set(d, kNever));
}

/// Of each lane the first meeting, and which of the rows it is with, as a number.
struct WideMeeting {
  Reals time, at;
};

HWY_INLINE WideMeeting first_of_lanes(const Flying* discs, const std::uint32_t* near, std::size_t count,
                                      const Vec& shift, const Vec* pull, const Looker& looker) {
  const D d;
  WideMeeting first{hn::Set(d, kNever), hn::Zero(d)};
  Reals at = hn::Iota(d, 0.0);
  for (std::size_t i = 0; i < count; i += kLanes) {
    const Reals time = times(discs, near + i, shift, pull, looker);
    const Mask sooner = hn::Lt(time, first.time);
    first = {hn::IfThenElse(sooner, time, first.time), hn::IfThenElse(sooner, at, first.at)};
    at = hn::Add(at, hn::Set(d, static_cast<double>(kLanes)));
  }
  return first;
}

void meet(const Flying* discs, std::uint32_t* near, std::size_t count, const Vec& shift, const Vec* pull,
          const Looker& looker, Meeting& first) {
  const D d;
  for (std::size_t k = 0; k < kLanes; ++k) near[count + k] = looker.disc;
  for (;;) {
    const WideMeeting wide = first_of_lanes(discs, near, count, shift, pull, looker);
    // Before the least is asked for, which of infinite times is not what it should be on each target.
    if (hn::AllFalse(d, hn::Lt(wide.time, hn::Set(d, first.time)))) return;
    const Reals time = hn::MinOfLanes(d, wide.time);
    const Reals at = hn::MinOfLanes(d, hn::IfThenElse(hn::Eq(wide.time, time), wide.at, hn::Set(d, kNever)));
    std::uint32_t& other = near[static_cast<std::size_t>(hn::GetLane(at))];
    if (other != looker.spared) {
      first = {hn::GetLane(time), other};
      return;
    }
    other = looker.disc;  // rounding lets them near each other, hardly ever
  }
}

}  // namespace
}  // namespace throng::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace throng {

namespace {
HWY_EXPORT(meet);
}  // namespace

void meet(const Flying* discs, std::uint32_t* near, std::size_t count, const Vec& shift, const Vec* pull,
          const Looker& looker, Meeting& first) {
  HWY_DYNAMIC_DISPATCH(meet)(discs, near, count, shift, pull, looker, first);
}

}  // namespace throng
#endif
