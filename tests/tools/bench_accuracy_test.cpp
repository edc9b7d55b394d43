// SPDX-License-Identifier: MIT
// throng bench accuracy: errors and orders are pinned, times are for people.
#include <gmock/gmock.h>

#include <map>
#include <nlohmann/json.hpp>

#include "tests/tools/program.h"

namespace throng {
namespace {

using Rows = std::vector<nlohmann::json>;  // their `error`

class BenchAccuracy : public Program {
 protected:
  /// The rows of each case and engine, in the order of the file.
  std::map<std::string, std::map<std::string, Rows>> rows_of(const std::string& arguments) {
    const Result result = throng("bench accuracy --blocks 1 " + arguments + " --json " + path("rows.json"));
    EXPECT_EQ(result.exit_code, 0) << result.err;
    std::map<std::string, std::map<std::string, Rows>> rows;
    for (const auto& row : nlohmann::json::parse(read(path("rows.json")))) {
      rows[row["case"]][row["engine"]].push_back(row["error"]);
      EXPECT_TRUE(row["error"]["error"].is_null() || row["ms"] > 0.0) << row;
    }
    return rows;
  }

  static double worst(const Rows& rows) {
    double worst = 0.0;
    for (const auto& row : rows) worst = std::max(worst, row["error"].get<double>());
    return worst;
  }

  static double order(const Rows& rows) {
    EXPECT_TRUE(!rows.empty() && rows[0]["order"].is_number());
    return rows.empty() || !rows[0]["order"].is_number() ? 0.0 : rows[0]["order"].get<double>();
  }
};

TEST_F(BenchAccuracy, PlaysEverySceneAndSaysWhyWhereAnEngineCant) {
  auto rows = rows_of("--quick");
  EXPECT_GE(rows.size(), 12u);
  for (const auto& [name, engines] : rows) {
    EXPECT_TRUE(engines.contains("native")) << name;
    for (const auto& row : engines.at("native")) EXPECT_TRUE(row["error"].is_number()) << name << ": " << row;
    if (name == "distances to a tolerance") continue;  // of outlines, which Box2D doesn't have
    ASSERT_TRUE(engines.contains("box2d")) << name;
    for (const auto& row : engines.at("box2d")) EXPECT_TRUE(row.contains("peer")) << name;
  }
  for (const auto& row : rows["spring and dashpot"]["chipmunk"])
    EXPECT_TRUE(row["error"].is_null()) << "its bodies are hard, and have no error there";
  EXPECT_FALSE(rows["gas, collision rate"].contains("spring")) << "who is in contact for more than a step";
  EXPECT_TRUE(rows["gas, speeds"].contains("spring"));
  const auto& refused = rows["slide to rest"]["event_driven"];
  ASSERT_EQ(refused.size(), 1u);
  EXPECT_TRUE(refused[0]["error"].is_null());
  EXPECT_THAT(refused[0]["note"].get<std::string>(), ::testing::HasSubstr("isn't a disc"));
}

TEST_F(BenchAccuracy, AsksForDistancesToATolerance) {
  const Rows native = rows_of("--quick --only tolerance")["distances to a tolerance"]["native"];
  ASSERT_EQ(native.size(), 5u);
  for (const auto& row : native) {
    const std::string setting = row["setting"];
    EXPECT_LE(row["error"], std::stod(setting.substr(2))) << setting;
  }
  EXPECT_GT(worst(native), 0.01) << "what it may be off it is";
}

TEST_F(BenchAccuracy, NamesTheEnginesWhereItIsAskedForNone) {
  const Result result = throng("bench accuracy --quick --engine nope");
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_THAT(result.err, ::testing::HasSubstr("--engine nope: is none; engines are native, "));
}

TEST_F(BenchAccuracy, SaysWhichBenchmarksThereAreAsAllCommandsSayIt) {
  const Result result = throng("bench nope");
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_THAT(result.err,
              ::testing::MatchesRegex("throng bench: NAME: nope not in .*; see throng bench --help\n"));
}

TEST_F(BenchAccuracy, FindsNoErrorWhereCollisionsAreSolvedInClosedForm) {
  auto rows = rows_of(
      "--quick --engine native --engine event_driven --only flight --only throw --only impact "
      "--only cradle --only illiard --only '1 mean free time'");
  for (const char* name :
       {"throw", "impact", "cradle", "billiard", "Sinai billiard", "gas, 1 mean free time"})
    EXPECT_LT(worst(rows[name]["event_driven"]), 1e-9) << name;
  for (const char* name :
       {"flight", "throw", "impact", "cradle", "billiard", "Sinai billiard", "gas, 1 mean free time"})
    EXPECT_LT(worst(rows[name]["native"]), 1e-9) << name << ": who is alone falls and bounces exactly";
}

TEST_F(BenchAccuracy, KeepsWhatIsPromisedWhereItChoosesTheSteps) {
  auto rows = rows_of(
      "--engine 'native auto' --only throw --only rolling --only slipping --only slide "
      "--only bounce --only cradle --only illiard --only impact");
  for (const auto& [name, engines] : rows)
    for (const auto& row : engines.at("native auto")) {
      if (name == "impact") {
        EXPECT_THAT(row["note"].get<std::string>(), ::testing::HasSubstr("errors grow at each collision"));
        continue;
      }
      ASSERT_TRUE(row["error"].is_number()) << name << row;
      EXPECT_LE(row["error"], row["asked"]) << name << row;
    }
  EXPECT_EQ(rows["throw"]["native auto"].size(), 3u) << "a tenth, a hundredth, a thousandth of a radius";
}

TEST_F(BenchAccuracy, ConvergesAtTheOrderOfTheIntegrator) {
  auto rows = rows_of("--only throw --only rolling --only slipping --only slide --only spring");
  for (const char* name : {"throw", "rolling", "slipping"})
    EXPECT_LT(worst(rows[name]["native"]), 1e-9) << name << ": nothing is off but rounding";
  for (const char* name : {"from slipping to rolling", "slide to rest"})
    EXPECT_NEAR(order(rows[name]["native"]), 2.0, 0.4) << name;
  EXPECT_NEAR(order(rows["throw"]["box2d"]), 1.0, 0.01) << "semi-implicit Euler";
  EXPECT_NEAR(order(rows["spring and dashpot"]["native"]), 2.0, 0.25) << "Verlet, eight phases of a step";
  EXPECT_TRUE(rows["throw"]["event_driven"][0].contains("exact"));
}

}  // namespace
}  // namespace throng
