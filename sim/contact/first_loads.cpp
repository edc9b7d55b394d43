// SPDX-License-Identifier: MIT
#include "sim/contact/first_loads.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace throng {

namespace {

constexpr double kTolerance = 1e-6;  // of all impulses, that a round of sweeps changes
constexpr int kMostRounds = 2000;
constexpr double kNothing = 1e-9;  // own weights: what bears less bears nothing

/// A contact and what is known of it from the last rounds, N s.
struct LoadedContact {
  BlockContact contact;
  double mass;                                     // kg, that its normal feels
  double normal = 0.0, tangent = 0.0;              // as found
  double normal_begun = 0.0, tangent_begun = 0.0;  // what the round began with
};

/// In their order, so that sums over them have one order, too.
std::vector<LoadedContact> list(Contacts& contacts) {
  std::vector<LoadedContact> loads;
  loads.reserve(contacts.discs.size() + contacts.faces.size());
  const auto add = [&](const BlockContact& contact) { loads.push_back({contact, *contact.normal_mass}); };
  for (std::size_t i = 0; i < contacts.discs.size(); ++i) add(contacts.discs.contact(i));
  for (std::size_t i = 0; i < contacts.faces.size(); ++i) add(contacts.faces.contact(i));
  return loads;
}

bool moves(const SolverBody& body) {
  return body.velocity != Vec(0.0, 0.0) || body.spin != 0.0;
}

/// Nobody gives way, and who overlaps isn't driven apart.
SolverSettings rigid(SolverSettings settings) {
  settings.softness.mass_scale = 1.0, settings.softness.impulse_scale = 0.0;
  settings.push_out = std::numeric_limits<double>::min();
  return settings;
}

template <class F>
void for_each_group(const Parts& parts, Workers& workers, F f) {
  workers.for_few(parts.count(), [&](std::size_t part) { f(part); });
  if (parts.count() > 1) f(parts.count());
}

/// A sweep over all contacts and one back, from the impulses that they have.
void sweep_both_ways(Contacts& contacts, const Parts& parts, BodyRows<SolverBody> bodies,
                     SolverSettings settings, const Vec& kick, const Vec* period, Workers& workers) {
  for (SolverBody& body : bodies.by_slot()) {
    body.velocity = body.is_dynamic() ? kick : Vec(0.0, 0.0);
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

/// Sends impulses on the way that they have come (Nesterov 1983), until the way turns back (O'Donoghue and
/// Candes 2015).
class Momentum {
 public:
  /// `least`: N s, below which all of them together are nothing.
  explicit Momentum(double least) : least_(least) {}

  /// What a round has found becomes what the next one begins with. False where it has hardly changed
  /// anything.
  bool extrapolate(std::span<LoadedContact> loads) {
    double sum = least_, change = 0.0, back = 0.0;
    for (const LoadedContact& load : loads) {
      const double normal = *load.contact.normal_impulse, tangent = *load.contact.tangent_impulse;
      sum += normal + std::abs(tangent);
      change += std::abs(normal - load.normal_begun) + std::abs(tangent - load.tangent_begun);
      back += (load.normal_begun - normal) * (normal - load.normal) +
              (load.tangent_begun - tangent) * (tangent - load.tangent);
    }
    age_ = back > 0.0 ? 0.0 : age_ + 1.0;
    for (LoadedContact& load : loads) send_on(load, age_ / (age_ + 3.0));
    return change > kTolerance * sum;
  }

 private:
  static void send_on(LoadedContact& load, double share) {
    double &normal = *load.contact.normal_impulse, &tangent = *load.contact.tangent_impulse;
    load.normal_begun = std::max(normal + share * (normal - load.normal), 0.0);
    load.tangent_begun = load.normal_begun > 0.0 ? tangent + share * (tangent - load.tangent) : 0.0;
    load.normal = normal, load.tangent = tangent;
    normal = load.normal_begun, tangent = load.tangent_begun;
  }

  double least_;
  double age_ = -1.0;  // rounds since the way turned back
};

void take_as_preload(LoadedContact& load, const Learning& learning) {
  const double own = learning.weight * load.mass;
  const bool bears = load.normal > kNothing * own && load.normal < learning.most * own;
  *load.contact.normal_mass = load.mass;
  *load.contact.preload = *load.contact.normal_impulse = bears ? load.normal : 0.0;
  *load.contact.tangent_impulse = bears ? load.tangent : 0.0;
}

}  // namespace

void find_first_loads(Contacts& contacts, const Parts& parts, BodyRows<SolverBody> bodies,
                      const SolverSettings& settings, const Vec& kick, const Vec* period, Workers& workers) {
  const std::span<SolverBody> all = bodies.by_slot();
  const std::vector<SolverBody> kept(all.begin(), all.end());
  const BodyRows<const SolverBody> given(kept, bodies.slots());
  const double weight = kick.norm();
  std::vector<LoadedContact> loads = list(contacts);
  double weights = 0.0;
  for (LoadedContact& load : loads) {
    weights += weight * load.mass;
    // Massless, the contact of who moves bears nothing.
    if (moves(given[load.contact.a]) || moves(given[load.contact.b])) *load.contact.normal_mass = 0.0;
  }
  Momentum momentum(kNothing * weights);
  int round = 0;
  do {
    sweep_both_ways(contacts, parts, bodies, rigid(settings), kick, period, workers);
  } while (momentum.extrapolate(loads) && ++round < kMostRounds);
  for (LoadedContact& load : loads) take_as_preload(load, settings.learning);
  std::ranges::copy(kept, all.begin());
}

}  // namespace throng
