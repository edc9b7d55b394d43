// SPDX-License-Identifier: MIT
// Eight contacts at a time: how their bodies get into lanes and back, and what all kinds of contact ask of an
// impulse. Included once for each width of vectors.
#if defined(THRONG_CONTACT_LANES_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef THRONG_CONTACT_LANES_INL
#undef THRONG_CONTACT_LANES_INL
#else
#define THRONG_CONTACT_LANES_INL
#endif

#include <hwy/cache_control.h>
#include <hwy/highway.h>

#include <cstddef>
#include <cstdint>
#include <span>

#include "sim/contact/block_order.h"
#include "sim/contact/solve.h"

HWY_BEFORE_NAMESPACE();
namespace throng::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;
using D = hn::CappedTag<double, BlockOrder::kWidth>;
using Reals = hn::Vec<D>;
using Mask = hn::Mask<D>;
constexpr std::size_t kLanes = hn::MaxLanes(D());

HWY_INLINE Reals load(const double* row) {
  return hn::Load(D(), row);
}
HWY_INLINE void store(Reals v, double* row) {
  hn::Store(v, D(), row);
}

/// Bodies are asked for so many blocks before they are needed: they don't stand together as blocks do.
constexpr std::size_t kAhead = 3;

template <class Block, class Body>
HWY_INLINE void ask_for_bodies(const Block& block, const Body* bodies) {
  for (const std::uint32_t a : block.a) hwy::Prefetch(bodies + a);
  for (const std::uint32_t b : block.b) hwy::Prefetch(bodies + b);
}

/// Whether nobody has a contact in the lanes from k on that are solved at once.
template <class Block>
HWY_INLINE bool is_empty(const Block& block, std::size_t k) {
  std::size_t lane = k;
  while (lane < k + kLanes && block.a[lane] == block.b[lane]) ++lane;
  return lane == k + kLanes;
}

/// Calls f(block, first lane) for all lanes of all blocks that have contacts, or from the last block on.
template <class Blocks, class F>
HWY_INLINE void for_each_part(Blocks blocks, const SolverBody* bodies, bool backward, F f) {
  const std::size_t last = blocks.size() - 1;
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    if (i + kAhead < blocks.size()) ask_for_bodies(blocks[backward ? last - i - kAhead : i + kAhead], bodies);
    auto& block = blocks[backward ? last - i : i];
    for (std::size_t k = 0; k < BlockOrder::kWidth; k += kLanes)
      if (!is_empty(block, k)) f(block, k);
  }
}
template <class Blocks, class F>
HWY_INLINE void for_each_part(Blocks blocks, const SolverBody* bodies, F f) {
  for_each_part(blocks, bodies, false, f);
}

/// Four numbers of one body in each lane.
struct Four {
  Reals first, second, third, fourth;
};

/// A body is two such halves: what contacts change, and what they look at.
HWY_INLINE const double* half(const SolverBody& body, std::size_t which) {
  return reinterpret_cast<const double*>(&body) + 4 * which;
}
HWY_INLINE double* half(SolverBody& body, std::size_t which) {
  return reinterpret_cast<double*>(&body) + 4 * which;
}

#if HWY_TARGET != HWY_SCALAR
/// Four numbers of the rows j and, with eight lanes, j + 4.
template <std::size_t kStride>
HWY_INLINE Reals two_fours(const double* numbers, const std::uint32_t* rows, std::size_t j) {
  if constexpr (kLanes == 8) {
    const hn::Half<D> d4;
    return hn::Combine(D(), hn::LoadU(d4, numbers + kStride * rows[j + 4]),
                       hn::LoadU(d4, numbers + kStride * rows[j]));
  } else {
    return hn::LoadU(D(), numbers + kStride * rows[j]);
  }
}

HWY_INLINE void put_halves(Reals v, SolverBody* bodies, const std::uint32_t* rows, std::size_t j) {
  if constexpr (kLanes == 8) {
    const hn::Half<D> d4;
    hn::StoreU(hn::LowerHalf(d4, v), d4, half(bodies[rows[j]], 0));
    hn::StoreU(hn::UpperHalf(d4, v), d4, half(bodies[rows[j + 4]], 0));
  } else {
    hn::StoreU(v, D(), half(bodies[rows[j]], 0));
  }
}
#endif

