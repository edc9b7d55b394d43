// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <filesystem>
#include <map>

#include "tests/scenarios/same_scene.h"
#include "tests/scenarios/scenario_texts.h"

namespace throng {

namespace {

const std::map<std::string, std::size_t> kBodies = {
    {"billiard", 16},   {"bottleneck", 100},  {"circle_swap", 16}, {"corridor", 60},    {"cradle", 5},
    {"crossing", 160},  {"counterflow", 180}, {"drum", 781},       {"evacuation", 500}, {"gas", 1'000},
    {"gears", 1'203},   {"hopper", 2'500},    {"mixed", 632},      {"pile", 10'000},    {"polygons", 10'000},
    {"pyramid", 5'050}, {"stadium", 100'000}, {"station", 10'000}};

std::string file(const std::string& name) {
  return THRONG_SOURCE_DIR "/scenarios/" + name + ".toml";
}

}  // namespace

TEST(Gallery, IsCompleteAndEveryFileIsKnownHere) {
  std::size_t files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(THRONG_SOURCE_DIR "/scenarios")) {
    if (entry.path().extension() != ".toml") continue;
    ++files;
    EXPECT_TRUE(kBodies.contains(entry.path().stem().string())) << entry.path();
  }
  EXPECT_EQ(files, kBodies.size());
}

TEST(Gallery, LoadsWithoutAWarning) {
  for (const auto& [name, bodies] : kBodies) {
    const Loaded loaded = load_scenario(file(name));
    EXPECT_EQ(to_string(loaded.diagnostics, name), "");
    EXPECT_EQ(loaded.scene.bodies.size(), bodies) << name;
    EXPECT_EQ(loaded.scene.name, name);
    EXPECT_FALSE(loaded.scene.description.empty()) << name;
    EXPECT_GT(loaded.scene.time.steps(), 0) << name;
  }
}

// It happened: ring.toml's goals, a tenth of which is walkable by design, were warned of.
TEST(Gallery, BenchmarksValidateByScenesWithoutAWarning) {
  std::size_t files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(THRONG_SOURCE_DIR "/tools/bench/validation")) {
    if (entry.path().extension() != ".toml") continue;
    ++files;
    const Loaded loaded = load_scenario(entry.path().string());
    EXPECT_EQ(to_string(loaded.diagnostics, entry.path().string()), "");
  }
  EXPECT_GT(files, 15u);
}

TEST(Gallery, ResolvesToTheSameScenes) {
  for (const auto& [name, bodies] : kBodies) {
    SCOPED_TRACE(name);
    const Loaded loaded = load_scenario(file(name));
    const Loaded again = load_scenario_text(loaded.resolved, name);
    testing::expect_same(loaded.scene, again.scene);
    EXPECT_EQ(loaded.resolved, again.resolved);
  }
}

}  // namespace throng
