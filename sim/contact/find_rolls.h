// SPDX-License-Identifier: MIT
#pragma once

#include "sim/contact/body_rows.h"
#include "sim/contact/candidates.h"
#include "sim/contact/contacts.h"
#include "sim/plan.h"
#include "sim/scene.h"
#include "sim/state.h"

namespace throng {

/// Adds to `contacts` what those between surfaces that resist rolling have beside pressing and rubbing, with
/// the impulses of the step before; bounces get their levers. O(contacts); nobody's business where no surface
/// resists.
void find_rolls(const Scene& scene, const Plan& plan, const Candidates& candidates, const State& state,
                BodyRows<const SolverBody> bodies, Contacts& contacts);

}  // namespace throng
