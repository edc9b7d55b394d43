// SPDX-License-Identifier: MIT
#include "sim/auto_time.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <numbers>
#include <vector>

#include "sim/contact/soft_law.h"
#include "sim/observe.h"
#include "sim/plan.h"
#include "sim/soft_timing.h"
#include "sim/standing.h"

namespace throng {

namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();
constexpr double kSoftness = 1.28;  // a contact sags by F h² / (kSoftness m): see README, of 16 substeps
constexpr double kStands = 3.0;     // sqrt(L / g) / n², the substep up to which towers stand
constexpr double kLongestStep = 1.0 / 60.0;  // s, of steps in which contacts are found once
constexpr int kSubsteps = 16;                // as cheap as fewer, longer steps of as many substeps are dear
constexpr int kFewestSubsteps = 4;           // of them
constexpr double kMostSubsteps = 1e10;       // of a run
constexpr double kFewPerImpact = 20.0;       // substeps

std::string text(const char* format, double a, double b = 0.0, double c = 0.0) {
  char out[240];
  std::snprintf(out, sizeof out, format, a, b, c);
  return out;
}

AutoTime refused(std::string why) {
  AutoTime result;
  result.refusal = std::move(why);
  return result;
}

/// Steps of `dt` at most, all as long, up to the end.
double whole_part(double until, double dt) {
  return until > 0.0 ? until / std::ceil(until / dt * (1.0 - 1e-12)) : dt;
}

/// Steps of at most `longest` (s), their substeps of at most `substep`.
AutoTime steps(const Scene& scene, double longest, double substep) {
  AutoTime result;
  const double wanted = std::min(longest, substep * kSubsteps);
  result.dt = whole_part(scene.time.until, wanted);
  const double substeps = std::ceil(result.dt / substep * (1.0 - 1e-12));
  result.substeps = std::max(static_cast<int>(substeps), kFewestSubsteps);
  if (scene.time.until / substep > kMostSubsteps)
    return refused(
        text("would take more than %.2g substeps of %.2g s: allow a larger error", kMostSubsteps, substep));
  return result;
}

double smallest_radius(const Scene& scene) {
  double radius = kInfinite;
  for (std::size_t row = 0; row < scene.bodies.size(); ++row)
    if (scene.bodies.kind[row] == BodyKind::dynamic) radius = std::min(radius, scene.bodies.radius[row]);
  return radius;
}

/// s, in which nobody moves by more than a radius.
double time_of_a_radius(const Scene& scene) {
  return smallest_radius(scene) / top_speed(scene);
}

/// Nothing but rounding; steps are there to be looked at.
AutoTime exact(const Scene& scene, std::string why) {
  AutoTime result = steps(scene, std::clamp(time_of_a_radius(scene), 1e-3, 0.1), kInfinite);
  result.promise = "rounding alone is off, which collisions make about ten times as large each";
  result.why = std::move(why);
  return result;
}

AutoTime falling(const Scene& scene, double longest) {
  const double g = scene.gravity.norm(), allowed = scene.time.error * smallest_radius(scene);
  AutoTime result = steps(scene, longest, 2.0 * allowed / (g * scene.time.until));
  result.promise = "how far off its exact way a body is at the end, of its radius";
  result.why = text("free fall is late by g h t / 2, and %.3g m are allowed at %.3g s: h <= %.3g s", allowed,
                    scene.time.until, 2.0 * allowed / (g * scene.time.until));
  return result;
}

AutoTime impacts(const Scene& scene) {
  const SoftTiming timing = soft_timing(scene);
  if (!std::isfinite(timing.contact)) return exact(scene, "nobody is to meet anybody");
  const double needed = substeps_per_impact(timing.restitution, scene.time.error);
  const double per_impact = std::max(kFewPerImpact, needed);
  const double substep = std::min(timing.contact / per_impact, timing.longest);
  AutoTime result = steps(scene, std::min(kLongestStep, time_of_a_radius(scene)), substep);
  result.promise = "how far off the restitution of an impact is";
  result.why = text("an impact lasts %.3g s, in which that error needs %.3g substeps: h <= %.3g s",
                    timing.contact, per_impact, substep);
  return result;
}

/// Towers of n squares of side L, 2 to 40 of them, sway by at most n g h² in steps of 1/60 s until h is
/// 3.7 sqrt(L / g) / n², and fall from a little more on. Where something r times as heavy stands on ten of
/// them, they fall from less than sqrt(r) times shorter substeps on.
AutoTime standing(const Scene& scene) {
  const double above = load_of(scene).most, g = scene.gravity.norm();
  const auto dynamic = static_cast<double>(std::ranges::count(scene.bodies.kind, BodyKind::dynamic));
  const double layers = std::min(above, dynamic), heavier = above / layers;
  const double radius = smallest_radius(scene), allowed = scene.time.error * radius;
  const double sways = std::sqrt(allowed / (above * g));
  const double falls = kStands * std::sqrt(std::numbers::sqrt2 * radius / g / heavier) / (layers * layers);
  const double substep = std::min(sways, falls);
  AutoTime result = steps(scene, kLongestStep, substep);
  result.promise = "how far those that stand get from where they do, of a radius";
  result.why = text("the lowest bear up to %.3g of the lightest", above);
  result.why +=
      sways < falls
          ? text(", and may move by %.3g m: h <= %.3g s", allowed, substep)
          : text(", and a tower of so many falls from 1.2 times %.3g s on: h is no longer", substep);
  return result;
}

AutoTime pressing(const Scene& scene) {
  const double above = load_of(scene).mean, g = scene.gravity.norm();
  const double allowed = scene.time.error * smallest_radius(scene);
  const double sag = above * g / (0.5 * kSoftness);  // m, over h²: two alike feel half a mass
  const double substep = std::sqrt(allowed / sag);
  AutoTime result = steps(scene, kLongestStep, substep);
  result.promise = "how deep those that press on one another overlap by the mean, of a radius";
  result.why = text("the lowest bear up to %.3g of the lightest, and may sag by %.3g m: h <= %.3g s", above,
                    allowed, substep);
  return result;
}

/// Bodies that begin to move and needn't ever hit each other: as good as one alone, and as those that press.
AutoTime sliding(const Scene& scene) {
  const AutoTime way = falling(scene, std::min(kLongestStep, time_of_a_radius(scene)));
  const AutoTime pressed = pressing(scene);
  AutoTime result = way.dt / way.substeps <= pressed.dt / pressed.substeps ? way : pressed;
  result.promise =
      "how far off its exact way at the end is who hits no other, and how deep those that press on one "
      "another overlap by the mean, of a radius";
  result.why = "they don't stay where they are, and " + result.why;
  return result;
}

AutoTime native(const Scene& scene) {
  const Plan plan = plan_for(scene);
  if (plan.soft) return impacts(scene);
  if (!plan.contacts())
    return plan.gravity ? falling(scene, 0.1) : exact(scene, "nothing pulls, nobody is met");
  if (plan.flights) return exact(scene, "discs fly from collision to collision");
  if (std::ranges::count(scene.bodies.kind, BodyKind::kinematic) > 0)
    return refused("kinematic bodies stir the others for ever");
  if (!plan.gravity) return refused("errors grow at each collision of bodies that bounce");
  if (!plan.pairs) {
    const std::string doubt = doubt_of_one(scene, plan.restitution);
    return doubt.empty() ? falling(scene, std::min(0.1, time_of_a_radius(scene))) : refused(doubt);
  }
  if (plan.restitution) return refused("errors grow at each collision of bodies that bounce");
  if (!touch_at_rest(scene)) return pressing(scene);
  if (stay(scene, scene.time.error * smallest_radius(scene))) return standing(scene);
  return doubt_of_one(scene, false).empty() ? sliding(scene) : pressing(scene);
}

}  // namespace

AutoTime auto_time(const Scene& scene) {
  const std::string instead = ": give dt, and look how results change with it";
  if (scene.crowd.size() > 0) return refused("nobody knows the exact way of agents" + instead);
  if (scene.engine == Engine::box2d) return refused("nothing is known of Box2D's error" + instead);
  if (scene.engine == Engine::event_driven)
    return exact(scene, "engine event_driven goes from collision to collision");
  AutoTime result = native(scene);
  if (!result.refusal.empty() && !result.refusal.starts_with("would take"))
    result.refusal += instead + ", or take engine event_driven for discs";
  return result;
}

}  // namespace throng
