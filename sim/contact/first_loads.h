// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "sim/contact/find_contacts.h"
#include "sim/workers.h"

/// The loads that a run begins with.
namespace throng {

/// Gives each contact as preload and impulse what it bears where all that touches stands still under gravity:
/// what was stacked then doesn't sink until its springs bear it, nor shake. Symmetric sweeps of rigid
/// contacts (Gauss and Seidel) from `kick` on, the velocity that gravity gives in a substep, accelerated as
/// in Mazhar, Heyn, Negrut and Tasora (2015), until one changes the impulses by no more than 1e-6 of them:
/// 280 for a pyramid of 100 rows, each as long as three sweeps of the step. After `kMostLoadRounds` loads are
/// taken as they are. What bears more than `Learning::kMost` own weights begins without. Leaves bodies as
/// they are.
void find_first_loads(Contacts& contacts, const Parts& parts, std::span<SolverBody> bodies,
                      const SolverSettings& settings, const Vec& kick, const Vec* period, Workers& workers);

inline constexpr int kMostLoadRounds = 2000;

}  // namespace throng
