// SPDX-License-Identifier: MIT
#pragma once

#include "sim/plan.h"
#include "sim/scene.h"
#include "sim/state.h"
#include "sim/workspace.h"

/// The native fixed-step loop.
namespace throng {

/// Advances `state` by dt. Allocates nothing once its buffers have grown. Semi-implicit Euler in substeps, of
/// first order where contacts press; who falls freely, rolls or slides straight on (FreeFall), or bounces
/// alone (lone_bounce.h) is where he should be but for rounding, unless under guard; discs that keep all
/// energy and that nothing pulls fly and collide exactly; discs whose contacts are soft go by Verlet's
/// method, of second order; agents walk dt at once. A step in which somebody may have got through a wall or
/// another is taken again, under guard (see Guard), and one in which bodies got farther than pairs were
/// looked for is, too. Throws SimulationError where a body is no longer at a finite place, where so much
/// happens within dt that contacts might be missed, and as `Candidates::find`; `state` is then that of the
/// step's beginning, but where a place isn't finite.
void step(const Scene& scene, const Plan& plan, State& state, Workspace& workspace);

}  // namespace throng