/// The first four of the `kStride` numbers that each of the rows has, one row a lane.
template <std::size_t kStride>
HWY_INLINE Four gather(const double* numbers, const std::uint32_t* rows) {
#if HWY_TARGET != HWY_SCALAR
  if constexpr (kLanes >= 4) {
    const D d;
    const Reals r0 = two_fours<kStride>(numbers, rows, 0), r1 = two_fours<kStride>(numbers, rows, 1);
    const Reals r2 = two_fours<kStride>(numbers, rows, 2), r3 = two_fours<kStride>(numbers, rows, 3);
    const Reals low01 = hn::InterleaveLower(d, r0, r1), high01 = hn::InterleaveUpper(d, r0, r1);
    const Reals low23 = hn::InterleaveLower(d, r2, r3), high23 = hn::InterleaveUpper(d, r2, r3);
    return {hn::OddEvenBlocks(hn::SwapAdjacentBlocks(low23), low01),
            hn::OddEvenBlocks(hn::SwapAdjacentBlocks(high23), high01),
            hn::OddEvenBlocks(low23, hn::SwapAdjacentBlocks(low01)),
            hn::OddEvenBlocks(high23, hn::SwapAdjacentBlocks(high01))};
  }
#endif
  alignas(64) double four[4][kLanes];
  for (std::size_t lane = 0; lane < kLanes; ++lane)
    for (std::size_t k = 0; k < 4; ++k) four[k][lane] = numbers[kStride * rows[lane] + k];
  return {load(four[0]), load(four[1]), load(four[2]), load(four[3])};
}

/// Of the bodies in `rows`, one a lane.
HWY_INLINE Four gather(const SolverBody* bodies, const std::uint32_t* rows, std::size_t which) {
  return gather<8>(half(bodies[0], which), rows);
}

/// Back into the half that contacts change.
HWY_INLINE void scatter(const Four& v, SolverBody* bodies, const std::uint32_t* rows) {
#if HWY_TARGET != HWY_SCALAR
  if constexpr (kLanes >= 4) {
    const D d;
    const Reals low12 = hn::InterleaveLower(d, v.first, v.second),
                high12 = hn::InterleaveUpper(d, v.first, v.second);
    const Reals low34 = hn::InterleaveLower(d, v.third, v.fourth),
                high34 = hn::InterleaveUpper(d, v.third, v.fourth);
    put_halves(hn::OddEvenBlocks(hn::SwapAdjacentBlocks(low34), low12), bodies, rows, 0);
    put_halves(hn::OddEvenBlocks(hn::SwapAdjacentBlocks(high34), high12), bodies, rows, 1);
    put_halves(hn::OddEvenBlocks(low34, hn::SwapAdjacentBlocks(low12)), bodies, rows, 2);
    put_halves(hn::OddEvenBlocks(high34, hn::SwapAdjacentBlocks(high12)), bodies, rows, 3);
    return;
  }
#endif
  alignas(64) double four[4][kLanes];
  store(v.first, four[0]), store(v.second, four[1]), store(v.third, four[2]), store(v.fourth, four[3]);
  for (std::size_t lane = 0; lane < kLanes; ++lane)
    for (std::size_t k = 0; k < 4; ++k) half(bodies[rows[lane]], 0)[k] = four[k][lane];
}

/// The halves by their names.
struct Motion {
  Reals velocity_x, velocity_y, spin, inverse_mass;
};
struct Place {
  Reals x, y, turn, inverse_inertia;
};

HWY_INLINE Motion motion(const SolverBody* bodies, const std::uint32_t* rows) {
  const Four v = gather(bodies, rows, 0);
  return {v.first, v.second, v.third, v.fourth};
}
HWY_INLINE void keep(const Motion& m, SolverBody* bodies, const std::uint32_t* rows) {
  scatter({m.velocity_x, m.velocity_y, m.spin, m.inverse_mass}, bodies, rows);
}
HWY_INLINE Place place(const SolverBody* bodies, const std::uint32_t* rows) {
  const Four v = gather(bodies, rows, 1);
  return {v.first, v.second, v.third, v.fourth};
}

HWY_INLINE Reals dot(Reals ax, Reals ay, Reals bx, Reals by) {
  return hn::Add(hn::Mul(ax, bx), hn::Mul(ay, by));
}

/// What a sweep asks of a contact: a normal velocity of at least -bias, more or less softly.
struct WideWish {
  Reals bias;     ///< m/s
  Reals nothing;  ///< m/s, see SolverSettings
  Reals mass_scale, impulse_scale;
};

/// As is_apart() in solve.cpp.
HWY_INLINE Mask is_apart(Reals separation, Reals preload, Reals ajar) {
  return hn::Gt(separation, hn::IfThenElseZero(hn::Gt(preload, hn::Zero(D())), ajar));
}

