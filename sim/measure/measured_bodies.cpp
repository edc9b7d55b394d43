// SPDX-License-Identifier: MIT
#include "sim/measure/measured_bodies.h"

#include <algorithm>
#include <array>
#include <limits>
#include <optional>

#include "sim/gas.h"
#include "sim/measure/coordination_number.h"
#include "sim/measure/packing_fraction.h"
#include "sim/measure/pair_correlation.h"
#include "sim/measure/speeds.h"
#include "sim/plan.h"

namespace throng {

namespace {

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

enum Column {
  temperature_column,
  packing_column,
  coordination_column,
  collisions_column,
  wall_collisions_column,
  compressibility_column,
  by_rate_column,
  speeds_column,
  correlation_column,
  kColumns
};

constexpr std::array<AskedColumn, kColumns> kKnown{{{"temperature"},
                                                    {"packing_fraction"},
                                                    {"coordination_number"},
                                                    {"collisions"},
                                                    {"wall_collisions"},
                                                    {"compressibility_factor"},
                                                    {"compressibility_factor_by_rate"},
                                                    {"speeds", 1, {0.0, 1}},
                                                    {"pair_correlation", 1, {0.0, 1}}}};

/// Whether collisions are told one by one.
bool collides(const Scene& scene) {
  return scene.engine == Engine::event_driven || (scene.engine == Engine::native && plan_for(scene).flights);
}

AskedColumn histogram(Column column, const Bins& bins) {
  return {kKnown[column].name, static_cast<std::size_t>(bins.count), bins};
}

Eigen::AlignedBox2d packing_box(const Scene& scene) {
  return scene.asked.packing_within.value_or(Eigen::AlignedBox2d(scene.domain.min, scene.domain.max));
}

std::string packing_refusal(const Scene& scene) {
  const auto& within = scene.asked.packing_within;
  if (!within && scene.domain.kind == DomainKind::unbounded)
    return "packing_fraction needs a domain, or observe.packing_within";
  if (within && scene.domain.kind == DomainKind::periodic &&
      (within->sizes().array() > (scene.domain.max - scene.domain.min).array()).any())
    return "must not be larger than the domain that repeats";
  return "";
}

void append_compressibility(const Scene& scene, const State& state, std::span<const ContactRow> contacts,
                            std::vector<double>& values) {
  if (is_soft(scene.contact))
    return values.push_back(compressibility_now(scene, state, contacts).value_or(kUnknown));
  values.push_back(compressibility_factor(scene, state, state.collisions).value_or(kUnknown));
  values.push_back(compressibility_by_rate(scene, state, state.collisions).value_or(kUnknown));
}

}  // namespace

std::span<const AskedColumn> known_columns() {
  return kKnown;
}

std::vector<AskedColumn> asked_columns(const Scene& scene) {
  const Asked& asked = scene.asked;
  std::vector<AskedColumn> all;
  const auto add = [&](bool wanted, Column column) {
    if (wanted) all.push_back(kKnown[column]);
  };
  add(asked.temperature, temperature_column);
  add(asked.packing_fraction, packing_column);
  add(asked.coordination_number, coordination_column);
  add(asked.collisions, collisions_column);
  add(asked.collisions, wall_collisions_column);
  add(asked.compressibility_factor, compressibility_column);
  add(asked.compressibility_factor && !is_soft(scene.contact), by_rate_column);
  if (asked.speeds) all.push_back(histogram(speeds_column, asked.speeds));
  if (asked.pair_correlation) all.push_back(histogram(correlation_column, asked.pair_correlation));
  return all;
}

std::vector<double> measure_bodies(const Scene& scene, const State& state,
                                   std::span<const ContactRow> contacts) {
  const Asked& asked = scene.asked;
  std::vector<double> values;
  if (asked.temperature) values.push_back(temperature(scene, state));
  if (asked.packing_fraction) values.push_back(packing_fraction(scene, state, packing_box(scene)));
  if (asked.coordination_number)
    values.push_back(state.step > 0 ? coordination_number(scene, contacts) : kUnknown);
  if (asked.collisions)
    for (const std::int64_t count : {state.collisions.pairs, state.collisions.walls})
      values.push_back(static_cast<double>(count));
  if (asked.compressibility_factor) append_compressibility(scene, state, contacts, values);
  if (asked.speeds) append_speeds(scene, state, asked.speeds, values);
  if (asked.pair_correlation) append_pair_correlation(scene, state, asked.pair_correlation, values);
  return values;
}

std::pair<std::string, std::string> asked_refusal(const Scene& scene) {
  const Asked& asked = scene.asked;
  if (!asked.any()) return {};
  if (scene.crowd.size() > 0) return {"", "is of bodies; what agents do is counted by [[measure]]"};
  const bool one_by_one = collides(scene);
  if (asked.collisions && !one_by_one)
    return {"quantities",
            "collisions are told one by one only by engine event_driven, and among discs that keep all their "
            "energy and "
            "that nothing pulls"};
  if (asked.compressibility_factor && !one_by_one &&
      !(is_soft(scene.contact) && scene.engine == Engine::native))
    return {"quantities",
            "compressibility_factor needs collisions one by one (engine event_driven, or discs that keep all "
            "their energy and that "
            "nothing pulls) or soft contacts"};
  if (asked.coordination_number && one_by_one)
    return {"quantities", "coordination_number needs contacts that last, and here are only collisions"};
  if (asked.packing_fraction)
    if (const std::string why = packing_refusal(scene); !why.empty())
      return {asked.packing_within ? "packing_within" : "quantities", why};
  if (asked.pair_correlation)
    if (const std::string why = correlation_refusal(scene, asked.pair_correlation.up_to); !why.empty())
      return {"pair_correlation.up_to", why};
  return {};
}

}  // namespace throng
