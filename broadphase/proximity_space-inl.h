// SPDX-License-Identifier: MIT
// Distances in the plane and where it repeats, eight lanes or fewer at a time; see proximity_search-inl.h.
#if defined(THRONG_PROXIMITY_SPACE_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef THRONG_PROXIMITY_SPACE_INL
#undef THRONG_PROXIMITY_SPACE_INL
#else
#define THRONG_PROXIMITY_SPACE_INL
#endif

#include <hwy/highway.h>

#include "broadphase/proximity_tree.h"

HWY_BEFORE_NAMESPACE();
namespace throng::broadphase::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;
using D = hn::CappedTag<double, ProximityTree::kWidth>;
using U = hn::RebindToUnsigned<D>;
using Reals = hn::Vec<D>;
using Rows = hn::Vec<U>;
using Mask = hn::Mask<D>;
constexpr std::size_t kLanes = hn::MaxLanes(D());

/// From a place to an item, and from an interval of places to one of items.
struct Plane {
  explicit Plane(const Period&) {}
  template <int>
  HWY_INLINE Reals to(Reals p, Reals q) const {
    return hn::Sub(q, p);
  }
  /// A subtraction rounds no lower where it subtracts from more: no item of the interval is nearer than this
  /// to any place from p to q, to the last bit.
  template <int>
  HWY_INLINE Reals to(Reals p, Reals q, Reals low, Reals high) const {
    const Reals zero = hn::Zero(D());
    return hn::Max(hn::Max(hn::Sub(low, q), hn::Sub(p, high)), zero);
  }
  static constexpr bool kWraps = false;
};

/// The same where lengths repeat; see `fold`. Within half the period a folded length grows with the length,
/// beyond it falls: over an interval it is least at an end, or 0.
struct Torus {
  explicit Torus(const Period& period) : size{hn::Set(D(), period.size.x()), hn::Set(D(), period.size.y())} {}
  template <int kAxis>
  HWY_INLINE Reals fold(Reals d) const {
    const Reals half = hn::Mul(hn::Set(D(), 0.5), size[kAxis]);
    const Reals shift = hn::IfThenElse(hn::Gt(d, half), size[kAxis],
                                       hn::IfThenElseZero(hn::Lt(d, hn::Neg(half)), hn::Neg(size[kAxis])));
    return hn::Sub(d, shift);
  }
  template <int kAxis>
  HWY_INLINE Reals to(Reals p, Reals q) const {
    return fold<kAxis>(hn::Sub(q, p));
  }
  template <int kAxis>
  HWY_INLINE Reals to(Reals p, Reals q, Reals low, Reals high) const {
    const Reals zero = hn::Zero(D()), a = hn::Sub(low, q), b = hn::Sub(high, p);
    const Reals end = hn::Min(hn::Abs(fold<kAxis>(a)), hn::Abs(fold<kAxis>(b)));
    return hn::IfThenZeroElse(hn::And(hn::Le(a, zero), hn::Ge(b, zero)), end);
  }
  static constexpr bool kWraps = true;
  Reals size[2];
};

HWY_INLINE Reals squared(Reals dx, Reals dy) {
  return hn::Add(hn::Mul(dx, dx), hn::Mul(dy, dy));
}

}  // namespace throng::broadphase::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
