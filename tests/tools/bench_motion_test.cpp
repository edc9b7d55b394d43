// SPDX-License-Identifier: MIT
// throng bench motion, as far as its rows go. Verdicts are compared with 50 digits before any time is taken:
// exit code 0 says that who promises to be exact was.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <nlohmann/json.hpp>

#include "tests/tools/program.h"

namespace throng {
namespace {

class BenchMotion : public Program {};

TEST_F(BenchMotion, AsksEveryEngineAboutEveryCaseAndFindsTheExactOnesRight) {
  const Result result = throng("bench motion --quick --blocks 1 --json " + path("rows.json"));
  ASSERT_EQ(result.exit_code, 0) << result.err;
  std::map<std::string, std::map<std::string, nlohmann::json>> errors;
  std::map<std::string, double> asked;
  int asked_less = 0;
  for (const auto& row : nlohmann::json::parse(read(path("rows.json")))) {
    errors[row["case"]][row["engine"]] = row["error"];
    const double work = row["work"], all = asked.try_emplace(row["case"], work).first->second;
    if (work < all) {
      ++asked_less;
      EXPECT_EQ(row["error"].at("asked"), work / all) << row;
    }
    EXPECT_EQ(row["error"].contains("first_ns"), work < all) << "for a ratio of the same queries: " << row;
    if (row["case"] == "octagons, random") {
      EXPECT_THAT(std::string(row["check"]), testing::MatchesRegex("(1[5-9]|2[0-9]|3[0-5]) of 50 hit"));
    }
    EXPECT_EQ(row["bench"], "motion");
    for (const char* key : {"evaluations", "missed", "false_hits", "undecided", "ns"})
      EXPECT_TRUE(row["error"].contains(key)) << row;
  }
  for (const char* engine :
       {"bisection", "first contact", "algebraic", "scalar advancement", "directional advancement",
        "swept hull", "sampled 0.1 in sequence", "sampled 0.001 by bisection", "box2d"})
    EXPECT_TRUE(errors["octagons, random"].contains(engine)) << engine;
  for (const char* name :
       {"rods, random", "gears n=64, random", "coasts n=128, random", "bracket in clutter of 400, random",
        "bar into post, 0.03 deep", "arm of 2 links, 1000 obstacles, free paths",
        "arm of 4 links, 1000 obstacles, random", "arm of 10 links, 1000 obstacles, free paths",
        "arm of 10 links, itself alone, random"})
    for (const char* engine : {"bisection", "first contact"})
      EXPECT_EQ(errors[name][engine]["missed"], 0) << name << ", " << engine;
  EXPECT_GT(asked_less, 0) << "some of the finest samples take too long to be asked about all";
  const auto& near = errors["bar past post, clearance 0.0001"];
  EXPECT_LE(near.at("bisection")["evaluations"], 700.0);
  EXPECT_LE(near.at("bisection")["growth"], 0.5) << "by a power of the clearance";
  EXPECT_EQ(near.at("bisection")["undecided"], 0);
  EXPECT_EQ(errors["bar past post, clearance 1"]["box2d"]["false_hits"], 0);
}

}  // namespace
}  // namespace throng
