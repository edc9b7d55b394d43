// SPDX-License-Identifier: MIT
// What throng pairs says of shapes that move: closed forms.
#include <gmock/gmock.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <sstream>
#include <string>

#include "tests/tools/program.h"

namespace throng {
namespace {

using nlohmann::json;
using testing::HasSubstr;

class PairsMotion : public Program {
 protected:
  json ask(const std::string& line) const {
    return json::parse(throng("pairs --work " + write("pairs.jsonl", line + "\n")).out);
  }
};

const std::string kWall = R"({"segment":[[4,-9],[4,9]]})";

void expect_hit(const json& answer, double time) {
  ASSERT_EQ(answer.value("motion", ""), "hit") << answer;
  EXPECT_NEAR(answer["time_of_impact"].get<double>(), time, 2e-12);
  EXPECT_EQ(answer["time_bracket"][1], answer["time_of_impact"]);
  EXPECT_LE(answer["time_bracket"][0].get<double>(), time + 1e-15);
  EXPECT_GE(answer["time_bracket"][1].get<double>(), time - 1e-15);
}

TEST_F(PairsMotion, OfADiscIntoAWallEndsWhereItTouches) {
  const json answer =
      ask(R"({"until":9,"a":{"disc":{"radius":1},"velocity":[2,0],"spin":7},"b":)" + kWall + "}");
  expect_hit(answer, 1.5);
  EXPECT_EQ(answer["distance"], 3.0) << "what else is said is of the start";
  EXPECT_EQ(answer["collide"], false);
  EXPECT_NEAR(answer["impact_point"][0].get<double>(), 4.0, 1e-11);
  EXPECT_NEAR(answer["impact_point"][1].get<double>(), 0.0, 1e-11);
  EXPECT_NEAR(answer["impact_normal"][0].get<double>(), 1.0, 1e-15);
  EXPECT_LE(answer["work"]["looks"], 4);
}

TEST_F(PairsMotion, OfASquareThatSpinsBesideAWallEndsWithItsCorner) {
  const json answer =
      ask(R"({"until":9,"a":{"polygon":[[-3,-3],[3,-3],[3,3],[-3,3]],"spin":0.5},"b":)" + kWall + "}");
  expect_hit(answer, (std::numbers::pi / 4 - std::acos(4 / (3 * std::numbers::sqrt2))) / 0.5);
}

TEST_F(PairsMotion, OfARodThatSweepsRoundEndsOnADisc) {
  const json answer = ask(
      R"({"until":9,"a":{"segment":[[0,0],[3,0]],"at":[1,1],"spin":1},"b":{"disc":{"radius":0.5},"at":[1,3]}})");
  expect_hit(answer, std::numbers::pi / 2 - std::asin(0.25));
}

TEST_F(PairsMotion, OfADiscThroughAHoleIsFreeIfItFits) {
  const std::string tube =
      R"({"polygon":[[-5,-3],[5,-3],[5,3],[-5,3]],"holes":[[[-4,-1],[4,-1],[4,1],[-4,1]]]})";
  const auto sent = [&](const std::string& radius) {
    return ask(R"({"until":3,"a":{"disc":{"radius":)" + radius + R"(},"at":[-2,0],"velocity":[1,0]},"b":)" +
               tube + "}");
  };
  EXPECT_EQ(sent("0.999999999").value("motion", ""), "free");
  EXPECT_FALSE(sent("0.9").contains("time_bracket"));
  EXPECT_FALSE(sent("0.9").contains("time_of_impact"));
  EXPECT_EQ(sent("1.000000001")["time_of_impact"], 0.0);
}

TEST_F(PairsMotion, FindsTheFirstOfManyParts) {
  const json answer = ask(R"({"until":9,"a":{"discs":[[0,0,1],[3,0,1]],"velocity":[1,0]},)"
                          R"("b":{"polygon":[[9,-2],[12,-2],[12,2],[9,2],[10,0]]}})");
  expect_hit(answer, 7 - std::sqrt(5.0) / 2);  // on the two flanks of the notch
}

TEST_F(PairsMotion, IsUndecidedWhereAGapStaysZero) {
  const json answer =
      ask(R"({"until":9,"a":{"disc":{"radius":1},"at":[-5,2],"velocity":[1,0]},"b":{"disc":{"radius":1}}})");
  EXPECT_EQ(answer.value("motion", ""), "undecided");
  EXPECT_NEAR(answer["time_bracket"][0].get<double>(), 5.0, 1e-6);
  EXPECT_NEAR(answer["time_bracket"][1].get<double>(), 5.0, 1e-6);
  EXPECT_FALSE(answer.contains("time_of_impact"));
}

TEST_F(PairsMotion, AnswersAtOnceWhereNothingMoves) {
  const std::string disc = R"({"disc":{"radius":1}})";
  EXPECT_EQ(ask(R"({"until":5,"a":)" + disc + R"(,"b":)" + kWall + "}")["motion"], "free");
  const json touching = ask(R"({"until":5,"a":)" + disc + R"(,"b":{"disc":{"radius":1},"at":[2,0]}})");
  expect_hit(touching, 0.0);
  EXPECT_EQ(ask(R"({"until":1e6,"a":{"disc":{"radius":1},"velocity":[5e-324,0],"spin":5e-324},"b":)" + kWall +
                "}")["motion"],
            "free");
}

TEST_F(PairsMotion, AnswersTheLargestNumbers) {
  const json answer =
      ask(R"({"until":1e100,"a":{"polygon":[[0,0],[1,0],[0,1]],"velocity":[1e100,0],"spin":1e100},"b":)" +
          kWall + "}");
  EXPECT_EQ(answer.value("motion", ""), "undecided") << answer;
}

}  // namespace
}  // namespace throng
