// SPDX-License-Identifier: MIT
#include "sim/contact/step_impulses.h"

#include "sim/contact/arms.h"

namespace throng {

namespace {

template <class Blocks>
void add_pressing(const Blocks& contacts, BodyRows<const SolverBody> bodies, double h,
                  std::vector<StepImpulses::Sum>& sums) {
  for (std::size_t i = 0; i < sums.size(); ++i) {
    if (!(contacts.normal_impulse(i) > 0.0)) continue;
    const auto contact = contacts[i];
    sums[i].impulse += contact.normal_impulse;
    sums[i].at = place(contact, bodies[contact.a], bodies[contact.b], h);
  }
}

/// What is struck and presses by the end is told where it presses.
template <class Blocks, class Contact>
void add_struck(const Blocks& contacts, const std::vector<Contact>& bounces,
                std::vector<StepImpulses::Sum>& sums) {
  for (const Contact& contact : bounces) {
    if (!(contact.struck_in_step > 0.0)) continue;
    StepImpulses::Sum& sum = sums[contact.row];
    sum.impulse += contact.struck_in_step;
    if (!(contacts.normal_impulse(contact.row) > 0.0)) sum.at = contact.struck_at;
  }
}

}  // namespace

void StepImpulses::start(const Contacts& contacts) {
  discs_.assign(contacts.discs.size(), {}), faces_.assign(contacts.faces.size(), {});
  strikes_.clear();
}

void StepImpulses::add(const Contacts& contacts, BodyRows<const SolverBody> bodies, double h) {
  add_pressing(contacts.discs, bodies, h, discs_);
  add_pressing(contacts.faces, bodies, h, faces_);
}

void StepImpulses::add_bounces(const Contacts& contacts) {
  add_struck(contacts.discs, contacts.disc_bounces, discs_);
  add_struck(contacts.faces, contacts.point_bounces, faces_);
}

}  // namespace throng
