// SPDX-License-Identifier: MIT
#pragma once

#include "sim/contact/body_rows.h"
#include "sim/contact/contacts.h"
#include "sim/contact/parts.h"
#include "sim/contact/solve.h"
#include "sim/workers.h"

/// The loads that a run begins with.
namespace throng {

/// Gives each contact of two bodies at rest as preload and impulse what it bears where all that touches
/// stands still under gravity: what was stacked then doesn't sink until its springs bear it, nor shake.
/// Sweeps of rigid contacts (Gauss and Seidel) from one end and back, from `kick` on, the velocity that
/// gravity gives in a substep; accelerated as in Mazhar, Heyn, Negrut and Tasora (2015), until two change the
/// impulses by no more than 1e-6 of them: 280 times for a pyramid of 100 rows, each as long as three sweeps
/// of the step, 2,000 times at most. What bears more than `Learning::most` own weights begins without. All
/// of a load is taken, where Learning leaves some to springs: what is given here balances. Leaves bodies as
/// they are.
void find_first_loads(Contacts& contacts, const Parts& parts, BodyRows<SolverBody> bodies,
                      const SolverSettings& settings, const Vec& kick, const Vec* period, Workers& workers);

}  // namespace throng
