// SPDX-License-Identifier: MIT
#include "sim/crowd/orca.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "sim/crowd/orca.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <algorithm>
#include <cmath>

#include "sim/crowd/near-inl.h"
#include "sim/crowd/permitted_velocity.h"
#include "sim/crowd/velocity_obstacle.h"
#include "sim/random.h"

#ifndef THRONG_ORCA
#define THRONG_ORCA
namespace throng {

/// In the order of the parameters.
struct Reciprocal {
  double horizon, wall_horizon, cutoff, neighbours, top_speed;

  void add_walls(const CrowdView& crowd, std::uint32_t place, HalfPlanes& planes) const;
  Vec wanted(const CrowdView& crowd, std::uint32_t place) const;
};

}  // namespace throng
#endif

HWY_BEFORE_NAMESPACE();
namespace throng::HWY_NAMESPACE {

/// Those who count, the nearest first.
struct Chosen {
  std::vector<double> square;                         // m², of all that are near
  std::vector<std::int64_t> rank;                     // likewise: how many are nearer
  std::vector<std::uint32_t> order;                   // which of them they are, and some to waste
  std::vector<double> dx, dy, width, slip_x, slip_y;  // m, m/s: own velocity less the other's
  std::size_t size = 0;

  void resize(std::size_t all, std::size_t most) {
    if (rank.size() < all) rank.resize(all), square.resize(all);
    if (order.size() <= most) order.resize(most + 1);
    if (dx.size() < most + 2 * kFour)
      for (std::vector<double>* one : {&dx, &dy, &width, &slip_x, &slip_y})
        one->resize(most + 2 * kFour, 1.0);
  }
};

/// Leaves out who is surely not of the nearest `most`, as far as a look or two tell: what follows is
/// quadratic.
HWY_INLINE void thin(double reach, std::size_t most, Others& others) {
  const Wide d;
  for (const double share : {1.5, 3.0}) {
    if (others.size <= 3 * most) return;
    const double bound = reach * reach * share * static_cast<double>(most) / static_cast<double>(others.size);
    std::size_t count = 0;
    for (std::size_t k = 0; k < others.size; k += kWide)
      count += hn::CountTrue(
          d, hn::And(hn::Le(others.square(k), hn::Set(d, bound)), hn::FirstN(d, others.size - k)));
    if (count >= most) return others.keep(bound);
  }
}

/// Of each how many are nearer, or as near and before him.
HWY_INLINE void rank(const Others& others, Chosen& chosen) {
  const hn::ScalableTag<double> d;
  const hn::RebindToSigned<decltype(d)> whole;
  const std::size_t lanes = hn::Lanes(d), size = others.size;
  for (std::size_t k = 0; k < size; k += lanes) hn::StoreU(others.square(k), d, chosen.square.data() + k);
  const double* square = chosen.square.data();
  const auto count = [&](auto& rank, auto is)
                         HWY_ATTR { rank = hn::Sub(rank, hn::BitCast(whole, hn::VecFromMask(d, is))); };
  for (std::size_t k = 0; k < size; k += lanes) {
    const auto own = hn::LoadU(d, square + k), place = hn::Iota(d, static_cast<double>(k));
    auto rank = hn::Zero(whole);
    std::size_t j = 0;
    for (; j < k; ++j) count(rank, hn::Le(hn::Set(d, square[j]), own));
    for (const std::size_t end = std::min(k + lanes, size); j < end; ++j) {
      const auto other = hn::Set(d, square[j]), before = hn::Set(d, static_cast<double>(j));
      count(rank, hn::Or(hn::Lt(other, own), hn::And(hn::Eq(other, own), hn::Lt(before, place))));
    }
    for (; j < size; ++j) count(rank, hn::Lt(hn::Set(d, square[j]), own));
    hn::StoreU(rank, whole, chosen.rank.data() + k);
  }
}

/// Picks the nearest `most`.
HWY_INLINE void choose(const CrowdView& crowd, std::uint32_t own, double reach, std::size_t most,
                       Others& others, Chosen& chosen) {
  chosen.resize(others.dx.size(), most);
  thin(reach, most, others);
  chosen.size = std::min(most, others.size);
  rank(others, chosen);
  const Vec v = crowd.velocity(own);
  for (std::size_t k = 0; k < others.size; ++k)
    chosen.order[std::min(static_cast<std::size_t>(chosen.rank[k]), most)] = static_cast<std::uint32_t>(k);
  for (std::size_t i = 0; i < chosen.size; ++i) {
    const std::uint32_t k = chosen.order[i];
    const auto place = static_cast<std::uint32_t>(others.place[k]);
    chosen.dx[i] = others.dx[k], chosen.dy[i] = others.dy[k], chosen.width[i] = others.width[k];
    chosen.slip_x[i] = v.x() - crowd.velocity_x[place], chosen.slip_y[i] = v.y() - crowd.velocity_y[place];
  }
}

/// Of velocity obstacles, each seen from the middle of it: outwards, and how deep it is to the border (m/s).
struct WayOut {
  WideReals x, y, depth;
};

/// The way out of the obstacle of a disc of radius `width` at (dx, dy) with these velocities against it, as
/// throng::escape has it; `rate` is 1 / s, in which it is to be avoided. Who overlap it are before its front.
HWY_INLINE WayOut way_out(WideReals dx, WideReals dy, WideReals width, WideReals vx, WideReals vy,
                          WideReals rate, WideMask overlap) {
  const Wide d;
  const WideReals zero = hn::Zero(d), square = hn::Add(hn::Mul(dx, dx), hn::Mul(dy, dy));
  const WideReals width2 = hn::Mul(width, width);
  const WideReals wx = hn::Sub(vx, hn::Mul(dx, rate)), wy = hn::Sub(vy, hn::Mul(dy, rate));
  const WideReals w2 = hn::Add(hn::Mul(wx, wx), hn::Mul(wy, wy));
  const WideReals along = hn::Add(hn::Mul(wx, dx), hn::Mul(wy, dy));
  const WideMask before = hn::And(hn::Lt(along, zero), hn::Gt(hn::Mul(along, along), hn::Mul(width2, w2)));
  const WideMask front = hn::Or(overlap, before);
  const WideReals root =  // |w|, or how long the legs are
      hn::Sqrt(hn::IfThenElse(front, w2, hn::Max(zero, hn::Sub(square, width2))));

  WideReals front_x = wx, front_y = wy, length = root;
  const WideMask middle = hn::And(front, hn::Eq(w2, zero));
  if (HWY_UNLIKELY(!hn::AllFalse(d, middle))) {
    front_x = hn::IfThenElse(middle, hn::Neg(dx), wx), front_y = hn::IfThenElse(middle, hn::Neg(dy), wy);
    length = hn::IfThenElse(middle, hn::Sqrt(square), root);
  }
  const WideMask left = hn::Gt(hn::Sub(hn::Mul(dx, wy), hn::Mul(dy, wx)), zero);
  const WideReals side = hn::IfThenElse(left, hn::Set(d, 1.0), hn::Set(d, -1.0)), lean = hn::Mul(side, width);
  const WideReals leg_x = hn::Neg(hn::Mul(side, hn::Add(hn::Mul(dx, lean), hn::Mul(dy, root))));
  const WideReals leg_y = hn::Mul(side, hn::Sub(hn::Mul(dx, root), hn::Mul(dy, lean)));

  const WideReals over = hn::Div(hn::Set(d, 1.0), hn::IfThenElse(front, length, square));
  const WideReals x = hn::Mul(hn::IfThenElse(front, front_x, leg_x), over);
  const WideReals y = hn::Mul(hn::IfThenElse(front, front_y, leg_y), over);
  const WideReals of_leg = hn::Neg(hn::Add(hn::Mul(vx, x), hn::Mul(vy, y)));
  return {x, y, hn::IfThenElse(front, hn::Sub(hn::Mul(width, rate), root), of_leg)};
}

/// Adds for each one half of the way out of its velocity obstacle; who overlap part within this step.
HWY_INLINE void add_planes(const Reciprocal& model, double dt, const Vec& own, const Chosen& chosen,
                           HalfPlanes& planes) {
  const Wide d;
  const WideReals own_x = hn::Set(d, own.x()), own_y = hn::Set(d, own.y()), half = hn::Set(d, 0.5);
  const WideReals at_once = hn::Set(d, 1.0 / dt), in_time = hn::Set(d, 1.0 / model.horizon);
  planes.make_room(planes.size + chosen.size);
  for (std::size_t k = 0; k < chosen.size; k += kWide) {
    const WideReals dx = hn::LoadU(d, chosen.dx.data() + k), dy = hn::LoadU(d, chosen.dy.data() + k);
    const WideReals width = hn::LoadU(d, chosen.width.data() + k);
    const WideMask overlap = hn::Le(hn::Add(hn::Mul(dx, dx), hn::Mul(dy, dy)), hn::Mul(width, width));
    const auto [x, y, depth] =
        way_out(dx, dy, width, hn::LoadU(d, chosen.slip_x.data() + k), hn::LoadU(d, chosen.slip_y.data() + k),
                hn::IfThenElse(overlap, at_once, in_time), overlap);
    const WideReals offset = hn::Add(hn::Add(hn::Mul(x, own_x), hn::Mul(y, own_y)), hn::Mul(half, depth));
    hn::StoreU(x, d, planes.normal_x.data() + planes.size + k);
    hn::StoreU(y, d, planes.normal_y.data() + planes.size + k);
    hn::StoreU(offset, d, planes.offset.data() + planes.size + k);
  }
  planes.size += chosen.size;
}

void WalkReciprocally(const Reciprocal& model, const CrowdView& crowd, std::span<const std::uint32_t> places,
                      std::span<Vec> velocity) {
  thread_local Others others;  // kept: a step allocates nothing
  thread_local Chosen chosen;
  thread_local HalfPlanes planes, room;
  const auto most = static_cast<std::size_t>(model.neighbours);
  for (const std::uint32_t place : places) {
    planes.size = 0;
    model.add_walls(crowd, place, planes);
    const std::size_t walls = planes.size;
    if (most > 0) {
      others.gather(crowd, place, model.cutoff);
      choose(crowd, place, model.cutoff, most, others, chosen);
      add_planes(model, crowd.dt, crowd.velocity(place), chosen, planes);
    }
    velocity[place] = permitted_velocity(planes, walls, model.top_speed, model.wanted(crowd, place), room);
  }
}

}  // namespace throng::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE

