// SPDX-License-Identifier: MIT
#include "sim/crowd/social_force.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "sim/crowd/social_force.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <algorithm>
#include <cmath>

#include "sim/crowd/exponential.h"
#include "sim/crowd/near-inl.h"

#ifndef THRONG_SOCIAL_FORCE
#define THRONG_SOCIAL_FORCE
namespace throng {

/// m/s: beyond the larger of this and so many times an agent's desired speed forces speed up nobody.
constexpr double kFastestPushed = 5.0, kTimesDesired = 3.0;

/// In the order of the parameters.
struct Forces {
  double mass, reaction_time, strength, range, stiffness, friction, cutoff;

  Vec touch(double depth, const Vec& away, const Vec& slip, double most) const;
  Vec of_wall(double depth, const Vec& away, const Vec& slip, double most) const;
};

}  // namespace throng
#endif

HWY_BEFORE_NAMESPACE();
namespace throng::HWY_NAMESPACE {

/// N, between bodies: of those who touch, one by one.
HWY_INLINE Vec touches(const Forces& model, const CrowdView& crowd, std::uint32_t own, const Others& others,
                       const std::vector<double>& gap, const Near& near) {
  Vec force(0.0, 0.0);
  for (std::size_t k = near.first; k < near.first + near.size; ++k) {
    if (!(gap[k] < 0.0)) continue;
    const Vec to(others.dx[k], others.dy[k]);
    const auto place = static_cast<std::uint32_t>(others.place[k]);
    force +=
        model.touch(-gap[k], -to / to.norm(), crowd.velocity(place) - crowd.velocity(own), 0.5 / crowd.dt);
  }
  return force;
}

/// `to` (m/s), no faster than forces may make who had the velocity `from`.
HWY_INLINE Vec pushed(const Vec& from, const Vec& to, double desired_speed) {
  const double square = to.squaredNorm();
  if (!(square > kFastestPushed * kFastestPushed)) return to;
  const double most = std::max({kFastestPushed, kTimesDesired * desired_speed, from.norm()});
  return square > most * most ? Vec(most / std::sqrt(square) * to) : to;
}

/// m/s, of one whom these near him push.
HWY_INLINE Vec walk_by_forces(const Forces& model, const CrowdView& crowd, std::uint32_t place,
                              const Others& others, const Pushes& pushes, const Near& near) {
  const Vec p = crowd.position(place), v = crowd.velocity(place);
  const double radius = crowd.radius[place];
  Vec force = (model.mass / model.reaction_time) * (crowd.desired_speed[place] * crowd.towards(place) - v);
  force += repulsion(others, pushes, near);
  force += touches(model, crowd, place, others, pushes.gap, near);
  const double wall_reach = radius + kNegligibleRanges * model.range;
  if (!crowd.is_clear(place, wall_reach))
    crowd.barriers.for_each_nearest(p, wall_reach, [&](const Vec& q) {
      const double distance = (p - q).norm();
      if (distance > 0.0) force += model.of_wall(radius - distance, (p - q) / distance, -v, 1.0 / crowd.dt);
    });
  return pushed(v, v + crowd.dt / model.mass * force, crowd.desired_speed[place]);
}

void WalkByForces(const Forces& model, const CrowdView& crowd, std::span<const std::uint32_t> places,
                  double reach, std::span<Vec> velocity) {
  thread_local Others others;  // kept: a step allocates nothing
  thread_local Pushes pushes;
  Near near[kTogether];
  for (std::size_t begin = 0; begin < places.size(); begin += kTogether) {
    const auto some = places.subspan(begin, std::min(kTogether, places.size() - begin));
    others.clear();
    for (std::size_t i = 0; i < some.size(); ++i) near[i] = others.add_near<Tell::who>(crowd, some[i], reach);
    push(model.strength, model.range, others, pushes);
    for (std::size_t i = 0; i < some.size(); ++i)
      velocity[some[i]] = walk_by_forces(model, crowd, some[i], others, pushes, near[i]);
  }
}

}  // namespace throng::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE

