// SPDX-License-Identifier: MIT
#include "sim/contact/first_loads.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <numeric>
#include <vector>

namespace throng {

namespace {

constexpr double kSettled = 1e-4;  // of all loads

/// Nobody gives way, and who overlaps isn't driven apart.
SolverSettings rigid(SolverSettings settings) {
  settings.softness.mass_scale = 1.0, settings.softness.impulse_scale = 0.0;
  settings.push_out = std::numeric_limits<double>::min();
  return settings;
}

template <class F>
void for_each_group(const Parts& parts, Workers& workers, F f) {
  workers.for_each(parts.count(), [&](std::size_t part) { f(part); });
  if (parts.count() > 1) f(parts.count());
}

/// N s, of all lanes of a row.
double sum(const double (&impulse)[BlockOrder::kWidth]) {
  return std::accumulate(std::begin(impulse), std::end(impulse), 0.0);
}

double take_as_preload(DiscBlock& block) {
  std::ranges::copy(block.normal_impulse, block.preload);
  return sum(block.normal_impulse);
}

/// As learn(), the points of a face bear alike.
double take_as_preload(FaceBlock& block) {
  FaceBlock::Point &first = block.points[0], &second = block.points[block.count - 1];
  for (std::size_t lane = 0; lane < BlockOrder::kWidth; ++lane) {
    const double mean = 0.5 * (first.normal_impulse[lane] + second.normal_impulse[lane]);
    first.preload[lane] = std::min(mean, first.normal_impulse[lane]);
    second.preload[lane] = std::min(mean, second.normal_impulse[lane]);
  }
  return sum(first.normal_impulse) + sum(second.normal_impulse);
}

/// N s, of all contacts, each of which then bears as much without giving way.
double take_as_preloads(Contacts& contacts, std::size_t groups) {
  double loads = 0.0;
  for (std::size_t group = 0; group < groups; ++group) {
    for (DiscBlock& block : contacts.discs.blocks(group)) loads += take_as_preload(block);
    for (FaceBlock& block : contacts.faces.blocks(group)) loads += take_as_preload(block);
  }
  return loads;
}

void sweep_until_settled(Contacts& contacts, const Parts& parts, std::span<SolverBody> bodies,
                         SolverSettings settings, Workers& workers) {
  double loads = 0.0;
  for (int sweep = 1; sweep <= kMostLoadSweeps; ++sweep) {
    settings.backward = sweep % 2 == 0;
    for_each_group(parts, workers, [&](std::size_t group) {
      if (!settings.backward) push_apart(contacts.discs.blocks(group), bodies, settings);
      push_apart(contacts.faces.blocks(group), bodies, settings);
      if (settings.backward) push_apart(contacts.discs.blocks(group), bodies, settings);
    });
    if (sweep % kLoadSweeps != 0) continue;
    const double before = loads;
    loads = take_as_preloads(contacts, parts.groups());
    if (std::abs(loads - before) <= kSettled * loads) return;
  }
}

}  // namespace

void find_first_loads(Contacts& contacts, const Parts& parts, std::span<SolverBody> bodies,
                      const SolverSettings& settings, const Vec& kick, const Vec* period, Workers& workers) {
  const std::vector<SolverBody> given(bodies.begin(), bodies.end());
  for (SolverBody& body : bodies) {
    body.velocity = body.inverse_mass > 0.0 ? kick : Vec(0.0, 0.0);
    body.spin = 0.0;
  }
  for_each_group(parts, workers, [&](std::size_t group) {
    prepare_and_start(contacts.discs.blocks(group), bodies, period);
    prepare_and_start(contacts.faces.blocks(group), bodies);
  });
  sweep_until_settled(contacts, parts, bodies, rigid(settings), workers);
  std::copy(given.begin(), given.end(), bodies.begin());
}

}  // namespace throng
