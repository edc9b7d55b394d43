// SPDX-License-Identifier: MIT
#pragma once

#include "sim/contact/find_contacts.h"

namespace throng {

/// Adds to `contacts` what those between surfaces that resist rolling have beside pressing and rubbing, with
/// the impulses of the step before; bounces get their levers. O(contacts); nobody's business where no surface
/// resists.
void find_rolls(const Scene& scene, const Plan& plan, const Candidates& candidates, const State& state,
                std::span<const SolverBody> bodies, Contacts& contacts);

/// Writes their impulses to the contacts kept, which are those that press, in their order.
template <class Blocks>
void save_rolls(const Blocks& contacts, std::span<const RollContact> rolls, std::span<ContactImpulse> kept) {
  std::uint32_t contact = 0;
  std::size_t row = 0;
  for (const RollContact& roll : rolls) {
    for (; contact < roll.contact; ++contact) row += contacts.normal_impulse(contact) > 0.0;
    if (contacts.normal_impulse(contact) > 0.0) kept[row].rolling = roll.impulse;
  }
}

}  // namespace throng
