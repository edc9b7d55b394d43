// SPDX-License-Identifier: MIT
// What models compute of all who are near, four at a time whatever the width of vectors: the same bits on
// every machine. Included once for each width.
#if defined(THRONG_CROWD_NEAR_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef THRONG_CROWD_NEAR_INL
#undef THRONG_CROWD_NEAR_INL
#else
#define THRONG_CROWD_NEAR_INL
#endif

#include <hwy/highway.h>

#include <cstddef>
#include <cstdint>
#include <vector>

#include "sim/crowd/exponential.h"
#include "sim/crowd/model.h"

HWY_BEFORE_NAMESPACE();
namespace throng::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;
using D = hn::CappedTag<double, 4>;
using Reals = hn::Vec<D>;
using Mask = hn::Mask<D>;

constexpr std::size_t kFour = 4, kLanes = hn::MaxLanes(D()), kParts = kFour / kLanes;

/// throng::exponential of each lane, bit for bit.
HWY_INLINE Reals exponential_of(Reals x) {
  const D d;
  const hn::RebindToSigned<D> whole;
  const Reals rounding = hn::Set(d, 0x1.8p52);
  x = hn::Max(x, hn::Set(d, -708.0));
  const Reals shifted = hn::Add(hn::Mul(x, hn::Set(d, 0x1.71547652b82fep0)), rounding);
  const Reals n = hn::Sub(shifted, rounding);
  const Reals r = hn::Sub(hn::Sub(x, hn::Mul(n, hn::Set(d, 0x1.62e42fee00000p-1))),
                          hn::Mul(n, hn::Set(d, 0x1.a39ef35793c76p-33)));
  Reals series = hn::Zero(d);
  for (const double term : kInverseFactorials) series = hn::Add(hn::Mul(series, r), hn::Set(d, term));
  const auto exponent = hn::Add(hn::BitCast(whole, shifted), hn::Set(whole, 1023));
  return hn::Mul(series, hn::BitCast(d, hn::ShiftLeft<52>(exponent)));
}

/// Sums of what comes at places 0, 1, 2 and 3 of each four; their sum is that of both halves.
struct FourSums {
  Reals part[kParts];

  FourSums() {
    for (Reals& p : part) p = hn::Zero(D());
  }
  HWY_INLINE void add(std::size_t p, Reals x) { part[p] = hn::Add(part[p], x); }
  double total() const {
    double each[kFour];
    for (std::size_t p = 0; p < kParts; ++p) hn::StoreU(part[p], D(), each + p * kLanes);
    return (each[0] + each[2]) + (each[1] + each[3]);
  }
};

/// Those near one agent: where from him (m), at which place, and how far apart the middles are when they
/// touch (m). Behind the last one a few who are far from everywhere fill up the four.
struct Others {
  std::vector<double> dx, dy, place, width;
  std::size_t size = 0;

  HWY_INLINE void make_room(std::size_t count) {
    if (count <= dx.size()) return;
    for (std::vector<double>* all : {&dx, &dy, &place, &width}) all->resize(2 * count + 64);
  }

  /// All whose middles are at most `reach` (m) away and behind no barrier. Two who stand in one place part
  /// along x, by their ids.
  HWY_INLINE void gather(const CrowdView& crowd, std::uint32_t own, double reach) {
    const D d;
    const Vec p = crowd.position(own);
    const Reals x = hn::Set(d, p.x()), y = hn::Set(d, p.y()), limit = hn::Set(d, reach * reach);
    const Reals radius = hn::Set(d, crowd.radius[own]);
    size = 0;
    crowd.cells.for_each_stretch(p, reach, [&](std::size_t first, std::size_t end) HWY_ATTR {
      make_room(size + (end - first) + 3 * kFour);
      for (std::size_t j = first; j < end; j += kLanes) {
        Reals to_x = hn::Sub(hn::LoadU(d, crowd.x.data() + j), x);
        const Reals to_y = hn::Sub(hn::LoadU(d, crowd.y.data() + j), y);
        const Reals square = hn::Add(hn::Mul(to_x, to_x), hn::Mul(to_y, to_y));
        Mask there = hn::And(hn::Le(square, limit), hn::FirstN(d, end - j));
        if (hn::AllFalse(d, there)) continue;
        const Mask same = hn::And(there, hn::Eq(square, hn::Zero(d)));
        const Reals places = hn::Iota(d, static_cast<double>(j));
        if (!hn::AllFalse(d, same)) {
          there = hn::AndNot(hn::Eq(places, hn::Set(d, static_cast<double>(own))), there);
          to_x = hn::IfThenElse(same, parting(crowd, own, j), to_x);
        }
        hn::CompressStore(to_x, there, d, dx.data() + size);
        hn::CompressStore(to_y, there, d, dy.data() + size);
        hn::CompressStore(places, there, d, place.data() + size);
        size += hn::CompressStore(hn::Add(radius, hn::LoadU(d, crowd.radius.data() + j)), there, d,
                                  width.data() + size);
      }
    });
    make_room(size + 2 * kFour);
    const Vec far(reach, reach);
    crowd.barriers.for_each_near({Vec(p - far), Vec(p + far)},
                                 [&](const Barriers::Segment& segment)
                                     HWY_ATTR { hide_behind(segment.a - p, segment.b - p); });
    fill_up();
  }

