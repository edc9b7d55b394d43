// SPDX-License-Identifier: MIT
#include "sim/crowd/orca.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "sim/crowd/orca.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <algorithm>
#include <cmath>

#include "sim/crowd/doubt-inl.h"
#include "sim/crowd/nearest-inl.h"
#include "sim/crowd/permitted_velocity.h"
#include "sim/crowd/velocity_obstacle.h"

#ifndef THRONG_ORCA
#define THRONG_ORCA
namespace throng {

/// In the order of the parameters.
struct Reciprocal {
  double horizon, wall_horizon, cutoff, neighbours, top_speed;

  void add_walls(const CrowdView& crowd, std::uint32_t place, HalfPlanes& planes) const;
};

}  // namespace throng
#endif

HWY_BEFORE_NAMESPACE();
namespace throng::HWY_NAMESPACE {

/// Those who count of several agents one after the other, of each the nearest first, and the ways out of
/// their velocity obstacles.
struct Chosen {
  std::vector<double> dx, dy, width, slip_x, slip_y;  // m, m/s: own velocity less the other's
  std::vector<double> out_x, out_y, depth;            // as WayOut
  std::size_t size = 0;

  void make_room(std::size_t count) {
    if (dx.size() >= count + kWide) return;
    for (std::vector<double>* one : {&dx, &dy, &width, &slip_x, &slip_y, &out_x, &out_y, &depth})
      one->resize(count + kWide, 1.0);
  }
};

/// Adds the nearest `most`. Returns the square (m²) of how far away the last of them is, or that of `reach`
/// where there are fewer.
HWY_INLINE double choose(const CrowdView& crowd, std::uint32_t own, const Others& others, const Near& near,
                         std::size_t most, double reach, Ranks& ranks, Chosen& chosen) {
  order_nearest(others, near, most, ranks);
  const Vec v = crowd.velocity(own);
  const std::size_t count = std::min(most, near.size);
  const double *const dx = others.dx.data() + near.first, *const dy = others.dy.data() + near.first,
                      *const width = others.width.data() + near.first,
                      *const place = others.place.data() + near.first,
                      *const velocity_x = crowd.velocity_x.data(),
                      *const velocity_y = crowd.velocity_y.data();
  double *const to_dx = chosen.dx.data() + chosen.size, *const to_dy = chosen.dy.data() + chosen.size,
                *const to_width = chosen.width.data() + chosen.size,
                *const slip_x = chosen.slip_x.data() + chosen.size,
                *const slip_y = chosen.slip_y.data() + chosen.size;
  const std::uint32_t* const order = ranks.order.data();
  for (std::size_t i = 0; i < count; ++i) {
    const std::uint32_t k = order[i];
    const auto its = static_cast<std::size_t>(static_cast<std::int64_t>(place[k]));
    to_dx[i] = dx[k], to_dy[i] = dy[k], to_width[i] = width[k];
    slip_x[i] = v.x() - velocity_x[its], slip_y[i] = v.y() - velocity_y[its];
  }
  chosen.size += count;
  return count == most ? ranks.square[ranks.order[most - 1]] : reach * reach;
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

/// Who overlap part within this step.
HWY_INLINE void find_ways_out(const Reciprocal& model, double dt, Chosen& chosen) {
  const Wide d;
  const WideReals at_once = hn::Set(d, 1.0 / dt), in_time = hn::Set(d, 1.0 / model.horizon);
  for (std::size_t k = 0; k < chosen.size; k += kWide) {
    const WideReals dx = hn::LoadU(d, chosen.dx.data() + k), dy = hn::LoadU(d, chosen.dy.data() + k);
    const WideReals width = hn::LoadU(d, chosen.width.data() + k);
    const WideMask overlap = hn::Le(hn::Add(hn::Mul(dx, dx), hn::Mul(dy, dy)), hn::Mul(width, width));
    const auto [x, y, depth] =
        way_out(dx, dy, width, hn::LoadU(d, chosen.slip_x.data() + k), hn::LoadU(d, chosen.slip_y.data() + k),
                hn::IfThenElse(overlap, at_once, in_time), overlap);
    hn::StoreU(x, d, chosen.out_x.data() + k), hn::StoreU(y, d, chosen.out_y.data() + k);
    hn::StoreU(depth, d, chosen.depth.data() + k);
  }
}

/// Adds for each of these one half of the way out of its velocity obstacle.
HWY_INLINE void add_planes(const Vec& own, const Chosen& chosen, const Near& its, HalfPlanes& planes) {
  const Wide d;
  const WideReals own_x = hn::Set(d, own.x()), own_y = hn::Set(d, own.y()), half = hn::Set(d, 0.5);
  planes.make_room(planes.size + its.size);
  for (std::size_t k = 0; k < its.size; k += kWide) {
    const WideReals x = hn::LoadU(d, chosen.out_x.data() + its.first + k),
                    y = hn::LoadU(d, chosen.out_y.data() + its.first + k),
                    depth = hn::LoadU(d, chosen.depth.data() + its.first + k);
    const WideReals offset = hn::Add(hn::Add(hn::Mul(x, own_x), hn::Mul(y, own_y)), hn::Mul(half, depth));
    hn::StoreU(x, d, planes.normal_x.data() + planes.size + k);
    hn::StoreU(y, d, planes.normal_y.data() + planes.size + k);
    hn::StoreU(offset, d, planes.offset.data() + planes.size + k);
  }
  planes.size += its.size;
}

/// Finds those who count for each of some agents, and the ways out.
HWY_INLINE void choose_all(const Reciprocal& model, const CrowdView& crowd,
                           std::span<const std::uint32_t> some, Outlook& outlook, Chosen& chosen, Near* its) {
  thread_local Others others;  // kept: a step allocates nothing
  thread_local Ranks ranks;
  const auto most = static_cast<std::size_t>(model.neighbours);
  others.clear();
  chosen.make_room(some.size() * most);
  chosen.size = 0;
  Near near[kTogether];
  for (std::size_t i = 0; i < some.size(); ++i) near[i] = outlook.add_nearest(crowd, some[i], others);
  double squares = 0.0;
  for (std::size_t i = 0; i < some.size(); ++i) {
    its[i].first = chosen.size;
    squares += choose(crowd, some[i], others, near[i], most, model.cutoff, ranks, chosen);
    its[i].size = chosen.size - its[i].first;
  }
  outlook.learn(squares / static_cast<double>(some.size()));
  find_ways_out(model, crowd.dt, chosen);
}

void WalkReciprocally(const Reciprocal& model, const CrowdView& crowd, std::span<const std::uint32_t> places,
                      std::span<Vec> velocity) {
  thread_local Chosen chosen;
  thread_local HalfPlanes planes, room;
  Outlook outlook(model.cutoff, static_cast<std::size_t>(model.neighbours));
  Near its[kTogether] = {};
  Doubts doubts;
  for (std::size_t begin = 0; begin < places.size(); begin += kTogether) {
    const auto some = places.subspan(begin, std::min(kTogether, places.size() - begin));
    if (model.neighbours >= 1.0) choose_all(model, crowd, some, outlook, chosen, its);
    draw_doubts(crowd, some, kOrcaDoubt, doubts);
    for (std::size_t i = 0; i < some.size(); ++i) {
      planes.size = 0;
      model.add_walls(crowd, some[i], planes);
      const std::size_t walls = planes.size;
      add_planes(crowd.velocity(some[i]), chosen, its[i], planes);
      const Vec wanted =
          crowd.desired_speed[some[i]] * (crowd.towards(some[i]) + Vec(doubts.x[i], doubts.y[i]));
      velocity[some[i]] = permitted_velocity(planes, walls, model.top_speed, wanted, room);
    }
  }
}

}  // namespace throng::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE

namespace throng {

HWY_EXPORT(WalkReciprocally);

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
     "How many of them, the nearest ones, at most.", true},
    {"top_speed", 2.0, 0.0, 1e3, "m/s", "That nobody goes beyond, m/s."}};

class Orca : public WalkingModel {
 public:
  explicit Orca(std::span<const double> v) : model_{v[0], v[1], v[2], v[3], v[4]} {}

  void steer(const CrowdView& crowd, std::span<const std::uint32_t> places,
             std::span<Vec> velocity) const override {
    HWY_DYNAMIC_DISPATCH(WalkReciprocally)(model_, crowd, places, velocity);
  }

  double reach(const Largest&) const override { return model_.neighbours >= 1.0 ? model_.cutoff : 0.0; }
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
