// SPDX-License-Identifier: MIT
#include "sim/crowd/collision_free_speed.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "sim/crowd/collision_free_speed.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <algorithm>
#include <cmath>

#include "sim/crowd/exponential.h"
#include "sim/crowd/near-inl.h"
#include "sim/random.h"

#ifndef THRONG_COLLISION_FREE_SPEED
#define THRONG_COLLISION_FREE_SPEED
namespace throng {

/// In the order of the parameters.
struct FreeSpeed {
  double time_gap, strength, range, wall_strength, wall_range, cutoff, noise;

  Vec doubt(const CrowdView& crowd, std::uint32_t place) const;

  /// m, beyond which nobody matters who touches at `touching` (m), to one of that desired speed (m/s).
  double reach(double touching, double desired_speed) const {
    const double matters = std::max(kNegligibleRanges * range, time_gap * desired_speed);
    return std::min(cutoff, touching + matters);
  }
};

}  // namespace throng
#endif

HWY_BEFORE_NAMESPACE();
namespace throng::HWY_NAMESPACE {

/// m, to the nearest one whom walking on along `heading` would run into.
HWY_INLINE double gap_ahead(const Others& others, const std::vector<double>& gap, const Near& near,
                            const Vec& heading) {
  const Wide d;
  const auto hx = hn::Set(d, heading.x()), hy = hn::Set(d, heading.y());
  auto least = hn::Set(d, 1e150);
  for (std::size_t k = near.first, end = near.first + near.size; k < end; k += kWide) {
    const auto dx = hn::LoadU(d, others.dx.data() + k), dy = hn::LoadU(d, others.dy.data() + k);
    const auto across = hn::Abs(hn::Sub(hn::Mul(hx, dy), hn::Mul(hy, dx)));
    const auto ahead =
        hn::And(hn::Ge(hn::Add(hn::Mul(hx, dx), hn::Mul(hy, dy)), hn::Zero(d)),
                hn::And(hn::Le(across, hn::LoadU(d, others.width.data() + k)), hn::FirstN(d, end - k)));
    least = hn::Min(least, hn::IfThenElse(ahead, hn::LoadU(d, gap.data() + k), least));
  }
  return hn::GetLane(hn::MinOfLanes(d, least));
}

Vec away_from_walls(const FreeSpeed& model, const CrowdView& crowd, std::uint32_t place) {
  const Vec p = crowd.position(place);
  const double radius = crowd.radius[place], reach = radius + kNegligibleRanges * model.wall_range;
  Vec sum(0.0, 0.0);
  if (crowd.is_clear(place, reach)) return sum;
  crowd.barriers.for_each_nearest(p, reach, [&](const Vec& q) {
    const double distance = (p - q).norm();
    if (distance > 0.0)
      sum += model.wall_strength *
             exponential(std::min((radius - distance) / model.wall_range, kMostExponent)) *
             ((p - q) / distance);
  });
  return sum;
}

/// m, beyond which nobody turns the agent nor slows him down.
HWY_INLINE double reach_of(const FreeSpeed& model, const CrowdView& crowd, std::uint32_t place) {
  return model.reach(crowd.radius[place] + crowd.largest.radius, crowd.desired_speed[place]);
}

/// Of several agents.
struct Headings {
  double x[kTogether + kWide], y[kTogether + kWide];

  HWY_INLINE void set(std::size_t i, const Vec& heading) { x[i] = heading.x(), y[i] = heading.y(); }

  /// Makes the first `count` 1 long, but for those of no length.
  HWY_INLINE void make_unit(std::size_t count) {
    const Wide d;
    for (std::size_t i = count; i < count + kWide; ++i) x[i] = y[i] = 0.0;
    for (std::size_t i = 0; i < count; i += kWide) {
      const auto to_x = hn::LoadU(d, x + i), to_y = hn::LoadU(d, y + i);
      const auto length = hn::Sqrt(hn::Add(hn::Mul(to_x, to_x), hn::Mul(to_y, to_y)));
      const auto over = hn::IfThenElse(hn::Gt(length, hn::Zero(d)), length, hn::Set(d, 1.0));
      hn::StoreU(hn::Div(to_x, over), d, x + i), hn::StoreU(hn::Div(to_y, over), d, y + i);
    }
  }
};

/// Of one whom others turn so; of any length.
HWY_INLINE Vec heading(const FreeSpeed& model, const CrowdView& crowd, std::uint32_t place, const Vec& turn) {
  Vec heading = crowd.towards(place) + away_from_walls(model, crowd, place);
  heading += turn;
  if (model.noise > 0.0) heading += model.doubt(crowd, place);
  return heading;
}

/// Turns all of some agents first, in the time of whose roots and quotients others' are taken.
void WalkFreely(const FreeSpeed& model, const CrowdView& crowd, std::span<const std::uint32_t> places,
                std::span<Vec> velocity) {
  thread_local Others others;  // kept: a step allocates nothing
  thread_local Pushes pushes;
  Near near[kTogether];
  Headings headings;
  for (std::size_t begin = 0; begin < places.size(); begin += kTogether) {
    const auto some = places.subspan(begin, std::min(kTogether, places.size() - begin));
    others.clear();
    for (std::size_t i = 0; i < some.size(); ++i)
      near[i] = others.add_near<Tell::where>(crowd, some[i], reach_of(model, crowd, some[i]));
    push(model.strength, model.range, others, pushes);
    for (std::size_t i = 0; i < some.size(); ++i)
      headings.set(i, heading(model, crowd, some[i], repulsion(others, pushes, near[i])));
    headings.make_unit(some.size());
    for (std::size_t i = 0; i < some.size(); ++i) {
      const Vec heading(headings.x[i], headings.y[i]);
      const double ahead = gap_ahead(others, pushes.gap, near[i], heading);
      const double speed = std::max(0.0, std::min(crowd.desired_speed[some[i]], ahead / model.time_gap));
      velocity[some[i]] = speed * heading;
    }
  }
}

}  // namespace throng::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE

