// SPDX-License-Identifier: MIT
#include "sim/contact/first_loads.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace throng {

namespace {

constexpr double kSettled = 1e-6;  // of all impulses, that a round of sweeps changes

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

/// Calls f(block or point) for all contacts, eight at a time.
template <class F>
void for_each_eight(Contacts& contacts, std::size_t groups, F f) {
  for (std::size_t group = 0; group < groups; ++group) {
    for (DiscBlock& block : contacts.discs.blocks(group)) f(block);
    for (FaceBlock& block : contacts.faces.blocks(group))
      for (FaceBlock::Point& point : std::span(block.points, block.count)) f(point);
  }
}

/// Sends impulses on the way that they have come (Nesterov 1983), until the way turns back (O'Donoghue and
/// Candes 2015).
class Momentum {
 public:
  Momentum(Contacts& contacts, std::size_t groups) : contacts_(contacts), groups_(groups) {
    std::size_t size = 0;
    for_each([&](double&, std::size_t, bool) { ++size; });
    found_.resize(size), begun_.resize(size);
  }

  /// What a round has found becomes what the next one begins with. Returns the share of all that it changed.
  double extrapolate() {
    double sum = 0.0, change = 0.0, back = 0.0;
    for_each([&](double& impulse, std::size_t i, bool) {
      sum += std::abs(impulse), change += std::abs(impulse - begun_[i]);
      back += (begun_[i] - impulse) * (impulse - found_[i]);
    });
    age_ = back > 0.0 ? 0.0 : age_ + 1.0;
    const double share = age_ / (age_ + 3.0);
    for_each([&](double& impulse, std::size_t i, bool normal) {
      begun_[i] = impulse + share * (impulse - found_[i]);
      if (normal) begun_[i] = std::max(begun_[i], 0.0);
      found_[i] = impulse, impulse = begun_[i];
    });
    return sum > 0.0 ? change / sum : 0.0;
  }

  /// Back to what the last round found.
  void stop() {
    for_each([&](double& impulse, std::size_t i, bool) { impulse = found_[i]; });
  }

 private:
  template <class F>
  void for_each(F f) {  // f(impulse, which, whether it is a normal one)
    std::size_t i = 0;
    for_each_eight(contacts_, groups_, [&](auto& eight) {
      for (double& impulse : eight.normal_impulse) f(impulse, i++, true);
      for (double& impulse : eight.tangent_impulse) f(impulse, i++, false);
    });
  }

  Contacts& contacts_;
  std::size_t groups_;
  double age_ = -1.0;  // rounds since the way turned back
  std::vector<double> found_, begun_;
};

/// A sweep over all contacts and one back, from the impulses that they have.
void sweep(Contacts& contacts, const Parts& parts, std::span<SolverBody> bodies, SolverSettings settings,
           const Vec& kick, const Vec* period, Workers& workers) {
  for (SolverBody& body : bodies) {
    body.velocity = body.inverse_mass > 0.0 ? kick : Vec(0.0, 0.0);
    body.spin = 0.0;
  }
  for_each_group(parts, workers, [&](std::size_t group) {
    prepare_and_start(contacts.discs.blocks(group), bodies, period);
    prepare_and_start(contacts.faces.blocks(group), bodies);
  });
  settings.backward = false;
  for_each_group(parts, workers, [&](std::size_t group) {
    push_apart(contacts.discs.blocks(group), bodies, settings);
    push_apart(contacts.faces.blocks(group), bodies, settings);
  });
  settings.backward = true;
  for_each_group(parts, workers, [&](std::size_t group) {
    push_apart(contacts.faces.blocks(group), bodies, settings);
    push_apart(contacts.discs.blocks(group), bodies, settings);
  });
}

/// `weight`: what bears more of a kilogram that it feels (m/s) begins without, as it swings too slowly.
void take_as_preloads(Contacts& contacts, std::size_t groups, double weight) {
  for_each_eight(contacts, groups, [weight](auto& eight) {
    for (std::size_t lane = 0; lane < BlockOrder::kWidth; ++lane) {
      double& load = eight.normal_impulse[lane];
      if (!(load < weight * eight.normal_mass[lane])) load = eight.tangent_impulse[lane] = 0.0;
      eight.preload[lane] = load;
    }
  });
}

}  // namespace

void find_first_loads(Contacts& contacts, const Parts& parts, std::span<SolverBody> bodies,
                      const SolverSettings& settings, const Vec& kick, const Vec* period, Workers& workers) {
  const std::vector<SolverBody> given(bodies.begin(), bodies.end());
  Momentum momentum(contacts, parts.groups());
  int round = 0;
  do {
    sweep(contacts, parts, bodies, rigid(settings), kick, period, workers);
  } while (momentum.extrapolate() > kSettled && ++round < kMostLoadRounds);
  momentum.stop();
  take_as_preloads(contacts, parts.groups(), Learning::kMost * settings.learning.weight);
  std::ranges::copy(given, bodies.begin());
}

}  // namespace throng