/// What push_apart asks at that separation, as wish_at() in solve.cpp.
class Pusher {
 public:
  explicit Pusher(const SolverSettings& settings)
      : rate_(hn::Set(D(), 1.0 / settings.h)),
        bias_rate_(hn::Set(D(), settings.softness.bias_rate)),
        least_(hn::Set(D(), -settings.push_out)),
        deep_(hn::Set(D(), settings.push_out / settings.softness.bias_rate)),
        mass_scale_(hn::Set(D(), settings.softness.mass_scale)),
        impulse_scale_(hn::Set(D(), settings.softness.impulse_scale)),
        nothing_(hn::Set(D(), settings.nothing())),
        ajar_(hn::Set(D(), settings.ajar)) {}

  HWY_INLINE WideWish wish(Reals separation, Reals preload) const {
    const Mask apart = is_apart(separation, preload, ajar_);
    const Reals limited = hn::Div(deep_, hn::Max(hn::Neg(separation), deep_));
    return {
        hn::IfThenElse(apart, hn::Mul(separation, rate_), hn::Max(hn::Mul(separation, bias_rate_), least_)),
        nothing_, hn::IfThenElse(apart, hn::Set(D(), 1.0), mass_scale_),
        hn::IfThenZeroElse(apart, hn::Mul(impulse_scale_, limited))};
  }

 private:
  Reals rate_, bias_rate_, least_, deep_, mass_scale_, impulse_scale_, nothing_, ajar_;
};

/// The change of the normal impulse that grants the wish, as press() in solve.cpp.
HWY_INLINE Reals press(Reals& impulse, Reals preload, Reals mass, Reals velocity, const WideWish& wish) {
  const Reals old = impulse;
  const Reals change = hn::Mul(hn::Mul(mass, wish.mass_scale), hn::Add(velocity, wish.bias));
  const Reals gives_way = hn::Max(hn::Sub(old, preload), hn::Zero(D()));
  const Reals wanted = hn::Sub(hn::Sub(old, change), hn::Mul(wish.impulse_scale, gives_way));
  const Reals least =
      hn::Mul(mass, hn::Add(hn::Mul(hn::Set(D(), kNoChange), hn::Abs(velocity)), wish.nothing));
  impulse = hn::IfThenElseZero(hn::Gt(wanted, least), wanted);
  return hn::Sub(impulse, old);
}

/// Learning, in lanes. `slow`: where the two bodies don't pass each other.
HWY_INLINE Reals learnt(const Learning& learning, Reals preload, Reals load, Reals mass, Mask slow) {
  const D d;
  const Reals most = hn::Mul(hn::Set(d, learning.most), hn::Mul(mass, hn::Set(d, learning.weight)));
  const Mask learns = hn::And(hn::Lt(load, most), slow);
  const Reals missing = hn::IfThenElseZero(
      learns, hn::Max(hn::Sub(hn::Mul(hn::Set(d, 1.0 - learning.left), load), preload), hn::Zero(d)));
  return hn::Min(hn::Add(preload, hn::Mul(hn::Set(d, learning.share), missing)), load);
}

HWY_INLINE Mask is_slow(const Motion& a, const Motion& b, const Learning& learning) {
  const Reals x = hn::Sub(b.velocity_x, a.velocity_x), y = hn::Sub(b.velocity_y, a.velocity_y);
  return hn::Lt(dot(x, y, x, y), hn::Set(D(), learning.slow * learning.slow));
}

/// Whether both are zero in all lanes.
HWY_INLINE bool idle(Reals impulse, Reals old) {
  const Reals zero = hn::Zero(D());
  return hn::AllFalse(D(), hn::Or(hn::Ne(impulse, zero), hn::Ne(old, zero)));
}

/// The change of the tangential impulse that stops the slip, within friction times the normal one.
HWY_INLINE Reals rub(Reals& impulse, Reals mass, Reals slip, Reals limit) {
  const Reals old = impulse;
  impulse = hn::Min(hn::Max(hn::Sub(old, hn::Mul(mass, slip)), hn::Neg(limit)), limit);
  return hn::Sub(impulse, old);
}

/// `way` less the whole periods that make it shortest. Hardly ever are there any.
HWY_INLINE Reals nearest(Reals way, double period) {
  const D d;
  const Reals p = hn::Set(d, period);
  if (hn::AllFalse(d, hn::Ge(hn::Abs(way), hn::Set(d, 0.5 * period)))) return way;
  return hn::Sub(way, hn::Mul(p, hn::Floor(hn::Add(hn::Div(way, p), hn::Set(d, 0.5)))));
}

}  // namespace
}  // namespace throng::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
