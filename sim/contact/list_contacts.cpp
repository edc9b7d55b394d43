// SPDX-License-Identifier: MIT
#include "sim/contact/list_contacts.h"

#include "sim/periodic.h"

namespace throng {

namespace {

Vec arm(const DiscContact& contact) {
  return contact.radius_a * contact.normal;
}
Vec arm(const PointContact& contact) {
  return contact.arm_a;
}

}  // namespace

void list_contacts(const Scene& scene, const Contacts& contacts, const State& state,
                   BodyRows<const SolverBody> bodies, std::vector<ContactRow>& rows) {
  rows.clear();
  const auto add = [&](const auto& contact) {
    if (!(contact.normal_impulse > 0.0)) return;
    const Vec point = bodies[contact.a].position + arm(contact);
    rows.push_back({state.id[contact.a], contact.b < state.id.size() ? state.id[contact.b] : 0,
                    contact.normal_impulse * scene.time.substeps,
                    scene.domain.kind == DomainKind::periodic ? wrapped(point, scene.domain) : point});
  };
  for (std::size_t i = 0; i < contacts.discs.size(); ++i) add(contacts.discs[i]);
  for (std::size_t i = 0; i < contacts.faces.size(); ++i) add(contacts.faces[i]);
}

void with_sleeping(const Scene& scene, const State& state, std::vector<ContactRow>& rows) {
  const SleepState& sleep = state.sleep;
  const auto sleeps = [&](std::uint32_t id) { return id > 0 && sleep.island[id - 1] != 0; };
  std::erase_if(rows, [&](const ContactRow& row) { return sleeps(row.a) || sleeps(row.b); });
  for (const auto* contacts : {&sleep.disc_contacts, &sleep.point_contacts})
    for (const SleepingContact& one : *contacts)
      rows.push_back({one.a, one.b, one.impulse.normal * scene.time.substeps, one.point});
}

}  // namespace throng
