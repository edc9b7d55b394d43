// SPDX-License-Identifier: MIT
#include "sim/contact/pressed.h"

#include "sim/contact/contact_key.h"

namespace throng {

namespace {

/// Whether f(body) is true of one that a contact pressed, in their order.
template <class F>
bool any_pressed(const State& state, const Colliders& colliders, F f) {
  const auto is_one = [&](std::uint32_t collider) {
    return collider < colliders.body.size() && f(colliders.body[collider]);  // else a checkpoint's alone
  };
  for (const auto* contacts : {&state.disc_contacts, &state.point_contacts})
    for (const ContactImpulse& contact : *contacts) {
      const auto [a, b] = pair_of(contact.key);
      if (is_one(a) || (!is_of_obstacle(contact.key) && is_one(b))) return true;
    }
  return false;
}

}  // namespace

void find_pressed(const State& state, const Colliders& colliders, std::vector<std::uint8_t>& pressed) {
  pressed.assign(state.position.size(), 0);
  any_pressed(state, colliders, [&](std::uint32_t body) { return pressed[body] = 1, false; });
}

bool is_pressed(const State& state, const Colliders& colliders, std::uint32_t body) {
  return any_pressed(state, colliders, [&](std::uint32_t pressed) { return pressed == body; });
}

}  // namespace throng