  /// Leaves those of which `square` (m²), by the same numbers, is at most `most`; `square` follows.
  HWY_INLINE void keep(double most, std::vector<double>& square) {
    const D d;
    std::size_t kept = 0;
    for (std::size_t k = 0; k < size; k += kLanes) {
      const Mask near =
          hn::And(hn::Le(hn::LoadU(d, square.data() + k), hn::Set(d, most)), hn::FirstN(d, size - k));
      std::size_t count = 0;
      for (std::vector<double>* all : {&dx, &dy, &place, &width, &square})
        count = hn::CompressStore(hn::LoadU(d, all->data() + k), near, d, all->data() + kept);
      kept += count;
    }
    size = kept;
    fill_up();
    for (std::size_t k = size; k < size + kFour; ++k) square[k] = kFar;
  }

 private:
  /// Takes out those who stand behind the segment from `a` to `b` (m), seen from the agent.
  HWY_INLINE void hide_behind(const Vec& a, const Vec& b) {
    const D d;
    const Reals ax = hn::Set(d, a.x()), ay = hn::Set(d, a.y()), bx = hn::Set(d, b.x()),
                by = hn::Set(d, b.y());
    const Reals along_x = hn::Sub(bx, ax), along_y = hn::Sub(by, ay);
    const Reals own_side = hn::Sub(hn::Mul(ax, by), hn::Mul(ay, bx));
    std::size_t kept = 0;
    for (std::size_t k = 0; k < size; k += kLanes) {
      const Reals x = hn::LoadU(d, dx.data() + k), y = hn::LoadU(d, dy.data() + k);
      const Reals side = hn::Sub(hn::Mul(along_x, hn::Sub(y, ay)), hn::Mul(along_y, hn::Sub(x, ax)));
      const Mask a_left = hn::Lt(hn::Sub(hn::Mul(x, ay), hn::Mul(y, ax)), hn::Zero(d));
      const Mask b_left = hn::Lt(hn::Sub(hn::Mul(x, by), hn::Mul(y, bx)), hn::Zero(d));
      const Mask behind = hn::And(hn::Lt(hn::Mul(own_side, side), hn::Zero(d)), hn::Xor(a_left, b_left));
      const Mask seen = hn::AndNot(behind, hn::FirstN(d, size - k));
      std::size_t count = 0;
      for (std::vector<double>* all : {&dx, &dy, &place, &width})
        count = hn::CompressStore(hn::LoadU(d, all->data() + k), seen, d, all->data() + kept);
      kept += count;
    }
    size = kept;
  }

  void fill_up() {
    for (std::size_t k = size; k < size + kFour; ++k) dx[k] = kFar, dy[k] = place[k] = width[k] = 0.0;
  }

  static constexpr double kFar = 1e150, kHardlyApart = 1e-150;

  static HWY_INLINE Reals parting(const CrowdView& crowd, std::uint32_t own, std::size_t j) {
    const D d;
    const Reals later = hn::Set(d, kHardlyApart);
    return hn::IfThenElse(hn::Gt(hn::LoadU(d, crowd.id.data() + j), hn::Set(d, crowd.id[own])), later,
                          hn::Neg(later));
  }
};

/// How all others push the agent away, or turn him: by `strength` (of any unit) where the two just touch, e
/// times less each `range` (m) farther; those too far to matter are left out. `gap` becomes how far from
/// touching each is (m, below 0: how deep).
HWY_INLINE Vec repulsion(double strength, double range, const Others& others, std::vector<double>& gap) {
  const D d;
  const Reals negligible = hn::Set(d, kNegligibleRanges * range), where_touching = hn::Set(d, strength);
  const Reals per_range = hn::Set(d, -1.0 / range), most = hn::Set(d, kMostExponent);
  FourSums x, y;
  if (gap.size() < others.dx.size()) gap.resize(others.dx.size());
  for (std::size_t i = 0; i < others.size; i += kFour)
    for (std::size_t p = 0; p < kParts; ++p) {
      const std::size_t k = i + p * kLanes;
      const Reals dx = hn::LoadU(d, others.dx.data() + k), dy = hn::LoadU(d, others.dy.data() + k);
      const Reals distance = hn::Sqrt(hn::Add(hn::Mul(dx, dx), hn::Mul(dy, dy)));
      const Reals free = hn::Sub(distance, hn::LoadU(d, others.width.data() + k));
      hn::StoreU(free, d, gap.data() + k);
      const Mask close = hn::Le(free, negligible);
      if (hn::AllFalse(d, close)) continue;
      const Reals push = hn::Mul(where_touching, exponential_of(hn::Min(hn::Mul(free, per_range), most)));
      const Reals scale = hn::IfThenElseZero(close, hn::Div(push, distance));
      x.add(p, hn::Mul(scale, dx));
      y.add(p, hn::Mul(scale, dy));
    }
  return {-x.total(), -y.total()};
}

}  // namespace throng::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
