// SPDX-License-Identifier: MIT
#include "sim/contact/contacts.h"

#include <span>
#include <utility>

namespace throng {

namespace {

/// Writes the rolls' impulses to the contacts kept, which are those that press, in their order.
template <class Blocks>
void save_rolls(const Blocks& contacts, std::span<const RollContact> rolls, std::span<ContactImpulse> kept) {
  std::uint32_t contact = 0;
  std::size_t row = 0;
  for (const RollContact& roll : rolls) {
    for (; contact < roll.contact; ++contact) row += contacts.normal_impulse(contact) > 0.0;
    if (contacts.normal_impulse(contact) > 0.0) kept[row].rolling = roll.impulse;
  }
}

/// Replaces the contacts kept by those that press, `name(i)` the i-th one's key and feature.
template <class Blocks, class F>
void save_pressing(const Blocks& contacts, std::vector<ContactImpulse>& kept,
                   std::vector<std::size_t>& counts, Workers& workers, F name) {
  const auto count = [&](std::size_t begin, std::size_t end) {
    std::size_t pressing = 0;
    for (std::size_t i = begin; i < end; ++i) pressing += contacts.normal_impulse(i) > 0.0;
    return pressing;
  };
  const auto write = [&](std::size_t begin, std::size_t end, auto out) {
    for (std::size_t i = begin; i < end; ++i) {
      const auto [normal, tangent, preload] = contacts.impulses(i);
      if (!(normal > 0.0)) continue;
      const auto [key, feature] = name(i);
      *out++ = ContactImpulse{key, feature, normal, tangent, 0.0, preload};
    }
  };
  workers.select(contacts.size(), counts, kept, count, write);
}

}  // namespace

void Contacts::start(BodyRows<const SolverBody> bodies, std::size_t groups) {
  discs.groups() == groups ? discs.clear() : discs.start(bodies.size(), groups, bodies.slots());
  hits = 0;
  disc_key.clear(), disc_bounces.clear();
  faces.groups() == groups ? faces.clear() : faces.start(bodies.size(), groups, bodies.slots());
  point_key.clear(), point_feature.clear(), point_bounces.clear(), turning.clear();
  disc_rolls.clear(), point_rolls.clear();
}

void Contacts::save(State& state, Workers& workers) {
  save_pressing(discs, state.disc_contacts, counts, workers,
                [&](std::size_t i) { return std::pair(disc_key[i], std::uint32_t{0}); });
  save_pressing(faces, state.point_contacts, counts, workers,
                [&](std::size_t i) { return std::pair(point_key[i], point_feature[i]); });
  save_rolls(discs, disc_rolls, state.disc_contacts);
  save_rolls(faces, point_rolls, state.point_contacts);
}

}  // namespace throng
