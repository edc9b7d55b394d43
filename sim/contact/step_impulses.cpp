// SPDX-License-Identifier: MIT
#include "sim/contact/step_impulses.h"

namespace throng {

namespace {

template <class Blocks>
void add_pressing(const Blocks& contacts, std::vector<double>& sums) {
  for (std::size_t i = 0; i < sums.size(); ++i) sums[i] += contacts.normal_impulse(i);
}

template <class Contact>
void add_struck(const std::vector<Contact>& bounces, std::vector<double>& sums,
                std::vector<StruckContact>& struck) {
  for (const Contact& contact : bounces) {
    if (!(contact.struck_in_step > 0.0)) continue;
    sums[contact.row] += contact.struck_in_step;
    struck.push_back({contact.row, contact.struck_at});
  }
}

}  // namespace

void StepImpulses::start(const Contacts& contacts) {
  discs.assign(contacts.discs.size(), 0.0), faces.assign(contacts.faces.size(), 0.0);
  struck_discs.clear(), struck_faces.clear(), strikes.clear();
}

void StepImpulses::add(const Contacts& contacts) {
  add_pressing(contacts.discs, discs);
  add_pressing(contacts.faces, faces);
}

void StepImpulses::add_bounces(const Contacts& contacts) {
  add_struck(contacts.disc_bounces, discs, struck_discs);
  add_struck(contacts.point_bounces, faces, struck_faces);
}

}  // namespace throng
