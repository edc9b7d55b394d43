// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>

#include <string>

#include "scenarios/load.h"

namespace throng {

/// A scene from the text of a scenario, whose first line every scenario has in common.
inline Scene scene_from(const std::string& text) {
  Loaded loaded = load_scenario_text("throng = 1\n" + text, "test.toml");
  EXPECT_EQ(loaded.errors(), 0) << to_string(loaded.diagnostics, "test.toml");
  return std::move(loaded.scene);
}

/// A scene of the gallery.
inline Scene gallery_scene(const std::string& name) {
  const std::string file = THRONG_SOURCE_DIR "/scenarios/" + name + ".toml";
  Loaded loaded = load_scenario(file);
  EXPECT_EQ(loaded.errors(), 0) << to_string(loaded.diagnostics, file);
  return std::move(loaded.scene);
}

}  // namespace throng
