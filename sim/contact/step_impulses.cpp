// SPDX-License-Identifier: MIT
#include "sim/contact/step_impulses.h"

#include "sim/contact/arms.h"

namespace throng {

namespace {

template <class Blocks>
void add_if_pressing(const Blocks& contacts, std::size_t i, BodyRows<const SolverBody> bodies, double h,
                     StepImpulses::Sum& sum) {
  if (!(contacts.normal_impulse(i) > 0.0)) return;
  const auto contact = contacts[i];
  sum.impulse += contact.normal_impulse;
  sum.at = place(contact, bodies[contact.a], bodies[contact.b], h);
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
  for (std::size_t i = 0; i < discs_.size(); ++i) add_if_pressing(contacts.discs, i, bodies, h, discs_[i]);
  for (std::size_t i = 0; i < faces_.size(); ++i) add_if_pressing(contacts.faces, i, bodies, h, faces_[i]);
}

void StepImpulses::add_face(std::size_t i, const Contacts& contacts, BodyRows<const SolverBody> bodies,
                            double h) {
  add_if_pressing(contacts.faces, i, bodies, h, faces_[i]);
}

void StepImpulses::add_bounces(const Contacts& contacts) {
  add_struck(contacts.discs, contacts.disc_bounces, discs_);
  add_struck(contacts.faces, contacts.point_bounces, faces_);
}

}  // namespace throng
