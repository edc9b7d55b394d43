// SPDX-License-Identifier: MIT
#pragma once

#include "sim/scene.h"

/// What can be told of a scene's rest before it runs.
namespace throng {

/// How many times the weight of the lightest body others bear, by the mean over all of the floor under the
/// bodies: their weight is spread over their width, or that of the box. Expects some dynamic bodies, and
/// gravity. O(bodies).
double mean_load(const Scene& scene);

/// Whether all dynamic bodies are at rest, and touch others or obstacles in as many places as there are
/// bodies, neither apart nor overlapping by more than a few billionths of the smallest radius: as those that
/// stand on one another do, and bear their loads as a run begins (sim/contact/first_loads.h). O(bodies and
/// pairs).
bool touch_at_rest(const Scene& scene);

/// Whether bodies that touch at rest stay there, but for what is allowed (m): none of them begins to gain
/// speed steadily, as what slides, rolls or falls apart does, at a rate that would take it farther within the
/// run. Finds the first loads and takes 64 short steps.
bool stay(const Scene& scene, double allowed);

}  // namespace throng
