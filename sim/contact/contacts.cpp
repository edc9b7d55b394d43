// SPDX-License-Identifier: MIT
#include "sim/contact/contacts.h"

#include <array>

#include "sim/contact/find_rolls.h"

namespace throng {

namespace {

constexpr std::size_t kParts = 8;  // of a list that several threads go through twice: count, then write

/// Replaces `kept` by write(i) of all contacts that press, in their order.
template <class Blocks, class F>
void keep_pressing(const Grouped<Blocks>& contacts, std::vector<ContactImpulse>& kept, Workers& workers,
                   F write) {
  const auto for_pressing = [&](std::size_t part, std::size_t parts, auto f) {
    const std::size_t n = contacts.size();
    for (std::size_t i = n * part / parts; i < n * (part + 1) / parts; ++i)
      if (contacts.normal_impulse(i) > 0.0) f(i);
  };
  if (!workers.share(contacts.size())) {
    kept.clear();
    return for_pressing(0, 1, [&](std::size_t i) { kept.push_back(write(i)); });
  }
  std::array<std::size_t, kParts + 1> first{};
  workers.for_each(kParts, [&](std::size_t part) {
    std::size_t count = 0;
    for_pressing(part, kParts, [&](std::size_t) { ++count; });
    first[part + 1] = count;
  });
  for (std::size_t part = 0; part < kParts; ++part) first[part + 1] += first[part];
  kept.resize(first.back());
  workers.for_each(kParts, [&](std::size_t part) {
    std::size_t next = first[part];
    for_pressing(part, kParts, [&](std::size_t i) { kept[next++] = write(i); });
  });
}

}  // namespace

void Contacts::clear() {
  discs.clear(), disc_key.clear(), disc_bounces.clear(), disc_rolls.clear();
  faces.clear(), point_key.clear(), point_feature.clear(), point_bounces.clear(), point_rolls.clear();
}

void Contacts::save(State& state, Workers& workers) const {
  keep_pressing(discs, state.disc_contacts, workers, [&](std::size_t i) {
    return ContactImpulse{disc_key[i], 0, discs.normal_impulse(i), discs.tangent_impulse(i)};
  });
  keep_pressing(faces, state.point_contacts, workers, [&](std::size_t i) {
    return ContactImpulse{point_key[i], point_feature[i], faces.normal_impulse(i), faces.tangent_impulse(i)};
  });
  save_rolls(discs, disc_rolls, state.disc_contacts);
  save_rolls(faces, point_rolls, state.point_contacts);
}

}  // namespace throng