namespace throng {

HWY_EXPORT(WalkFreely);

namespace {

constexpr ModelParameter kParameters[] = {
    {"time_gap", 1.0, 1e-2, 1e2, "s", "To the one ahead: speed is the gap over it, s."},
    {"neighbour_strength", 8.0, 0.0, 1e3, "", "Of the turning away from others who touch."},
    {"neighbour_range", 0.1, 1e-3, 1e2, "m", "Over which that falls by e, m."},
    {"wall_strength", 5.0, 0.0, 1e3, "", "Of the turning away from barriers that are touched."},
    {"wall_range", 0.02, 1e-3, 1e2, "m", "Over which that falls by e, m."},
    {"cutoff", 3.0, 0.0, 1e3, "m", "How far others are looked at, centre to centre, m."},
    {"noise", 0.0, 0.0, 10.0, "",
     "Added to each component of the direction, where the way is 1: up to this, at random in each step by "
     "seed and "
     "id; who blocks one another part."}};

/// Found by throng bench validation. The wider range lets two streams pass each other: with the paper's 0.1 m
/// IMO 8 jams for some draws of the crowd. Of some 950 sets none keeps both IMO 4, which allows 1.33 /s
/// through 1 m, and the bottlenecks of Seyfried (2009), who measured 1.9: the flow into a passage 2.8 m long
/// is 0.8 to 0.9 of that through a door of the same width, and both follow from time gap and size.
constexpr double kCalibrated[] = {1.0, 8.0, 0.14, 5.0, 0.02, 3.0, 0.0};
constexpr double kBottleneck[] = {0.5, 8.0, 0.14, 5.0, 0.02, 3.0, 0.0};
constexpr ModelPreset kPresets[] = {
    {"calibrated", "for people in rooms and at exits as in guidelines, by throng bench validation",
     kCalibrated},
    {"bottleneck", "for as many through bottlenecks as Seyfried et al. (2009) measured", kBottleneck}};
static_assert(std::size(kCalibrated) == std::size(kParameters));
static_assert(std::size(kBottleneck) == std::size(kParameters));

class CollisionFreeSpeed : public WalkingModel {
 public:
  explicit CollisionFreeSpeed(std::span<const double> v) : model_{v[0], v[1], v[2], v[3], v[4], v[5], v[6]} {}

  void steer(const CrowdView& crowd, std::span<const std::uint32_t> places,
             std::span<Vec> velocity) const override {
    HWY_DYNAMIC_DISPATCH(WalkFreely)(model_, crowd, places, velocity);
  }

  double reach(const Largest& largest) const override {
    return model_.reach(2.0 * largest.radius, largest.desired_speed);
  }

  double longest_step(double radius, double desired_speed) const override {
    const double half = 0.5 * model_.time_gap;
    if (!(desired_speed > 0.0)) return half;
    return std::min(half, 2.0 * radius * (std::sqrt(2.0) - 1.0) / (desired_speed * std::sqrt(2.0)));
  }

 private:
  FreeSpeed model_;
};

}  // namespace

Vec FreeSpeed::doubt(const CrowdView& crowd, std::uint32_t place) const {
  Random random(crowd.seed, static_cast<std::uint64_t>(crowd.step),
                static_cast<std::uint32_t>(crowd.id[place]), Purpose::doubt);
  const double x = random.uniform(-noise, noise);
  return {x, random.uniform(-noise, noise)};
}

ModelKind collision_free_speed() {
  return {"collision_free_speed", "Speed by the gap ahead, of Tordeux, Chraibi and Seyfried (2016).",
          kParameters,
          [](std::span<const double> values) -> std::unique_ptr<WalkingModel> {
            return std::make_unique<CollisionFreeSpeed>(values);
          },
          kPresets};
}

}  // namespace throng

#endif
