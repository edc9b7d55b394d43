// SPDX-License-Identifier: MIT
#include "sim/contact/pressed.h"

#include "sim/contact/contact_key.h"

namespace throng {

void find_pressed(const State& state, const Colliders& colliders, std::vector<std::uint8_t>& pressed) {
  pressed.assign(state.position.size(), 0);
  const auto press = [&](std::uint32_t collider) {
    if (collider < colliders.body.size()) pressed[colliders.body[collider]] = 1;  // else a checkpoint's alone
  };
  for (const auto* contacts : {&state.disc_contacts, &state.point_contacts})
    for (const ContactImpulse& contact : *contacts) {
      const auto [a, b] = pair_of(contact.key);
      press(a);
      if (!is_of_obstacle(contact.key)) press(b);
    }
}

}  // namespace throng
