// SPDX-License-Identifier: MIT
#include "sim/auto_time.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <numbers>
#include <vector>

#include "sim/column.h"
#include "sim/contact/soft_law.h"
#include "sim/engine_event_driven.h"
#include "sim/lone_ways.h"
#include "sim/may_meet.h"
#include "sim/meeting_materials.h"
#include "sim/observe.h"
#include "sim/plan.h"
#include "sim/soft_timing.h"
#include "sim/standing.h"

namespace throng {

namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();
constexpr double kSoftness = 1.28;   // a contact sags by F h² / (kSoftness m): see README, of 16 substeps
constexpr double kLeans = 2.0;       // times the mean load, as who lies between others presses aside, too
constexpr double kJams = 6.0;        // widths of a body, in a box narrower than which it jams
constexpr double kThinnest = 4.001;  // height over width of bodies whose towers' sway is known
constexpr double kStands = 2.85;     // sqrt(L / g) / n², the substep up to which towers stand
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

/// s, in which nobody moves by more than a radius.
double time_of_a_radius(const Scene& scene) {
  return smallest_dynamic_radius(scene) / top_speed(scene);
}

/// Nothing but rounding; steps are there to be looked at.
AutoTime exact(const Scene& scene, std::string why) {
  AutoTime result = steps(scene, std::clamp(time_of_a_radius(scene), 1e-3, 0.1), kInfinite);
  result.promise = "nothing is off but rounding, which each collision makes about ten times as large";
  result.why = std::move(why);
  return result;
}

/// Steps in which nobody is off by more than allowed who is off by `speed` (m/s) times a substep at most.
AutoTime late(const Scene& scene, double speed, const char* by) {
  const double allowed = scene.time.error * smallest_dynamic_radius(scene), substep = allowed / speed;
  AutoTime result = steps(scene, std::min(0.1, time_of_a_radius(scene)), substep);
  result.promise = "how far off its exact way a body is at the end, of its radius";
  result.why = text("%.3g m are allowed at %.3g s: h <= %.3g s", allowed, scene.time.until, substep);
  result.why = by + result.why;
  return result;
}

/// Who rolls or slides is ahead by half of what his acceleration gives in a substep, g h t / 2 at most. Who
/// bounces does so when he meets the wall, unless he meets two at once: then he is off by what is left of
/// his substep.
AutoTime alone(const Scene& scene, double impact) {
  if (impact == 0.0 && scene.gravity == Vec(0.0, 0.0)) return exact(scene, "nothing pulls, nothing is met");
  const double ahead = 0.5 * scene.gravity.norm() * scene.time.until;
  if (impact == 0.0) return late(scene, ahead, "who rolls or slides is ahead by g h t / 2 at most, and ");
  double restitution = 0.0;
  for (const auto& [a, b] : meeting_materials(scene))
    restitution = std::max({restitution, scene.materials[a].restitution, scene.materials[b].restitution});
  return late(scene, ahead + (1.0 + restitution) * impact,
              "who hits a wall is off by g h t / 2 + (1 + e) v h at most, and ");
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

/// How many times as far a column sways while it comes to rest as its contacts sag, at most; as measured for
/// towers of 5 to 60 boxes, a quarter to eight times as wide as high, and for 2 to 16 of 5 to 20 side by
/// side.
double sway(const Column& column) {
  const double high = std::clamp(column.layers / 9.0, 1.0, 2.0), thin = column.thinnest;
  const double slender = std::clamp(column.slenderness / 30.0, 1.0, 2.2);
  const double abreast = column.is_tower ? 1.0 : std::max(3.0 * thin * std::sqrt(std::sqrt(thin)), 1.0);
  return high * high * slender * slender * abreast;
}

/// s, the longest substep in which the column sways by no more than is allowed (m).
double sways_by(const Column& column, double allowed, double g) {
  return std::sqrt(allowed / (sway(column) * column.load * g));
}

/// s, the longest substep in which the column is sure to stand. Towers of n squares of side L, 2 to 40 of
/// them, stand until h is 3.7 sqrt(L / g) / n², and fall from a little more on; those of thinner boxes as
/// much sooner as they are slenderer. Where something r times as heavy stands on ten of them, they fall from
/// less than sqrt(r) times shorter substeps on.
double stands_by(const Column& column, double radius, double g) {
  const double heavier = column.load / column.layers,
               thin = std::min(column.layers / column.slenderness, 1.0);
  return kStands * std::sqrt(std::numbers::sqrt2 * radius * thin / g / heavier) /
         (column.layers * column.layers);
}

AutoTime standing(const Scene& scene) {
  const double g = scene.gravity.norm(), radius = smallest_dynamic_radius(scene);
  const double allowed = scene.time.error * radius;
  double sways = kInfinite, falls = kInfinite, load = 0.0;
  for (const Column& column : columns(scene)) {
    if (column.thinnest > kThinnest)
      return refused(
          "a body of those that stand on one another is more than four times as high as wide, and sways");
    sways = std::min(sways, sways_by(column, allowed, g));
    falls = std::min(falls, stands_by(column, radius, g)), load = std::max(load, column.load);
  }
  const double substep = std::min(sways, falls);
  AutoTime result = steps(scene, kLongestStep, substep);
  result.promise = "how far those that stand get from where they do, of a radius";
  result.why = text("the lowest bear up to %.3g of the lightest", load);
  result.why +=
      sways < falls
          ? text(", and may move by %.3g m: h <= %.3g s", allowed, substep)
          : text(", and a tower of so many falls from 1.3 times %.3g s on: h is no longer", substep);
  return result;
}

/// Whether what isn't a disc may jam between walls, where no step is short enough for contacts to bear it.
bool may_jam(const Scene& scene) {
  bool discs = true;
  double widest = 0.0;
  for_dynamic(scene, [&](std::size_t row) {
    discs = discs && scene.shapes[scene.bodies.shape[row]].kind == ShapeKind::disc;
    widest = std::max(widest, 2.0 * scene.bodies.radius[row]);
  });
  if (discs) return false;
  const Vec size = scene.domain.max - scene.domain.min;
  if (scene.domain.kind == DomainKind::box && size.minCoeff() < kJams * widest) return true;
  return std::ranges::any_of(scene.walls, [&](const Wall& wall) {
    for (std::size_t i = 1; i < wall.points.size(); ++i) {
      const Vec way = wall.points[i] - wall.points[i - 1];
      if (std::abs(way.dot(scene.gravity)) > 0.5 * way.norm() * scene.gravity.norm()) return true;
    }
    return wall.closed;
  });
}

AutoTime pressing(const Scene& scene) {
  if (may_jam(scene)) return refused("what isn't a disc may jam between walls, and overlap more");
  const double above = mean_load(scene), g = scene.gravity.norm();
  const double allowed = scene.time.error * smallest_dynamic_radius(scene);
  const double sag = kLeans * above * g / (0.5 * kSoftness);  // m, over h²: two alike feel half a mass
  const double substep = std::sqrt(allowed / sag);
  AutoTime result = steps(scene, kLongestStep, substep);
  result.promise = "how deep those that press on one another overlap by the mean once all lie, of a radius";
  result.why = text("the lowest bear up to %.3g of the lightest, and may sag by %.3g m: h <= %.3g s", above,
                    allowed, substep);
  return result;
}

/// The shorter steps of the two, for what both promise.
AutoTime both(AutoTime a, AutoTime b) {
  if (!a.refusal.empty()) return a;
  if (!b.refusal.empty()) return b;
  const std::string promise = a.promise + "; " + b.promise;
  AutoTime& shorter = a.dt / a.substeps <= b.dt / b.substeps ? a : b;
  shorter.promise = promise;
  return shorter;
}

/// A scene without those dynamic bodies that aren't `who`.
Scene only(const Scene& scene, const std::vector<bool>& who) {
  Scene part = scene;
  part.bodies = {};
  const Bodies& all = scene.bodies;
  for (std::size_t row = 0; row < all.size(); ++row) {
    if (all.kind[row] == BodyKind::dynamic && !who[row]) continue;
    part.bodies.shape.push_back(all.shape[row]);
    part.bodies.material.push_back(all.material[row]);
    part.bodies.kind.push_back(all.kind[row]);
    part.bodies.radius.push_back(all.radius[row]);
    part.bodies.position.push_back(all.position[row]);
    part.bodies.angle.push_back(all.angle[row]);
    part.bodies.velocity.push_back(all.velocity[row]);
    part.bodies.spin.push_back(all.spin[row]);
  }
  return part;
}

/// Of bodies that may meet; `doubt`: of the way of one of them, if it meets none.
AutoTime together(const Scene& scene, const Plan& plan, const std::string& doubt) {
  if (plan.restitution || !plan.gravity) return refused("bodies may meet, and errors grow at each collision");
  if (!touch_at_rest(scene)) return pressing(scene);
  if (const std::string edges = doubt_of_obstacles(scene, plan); !edges.empty()) return refused(edges);
  if (stay(scene, scene.time.error * smallest_dynamic_radius(scene))) return standing(scene);
  if (!doubt.empty()) return pressing(scene);
  AutoTime slides = both(alone(scene, 0.0), pressing(scene));
  slides.promise = "who hits no other: " + slides.promise;
  slides.why = "they don't stay where they are, and " + slides.why;
  return slides;
}

/// What hard contacts do.
AutoTime hard(const Scene& scene, const Plan& plan) {
  const std::vector<LoneWay> ways = lone_ways(scene, plan);
  const std::vector<bool> meets = may_meet(scene, ways);
  double impact = 0.0;
  std::string doubt_alone, doubt_together;
  std::size_t some_alone = 0, some_together = 0;
  for_dynamic(scene, [&](std::size_t row) {
    std::string& doubt = meets[row] ? doubt_together : doubt_alone;
    if (doubt.empty()) doubt = ways[row].doubt;
    ++(meets[row] ? some_together : some_alone);
    if (!meets[row]) impact = std::max(impact, ways[row].impact);
  });
  if (!doubt_alone.empty()) return refused(doubt_alone);
  if (some_together == 0) return alone(scene, impact);
  AutoTime result = together(only(scene, meets), plan, doubt_together);
  return some_alone == 0 ? result : both(alone(scene, impact), std::move(result));
}

AutoTime native(const Scene& scene) {
  const Plan plan = plan_for(scene);
  if (plan.soft) return impacts(scene);
  if (!plan.contacts())
    return exact(scene,
                 plan.gravity ? "who falls freely keeps to a parabola" : "nothing pulls, nobody is met");
  if (plan.flights) return exact(scene, "discs fly from collision to collision");
  if (std::ranges::count(scene.bodies.kind, BodyKind::kinematic) > 0)
    return refused("kinematic bodies stir the others for ever");
  return hard(scene, plan);
}

/// What to do where nothing is promised. Engine event_driven stops where discs come to rest.
std::string instead(const Scene& scene) {
  const std::string look = ": give dt, and look how results change with it";
  if (scene.engine != Engine::native || !event_driven_refusal(scene).empty()) return look;
  const Plan plan = plan_for(scene);
  const bool rests =
      plan.gravity && std::ranges::any_of(plan.meeting, [](const Surface& s) { return s.restitution < 1.0; });
  return look + ", or take engine event_driven" + (rests ? ", which stops where discs come to rest" : "");
}

}  // namespace

AutoTime auto_time(const Scene& scene) {
  if (scene.crowd.size() > 0) return refused("nobody knows the exact way of agents" + instead(scene));
  if (scene.engine == Engine::box2d) return refused("nothing is known of Box2D's error" + instead(scene));
  if (scene.engine == Engine::event_driven)
    return exact(scene, "engine event_driven goes from collision to collision");
  AutoTime result = native(scene);
  if (!result.refusal.empty() && !result.refusal.starts_with("would take")) result.refusal += instead(scene);
  return result;
}

}  // namespace throng
