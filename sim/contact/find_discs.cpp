// SPDX-License-Identifier: MIT
#include "sim/contact/find_discs.h"

#include "sim/contact/contact_key.h"
#include "sim/contact/memory.h"

namespace throng {

using broadphase::Pair;

/// Its normal is found in each substep.
DiscContact DiscFinder::contact(const Colliders& colliders, Pair pair,
                                std::span<const SolverBody> bodies) const {
  DiscContact contact;
  contact.a = colliders.body[pair.a], contact.b = colliders.body[pair.b];
  contact.radius_a = colliders.radius[pair.a], contact.radius_b = colliders.radius[pair.b];
  const std::vector<std::uint32_t>& material = scene_.bodies.material;
  const Surface& surface =
      plan_.surfaces[material[contact.a] * scene_.materials.size() + material[contact.b]];
  contact.friction = surface.friction, contact.restitution = surface.restitution;
  const SolverBody &a = bodies[contact.a], &b = bodies[contact.b];
  const double masses = a.inverse_mass + b.inverse_mass;
  contact.normal_mass = 1.0 / masses;
  contact.tangent_mass = 1.0 / (masses + a.inverse_inertia * contact.radius_a * contact.radius_a +
                                b.inverse_inertia * contact.radius_b * contact.radius_b);
  return contact;
}

/// Keys, groups, and what is kept of the last step.
void DiscFinder::look_up(std::span<const Pair> pairs, const Colliders& colliders, const State& state,
                         Contacts& contacts, Workers& workers) {
  kept_.resize(pairs.size()), group_.resize(pairs.size()), contacts.disc_key.resize(pairs.size());
  workers.for_ranges(pairs.size(), [&](std::size_t begin, std::size_t end) {
    Memory memory(state.disc_contacts, key_of(pairs[begin], false));
    for (std::size_t i = begin; i < end; ++i) {
      const std::uint64_t key = contacts.disc_key[i] = key_of(pairs[i], false);
      const auto kept = memory.find(key);
      kept_[i] = kept.empty() ? nullptr : &kept[0];
      group_[i] = contacts.strips.group(colliders.body[pairs[i].a], colliders.body[pairs[i].b]);
    }
  });
}

void DiscFinder::find(std::span<const Pair> pairs, const Candidates& candidates, const State& state,
                      std::span<const SolverBody> bodies, Contacts& contacts, Workers& workers) {
  const Colliders& colliders = candidates.colliders();
  const Strips& strips = contacts.strips;
  look_up(pairs, colliders, state, contacts, workers);
  of_group_.sort(group_, strips.groups(), workers);
  contacts.discs.start(pairs.size(), bodies.size(), strips.groups());
  contacts.disc_bounces.resize(plan_.restitution ? pairs.size() : 0);
  strips.for_each_group(workers, [&](std::size_t group, std::size_t phase) {
    contacts.discs.start_group(group, phase, still_row(bodies, group));
    for (const std::uint32_t i : of_group_[group]) {
      DiscContact one = contact(colliders, pairs[i], bodies);
      if (kept_[i]) one.normal_impulse = kept_[i]->normal, one.tangent_impulse = kept_[i]->tangent;
      const std::uint32_t seat = contacts.discs.group(group).add(one, bodies[one.a], bodies[one.b]);
      contacts.discs.seat(i, group, seat);
      if (plan_.restitution) contacts.disc_bounces[i] = one;
    }
    contacts.discs.group(group).finish();
  });
}

}  // namespace throng
