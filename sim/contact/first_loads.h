// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "sim/contact/find_contacts.h"
#include "sim/workers.h"

/// The loads that a run begins with.
namespace throng {

/// Gives each contact as preload and impulse what it bears where all that touches stands still under gravity:
/// what was stacked then doesn't sink until its springs bear it, nor shake. Gauss and Seidel's sweeps of rigid
/// contacts (Moreau 1988) from `kick` on, the velocity that gravity gives in a substep, until from one to the
/// other of every `kLoadSweeps` the sum of all loads changes by no more than 1e-4 of it: some 0.75 n^2 sweeps
/// where n layers stand on one another, at most `kMostLoadSweeps` of them, after which loads of what is still
/// higher are too small. Leaves bodies as they are, but for the rows of obstacles.
void find_first_loads(Contacts& contacts, const Parts& parts, std::span<SolverBody> bodies,
                      const SolverSettings& settings, const Vec& kick, const Vec* period, Workers& workers);

inline constexpr int kLoadSweeps = 64, kMostLoadSweeps = 8192;

}  // namespace throng
