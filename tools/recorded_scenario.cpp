// SPDX-License-Identifier: MIT
#include "tools/recorded_scenario.h"

#include <algorithm>
#include <bit>
#include <cstdint>

#include "scenarios/load.h"
#include "sim/input_error.h"
#include "sim/uses_substeps.h"

namespace throng::tools {

namespace {

bool same_region(const Record& a, const Record& b) {
  if (!a.within || !b.within) return a.within.has_value() == b.within.has_value();
  return a.within->min() == b.within->min() && a.within->max() == b.within->max();
}

/// What a recording of one kind holds otherwise than one of another; "" where nothing.
std::string difference(const Record& a, const Record& b) {
  if (a.every != b.every) return "frames";
  if (a.ids != b.ids) return "bodies";
  if (!same_region(a, b)) return "a region";
  if (a.quantum != b.quantum) return "a quantum";
  if (a.single != b.single) return "a precision";
  if (a.observables != b.observables) return "observables";
  for (RecordField field : kRecordFields)
    if (every(a, field) != every(b, field)) return std::string("a rate of ") + name(field);
  return "";
}

bool same_bits(double a, double b) {
  return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
}

/// As far as a recording says: it doesn't hold who has a sensor.
bool same_sensor(const Sensor& a, const Sensor& b) {
  return a.name == b.name && same_bits(a.radius, b.radius) && same_bits(a.fov, b.fov) &&
         a.screens == b.screens && a.every == b.every;
}

/// The same; nor does it hold when something is measured.
bool same_measure(const Measure& a, const Measure& b) {
  return a.name == b.name && a.line == b.line && a.area.rings == b.area.rings;
}

}  // namespace

std::vector<std::string> fields_of_run(const Recording& recording) {
  const Scene& scene = recording.geometry();
  if (!uses_substeps(scene) || says_substeps(recording.origin().provenance.resolved)) return {};
  return {"time.substeps=" + std::to_string(scene.time.substeps)};
}

void expect_scenario(const Recording& recording, const Scene& scene, const std::string& file) {
  const auto refuse = [&](const std::string& why) { throw InputError(file + " is inconsistent: " + why); };
  if (scene.bodies.size() != recording.bodies_of_run())
    refuse("its scenario makes " + std::to_string(scene.bodies.size()) + " bodies, its frames hold " +
           std::to_string(recording.bodies_of_run()));
  if (!same_bits(scene.time.dt, recording.geometry().time.dt))
    refuse("its scenario has other steps than its frames");
  if (recording.origin().minor >= 5 &&
      !std::ranges::equal(scene.crowd.measures, recording.geometry().crowd.measures, same_measure))
    refuse("its scenario measures otherwise than its frames");
  const auto same_cutoff = [](const Measure& a, const Measure& b) { return same_bits(a.cutoff, b.cutoff); };
  if (recording.origin().minor >= 9 &&
      !std::ranges::equal(scene.crowd.measures, recording.geometry().crowd.measures, same_cutoff))
    refuse("its scenario has other Voronoi cells than its frames");
  if (!std::ranges::equal(recorded(scene.sensors), recording.geometry().sensors, same_sensor))
    refuse("its scenario has other sensors than its frames");
  if (const std::string what = difference(scene.record, recording.geometry().record); !what.empty())
    refuse("its scenario records " + what + " that its frames do not have");
}

}  // namespace throng::tools
