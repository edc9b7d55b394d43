// SPDX-License-Identifier: MIT
#include "sim/contact/list_contacts.h"

#include <span>

#include "sim/contact/arms.h"
#include "sim/periodic.h"

namespace throng {

namespace {

/// Makes rows of contacts, and of their impulses.
class ContactLister {
 public:
  ContactLister(const Scene& scene, const State& state, BodyRows<const SolverBody> bodies,
                std::vector<ContactRow>& rows)
      : scene_(scene), state_(state), bodies_(bodies), rows_(rows) {}

  /// Those that press, as in the last substep in all.
  template <class Blocks>
  void add_last(const Blocks& contacts) {
    const double h = scene_.time.dt / scene_.time.substeps;
    for (std::size_t i = 0; i < contacts.size(); ++i) {
      if (!(contacts.normal_impulse(i) > 0.0)) continue;
      const auto contact = contacts[i];
      add(contact, contact.normal_impulse * scene_.time.substeps,
          place(contact, bodies_[contact.a], bodies_[contact.b], h));
    }
  }

  template <class Blocks>
  void add_sums(const Blocks& contacts, std::span<const StepImpulses::Sum> sums) {
    for (std::size_t i = 0; i < contacts.size(); ++i)
      if (sums[i].impulse > 0.0) add(contacts[i], sums[i].impulse, sums[i].at);
  }

 private:
  void add(const ContactBase& contact, double impulse, const Vec& point) {
    const std::uint32_t b = contact.b < state_.id.size() ? state_.id[contact.b] : 0;
    rows_.push_back({state_.id[contact.a], b, impulse,
                     scene_.domain.kind == DomainKind::periodic ? wrapped(point, scene_.domain) : point,
                     contact.normal_impulse > 0.0});
  }

  const Scene& scene_;
  const State& state_;
  BodyRows<const SolverBody> bodies_;
  std::vector<ContactRow>& rows_;
};

}  // namespace

void list_contacts(const Scene& scene, const Contacts& contacts, const StepImpulses* impulses,
                   const State& state, BodyRows<const SolverBody> bodies, std::vector<ContactRow>& rows) {
  rows.clear();
  ContactLister list(scene, state, bodies, rows);
  if (!impulses) return list.add_last(contacts.discs), list.add_last(contacts.faces);
  list.add_sums(contacts.discs, impulses->discs());
  list.add_sums(contacts.faces, impulses->faces());
  rows.insert(rows.end(), impulses->strikes().begin(), impulses->strikes().end());
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
