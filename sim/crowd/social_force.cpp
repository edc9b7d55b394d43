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

/// The friction of all that touch one.
struct Rubbing {
  Vec force{0.0, 0.0};                  ///< N, at the velocities before the step
  double xx = 0.0, xy = 0.0, yy = 0.0;  ///< kg/s, by how much it falls with his velocity

  Vec change(const Vec& others, double rate) const;
};

/// In the order of the parameters.
struct Forces {
  double mass, reaction_time, strength, range, stiffness, friction, cutoff;

  Vec touch(double depth, const Vec& away, const Vec& slip, double share, Rubbing& rubbing) const;
  Vec of_wall(double depth, const Vec& away, const Vec& slip, Rubbing& rubbing) const;
};

}  // namespace throng
#endif

HWY_BEFORE_NAMESPACE();
namespace throng::HWY_NAMESPACE {

/// N, between bodies: of those who touch, one by one, each of whom ends half of a slip.
HWY_INLINE Vec touches(const Forces& model, const CrowdView& crowd, std::uint32_t own, const Others& others,
                       const std::vector<double>& gap, const Near& near, Rubbing& rubbing) {
  Vec force(0.0, 0.0);
  for (std::size_t k = near.first; k < near.first + near.size; ++k) {
    if (!(gap[k] < 0.0)) continue;
    const Vec to(others.dx[k], others.dy[k]);
    const auto place = static_cast<std::uint32_t>(others.place[k]);
    force += model.touch(-gap[k], -to / to.norm(), crowd.velocity(place) - crowd.velocity(own), 2.0, rubbing);
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
  Rubbing rubbing;
  force += touches(model, crowd, place, others, pushes.gap, near, rubbing);
  const double wall_reach = radius + kNegligibleRanges * model.range;
  if (!crowd.is_clear(place, wall_reach))
    crowd.barriers.for_each_nearest(p, wall_reach, [&](const Vec& q) {
      const double distance = (p - q).norm();
      if (distance > 0.0) force += model.of_wall(radius - distance, (p - q) / distance, -v, rubbing);
    });
  return pushed(v, v + rubbing.change(force, crowd.dt / model.mass), crowd.desired_speed[place]);
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

/// Found by throng bench validation: all draws of the crowd keep what they are for. As many get through a
/// passage as through a door of the same width, to 5 %, so that no set keeps both IMO 4, which allows 1.33 /s
/// through 1 m, and the bottlenecks of Seyfried (2009), who measured 1.9.
constexpr double kCalibrated[] = {80.0, 1.31, 2500.0, 0.063, 4.6e4, 1.1e6, 2.5};
constexpr double kBottleneck[] = {80.0, 1.25, 63.0, 0.218, 9.2e3, 1.4e4, 2.5};
constexpr ModelPreset kPresets[] = {
    {"calibrated", "for people in rooms and at exits as in guidelines, by throng bench validation",
     kCalibrated},
    {"bottleneck", "for as many through bottlenecks as Seyfried et al. (2009) measured", kBottleneck}};
static_assert(std::size(kCalibrated) == std::size(kParameters));
static_assert(std::size(kBottleneck) == std::size(kParameters));

constexpr double kTouching = 6.0;  // as many discs of one size may touch one

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

 private:
  Forces model_;
};

}  // namespace

/// m/s, by it and by other forces (N) in a step of `rate` (s/kg) times the mass: by what it has become at the
/// step's end, to first order (Rosenbrock, "Some general implicit processes for the numerical solution of
/// differential equations", Computer Journal 1963), as it ends a slip in less than a step.
Vec Rubbing::change(const Vec& others, double rate) const {
  const Vec f = rate * (others + force);
  const double a = 1.0 + rate * xx, b = rate * xy, c = 1.0 + rate * yy;
  return Vec(c * f.x() - b * f.y(), a * f.y() - b * f.x()) / (a * c - b * b);
}

/// N, at this depth (m, above 0); what rubs, from what moves past at `slip` (m/s), joins `rubbing`. A change
/// of velocity changes the slip `share` times as much.
Vec Forces::touch(double depth, const Vec& away, const Vec& slip, double share, Rubbing& rubbing) const {
  const Vec along(-away.y(), away.x());
  const double rub = friction * depth;
  rubbing.force += rub * slip.dot(along) * along;
  rubbing.xx += share * rub * along.x() * along.x();
  rubbing.xy += share * rub * along.x() * along.y();
  rubbing.yy += share * rub * along.y() * along.y();
  return stiffness * depth * away;
}

/// The same with the repulsion (depth below 0: a gap).
Vec Forces::of_wall(double depth, const Vec& away, const Vec& slip, Rubbing& rubbing) const {
  const Vec push = strength * exponential(std::min(depth / range, kMostExponent)) * away;
  return depth > 0.0 ? Vec(push + touch(depth, away, slip, 1.0, rubbing)) : push;
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
