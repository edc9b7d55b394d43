// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "scenarios/report.h"

namespace throng::scenarios {

/// Applies one "PATH=VALUE" to the tree: `time.dt=0.005`, `bodies[0].velocity=[1, 0]` or
/// `bodies.0.velocity=[1, 0]`, `shapes."my ball".disc.radius=1`. The value is one of TOML; what is none
/// counts as a string, so `engine=box2d` does. Tables on the way are made where they are absent, entries of
/// lists are not. The new nodes' source is the override. What can't be applied is reported.
void apply_override(toml::table& root, const std::string& override_, Report& report);

}  // namespace throng::scenarios
