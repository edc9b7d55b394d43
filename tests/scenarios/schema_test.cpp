// SPDX-License-Identifier: MIT
#include "scenarios/schema.h"

#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "scenarios/grammar.h"
#include "tests/scenarios/scenario_texts.h"

namespace throng::scenarios {

TEST(Schema, IsWhatTheCheckedInFileSays) {
  std::ifstream file(THRONG_SOURCE_DIR "/scenarios/scenario.schema.json");
  std::stringstream text;
  text << file.rdbuf();
  EXPECT_EQ(text.str(), schema()) << "run: throng validate --schema > scenarios/scenario.schema.json";
}

namespace {

void collect_presets(const Table& table, const std::string& path, std::vector<std::string>& overrides) {
  for (const Field& field : table.fields) {
    if (!field.preset.empty()) overrides.push_back(path + field.key + "=" + field.preset);
    if (field.type.kind == Type::Kind::table && field.type.table)
      collect_presets(*field.type.table, path + field.key + ".", overrides);
  }
}

}  // namespace

// What the table says a field is when absent must be what the code makes of an absent field.
TEST(Grammar, SaysWhatAbsentFieldsAre) {
  std::vector<std::string> overrides;
  collect_presets(grammar(), "", overrides);
  EXPECT_GE(overrides.size(), 12u);
  const Loaded loaded = testing::load_text("throng = 1\n", overrides),
               plain = testing::load_text("throng = 1\n");
  ASSERT_EQ(testing::faults(loaded), "");
  EXPECT_EQ(loaded.scene.seed, plain.scene.seed);
  EXPECT_EQ(loaded.scene.engine, plain.scene.engine);
  EXPECT_EQ(loaded.scene.gravity, plain.scene.gravity);
  EXPECT_EQ(loaded.scene.sleep, plain.scene.sleep);
  EXPECT_EQ(loaded.scene.time.dt, plain.scene.time.dt);
  EXPECT_EQ(loaded.scene.time.until, plain.scene.time.until);
  EXPECT_EQ(loaded.scene.time.substeps, plain.scene.time.substeps);
  EXPECT_EQ(loaded.scene.contact, plain.scene.contact);
  EXPECT_EQ(loaded.scene.record.every, plain.scene.record.every);
  EXPECT_EQ(loaded.scene.record.spin, plain.scene.record.spin);
  EXPECT_EQ(loaded.scene.record.velocity, plain.scene.record.velocity);
  EXPECT_EQ(loaded.scene.record.single, plain.scene.record.single);
}

}  // namespace throng::scenarios
