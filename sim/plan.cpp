// SPDX-License-Identifier: MIT
#include "sim/plan.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "sim/meeting_materials.h"
#include "sim/record.h"
#include "sim/soft_timing.h"

namespace throng {

namespace {

bool is_disc(const Scene& scene, std::size_t row) {
  return scene.shapes[scene.bodies.shape[row]].kind == ShapeKind::disc;
}

std::size_t count(const Scene& scene, BodyKind kind) {
  return static_cast<std::size_t>(std::ranges::count(scene.bodies.kind, kind));
}

std::vector<Surface> surfaces(const Scene& scene) {
  std::vector<Surface> result;
  for (const Material& a : scene.materials)
    for (const Material& b : scene.materials)
      result.push_back({std::sqrt(a.friction * b.friction), std::max(a.restitution, b.restitution),
                        std::max(a.rolling_resistance, b.rolling_resistance)});
  return result;
}

/// Some moving body for which `wanted` holds.
template <class F>
bool any_moving(const Scene& scene, F wanted) {
  for (std::size_t row = 0; row < scene.bodies.size(); ++row)
    if (scene.bodies.kind[row] != BodyKind::fixed && wanted(row)) return true;
  return false;
}

/// Why nobody sleeps with the native engine; "" where bodies may.
std::string awake_because(const Scene& scene, const Plan& plan) {
  if (!scene.sleep) return "sleep is false";
  if (!plan.contacts()) return "nothing to rest on";
  if (plan.crowd) return "agents don't sleep";
  if (plan.soft) return "soft contacts keep bodies awake";
  if (!plan.gravity) return "gravity is zero: what is slow isn't at rest";
  return "";
}

std::string counted(std::size_t n, const std::string& one, const std::string& more) {
  return std::to_string(n) + " " + (n == 1 ? one : more);
}

std::string counted(std::size_t n, const char* what) {
  return counted(n, what, std::string(what) + "s");
}

/// "linear springs and dashpots, 20 substeps: 25.1 in the 0.00314 s of an impact".
std::string soft_solve(const Scene& scene, const Plan& plan, const std::string& substeps) {
  const SoftTiming timing = soft_timing(scene);
  const char* law = scene.contact == ContactModel::spring ? "linear springs" : "Hertz's springs";
  char text[200];
  if (std::isfinite(timing.contact))
    std::snprintf(text, sizeof text, "%s and dashpots, %s: %.3g in an impact of %.3g s", law,
                  substeps.c_str(), timing.contact / plan.substep, timing.contact);
  else
    std::snprintf(text, sizeof text, "%s and dashpots, %s; nothing moves, nothing falls", law,
                  substeps.c_str());
  return text;
}

bool spins(const Scene& scene) {
  return any_moving(scene, [&](std::size_t row) { return scene.bodies.spin[row] != 0.0; });
}

std::string why_it_turns(const Scene& scene, const Plan& plan) {
  if (plan.crowd) return "the matter of who pushes agents";
  if (spins(scene)) return "some body spins";
  if (!plan.contacts()) return "nobody spins, and nothing touches";
  if (plan.polygons) return "some body isn't a disc: what touches it turns it";
  if (plan.rotation) return "surfaces that rub or resist rolling turn discs";
  return "nobody spins, all are discs, and no surfaces that meet rub";
}

/// Those of the native engine, whichever runs.
std::vector<Stage> stages(const Scene& scene, const Plan& plan) {
  const std::size_t moving = count(scene, BodyKind::dynamic) + count(scene, BodyKind::kinematic);
  const bool dynamic = count(scene, BodyKind::dynamic) > 0;
  const bool off = scene.contact == ContactModel::none;
  const std::string no_contact = "contact.model is none";
  const std::string bodies = std::to_string(moving) + (moving == 1 ? " moving body" : " moving bodies");
  const std::string substeps = counted(static_cast<std::size_t>(scene.time.substeps), "substep");
  const bool one = scene.crowd.size() == 1;
  const bool hits = plan.contacts() && !plan.soft;
  const std::string awake = awake_because(scene, plan);
  return {
      {"find_pairs", plan.pairs,
       plan.pairs ? bodies + " may meet" : (off ? no_contact : "no two bodies of which one is dynamic")},
      {"find_contacts", plan.contacts() && !plan.soft,
       !plan.contacts() ? (off ? no_contact : "nothing to touch")
       : plan.soft      ? "soft contacts are found in each substep"
       : plan.polygons  ? "discs and manifolds of convex parts"
                        : "discs only: no manifolds"},
      {"obstacles", plan.obstacles,
       plan.obstacles ? "walls or static bodies, indexed once"
                      : (off       ? no_contact
                         : dynamic ? "no walls, no static bodies"
                                   : "nothing is dynamic")},
      {"box", plan.box,
       plan.box  ? "the domain's four walls"
       : off     ? no_contact
       : dynamic ? "the domain is no box"
                 : "nothing is dynamic"},
      {"integrate", moving > 0 && !plan.crowd,
       moving == 0  ? "nothing moves"
       : plan.crowd ? "what moves beside agents moves as they walk"
                    : bodies + ", " + substeps},
      {"rotation", plan.rotation && !plan.crowd, why_it_turns(scene, plan)},
      {"gravity", plan.gravity, plan.gravity ? "bodies fall" : "gravity is zero, or nothing is dynamic"},
      {"collide", plan.restitution || hits,
       plan.soft ? "springs throw back what meets"
       : plan.flights
           ? "all surfaces keep all energy and nothing pulls: one by one, in the order of their times"
       : plan.restitution ? "surfaces that meet bounce"
       : hits ? "who meets is stopped, together with all that touches him: no surfaces that meet bounce"
              : "no surfaces that meet bounce"},
      {"solve", plan.contacts(),
       plan.soft         ? soft_solve(scene, plan, substeps)
       : plan.flights    ? "contacts, " + substeps + ", in steps that begin with overlaps only"
       : plan.contacts() ? "contacts, " + substeps
                         : (off ? no_contact : "nothing to touch")},
      {"friction", plan.friction, plan.friction ? "surfaces that meet rub" : "no surfaces that meet rub"},
      {"sleep", awake.empty(), awake.empty() ? "bodies at rest leave the loop, island by island" : awake},
      {"rolling", plan.rolling,
       plan.rolling       ? "surfaces that meet resist the rolling of discs"
       : any_round(scene) ? "no surfaces that meet resist rolling"
                          : "no body is a disc"},
      {"crowd", plan.crowd,
       plan.crowd ? counted(scene.crowd.size(), "agent") +
                        (one ? " looks, steers, walks and leaves at its goal"
                             : " look, steer, walk and leave at their goals") +
                        (moving > 0 ? ", pushed by " + bodies : "")
                  : "no agents"},
      {"appear", plan.entrances,
       plan.entrances ? "some agents appear when they are due" : "nobody appears in the course of time"},
      {"measure", plan.measures,
       plan.measures ? counted(scene.crowd.measures.size(), "line or area", "lines and areas")
                     : "no line, no area is measured"},
      {"wrap", plan.periodic, plan.periodic ? "the domain is periodic" : "the domain is not periodic"},
      {"sense", plan.sensors, plan.sensors ? counted(scene.sensors.size(), "sensor") : "no sensors"},
  };
}

}  // namespace

Plan plan_for(const Scene& scene) {
  return plan_for(scene, scene.contact);
}

Plan plan_for(const Scene& scene, ContactModel contact) {
  const std::size_t dynamic = count(scene, BodyKind::dynamic);
  const bool touching = contact != ContactModel::none && dynamic > 0;
  Plan plan;
  plan.substep = scene.time.dt / scene.time.substeps;
  plan.gravity = dynamic > 0 && scene.gravity != Vec(0.0, 0.0);
  plan.pairs = touching && dynamic + count(scene, BodyKind::kinematic) > 1;
  plan.obstacles = touching && (!scene.walls.empty() || count(scene, BodyKind::fixed) > 0);
  plan.box = touching && scene.domain.kind == DomainKind::box;
  plan.crowd = scene.crowd.size() > 0;
  plan.entrances = plan.crowd && std::ranges::any_of(scene.crowd.groups, [](const AgentGroup& group) {
                     return group.entrance.has_value();
                   });
  plan.measures = plan.crowd && !scene.crowd.measures.empty();
  plan.sensors = !scene.sensors.empty();
  plan.periodic = scene.domain.kind == DomainKind::periodic;
  plan.polygons = any_moving(scene, [&](std::size_t row) { return !is_disc(scene, row); });
  plan.composites = any_moving(
      scene, [&](std::size_t row) { return scene.shapes[scene.bodies.shape[row]].parts.size() > 1; });
  plan.materials = scene.materials.size();
  plan.surfaces = surfaces(scene);
  if (plan.contacts())
    for (const auto& [a, b] : meeting_materials(scene)) plan.meeting.push_back(plan.surface(a, b));
  const auto some = [&](auto wanted) { return std::ranges::any_of(plan.meeting, wanted); };
  plan.friction = some([](const Surface& s) { return s.friction > 0.0; });
  plan.rolling = any_round(scene) && some([](const Surface& s) { return s.rolling > 0.0; });
  plan.rotation = spins(scene) || (plan.contacts() && (plan.polygons || plan.friction || plan.rolling));
  plan.soft = plan.contacts() && is_soft(contact) && !plan.crowd;
  plan.restitution = !plan.soft && some([](const Surface& s) { return s.restitution > 0.0; });
  plan.elastic = plan.restitution && some([](const Surface& s) { return s.restitution >= 1.0; });
  plan.flights = plan.elastic && !plan.gravity && !plan.polygons &&
                 !some([](const Surface& s) { return s.restitution < 1.0 || s.rolling > 0.0; });
  plan.sums_impulses = scene.engine == Engine::native && plan.contacts() && !plan.soft &&
                       every(scene.record, RecordField::contacts) > 0;
  plan.sleep = scene.engine == Engine::native && awake_because(scene, plan).empty();
  plan.stages = stages(scene, plan);
  return plan;
}

}  // namespace throng
