// SPDX-License-Identifier: MIT
#include "sim/contact/list_contacts.h"

#include "sim/periodic.h"

namespace throng {

namespace {

Vec place(const DiscContact& contact, BodyRows<const SolverBody> bodies) {
  return bodies[contact.a].position + contact.radius_a * contact.normal;
}

/// On the surface of who yields: a face that is driven may be felt elsewhere.
Vec place(const PointContact& contact, BodyRows<const SolverBody> bodies) {
  const bool yields_a = bodies[contact.a].inverse_mass > 0.0;
  return yields_a ? bodies[contact.a].position + contact.arm_a : bodies[contact.b].position + contact.arm_b;
}

}  // namespace

void list_contacts(const Scene& scene, const Contacts& contacts, const StepImpulses* impulses,
                   const State& state, BodyRows<const SolverBody> bodies, std::vector<ContactRow>& rows) {
  rows.clear();
  const auto add = [&](const auto& contact, const double* sum) {
    const double impulse = sum ? *sum : contact.normal_impulse * scene.time.substeps;
    const bool presses = contact.normal_impulse > 0.0;
    if (!presses && !(impulse > 0.0)) return;
    const Vec point = place(contact, bodies);
    rows.push_back({state.id[contact.a], contact.b < state.id.size() ? state.id[contact.b] : 0, impulse,
                    scene.domain.kind == DomainKind::periodic ? wrapped(point, scene.domain) : point,
                    presses});
  };
  for (std::size_t i = 0; i < contacts.discs.size(); ++i)
    add(contacts.discs[i], impulses ? &impulses->discs[i] : nullptr);
  for (std::size_t i = 0; i < contacts.faces.size(); ++i)
    add(contacts.faces[i], impulses ? &impulses->faces[i] : nullptr);
  if (impulses) rows.insert(rows.end(), impulses->strikes.begin(), impulses->strikes.end());
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
