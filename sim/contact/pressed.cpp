// SPDX-License-Identifier: MIT
#include "sim/contact/pressed.h"

#include "sim/contact/contact_key.h"

namespace throng {

namespace {

/// Calls f(body) for who was pressed, by each contact.
template <class F>
void for_each_pressed(const State& state, const Colliders& colliders, F f) {
  const auto tell = [&](std::uint32_t collider) {
    if (collider < colliders.body.size()) f(colliders.body[collider]);  // else a checkpoint's alone
  };
  for (const auto* contacts : {&state.disc_contacts, &state.point_contacts})
    for (const ContactImpulse& contact : *contacts) {
      const auto [a, b] = pair_of(contact.key);
      tell(a);
      if (!is_of_obstacle(contact.key)) tell(b);
    }
}

}  // namespace

void find_pressed(const State& state, const Colliders& colliders, std::vector<std::uint8_t>& pressed) {
  pressed.assign(state.position.size(), 0);
  for_each_pressed(state, colliders, [&](std::uint32_t body) { pressed[body] = 1; });
}

bool are_pressed(const State& state, const Colliders& colliders, std::uint32_t one, std::uint32_t two) {
  bool is_one = false, is_two = false;
  for_each_pressed(state, colliders,
                   [&](std::uint32_t body) { is_one |= body == one, is_two |= body == two; });
  return is_one && is_two;
}

}  // namespace throng
