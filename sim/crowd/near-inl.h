// SPDX-License-Identifier: MIT
// What models compute of all who are near: each on its own at the full width of vectors, sums four at a time
// whatever the width is: the same bits on every machine. Included once for each width.
#if defined(THRONG_CROWD_NEAR_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef THRONG_CROWD_NEAR_INL
#undef THRONG_CROWD_NEAR_INL
#else
#define THRONG_CROWD_NEAR_INL
#endif

#include <hwy/highway.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "sim/crowd/compress-inl.h"
#include "sim/crowd/exponential.h"
#include "sim/crowd/model.h"

HWY_BEFORE_NAMESPACE();
namespace throng::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;
using D = hn::CappedTag<double, 4>;
using Reals = hn::Vec<D>;
using Mask = hn::Mask<D>;

constexpr std::size_t kFour = 4, kLanes = hn::MaxLanes(D()), kParts = kFour / kLanes;
using Wide = hn::ScalableTag<double>;  // where each number is computed on its own
using WideReals = hn::Vec<Wide>;
using WideMask = hn::Mask<Wide>;
constexpr std::size_t kWide = hn::MaxLanes(Wide());

/// Makes each lane of some vectors throng::exponential of it, bit for bit. Each step of one waits for the
/// step before, in whose time those of others are done.
template <std::size_t kCount, class Tag, class Numbers = hn::Vec<Tag>>
HWY_INLINE void exponentiate(Tag d, Numbers (&x)[kCount]) {
  const hn::RebindToSigned<Tag> whole;
  const Numbers rounding = hn::Set(d, 0x1.8p52);
  Numbers shifted[kCount], series[kCount];
  for (std::size_t i = 0; i < kCount; ++i) {
    x[i] = hn::Max(x[i], hn::Set(d, -708.0));
    shifted[i] = hn::Add(hn::Mul(x[i], hn::Set(d, 0x1.71547652b82fep0)), rounding);
    const Numbers n = hn::Sub(shifted[i], rounding);
    x[i] = hn::Sub(hn::Sub(x[i], hn::Mul(n, hn::Set(d, 0x1.62e42fee00000p-1))),
                   hn::Mul(n, hn::Set(d, 0x1.a39ef35793c76p-33)));
    series[i] = hn::Zero(d);
  }
  for (const double term : kInverseFactorials)
    for (std::size_t i = 0; i < kCount; ++i) series[i] = hn::Add(hn::Mul(series[i], x[i]), hn::Set(d, term));
  for (std::size_t i = 0; i < kCount; ++i) {
    const auto exponent = hn::Add(hn::BitCast(whole, shifted[i]), hn::Set(whole, 1023));
    x[i] = hn::Mul(series[i], hn::BitCast(d, hn::ShiftLeft<52>(exponent)));
  }
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

/// Where those near one of several agents are in `Others`.
struct Near {
  std::size_t first, size;
};

constexpr std::size_t kAtOnce = 12;  // vectors, whose exponentials are computed in the time of one another
constexpr std::size_t kMostly = 16;  // so many agents are near at the most, mostly
constexpr std::size_t kBehind =
    std::max((kAtOnce + 1) * kWide, kMostly);  // numbers of room behind the last one, of no meaning
constexpr std::size_t kTogether = 32;          // agents, whose others fit into the nearest cache

/// What a model is told of others: `who`: also at which places they are.
enum class Tell { where, who };

/// Those near one agent, or near several one after the other: where from him (m), how far apart the middles
/// are when they touch (m), and at which place, where that is asked.
struct Others {
  std::vector<double> dx, dy, width, place;
  std::size_t first = 0, size = 0;  // of the agent who was added last

  void clear() { first = size = 0; }
  std::size_t end() const { return first + size; }

  /// All whose middles are at most `reach` (m) away and behind no barrier. Two who stand in one place part
  /// along x, by their ids.
  template <Tell kTell>
  HWY_INLINE Near add_near(const CrowdView& crowd, std::uint32_t own, double reach) {
    first = end(), size = 0;
    make_room(0);
    broadphase::Range range;
    if (crowd.cells.find(crowd.position(own), reach, range)) add<kTell>(crowd, range, own, reach * reach);
    if (HWY_UNLIKELY(!crowd.is_clear(own, reach))) hide_behind_barriers(crowd, own, reach);
    return {first, size};
  }

  /// Forgets those who were added last.
  void drop() { size = 0; }

  /// m², of those from the k-th on.
  HWY_INLINE WideReals square(std::size_t k) const {
    const Wide d;
    const auto x = hn::LoadU(d, dx.data() + k), y = hn::LoadU(d, dy.data() + k);
    return hn::Add(hn::Mul(x, x), hn::Mul(y, y));
  }

 private:
  static constexpr double kHardlyApart = 1e-150;

  /// For so many of the agent who was added last, and kBehind.
  void make_room(std::size_t count) {
    count += first + kBehind;
    if (count <= dx.size()) return;
    for (std::vector<double>* all : {&dx, &dy, &width, &place}) all->resize(2 * count + 64);
  }

  template <Tell kTell>
  HWY_INLINE void add(const CrowdView& crowd, const broadphase::Range& range, std::uint32_t own,
                      double limit) {
    const Wide d;
    const auto x = hn::Set(d, crowd.x[own]), y = hn::Set(d, crowd.y[own]), farthest = hn::Set(d, limit),
               radius = hn::Set(d, crowd.radius[own]), itself = hn::Set(d, static_cast<double>(own));
    const double *const all_x = crowd.x.data(), *const all_y = crowd.y.data();
    const double* const all_radius = crowd.radius.data();
    for (std::int64_t row = range.first.y; row <= range.last.y; ++row) {
      const auto [begin, end] = crowd.cells.stretch(range, row);
      make_room(size + (end - begin));
      double *const near_x = dx.data(), *const near_y = dy.data(), *const near_width = width.data(),
                    *const near_place = place.data();
      std::size_t count = first + size;
      const auto last = hn::Set(d, static_cast<double>(end));
      auto places = hn::Iota(d, static_cast<double>(begin));
      for (std::size_t j = begin; j < end; j += kWide) {
        auto to_x = hn::Sub(hn::LoadU(d, all_x + j), x);
        const auto to_y = hn::Sub(hn::LoadU(d, all_y + j), y);
        const auto far = hn::Add(hn::Mul(to_x, to_x), hn::Mul(to_y, to_y));
        const auto there =
            hn::And(hn::And(hn::Le(far, farthest), hn::Lt(places, last)), hn::Ne(places, itself));
        const auto same = hn::And(there, hn::Eq(far, hn::Zero(d)));
        if (HWY_UNLIKELY(!hn::AllFalse(d, same))) to_x = hn::IfThenElse(same, parting(crowd, own, j), to_x);
        const Compressor those(there);
        those.store(to_x, near_x + count);
        those.store(to_y, near_y + count);
        those.store(hn::Add(radius, hn::LoadU(d, all_radius + j)), near_width + count);
        if constexpr (kTell == Tell::who) those.store(places, near_place + count);
        count += those.count();
        places = hn::Add(places, hn::Set(d, static_cast<double>(kWide)));
      }
      size = count - first;
    }
  }

  HWY_NOINLINE void hide_behind_barriers(const CrowdView& crowd, std::uint32_t own, double reach) {
    const Vec p = crowd.position(own), far(reach, reach);
    crowd.barriers.for_each_near({Vec(p - far), Vec(p + far)},
                                 [&](const Barriers::Segment& segment)
                                     HWY_ATTR { hide_behind(segment.a - p, segment.b - p); });
  }

  static HWY_INLINE hn::Vec<Wide> parting(const CrowdView& crowd, std::uint32_t own, std::size_t j) {
    const Wide d;
    const auto later = hn::Set(d, kHardlyApart);
    return hn::IfThenElse(hn::Gt(hn::LoadU(d, crowd.id.data() + j), hn::Set(d, crowd.id[own])), later,
                          hn::Neg(later));
  }

  /// Leaves those of which `stays`, which is asked from the k-th on, is true.
  template <class F>
  HWY_INLINE void filter(F stays) {
    const Wide d;
    std::size_t kept = first;
    for (std::size_t k = first, last = first + size; k < last; k += kWide) {
      const Compressor left(hn::And(stays(k), hn::FirstN(d, last - k)));
      for (std::vector<double>* all : {&dx, &dy, &width, &place})
        left.store(hn::LoadU(d, all->data() + k), all->data() + kept);
      kept += left.count();
    }
    size = kept - first;
  }

  /// Takes out those who stand behind the segment from `a` to `b` (m), seen from the agent.
  HWY_INLINE void hide_behind(const Vec& a, const Vec& b) {
    const Wide d;
    const auto ax = hn::Set(d, a.x()), ay = hn::Set(d, a.y()), bx = hn::Set(d, b.x()), by = hn::Set(d, b.y());
    const auto along_x = hn::Sub(bx, ax), along_y = hn::Sub(by, ay);
    const auto own_side = hn::Sub(hn::Mul(ax, by), hn::Mul(ay, bx));
    filter([&](std::size_t k) HWY_ATTR {
      const auto x = hn::LoadU(d, dx.data() + k), y = hn::LoadU(d, dy.data() + k);
      const auto side = hn::Sub(hn::Mul(along_x, hn::Sub(y, ay)), hn::Mul(along_y, hn::Sub(x, ax)));
      const auto a_left = hn::Lt(hn::Sub(hn::Mul(x, ay), hn::Mul(y, ax)), hn::Zero(d));
      const auto b_left = hn::Lt(hn::Sub(hn::Mul(x, by), hn::Mul(y, bx)), hn::Zero(d));
      return hn::Not(hn::And(hn::Lt(hn::Mul(own_side, side), hn::Zero(d)), hn::Xor(a_left, b_left)));
    });
  }
};

/// How hard each of the others pushes whom he is near, and how far from touching it is (m, below 0: how
/// deep).
struct Pushes {
  std::vector<double> gap, per_metre;  // per_metre: the push over the distance

  void resize(std::size_t size) {
    if (gap.size() < size) gap.resize(size), per_metre.resize(size);
  }
};

/// By `strength` (of any unit) where the two just touch, e times less each `range` (m) farther; by nothing
/// where that is too little to matter.
HWY_INLINE void push(double strength, double range, const Others& others, Pushes& pushes) {
  const Wide d;
  const auto negligible = hn::Set(d, kNegligibleRanges * range), where_touching = hn::Set(d, strength);
  const auto per_range = hn::Set(d, -1.0 / range), most = hn::Set(d, kMostExponent);
  pushes.resize(others.dx.size());
  double *const gap = pushes.gap.data(), *const per_metre = pushes.per_metre.data();
  for (std::size_t first = 0; first < others.end(); first += kAtOnce * kWide) {
    WideReals distance[kAtOnce], power[kAtOnce];
    for (std::size_t i = 0, k = first; i < kAtOnce; ++i, k += kWide) {
      distance[i] = hn::Sqrt(others.square(k));
      const auto free = hn::Sub(distance[i], hn::LoadU(d, others.width.data() + k));
      power[i] = hn::Min(hn::Mul(free, per_range), most);
      hn::StoreU(free, d, gap + k);
    }
    exponentiate(d, power);
    for (std::size_t i = 0, k = first; i < kAtOnce; ++i, k += kWide) {
      const auto its = hn::Div(hn::Mul(where_touching, power[i]), distance[i]);
      hn::StoreU(hn::IfThenElseZero(hn::Le(hn::LoadU(d, gap + k), negligible), its), d, per_metre + k);
    }
  }
}

/// How all near him push the agent away, or turn him. As many as there mostly are without asking how many
/// there are, which no processor foretells.
HWY_INLINE Vec repulsion(const Others& others, const Pushes& pushes, const Near& near) {
  const D d;
  FourSums x, y;
  const double *const dx = others.dx.data() + near.first, *const dy = others.dy.data() + near.first,
                      *const per_metre = pushes.per_metre.data() + near.first;
  const auto add_four = [&](std::size_t i) HWY_ATTR {
    for (std::size_t p = 0; p < kParts; ++p) {
      const std::size_t k = i + p * kLanes;
      const Mask is = hn::FirstN(d, k < near.size ? near.size - k : 0);
      const Reals scale = hn::LoadU(d, per_metre + k);
      x.add(p, hn::IfThenElseZero(is, hn::Mul(scale, hn::LoadU(d, dx + k))));
      y.add(p, hn::IfThenElseZero(is, hn::Mul(scale, hn::LoadU(d, dy + k))));
    }
  };
  for (std::size_t i = 0; i < kMostly; i += kFour) add_four(i);
  for (std::size_t i = kMostly; i < near.size; i += kFour) add_four(i);
  return {-x.total(), -y.total()};
}

}  // namespace throng::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
