// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

#include "sim/plan.h"
#include "sim/rows.h"
#include "sim/scene.h"
#include "sim/state.h"
#include "sim/workspace.h"

/// What a step of rigid bodies does so many times.
namespace throng {

/// How a substep runs.
struct SubstepWay {
  bool backward;  ///< pushes apart from each part's last contact on, and relaxes from its first; else the
                  ///< other way
  bool guarded;   ///< nobody gets through another or a wall, however fast
};

/// Takes `work.bodies` on by a substep: bounce, fall, push apart, move, relax, land. `state`
/// is that of the step's beginning.
void substep(const Scene& scene, const Plan& plan, const State& state, Workspace& work, SubstepWay way);

/// The bodies of a part that are awake.
inline Rows rows_of(const Workspace& work, std::size_t part) {
  const Parts& parts = work.finder.parts();
  return parts.count() == 1 ? work.sleepers.bodies() : parts.rows(part);
}

/// Calls f(rows) with the bodies of each part, by the thread that solves the contacts of the part: it has the
/// bodies at hand.
template <class F>
void by_parts(Workspace& work, F f) {
  work.workers.for_few(work.finder.parts().count(), [&](std::size_t part) { f(rows_of(work, part)); });
}

}  // namespace throng
