// SPDX-License-Identifier: MIT
#include "sim/recording/soundness.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <utility>

#include "sim/recording/contact_columns.h"
#include "sim/simulation_error.h"

namespace throng::recording {

namespace {

bool is_possible(const std::vector<ContactImpulse>& contacts) {
  return std::is_sorted(contacts.begin(), contacts.end(),
                        [](const ContactImpulse& a, const ContactImpulse& b) { return a.key < b.key; }) &&
         std::all_of(contacts.begin(), contacts.end(), [](const ContactImpulse& c) {
           return std::isfinite(c.normal) && std::isfinite(c.tangent) && std::isfinite(c.rolling) &&
                  std::isfinite(c.preload);
         });
}

/// Who they are of is for `fits` to say.
bool is_possible(const std::vector<SleepingContact>& contacts) {
  return is_possible(impulses(contacts)) &&
         std::all_of(contacts.begin(), contacts.end(),
                     [](const SleepingContact& c) { return is_near(c.point); });
}

/// All different, those of the agents who have left, too, and from 1 to as many as there are with those who
/// are to come.
bool are_names(std::vector<std::uint32_t> id, const CrowdState& crowd) {
  id.insert(id.end(), crowd.arrived_id.begin(), crowd.arrived_id.end());
  std::sort(id.begin(), id.end());
  return std::adjacent_find(id.begin(), id.end()) == id.end() &&
         (id.empty() || (id.front() > 0 && id.back() <= id.size() + waiting(crowd)));
}

/// What no run counts up to.
bool is_count(std::int64_t n) {
  return 0 <= n && n < std::int64_t{1} << 62;
}

bool is_possible(const Measured& measured, std::int64_t step) {
  return 0 <= measured.first && measured.first <= measured.last && measured.last <= step &&
         0 <= measured.steps && measured.steps <= step && is_count(measured.count) &&
         is_count(measured.back) && is_count(measured.samples) && measured.speed >= 0.0 &&
         std::isfinite(measured.speed) && measured.voronoi >= 0.0 && std::isfinite(measured.voronoi);
}

/// Each once, and nobody has gone round the end of a line so often.
bool is_possible(const std::vector<OnLine>& on_line) {
  const auto is_astray = [](const OnLine& a, const OnLine& b) {
    return std::pair(a.line, a.id) >= std::pair(b.line, b.id);
  };
  return std::adjacent_find(on_line.begin(), on_line.end(), is_astray) == on_line.end() &&
         std::all_of(on_line.begin(), on_line.end(),
                     [](const OnLine& his) { return std::abs(std::int64_t{his.uncounted}) < 1 << 30; });
}

/// No body senses more than all the others, which 32 bits name.
bool is_possible(const SensedSum& sum) {
  return is_count(sum.looks) && is_count(sum.sensed) && sum.sensed >> 32 <= sum.looks;
}

bool is_possible(const Collisions& all) {
  return is_count(all.pairs) && is_count(all.walls) && is_count(all.pushed) && std::isfinite(all.virial) &&
         std::isfinite(all.equilibrium);
}

/// Steps from 1 to `last`, ascending, those who arrive in one by their ids.
bool are_in_order(std::span<const std::int64_t> steps, std::span<const std::uint32_t> id, std::int64_t last) {
  if (steps.size() != id.size()) return false;
  for (std::size_t i = 1; i < steps.size(); ++i)
    if (std::pair(steps[i - 1], id[i - 1]) >= std::pair(steps[i], id[i])) return false;
  return steps.empty() || (steps.front() > 0 && steps.back() <= last);
}

/// Who arrived is for `are_names` to say.
bool is_possible(const CrowdState& crowd, std::int64_t step) {
  const auto past = [step](std::int64_t s) { return s >= 0 && s <= step; };
  return std::all_of(crowd.stand.begin(), crowd.stand.end(), is_near) &&
         std::all_of(crowd.spot.begin(), crowd.spot.end(), is_near) &&
         std::all_of(crowd.stand_step.begin(), crowd.stand_step.end(), past) &&
         std::all_of(crowd.halt.begin(), crowd.halt.end(), is_near) &&
         std::all_of(crowd.halt_step.begin(), crowd.halt_step.end(), past) &&
         std::all_of(crowd.since.begin(), crowd.since.end(), past) &&
         are_in_order(crowd.arrivals, crowd.arrived_id, step) && is_count(crowd.wall_corrections) &&
         is_count(crowd.squeezed) &&
         std::all_of(crowd.measured.begin(), crowd.measured.end(),
                     [&](const Measured& measured) { return is_possible(measured, step); }) &&
         is_possible(crowd.on_line);
}

}  // namespace

bool are_arrivals(std::span<const std::int64_t> steps, std::span<const std::uint32_t> id, std::int64_t last,
                  AgentIds agents) {
  std::vector<std::uint32_t> all(id.begin(), id.end());
  std::sort(all.begin(), all.end());
  return are_in_order(steps, id, last) && std::adjacent_find(all.begin(), all.end()) == all.end() &&
         (all.empty() || (all.front() >= agents.first && all.back() <= agents.last));
}

bool is_sound(const State& state) {
  for (std::size_t row = 0; row < state.id.size(); ++row)
    if (!can_go_on(state, row)) return false;
  return state.step >= 0 && is_possible(state.crowd, state.step) && are_names(state.id, state.crowd) &&
         std::all_of(state.sensed.begin(), state.sensed.end(),
                     [](const SensedSum& sum) { return is_possible(sum); }) &&
         is_possible(state.collisions) && is_possible(state.disc_contacts) &&
         is_possible(state.point_contacts) && is_possible(state.sleep.disc_contacts) &&
         is_possible(state.sleep.point_contacts);
}

}  // namespace throng::recording
