// SPDX-License-Identifier: MIT
#include "sim/contact/contacts.h"

#include <span>

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

}  // namespace

void Contacts::start(std::size_t bodies, std::size_t groups) {
  discs.groups() == groups ? discs.clear() : discs.start(bodies, groups);
  hits = 0;
  disc_key.clear(), disc_bounces.clear();
  faces.groups() == groups ? faces.clear() : faces.start(bodies, groups);
  point_key.clear(), point_feature.clear(), point_bounces.clear();
  disc_rolls.clear(), point_rolls.clear();
}

void Contacts::save(State& state) const {
  state.disc_contacts.clear(), state.point_contacts.clear();
  for (std::size_t i = 0; i < discs.size(); ++i)
    if (const auto [normal, tangent, preload] = discs.impulses(i); normal > 0.0)
      state.disc_contacts.push_back({disc_key[i], 0, normal, tangent, 0.0, preload});
  for (std::size_t i = 0; i < faces.size(); ++i)
    if (const auto [normal, tangent, preload] = faces.impulses(i); normal > 0.0)
      state.point_contacts.push_back({point_key[i], point_feature[i], normal, tangent, 0.0, preload});
  save_rolls(discs, disc_rolls, state.disc_contacts);
  save_rolls(faces, point_rolls, state.point_contacts);
}

}  // namespace throng
