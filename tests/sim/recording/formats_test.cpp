// SPDX-License-Identifier: MIT
// Recordings are read by other people's tools.
#include <gtest/gtest.h>

#include <cstdio>

#include "tests/sim/recording/scenes.h"

namespace throng {
namespace {

using namespace testing_recordings;

/// What a command prints, and its exit code.
std::pair<std::string, int> output_of(const std::string& command) {
  FILE* pipe = popen((command + " 2>&1").c_str(), "r");
  std::string text;
  for (int c; (c = std::fgetc(pipe)) != EOF;) text += static_cast<char>(c);
  return {text, pclose(pipe)};
}

TEST(Formats, H5pyFindsWhatTheReadersOfH5mdExpect) {
  const Folder folder;
  const Scene scene = mixed_scene(10);
  record_drift(folder / "a.h5", scene, 5);
  const auto [text, code] = output_of(
      "/usr/bin/python3 " THRONG_SOURCE_DIR "/tests/sim/recording/read_h5md.py " + (folder / "a.h5"));
  ASSERT_EQ(code, 0) << text;
  EXPECT_EQ(text.substr(0, provenance().scenario.size()), provenance().scenario);
  const State state = state_at(scene, 2);
  double position = 0, angle = 0;
  char name[100] = "";
  ASSERT_EQ(
      std::sscanf(text.c_str() + provenance().scenario.size(), "%lf %lf %99[^\n]", &position, &angle, name),
      3);
  EXPECT_EQ(position, state.position[7].y());
  EXPECT_EQ(angle, state.angle[7]);
  EXPECT_EQ(name, scene.name);
}

TEST(Formats, H5dumpReadsAllOfIt) {
  const Folder folder;
  record_drift(folder / "a.h5", mixed_scene(10), 5);
  const auto [text, code] = output_of("h5dump " + (folder / "a.h5"));
  EXPECT_EQ(code, 0) << text;
  EXPECT_NE(text.find("GROUP \"trajectory\""), std::string::npos);
  EXPECT_EQ(text.find("unable"), std::string::npos);
}

}  // namespace
}  // namespace throng
