// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "sim/contact/body_rows.h"
#include "sim/contact/contacts.h"
#include "sim/contact/step_impulses.h"
#include "sim/contact_row.h"
#include "sim/scene.h"
#include "sim/state.h"

namespace throng {

/// Replaces `rows` by the contacts of the step that has just ended, in the solver's order: without `impulses`
/// those that press at its end, which `Contacts::save` keeps, each substep's taken for the last one's; with
/// them all that pressed or were struck in it, that much, and then what struck without a contact. `bodies`:
/// as that step left them, the obstacles last. O(contacts); allocates only to grow.
void list_contacts(const Scene& scene, const Contacts& contacts, const StepImpulses* impulses,
                   const State& state, BodyRows<const SolverBody> bodies, std::vector<ContactRow>& rows);

/// Leaves of those rows the ones of bodies that are awake, and adds the contacts that sleep.
void with_sleeping(const Scene& scene, const State& state, std::vector<ContactRow>& rows);

}  // namespace throng
