// SPDX-License-Identifier: MIT
#pragma once

#include "tools/bench/accuracy/judge.h"

/// What is exact where no formula is: a run of another engine, or of shorter steps.
namespace throng::bench {

/// Runs the scene as it is to its end and keeps all bodies at the times k * every (s), of which dt is a
/// divisor. Memory: bodies times samples.
Truth recorded_truth(Scene scene, double every);

/// The root mean square distance of two truths of one scene at its end, in radii of the bodies.
double difference(const Scene& scene, const Truth& a, const Truth& b);

}  // namespace throng::bench
