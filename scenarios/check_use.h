// SPDX-License-Identifier: MIT
#pragma once

#include <set>
#include <string>

#include "scenarios/report.h"
#include "scenarios/toml.h"
#include "sim/scene.h"

/// What of a file's names its other parts ask for.
namespace throng::scenarios {

/// Names of the areas where agents go, wait, or have their random places. Call it after `read_agents`.
std::set<std::string> areas_of_agents(const toml::table& root, const Scene& scene);

/// Warns of materials, shapes, areas and queues that nothing in the file asks for, in one line a table. Call
/// it last: there are warnings that matter more. Expects all in the scene.
void warn_of_unused(const toml::table& root, const Scene& scene, Report& report);

}  // namespace throng::scenarios
