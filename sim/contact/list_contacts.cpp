// SPDX-License-Identifier: MIT
#include "sim/contact/list_contacts.h"

#include <span>

#include "sim/periodic.h"

namespace throng {

namespace {

Vec place(const DiscContact& contact, BodyRows<const SolverBody> bodies, double) {
  return bodies[contact.a].position + contact.radius_a * contact.normal;
}

/// On the surface of who yields: a face that is driven may be felt elsewhere. Arms are as the last substep
/// (of h, s) began.
Vec place(const PointContact& contact, BodyRows<const SolverBody> bodies, double h) {
  const bool of_a = bodies[contact.a].inverse_mass > 0.0;
  const SolverBody& body = bodies[of_a ? contact.a : contact.b];
  const Vec round = of_a ? Vec(contact.round_a * contact.normal) : Vec(-contact.round_b * contact.normal);
  const Vec turning = (of_a ? contact.arm_a : contact.arm_b) - round;
  return body.position + Turn(h * body.spin)(turning) + round;
}

}  // namespace

void list_contacts(const Scene& scene, const Contacts& contacts, const StepImpulses* impulses,
                   const State& state, BodyRows<const SolverBody> bodies, std::vector<ContactRow>& rows) {
  rows.clear();
  const double h = scene.time.dt / scene.time.substeps;
  const auto add = [&](const auto& contact, double impulse, const Vec* struck_at) {
    const bool presses = contact.normal_impulse > 0.0;
    if (!presses && !(impulse > 0.0)) return;
    const Vec point = presses || !struck_at ? place(contact, bodies, h) : *struck_at;
    rows.push_back({state.id[contact.a], contact.b < state.id.size() ? state.id[contact.b] : 0, impulse,
                    scene.domain.kind == DomainKind::periodic ? wrapped(point, scene.domain) : point,
                    presses});
  };
  const auto add_last = [&](const auto& all) {
    for (std::size_t i = 0; i < all.size(); ++i)
      add(all[i], all.normal_impulse(i) * scene.time.substeps, nullptr);
  };
  const auto add_sums = [&](const auto& all, const std::vector<double>& sums,
                            std::span<const StruckContact> struck) {
    for (std::size_t i = 0; i < all.size(); ++i) {
      const bool is_struck = !struck.empty() && struck[0].row == i;
      add(all[i], sums[i], is_struck ? &struck[0].at : nullptr);
      if (is_struck) struck = struck.subspan(1);
    }
  };
  if (!impulses) return add_last(contacts.discs), add_last(contacts.faces);
  add_sums(contacts.discs, impulses->discs, impulses->struck_discs);
  add_sums(contacts.faces, impulses->faces, impulses->struck_faces);
  rows.insert(rows.end(), impulses->strikes.begin(), impulses->strikes.end());
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
