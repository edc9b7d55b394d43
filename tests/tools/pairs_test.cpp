// SPDX-License-Identifier: MIT
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace throng {
namespace {

using nlohmann::json;
using testing::HasSubstr;

struct Answers {
  std::vector<json> lines;
  int exit_code;
};

/// What `throng pairs` says to a file with this text.
Answers ask(const std::string& text) {
  const auto* test = testing::UnitTest::GetInstance()->current_test_info();
  const std::string file = testing::TempDir() + "pairs_" + test->name() + ".jsonl";
  std::ofstream(file) << text;
  FILE* pipe = popen((std::string(THRONG_PROGRAM) + " pairs " + file).c_str(), "r");
  std::string output;
  for (int c; (c = std::fgetc(pipe)) != EOF;) output += static_cast<char>(c);
  Answers answers{{}, WEXITSTATUS(pclose(pipe))};
  std::filesystem::remove(file);
  for (std::size_t at = 0; at < output.size();) {
    const std::size_t end = output.find('\n', at);
    answers.lines.push_back(json::parse(output.substr(at, end - at)));
    at = end + 1;
  }
  return answers;
}

json ask_one(const std::string& line) {
  return ask(line + "\n").lines.at(0);
}

const std::string kDisc = R"({"disc":{"radius":1}})";
const std::string kSquare = R"({"polygon":[[-1,-1],[1,-1],[1,1],[-1,1]]})";

TEST(Pairs, AnswersADiscAndAPolygonWithAllTheirFigures) {
  const json answer = ask_one(R"({"id":"x1","a":)" + kDisc + R"(,"b":{"polygon":[[2,-1],[3,0],[2,1]]}})");
  EXPECT_EQ(answer, json::parse(R"({"id":"x1","distance":1.0,"lower":1.0,"upper":1.0,"collide":false,
      "normal":[1.0,0.0],"point_a":[1.0,0.0],"point_b":[2.0,0.0]})"));
}

TEST(Pairs, GivesOverlappingConvexShapesAManifold) {
  const json answer =
      ask_one(R"({"a":)" + kSquare + R"(,"b":{"polygon":[[-1,-1],[1,-1],[1,1],[-1,1]],"at":[1.5,0]}})");
  EXPECT_EQ(answer["distance"], -0.5);
  EXPECT_EQ(answer["collide"], true);
  EXPECT_EQ(answer["manifold"].size(), 2u);
  EXPECT_FALSE(answer.contains("id"));
}

TEST(Pairs, RotatesAboutTheLocalOriginThenTranslates) {
  const json answer = ask_one(
      R"({"a":)" + kDisc + R"(,"b":{"disc":{"at":[1,0],"radius":1},"at":[0,4],"angle":1.5707963267948966}})");
  EXPECT_NEAR(answer["distance"].get<double>(), 3.0, 1e-15);
}

TEST(Pairs, SeesIntoTheNotchOfANonConvexPolygon) {
  const json answer = ask_one(
      R"({"a":{"polygon":[[0,0],[3,0],[3,1],[1,1],[1,3],[0,3]]},"b":{"disc":{"at":[2,2.25],"radius":0.5}}})");
  EXPECT_DOUBLE_EQ(answer["distance"].get<double>(), 0.5);
  EXPECT_EQ(answer["lower"], answer["upper"]);
}

TEST(Pairs, BracketsTheDepthOfNonConvexSolids) {
  const json answer = ask_one(
      R"({"a":{"polygon":[[0,0],[3,0],[3,1],[1,1],[1,3],[0,3]]},"b":{"disc":{"at":[0.5,0.5],"radius":0.25}}})");
  EXPECT_EQ(answer["collide"], true);
  EXPECT_LE(answer["lower"].get<double>(), -0.75);
  EXPECT_GE(answer["upper"].get<double>(), -0.75);
  EXPECT_FALSE(answer.contains("manifold"));
}

TEST(Pairs, TakesASolidInsideAnotherForACollision) {
  const json answer = ask_one(R"({"a":)" + kSquare + R"(,"b":{"disc":{"radius":0.01}}})");
  EXPECT_DOUBLE_EQ(answer["distance"].get<double>(), -1.01);
}

TEST(Pairs, RoundsSegmentsAndPolygons) {
  const json answer = ask_one(
      R"({"a":{"segment":[[0,0],[1,0]],"radius":0.25},"b":{"polygon":[[0,2],[1,2],[1,3]],"radius":0.5}})");
  EXPECT_EQ(answer["distance"], 1.25);
}

TEST(Pairs, AnswersTheOtherLinesAroundFaultyOnes) {
  const std::string good = R"({"id":1,"a":)" + kDisc + R"(,"b":)" + kDisc + "}\n";
  const Answers answers = ask(good + "nonsense\n\n" + good);
  EXPECT_EQ(answers.exit_code, 2);
  ASSERT_EQ(answers.lines.size(), 4u);
  EXPECT_EQ(answers.lines[0]["distance"], -2.0);
  EXPECT_EQ(answers.lines[1]["line"], 2);
  EXPECT_TRUE(answers.lines[2].contains("error"));
  EXPECT_EQ(answers.lines[3]["id"], 1);
  EXPECT_EQ(ask(good).exit_code, 0);
}

TEST(Pairs, RefusesABadLineAndSaysWhy) {
  const std::pair<std::string, std::string> cases[] = {
      {R"({"a":{"disc":{"radius":1}},"a":{"disc":{"radius":1}}})", "twice"},
      {R"({"a":)" + kDisc + R"(,"b":)" + kDisc + R"(,"c":1})", "unknown key \"c\""},
      {R"({"a":)" + kDisc + "}", "b: is missing"},
      {R"({"a":)" + kDisc + R"(,"b":{"disc":{"radius":-1}}})", "negative"},
      {R"({"a":)" + kDisc + R"(,"b":{"disc":{"radius":"1"}}})", "number"},
      {R"({"a":)" + kDisc + R"(,"b":{"disc":{"radius":NaN}}})", "not JSON"},
      {R"({"a":)" + kDisc + R"(,"b":{"disc":{"radius":1e999}}})", "overflow"},
      {R"({"a":)" + kDisc + R"(,"b":{"disc":{"radius":1},"at":[1]}})", "b.at"},
      {R"({"a":)" + kDisc + R"(,"b":{"polygon":[[0,0],[2,2],[2,0],[0,2]]}})", "edge 0-1 meets edge 2-3"},
      {R"({"a":)" + kDisc + R"(,"b":{"segment":[[1,1],[1,1]]}})", "differ"},
      {R"({"a":)" + kDisc + R"(,"b":{"discs":[]}})", "b.discs"},
      {R"({"a":)" + kDisc + R"(,"b":{"disc":{"radius":1},"velocity":[1,0]}})", "not supported yet: motion"},
      {R"({"a":)" + kDisc + R"(,"b":)" + kDisc + R"(,"until":1})", "not supported yet: motion"},
      {R"([1,2])", "object"},
      {R"({"id":[1],"a":)" + kDisc + R"(,"b":)" + kDisc + "}", "id"},
      {"{\"\xff\":1}", "not JSON"},
  };
  for (const auto& [line, why] : cases) {
    const json answer = ask_one(line);
    ASSERT_TRUE(answer.contains("error")) << line;
    EXPECT_THAT(answer["error"].get<std::string>(), HasSubstr(why)) << line;
    EXPECT_EQ(answer["line"], 1) << line;
  }
}

TEST(Pairs, SurvivesATowerOfBrackets) {
  EXPECT_THAT(ask_one(std::string(1000000, '['))["error"].get<std::string>(), HasSubstr("deep"));
}

TEST(Pairs, SaysWhatItMendedInAPolygon) {
  const json answer = ask_one(R"({"a":)" + kDisc + R"(,"b":{"polygon":[[3,0],[3,1],[4,1],[4,0],[4,0]]}})");
  EXPECT_EQ(answer["distance"], 2.0);
  EXPECT_EQ(answer["repairs"].size(), 2u);
}

TEST(Pairs, EndsWithTwoWhereThereIsNoFile) {
  const std::string command = std::string(THRONG_PROGRAM) + " pairs /nowhere/at/all 2>/dev/null";
  EXPECT_EQ(WEXITSTATUS(std::system(command.c_str())), 2);
}

}  // namespace
}  // namespace throng