namespace throng {

HWY_EXPORT(WalkReciprocally);

Vec Reciprocal::wanted(const CrowdView& crowd, std::uint32_t place) const {
  Random random(crowd.seed, static_cast<std::uint64_t>(crowd.step),
                static_cast<std::uint32_t>(crowd.id[place]), Purpose::doubt);
  const double x = random.uniform(-kOrcaDoubt, kOrcaDoubt);
  const double y = random.uniform(-kOrcaDoubt, kOrcaDoubt);
  return crowd.desired_speed[place] * (crowd.towards(place) + Vec(x, y));
}

/// Who touches a wall gets no nearer to it.
void Reciprocal::add_walls(const CrowdView& crowd, std::uint32_t place, HalfPlanes& planes) const {
  const Vec p = crowd.position(place);
  const double radius = crowd.radius[place], reach = radius + wall_horizon * top_speed;
  const Vec far(reach, reach);
  if (crowd.is_clear(place, reach)) return;
  crowd.barriers.for_each_near({Vec(p - far), Vec(p + far)}, [&](const Barriers::Segment& segment) {
    const Vec out = p - nearest_on_segment(segment.a, segment.b, p);
    const double distance = out.norm();
    if (distance > reach || !(distance > 0.0)) return;
    if (distance <= radius) return planes.push_back({out / distance, 0.0});
    const auto [point, normal] =
        escape(segment.a - p, segment.b - p, radius, wall_horizon, crowd.velocity(place));
    planes.push_back({normal, normal.dot(point)});
  });
}

namespace {

constexpr std::size_t kMostNeighbours = 32;
constexpr ModelParameter kParameters[] = {
    {"horizon", 3.0, 1e-2, 1e3, "s", "For which ways are clear of others, s."},
    {"wall_horizon", 0.5, 1e-2, 1e3, "s", "For which ways are clear of walls, s."},
    {"cutoff", 5.0, 0.0, 1e3, "m", "How far others are looked at, centre to centre, m."},
    {"neighbours", 10.0, 0.0, static_cast<double>(kMostNeighbours), "",
     "How many of them, the nearest ones, at most."},
    {"top_speed", 2.0, 0.0, 1e3, "m/s", "That nobody goes beyond, m/s."}};

class Orca : public WalkingModel {
 public:
  explicit Orca(std::span<const double> v) : model_{v[0], v[1], v[2], v[3], v[4]} {}

  void steer(const CrowdView& crowd, std::span<const std::uint32_t> places,
             std::span<Vec> velocity) const override {
    HWY_DYNAMIC_DISPATCH(WalkReciprocally)(model_, crowd, places, velocity);
  }

  double reach(double) const override { return model_.neighbours >= 1.0 ? model_.cutoff : 0.0; }
  double longest_step(double, double) const override { return std::min(model_.horizon, model_.wall_horizon); }

 private:
  Reciprocal model_;
};

}  // namespace

ModelKind orca() {
  return {"orca", "Reciprocal collision avoidance of van den Berg, Guy, Lin and Manocha (2011).", kParameters,
          [](std::span<const double> values) -> std::unique_ptr<WalkingModel> {
            return std::make_unique<Orca>(values);
          }};
}

}  // namespace throng

#endif
