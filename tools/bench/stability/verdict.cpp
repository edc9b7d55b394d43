// SPDX-License-Identifier: MIT
#include "tools/bench/stability/verdict.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>

#include "sim/observe.h"
#include "sim/simulation_error.h"

namespace throng::bench {

namespace {

constexpr double kEarthGravity = 9.81;  // m/s²

double energy(const Scene& scene, const State& state) {
  return kinetic_energy(scene, state) + potential_energy(scene, state);
}

/// J: what there is to lose, above all lying on the floor.
double energy_at_hand(const Scene& scene, const State& first, double floor) {
  double above = kinetic_energy(scene, first);
  for (std::size_t row = 0; row < first.id.size(); ++row)
    above += mass(scene, row) * -scene.gravity.y() * (first.position[row].y() - floor);
  return above;
}

double root_mean_square_speed(const State& state) {
  double sum = 0.0;
  for (const Vec& velocity : state.velocity) sum += velocity.squaredNorm();
  return std::sqrt(sum / static_cast<double>(state.velocity.size()));
}

double farthest(const Scene& scene, const State& state) {
  double way = 0.0;
  for (std::size_t row = 0; row < state.id.size(); ++row)
    way = std::max(way, (state.position[row] - scene.bodies.position[row]).norm());
  return way;
}

bool all_inside(const Scene& scene, const State& state) {
  if (scene.domain.kind != DomainKind::box) return true;
  return std::ranges::all_of(state.position, [&](const Vec& p) {
    return (p.array() >= scene.domain.min.array()).all() && (p.array() <= scene.domain.max.array()).all();
  });
}

Stability judged(Stressed which, const Stress& stress, const Endured& seen, bool inside) {
  if (!seen.end.empty() || !inside || !(seen.energy <= 0.1)) return Stability::exploded;
  const bool rests = which != Stressed::gas && stress[std::size_t(Factor::restitution)] < 1.0;
  const bool moved = which == Stressed::stack && seen.moved > 0.1;
  const bool drifts = seen.energy > 0.01 || seen.overlap > 0.1 || (rests && (moved || seen.speed > 0.1));
  return drifts ? Stability::drifting : Stability::stable;
}

}  // namespace

const char* verdict_name(Stability verdict) {
  constexpr std::array names{"stable", "drifting", "exploded"};
  return names[static_cast<std::size_t>(verdict)];
}

Endured endure(Stressed which, const Stress& stress) {
  const Scene scene = stressed_scene(which, stress);
  const double scale = stress[std::size_t(Factor::scale)], offset = stress[std::size_t(Factor::offset)];
  const bool lossless =
      stress[std::size_t(Factor::restitution)] >= 1.0 && stress[std::size_t(Factor::friction)] == 0.0;
  const auto run = simulation(scene);
  const double at_first = energy(scene, run->state()), at_hand = energy_at_hand(scene, run->state(), offset);
  const double pace = which == Stressed::gas ? scale : std::sqrt(kEarthGravity * scale);  // m/s
  Endured seen;
  const auto begin = std::chrono::steady_clock::now();
  try {
    for (std::int64_t i = 0; i < scene.time.steps(); ++i) {
      run->step();
      const double change = (energy(scene, run->state()) - at_first) / at_hand;
      seen.energy = std::max(seen.energy, lossless ? std::abs(change) : change);
    }
  } catch (const SimulationError& error) {
    seen.end = error.what();
  }
  seen.ms = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count();
  const State& state = run->state();
  seen.steps = state.step;
  if (seen.end.empty()) seen.overlap = overlap(scene, state).max / (0.45 * scale);
  seen.speed = root_mean_square_speed(state) / pace;
  if (which == Stressed::stack) seen.moved = farthest(scene, state) / scale;
  seen.verdict = judged(which, stress, seen, all_inside(scene, state));
  return seen;
}

}  // namespace throng::bench
