// SPDX-License-Identifier: MIT
#include "sim/contact/find_discs.h"

#include <algorithm>
#include <cassert>

#include "sim/contact/contact_key.h"
#include "sim/contact/kept_impulses.h"

namespace throng {

using broadphase::Pair;

namespace {

constexpr double kRoom = 0.02;          // of the two radii: who is nearer than asked for by this gets a seat
constexpr int kWait = 30;               // steps, where room was of no use
constexpr std::size_t kFewSeats = 100;  // don't matter if they are empty

}  // namespace

DiscFinder::DiscFinder(const Scene& scene, const Plan& plan) : scene_(scene), plan_(plan) {}

DiscContact DiscFinder::contact_of(const Colliders& colliders, Pair pair,
                                   BodyRows<const SolverBody> bodies) const {
  DiscContact contact;
  contact.a = colliders.body[pair.a], contact.b = colliders.body[pair.b];
  contact.radius_a = colliders.radius[pair.a], contact.radius_b = colliders.radius[pair.b];
  const std::vector<std::uint32_t>& material = scene_.bodies.material;
  const Surface& surface = plan_.surface(material[contact.a], material[contact.b]);
  contact.friction = surface.friction, contact.restitution = surface.restitution;
  const SolverBody &a = bodies[contact.a], &b = bodies[contact.b];
  contact.normal_mass = effective_mass(a, b, 0.0, 0.0);
  contact.tangent_mass = effective_mass(a, b, contact.radius_a, contact.radius_b);
  return contact;
}

void DiscFinder::find(const Candidates& candidates, const State& state, BodyRows<const SolverBody> bodies,
                      const Parts& parts, bool moved, std::span<const std::uint64_t> keys, DiscBlocks& discs,
                      Workers& workers) {
  const bool well_filled = 2 * discs.seats() <= 3 * keys.size() + kFewSeats;
  if (moved || wait_ > 0 || !well_filled || !discs.take(keys, workers)) {
    choose(candidates);
    seat(candidates.colliders(), bodies, parts, discs);
    [[maybe_unused]] const bool all = discs.take(keys, workers);
    assert(all);
  }
  ++age_;
  workers.for_ranges(keys.size(), [&](std::size_t begin, std::size_t end) {
    if (begin == end) return;
    KeptImpulses memory(state.disc_contacts, keys[begin]);
    for (std::size_t i = begin; i < end; ++i) discs.set_impulses(i, impulses_of(memory.find(keys[i])));
  });
}

/// Seats for the discs that may touch now, and where the last ones were of use also for those that may soon.
void DiscFinder::choose(const Candidates& candidates) {
  if (wait_ > 0)
    --wait_;
  else if (age_ < kGain)
    wait_ = kWait;
  age_ = 0;
  if (wait_ == 0)
    candidates.list_near(kRoom, seated_);
  else
    seated_.assign(candidates.pairs().begin(), candidates.pairs().end());
  const Colliders& colliders = candidates.colliders();
  if (colliders.shape.empty()) return;
  std::erase_if(seated_,
                [&](const Pair& pair) { return !is_disc(colliders, pair.a) || !is_disc(colliders, pair.b); });
}

void DiscFinder::seat(const Colliders& colliders, BodyRows<const SolverBody> bodies, const Parts& parts,
                      DiscBlocks& discs) {
  discs.start(bodies.size(), parts.groups(), bodies.slots());
  for (const Pair& pair : seated_) {
    const DiscContact contact = contact_of(colliders, pair, bodies);
    discs.add(key_of(pair, false), contact, bodies[contact.a], bodies[contact.b],
              parts.group(contact.a, contact.b));
  }
  discs.finish();
}

}  // namespace throng