namespace throng {

HWY_EXPORT(WalkByForces);

namespace {

constexpr ModelParameter kParameters[] = {
    {"mass", 80.0, 1.0, 1e4, "kg", "Mass, kg."},
    {"reaction_time", 0.5, 1e-3, 1e3, "s", "In which the velocity adapts to the desired one, s."},
    {"strength", 2000.0, 0.0, 1e6, "N", "Of the repulsion where two agents just touch, N."},
    {"range", 0.08, 1e-4, 1e3, "m", "Over which the repulsion falls by e, m."},
    {"stiffness", 1.2e5, 0.0, 1e9, "kg/s^2", "Of bodies in touch, kg/s^2."},
    {"friction", 2.4e5, 0.0, 1e9, "kg/(m s)", "Of bodies in touch, kg/(m s)."},
    {"cutoff", 2.5, 0.0, 1e3, "m", "How far others are looked at, centre to centre, m."}};

/// Found by throng bench validation: all ten draws of the crowd keep what they are for. Of some 800 sets none
/// keeps both IMO 4, which allows 1.33 /s through 1 m, and the bottlenecks of Seyfried (2009), who measured
/// 1.9, with every draw: what raises the flow through the one raises it through the others.
constexpr double kCalibrated[] = {80.0, 1.0, 160.0, 0.08, 2.6e4, 4e5, 2.5};
constexpr double kBottleneck[] = {80.0, 1.25, 63.0, 0.218, 9.2e3, 2.2e4, 2.5};
constexpr ModelPreset kPresets[] = {
    {"calibrated", "for people in rooms and at exits as in guidelines, by throng bench validation",
     kCalibrated},
    {"bottleneck", "for as many through bottlenecks as Seyfried et al. (2009) measured", kBottleneck}};
static_assert(std::size(kCalibrated) == std::size(kParameters));
static_assert(std::size(kBottleneck) == std::size(kParameters));

constexpr double kTouching = 6.0;  // as many discs of one size may touch one
constexpr double kPressing = 2.0;  // so many want the same way as one, who feels what all of them want

class SocialForce : public WalkingModel {
 public:
  explicit SocialForce(std::span<const double> v) : model_{v[0], v[1], v[2], v[3], v[4], v[5], v[6]} {}

  void steer(const CrowdView& crowd, std::span<const std::uint32_t> places,
             std::span<Vec> velocity) const override {
    HWY_DYNAMIC_DISPATCH(WalkByForces)(model_, crowd, places, reach(crowd.largest), velocity);
  }

  double reach(const Largest& largest) const override {
    return std::min(model_.cutoff, 2.0 * largest.radius + kNegligibleRanges * model_.range);
  }
  bool stands_at_will() const override { return false; }

  double core() const override { return 0.5; }
  double longest_step(double, double) const override {
    return std::min(model_.reaction_time, 2.0 / std::sqrt(kTouching * model_.stiffness / model_.mass));
  }
  /// In which friction at the depth to which kPressing agents press one ends all slip between two.
  double converged_step(double desired_speed) const override {
    const double pressed = kPressing * model_.mass * desired_speed / model_.reaction_time;  // N
    const double rubs = model_.friction * pressed;
    return rubs > 0.0 && model_.stiffness > 0.0 ? 0.5 * model_.mass * model_.stiffness / rubs
                                                : WalkingModel::converged_step(desired_speed);
  }

 private:
  Forces model_;
};

}  // namespace

/// N, at this depth (m, above 0), from what moves past at `slip` (m/s). Friction may end the slip at `most`
/// (1/s) at the fastest.
Vec Forces::touch(double depth, const Vec& away, const Vec& slip, double most) const {
  const Vec along(-away.y(), away.x());
  const double rub = std::min(friction * depth, mass * most);
  return stiffness * depth * away + rub * slip.dot(along) * along;
}

/// The same with the repulsion (depth below 0: a gap).
Vec Forces::of_wall(double depth, const Vec& away, const Vec& slip, double most) const {
  const Vec push = strength * exponential(std::min(depth / range, kMostExponent)) * away;
  return depth > 0.0 ? Vec(push + touch(depth, away, slip, most)) : push;
}

ModelKind social_force() {
  return {"social_force", "Forces of Helbing, Farkas and Vicsek (2000).", kParameters,
          [](std::span<const double> values) -> std::unique_ptr<WalkingModel> {
            return std::make_unique<SocialForce>(values);
          },
          kPresets};
}

}  // namespace throng

#endif
