// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>

#include <string>

#include "scenarios/load.h"
#include "sim/input_error.h"
#include "sim/simulation.h"

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

/// Why an engine doesn't take a scene, "" where it does.
inline std::string engine_refusal(Engine engine, const std::string& text) {
  Scene scene = scene_from(text);  // the loader would refuse it first
  scene.engine = engine;
  try {
    simulation(scene);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

}  // namespace throng
