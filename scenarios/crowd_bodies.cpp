// SPDX-License-Identifier: MIT
#include <cmath>

#include "scenarios/read_crowd.h"
#include "scenarios/region_sets.h"
#include "sim/crowd/body_solids.h"

namespace throng::scenarios {

namespace {

void refuse_dynamic_bodies(std::span<const Entry> entries, Report& report) {
  for (const Entry& entry : entries)
    if (entry.kind == BodyKind::dynamic)
      report.error(
          *entry.node, "bodies[" + std::to_string(entry.index) + "].kind",
          "not supported yet: dynamic bodies beside agents; give it kind = \"static\" or \"kinematic\"");
}

constexpr double kMostTurn = 0.5;  // rad in a step: agents take the ways of what turns as straight

void refuse_fast_turns(std::span<const Entry> entries, double dt, Report& report) {
  for (const Entry& entry : entries)
    if (entry.kind == BodyKind::kinematic && std::abs(entry.spin) * dt > kMostTurn)
      report.error(*entry.node, "bodies[" + std::to_string(entry.index) + "].spin",
                   "turns by " + to_text(std::abs(entry.spin) * dt) +
                       " rad in a step; beside agents it must be at most " + to_text(kMostTurn) +
                       ", so time.dt at most " + to_text(kMostTurn / std::abs(entry.spin)) + " s");
}

/// The last of them, which covered what had been left.
void refuse_covering(std::span<const Entry> entries, const std::string& what, Report& report) {
  const Entry* last = nullptr;
  for (const Entry& entry : entries)
    if (entry.kind == BodyKind::fixed) last = &entry;
  report.error(*last->node, "bodies[" + std::to_string(last->index) + "]", "static bodies cover " + what);
}

}  // namespace

void add_bodies_to_floor(std::span<const Entry> entries, Scene& scene, Report& report) {
  if (scene.crowd.groups.empty()) return;
  refuse_dynamic_bodies(entries, report);
  refuse_fast_turns(entries, scene.time.dt, report);
  if (report.errors() > 0) return;
  Crowd& crowd = scene.crowd;
  const std::vector<Region> standing = standing_solids(scene);
  if (standing.empty()) return;
  crowd.walkable = without(crowd.walkable, united(standing));
  if (crowd.walkable.empty()) return refuse_covering(entries, "all of the walkable area", report);
  for (Measure& measure : crowd.measures) {
    if (!measure.area.empty()) find_ground(crowd.walkable, measure);
    if (measure.area.empty() ? !runs_through(measure.line[0], measure.line[1], crowd.walkable)
                             : !(measure.size > 0.0))
      refuse_covering(entries, "all that measure " + in_quotes(measure.name) + " looks at", report);
  }
}

}  // namespace throng::scenarios
