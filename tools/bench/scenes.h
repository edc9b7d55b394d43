// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "sim/scene.h"
#include "sim/state.h"

namespace throng::bench {

/// A scene of the gallery, with overrides. Throws InputError where it doesn't load.
Scene gallery_scene(const std::string& folder, const std::string& name,
                    const std::vector<std::string>& overrides = {});

/// The same scene, begun where the state is.
Scene begun_at(Scene scene, const State& state);

/// The same scene, begun where the native engine has brought it after `seconds`.
Scene settled(Scene scene, double seconds);

}  // namespace throng::bench
