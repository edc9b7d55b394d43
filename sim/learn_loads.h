// SPDX-License-Identifier: MIT
#pragma once

#include "sim/plan.h"
#include "sim/scene.h"
#include "sim/state.h"
#include "sim/workspace.h"

/// What contacts learn of what they bear, round the substeps of a step: see Learning.
namespace throng {

/// Before the substeps: decides how contacts learn whose bodies stand as high as now, and gives them their
/// first loads as a run begins. Expects gravity, and contacts that were found.
void prepare_to_learn(const Scene& scene, const Plan& plan, const State& state, Workspace& work);

/// After them.
void learn_loads(Workspace& work);

}  // namespace throng
