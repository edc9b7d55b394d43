// SPDX-License-Identifier: MIT
#include "sim/crowd/permitted_velocity.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "sim/crowd/permitted_velocity.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "sim/crowd/compress-inl.h"

HWY_BEFORE_NAMESPACE();
namespace throng::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;
using Wide = hn::ScalableTag<double>;  // least, largest, any: nothing depends on the width
using Reals = hn::Vec<Wide>;
using Mask = hn::Mask<Wide>;
static_assert(hn::MaxLanes(Wide()) <= HalfPlanes::kPadding);

constexpr double kParallel = 1e-14;  // sine of an angle between unit vectors that rounding makes

/// What is looked for: the point nearest to `target`, or the farthest along the unit vector `target`.
struct Aim {
  Vec target;
  bool far = false;
};

double outside(const HalfPlane& plane, const Vec& v) {
  return plane.offset - plane.normal.dot(v);
}

/// As many numbers of each array as there are lanes.
struct Planes {
  Reals x, y, offset;

  HWY_INLINE Planes(const HalfPlanes& planes, std::size_t first)
      : x(hn::LoadU(Wide(), planes.normal_x.data() + first)),
        y(hn::LoadU(Wide(), planes.normal_y.data() + first)),
        offset(hn::LoadU(Wide(), planes.offset.data() + first)) {}

  HWY_INLINE Reals along(const Vec& v) const {
    return hn::Add(hn::Mul(x, hn::Set(Wide(), v.x())), hn::Mul(y, hn::Set(Wide(), v.y())));
  }
  HWY_INLINE Reals outside(const Vec& v) const { return hn::Sub(offset, along(v)); }
};

/// The first from the i-th on that `v` lies outside of; `end` where there is none.
HWY_INLINE std::size_t first_outside(const HalfPlanes& planes, std::size_t i, std::size_t end, const Vec& v) {
  const Wide d;
  for (; i < end; i += hn::Lanes(d)) {
    const Mask out = hn::Gt(Planes(planes, i).outside(v), hn::Zero(d));
    const std::intptr_t found = hn::FindFirstTrue(d, hn::And(out, hn::FirstN(d, end - i)));
    if (found >= 0) return i + static_cast<std::size_t>(found);
  }
  return end;
}

/// Of the border of the i-th within the disc and the half planes before it, the best point. False where there
/// is none.
HWY_INLINE bool best_on_border(const HalfPlanes& planes, std::size_t i, double most, const Aim& aim,
                               Vec& best) {
  const HalfPlane plane = planes[i];
  const double room = most * most - plane.offset * plane.offset;
  if (!(room >= 0.0)) return false;
  const Vec along(-plane.normal.y(), plane.normal.x()), middle = plane.offset * plane.normal;
  const Wide d;
  const Reals zero = hn::Zero(d), parallel = hn::Set(d, kParallel), much = hn::Set(d, kParallel * most);
  Reals highs = hn::Set(d, std::sqrt(room)), lows = hn::Neg(highs);
  Mask nowhere = hn::Lt(zero, zero);
  for (std::size_t k = 0; k < i; k += hn::Lanes(d)) {
    const Planes others(planes, k);
    const Mask there = hn::FirstN(d, i - k);
    const Reals slope = others.along(along), lack = others.outside(middle);
    const Mask meets = hn::And(there, hn::Gt(hn::Abs(slope), parallel));
    nowhere = hn::Or(nowhere, hn::And(hn::AndNot(meets, there), hn::Gt(lack, much)));
    const Reals t = hn::Add(hn::Div(lack, slope), zero);  // never -0, which has no place among numbers
    const Mask rises = hn::Gt(slope, zero);
    lows = hn::IfThenElse(hn::And(meets, rises), hn::Max(lows, t), lows);
    highs = hn::IfThenElse(hn::AndNot(rises, meets), hn::Min(highs, t), highs);
  }
  const double low = hn::GetLane(hn::MaxOfLanes(d, lows)), high = hn::GetLane(hn::MinOfLanes(d, highs));
  if (low > high || !hn::AllFalse(d, nowhere)) return false;
  const double wanted = along.dot(aim.target);
  const double t = aim.far ? (wanted > 0.0 ? high : low) : std::clamp(wanted, low, high);
  best = middle + t * along;
  return true;
}

/// The best point within the disc and the first `count` half planes. Returns how many of these, from the
/// first on, it lies in: all, unless they have none in common.
HWY_INLINE std::size_t best_within(const HalfPlanes& planes, std::size_t count, double most, const Aim& aim,
                                   Vec& best) {
  const double length = aim.target.norm();
  best = aim.far ? Vec(most * aim.target) : length > most ? Vec(most / length * aim.target) : aim.target;
  for (std::size_t i = 0; (i = first_outside(planes, i, count, best)) < count; ++i)
    if (!best_on_border(planes, i, most, aim, best)) return i;
  return count;
}

/// Behind the hard ones: for each of the others before the i-th where no more than it is outside of its
/// plane, one is outside of the i-th; none where that is everywhere or nowhere.
HWY_INLINE void set_less_outside(const HalfPlanes& planes, std::size_t hard, std::size_t i,
                                 HalfPlanes& room) {
  const Wide d;
  const HalfPlane plane = planes[i];
  const Reals x = hn::Set(d, plane.normal.x()), y = hn::Set(d, plane.normal.y()),
              offset = hn::Set(d, plane.offset);
  room.size = 0;
  room.make_room(i);
  for (std::size_t j = 0; j < hard; ++j) room.push_back(planes[j]);
  for (std::size_t j = hard; j < i; j += hn::Lanes(d)) {
    const Planes others(planes, j);
    const Reals to_x = hn::Sub(others.x, x), to_y = hn::Sub(others.y, y);
    const Reals length = hn::Sqrt(hn::Add(hn::Mul(to_x, to_x), hn::Mul(to_y, to_y)));
    const Compressor apart(hn::And(hn::Gt(length, hn::Set(d, kParallel)), hn::FirstN(d, i - j)));
    apart.store(hn::Div(to_x, length), room.normal_x.data() + room.size);
    apart.store(hn::Div(to_y, length), room.normal_y.data() + room.size);
    apart.store(hn::Div(hn::Sub(others.offset, offset), length), room.offset.data() + room.size);
    room.size += apart.count();
  }
}

Vec PermittedVelocity(const HalfPlanes& planes, std::size_t hard, double most, const Vec& preferred,
                      HalfPlanes& room) {
  Vec best;
  const std::size_t good = best_within(planes, planes.size, most, {preferred}, best);
  if (good == planes.size) return best;
  double depth = -std::numeric_limits<double>::infinity();
  for (std::size_t i = hard; i < good; ++i) depth = std::max(depth, outside(planes[i], best));
  if (good < hard) best_within(planes, hard, most, {preferred}, best);
  for (std::size_t i = std::max(good, hard); i < planes.size; ++i) {
    const HalfPlane plane = planes[i];
    if (!(outside(plane, best) > depth)) continue;
    set_less_outside(planes, hard, i, room);
    const Vec before = best;
    if (best_within(room, room.size, most, {plane.normal, true}, best) < room.size) best = before;
    depth = outside(plane, best);
  }
  return best;
}

}  // namespace throng::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE

namespace throng {

HWY_EXPORT(PermittedVelocity);

Vec permitted_velocity(const HalfPlanes& planes, std::size_t hard, double most, const Vec& preferred,
                       HalfPlanes& room) {
  return HWY_DYNAMIC_DISPATCH(PermittedVelocity)(planes, hard, most, preferred, room);
}

}  // namespace throng

#endif
