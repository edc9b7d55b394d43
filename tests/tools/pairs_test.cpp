// SPDX-License-Identifier: MIT
// throng pairs, run as its users run it.
#include <gmock/gmock.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <random>
#include <sstream>
#include <string>
#include <vector>

#include "tests/tools/program.h"

namespace throng {
namespace {

using nlohmann::json;
using testing::HasSubstr;
using Vec = Eigen::Vector2d;

struct Answers {
  std::vector<json> lines;
  int exit_code;
};

class Pairs : public Program {
 protected:
  static Answers answers_of(const Result& result) {
    Answers answers{{}, result.exit_code};
    std::istringstream lines(result.out);
    for (std::string line; std::getline(lines, line);) answers.lines.push_back(json::parse(line));
    return answers;
  }

  /// What `throng pairs` says to a file with this text.
  Answers ask(const std::string& text) const {
    return answers_of(throng("pairs " + write("pairs.jsonl", text)));
  }

  json ask_one(const std::string& line) const { return ask(line + "\n").lines.at(0); }
};

const std::string kDisc = R"({"disc":{"radius":1}})";
const std::string kSquare = R"({"polygon":[[-1,-1],[1,-1],[1,1],[-1,1]]})";

TEST_F(Pairs, AnswersADiscAndAPolygonWithAllTheirFigures) {
  const json answer = ask_one(R"({"id":"x1","a":)" + kDisc + R"(,"b":{"polygon":[[2,-1],[3,0],[2,1]]}})");
  EXPECT_EQ(answer, json::parse(R"({"id":"x1","distance":1.0,"lower":1.0,"upper":1.0,"collide":false,
      "normal":[1.0,0.0],"point_a":[1.0,0.0],"point_b":[2.0,0.0]})"));
}

TEST_F(Pairs, GivesOverlappingConvexShapesAManifold) {
  const json answer =
      ask_one(R"({"a":)" + kSquare + R"(,"b":{"polygon":[[-1,-1],[1,-1],[1,1],[-1,1]],"at":[1.5,0]}})");
  EXPECT_EQ(answer["distance"], -0.5);
  EXPECT_EQ(answer["collide"], true);
  EXPECT_EQ(answer["manifold"].size(), 2u);
  EXPECT_FALSE(answer.contains("id"));
}

TEST_F(Pairs, RotatesAboutTheLocalOriginThenTranslates) {
  const json answer = ask_one(
      R"({"a":)" + kDisc + R"(,"b":{"disc":{"at":[1,0],"radius":1},"at":[0,4],"angle":1.5707963267948966}})");
  EXPECT_NEAR(answer["distance"].get<double>(), 3.0, 1e-15);
}

TEST_F(Pairs, SeesIntoTheNotchOfANonConvexPolygon) {
  const json answer = ask_one(
      R"({"a":{"polygon":[[0,0],[3,0],[3,1],[1,1],[1,3],[0,3]]},"b":{"disc":{"at":[2,2.25],"radius":0.5}}})");
  EXPECT_DOUBLE_EQ(answer["distance"].get<double>(), 0.5);
  EXPECT_EQ(answer["lower"], answer["upper"]);
}

// A square frame of 1 m round a hole of 2 m by 2 m.
const std::string kFrame =
    R"({"polygon":[[-2,-2],[2,-2],[2,2],[-2,2]],"holes":[[[-1,-1],[1,-1],[1,1],[-1,1]]]})";

TEST_F(Pairs, LetsADiscStandInAHole) {
  const json answer = ask_one(R"({"a":)" + kFrame + R"(,"b":{"disc":{"at":[0.25,0],"radius":0.5}}})");
  EXPECT_EQ(answer["distance"], 0.25);
  EXPECT_EQ(answer["collide"], false);
  EXPECT_EQ(answer["normal"], json::parse("[-1.0,0.0]"));
  EXPECT_EQ(answer["point_a"], json::parse("[1.0,0.0]"));
  EXPECT_FALSE(answer.contains("repairs"));
}

TEST_F(Pairs, TouchesTheRimOfAHoleFromWithin) {
  EXPECT_EQ(ask_one(R"({"a":)" + kFrame + R"(,"b":)" + kDisc + "}")["distance"], 0.0);
  const json deep = ask_one(R"({"a":)" + kFrame + R"(,"b":{"disc":{"at":[1.5,0],"radius":0.25}}})");
  EXPECT_EQ(deep["distance"], -0.75);
  EXPECT_LE(deep["lower"].get<double>(), -0.75);
}

// Grown by 0.25 m, the frame leaves a hole of 1.5 m.
TEST_F(Pairs, RoundsAPolygonIntoItsHoles) {
  std::string rounded = kFrame;
  rounded.insert(1, R"("radius":0.25,)");
  const json answer = ask_one(R"({"a":)" + rounded + R"(,"b":{"disc":{"at":[0.25,0],"radius":0.25}}})");
  EXPECT_EQ(answer["distance"], 0.25);
}

TEST_F(Pairs, RefusesHolesThatAreNone) {
  const std::pair<std::string, std::string> cases[] = {
      {"7", "b.holes: a list of lists"},
      {"[7]", "b.holes[0]: a list of points"},
      {"[[[1,1],[2,2]]]", "b.holes[0]: a polygon needs three"},
      {"[[[1,1],[2,1],[2,2]],[[5,5],[6,6],[6,5],[5,6]]]", "b.holes[1]: edge 0-1 meets edge 2-3"},
      {"[[[1,1],[2,1],[9,2]]]", "b.holes[0]: edge 1-2 meets edge 1-2 of the outline"},
      {"[[[1,1],[5,1],[1,5]],[[4,2],[5,5],[6,6]]]", "b.holes[1]: edge "},
      {"[[[10,1],[11,1],[10,2]]]", "b.holes[0]: lies outside the outline"},
      {"[[[1,1],[8,1],[1,8]],[[2,2],[3,2],[2,3]]]", "b.holes[1]: lies in hole 0"},
  };
  for (const auto& [holes, why] : cases) {
    const json answer =
        ask_one(R"({"a":)" + kDisc + R"(,"b":{"polygon":[[0,0],[9,0],[9,9],[0,9]],"holes":)" + holes + "}}");
    EXPECT_THAT(answer.value("error", ""), testing::StartsWith(why)) << holes;
  }
  EXPECT_THAT(ask_one(R"({"a":)" + kDisc + R"(,"b":{"disc":{"radius":1},"holes":[]}})").value("error", ""),
              HasSubstr("b.holes: only a polygon"));
}

TEST_F(Pairs, BracketsTheDepthOfNonConvexSolids) {
  const json answer = ask_one(
      R"({"a":{"polygon":[[0,0],[3,0],[3,1],[1,1],[1,3],[0,3]]},"b":{"disc":{"at":[0.5,0.5],"radius":0.25}}})");
  EXPECT_EQ(answer["collide"], true);
  EXPECT_LE(answer["lower"].get<double>(), -0.75);
  EXPECT_GE(answer["upper"].get<double>(), -0.75);
  EXPECT_FALSE(answer.contains("manifold"));
}

// The middle disc is left after 1.5 m, and across their row so are all three.
TEST_F(Pairs, FindsTheWayOutAcrossARowOfDiscs) {
  const std::string row = R"({"discs":[[0,0,1],[-1,0,1],[1,0,1]]})", disc = R"({"disc":{"radius":0.5}})";
  const json answer = ask_one(R"({"a":)" + row + R"(,"b":)" + disc + "}");
  EXPECT_EQ(answer["distance"], -1.5);
  EXPECT_EQ(answer["upper"], -1.5);
  EXPECT_EQ(answer["lower"], -1.5);
  EXPECT_EQ(answer["way_out"][0], 0.0);
  EXPECT_EQ(ask_one(R"({"a":)" + disc + R"(,"b":)" + row + "}")["lower"], -1.5);
}

// Of unequal discs only the way along the normal is tried, here along the row.
TEST_F(Pairs, BracketsTheDepthInACompositeOfUnequalDiscs) {
  const std::string row = R"({"discs":[[0,0,1],[-1,0,1],[1,0,0.75]]})", disc = R"({"disc":{"radius":0.5}})";
  const json answer = ask_one(R"({"a":)" + row + R"(,"b":)" + disc + "}");
  EXPECT_EQ(answer["upper"], -1.5);
  EXPECT_EQ(answer["lower"], answer["normal"][0] == 1.0 ? -2.25 : -2.5);
}

// To the right the disc leaves the upright of the L soonest, but only to the left it surely leaves all of it.
TEST_F(Pairs, FindsTheShortestSureWayOutAlongTheNormalsOfBoth) {
  const std::string bent = R"({"polygon":[[0,0],[9,0],[9,1],[1,1],[1,9],[0,9]]})";
  const std::string disc = R"({"disc":{"at":[0.625,6],"radius":0.25}})";
  const json one = ask_one(R"({"a":)" + bent + R"(,"b":)" + disc + "}");
  const json other = ask_one(R"({"a":)" + disc + R"(,"b":)" + bent + "}");
  EXPECT_EQ(one["lower"], other["lower"]);
  EXPECT_EQ(one["upper"], -0.625);
  EXPECT_DOUBLE_EQ(one["lower"].get<double>(), -0.875);
  EXPECT_DOUBLE_EQ(one["way_out"][0].get<double>(), -0.875);
  EXPECT_DOUBLE_EQ(other["way_out"][0].get<double>(), 0.875);
}

/// Random shapes, none of them convex, without their poses.
std::string random_solid(std::mt19937_64& random, int kind) {
  const auto uniform = [&] {
    return std::to_string(4.0 * static_cast<double>(random() >> 11) * 0x1p-53 - 2.0);
  };
  if (kind == 0) return R"({"polygon":[[0,0],[3,0],[3,1],[1,1],[1,3],[0,3]])";
  if (kind == 1) return kFrame.substr(0, kFrame.size() - 1) + R"(,"radius":0.125)";
  const std::string x = uniform(), y = uniform();
  return R"({"discs":[[0,0,1],[)" + x + ",1,0.5],[1," + y + ",0.25]]";
}

std::string placed_solid(const std::string& solid, const Vec& at, double angle) {
  std::ostringstream text;
  text.precision(17);
  text << solid << R"(,"at":[)" << at.x() << ',' << at.y() << R"(],"angle":)" << angle << '}';
  return text.str();
}

TEST_F(Pairs, PartsWhatOverlapsByItsWayOut) {
  std::mt19937_64 random(22);
  const auto uniform = [&] { return static_cast<double>(random() >> 11) * 0x1p-53; };
  struct Pair {
    std::string a, b;
    Vec at;
    double angle;
    std::string line() const { return R"({"a":)" + a + R"(,"b":)" + placed_solid(b, at, angle) + "}\n"; }
  };
  std::vector<Pair> pairs;
  std::string text;
  for (int i = 0; i < 300; ++i) {
    const Vec at{8 * uniform() - 3, 8 * uniform() - 2};
    pairs.push_back({placed_solid(random_solid(random, i % 3), {1, 2}, 6 * uniform()),
                     random_solid(random, i / 3 % 3), at, 6 * uniform()});
    text += pairs.back().line();
  }
  const Answers answers = ask(text);
  std::string moved;
  std::size_t overlapping = 0;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const json& answer = answers.lines.at(i);
    ASSERT_EQ(answer.contains("way_out"), answer["distance"] < 0.0) << answer;
    if (!answer.contains("way_out")) continue;
    const Vec way(answer["way_out"][0], answer["way_out"][1]);
    EXPECT_NEAR(way.norm(), -answer["lower"].get<double>(), 1e-15 * way.norm()) << answer;
    EXPECT_LE(answer["lower"], answer["upper"]);
    pairs[i].at += way;
    moved += pairs[i].line();
    ++overlapping;
  }
  EXPECT_GT(overlapping, 90u);
  EXPECT_LT(overlapping, 270u);
  for (const json& answer : ask(moved).lines) EXPECT_GE(answer["distance"], -1e-14) << answer;
}

TEST_F(Pairs, FindsALargePartWhoseMiddleIsFarAway) {
  const json answer = ask_one(R"({"a":)" + kDisc + R"(,"b":{"discs":[[4,0,1],[20,0,18.5]]}})");
  EXPECT_EQ(answer["distance"], 0.5);
}

// Of a hundred discs the last is the nearest, as if the others were not there.
TEST_F(Pairs, FindsTheNearestOfManyParts) {
  std::string discs;
  for (int i = 0; i < 100; ++i) discs += (i > 0 ? ",[" : "[") + std::to_string(200 - 2 * i) + ",0,0.5]";
  const json answer = ask_one(R"({"a":)" + kDisc + R"(,"b":{"discs":[)" + discs + "]}}");
  EXPECT_EQ(answer["distance"], 0.5);
  EXPECT_EQ(answer["point_b"], json::parse("[1.5,0.0]"));
}

TEST_F(Pairs, SaysWhatAnAnswerTookWhereAsked) {
  std::string discs;
  for (int i = 0; i < 100; ++i) discs += (i > 0 ? ",[" : "[") + std::to_string(2 * i) + ",0,0.5]";
  const std::string line = R"({"a":)" + kDisc + R"(,"b":{"discs":[)" + discs + R"(],"at":[5,0]}})";
  const Answers answers = answers_of(throng("pairs --work " + write("pairs.jsonl", line)));
  const json work = answers.lines.at(0).at("work");
  EXPECT_GE(work["leaves"], 1);
  EXPECT_LT(work["leaves"], 5);
  EXPECT_GT(work["nodes"], work["leaves"]);
  EXPECT_LT(work["nodes"], 50);
  EXPECT_GT(work["us"], 0.0);
  EXPECT_FALSE(ask_one(line).contains("work"));
}

TEST_F(Pairs, TakesTouchingForACollision) {
  const json answer =
      ask_one(R"({"a":)" + kSquare + R"(,"b":{"disc":{"at":[2,0],"radius":1}},"epsilon":0.1})");
  EXPECT_EQ(answer["distance"], 0.0);
  EXPECT_EQ(answer["collide"], true);
  EXPECT_EQ(answer["manifold"], json::parse(R"([{"point":[1.0,0.0],"separation":0.0}])"));
}

TEST_F(Pairs, TakesASolidInsideAnotherForACollision) {
  const json answer = ask_one(R"({"a":)" + kSquare + R"(,"b":{"disc":{"radius":0.01}}})");
  EXPECT_DOUBLE_EQ(answer["distance"].get<double>(), -1.01);
}

TEST_F(Pairs, RoundsSegmentsAndPolygons) {
  const json answer = ask_one(
      R"({"a":{"segment":[[0,0],[1,0]],"radius":0.25},"b":{"polygon":[[0,2],[1,2],[1,3]],"radius":0.5}})");
  EXPECT_EQ(answer["distance"], 1.25);
}

TEST_F(Pairs, AnswersTheOtherLinesAroundFaultyOnes) {
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

TEST_F(Pairs, RefusesABadLineAndSaysWhy) {
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
      {R"({"a":)" + kDisc + R"(,"b":{"disc":{"radius":1},"velocity":[1,0]}})",
       "until: is missing, but b moves"},
      {R"({"b":)" + kDisc + R"(,"a":{"disc":{"radius":1},"spin":-1}})", "until: is missing, but a moves"},
      {R"({"a":)" + kDisc + R"(,"b":)" + kDisc + R"(,"until":-1})", "until: must not be negative"},
      {R"({"a":)" + kDisc + R"(,"b":)" + kDisc + R"(,"until":1e101})", "until: a number up to 1e100"},
      {R"({"a":{"disc":{"radius":1},"velocity":0},"b":)" + kDisc + "}", "a.velocity: a list of 2"},
      {R"({"a":)" + kDisc + R"(,"b":)" + kDisc + R"(,"until":"0"})", "until: a number"},
      {R"({"a":)" + kDisc + R"(,"b":{"disc":{"radius":1},"radius":1}})", "b.radius: only"},
      {R"({"a":)" + kDisc + R"(,"b":{"disc":{"radius":1},"discs":[[0,0,1]]}})", "b: one of"},
      {R"({"a":)" + kDisc + R"(,"b":{"segment":[[0,0],[1,0]],"radius":-1}})",
       "b.radius: must not be negative"},
      {R"({"a":)" + kDisc + R"(,"b":{"discs":[[0,0,-1]]}})", "b.discs[0][2]"},
      {R"({"a":)" + kDisc + R"(,"b":{"disc":{}}})", "radius is missing"},
      {R"({"a":)" + kDisc + R"(,"b":{"disc":{"radius":1e101}}})", "up to 1e100"},
      {R"({"a":)" + kDisc + R"(,"b":)" + kDisc + R"(,"epsilon":-1})", "epsilon"},
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

TEST_F(Pairs, NeedsNoEndOfWhatMovesByNothing) {
  const std::string still = R"({"disc":{"radius":1},"velocity":[0,-0.0],"spin":0.0})";
  const json answer = ask_one(R"({"id":1,"a":)" + still + R"(,"b":)" + still + "}");
  EXPECT_EQ(answer.value("distance", 0.0), -2.0) << answer;
  EXPECT_FALSE(answer.contains("motion"));
}

TEST_F(Pairs, SurvivesATowerOfBrackets) {
  EXPECT_THAT(ask_one(std::string(1000000, '['))["error"].get<std::string>(), HasSubstr("deep"));
}

TEST_F(Pairs, SaysWhatItMendedInAPolygon) {
  const json answer = ask_one(R"({"a":)" + kDisc + R"(,"b":{"polygon":[[3,0],[3,1],[4,1],[4,0],[4,0]]}})");
  EXPECT_EQ(answer["distance"], 2.0);
  EXPECT_EQ(answer["repairs"].size(), 2u);
}

TEST_F(Pairs, SaysWhatItMendedInAHole) {
  const json answer = ask_one(
      R"({"a":{"polygon":[[0,0],[9,0],[9,9],[0,9]],"holes":[[[1,1],[2,1],[1,2]],[[4,4],[4,4],[5,4],[4,5]]]},)"
      R"("b":)" +
      kDisc + "}");
  EXPECT_EQ(answer["repairs"], json::parse(R"(["a.holes[1]: vertex 1 repeats the one before it: dropped"])"));
}

TEST_F(Pairs, KeepsTheIdOfAFaultyLine) {
  const std::string good = R"("a":)" + kDisc + R"(,"b":)" + kDisc;
  const Answers answers = ask(R"({"id":"x",)" + good + R"(,"until":-1})" + "\n" + R"({"id":7})" + "\n" +
                              R"({"id":[7],)" + good + "}\n" + R"({"a":7})" + "\n" + R"({"id":8,)" + "\n" +
                              R"({"id":9,"a":{"segment":[[0,0],[9e99,0]],"at":[9e99,0],"radius":1e99},"b":)" +
                              R"({"polygon":[[0,0],[1e-140,0],[0,1e-140]],"at":[-1e100,0]}})");
  ASSERT_EQ(answers.lines.size(), 6u);
  EXPECT_EQ(answers.lines[0]["id"], "x");
  EXPECT_EQ(answers.lines[0]["line"], 1);
  EXPECT_EQ(answers.lines[1]["id"], 7);
  for (std::size_t i : {2, 3, 4}) {
    EXPECT_FALSE(answers.lines[i].contains("id")) << i;
    EXPECT_TRUE(answers.lines[i].contains("error")) << i;
  }
  EXPECT_EQ(answers.lines[5]["id"], 9);
}

// Two stars of a thousand corners: for a tenth of the distance one looks at less of them.
TEST_F(Pairs, AnswersWithinEpsilon) {
  std::string star;
  for (int i = 0; i < 1000; ++i) {
    const double radius = i % 2 ? 1.0 : 0.9, angle = 2 * 3.14159265358979 * i / 1000;
    star += (i > 0 ? ",[" : "[") + std::to_string(radius * std::cos(angle)) + "," +
            std::to_string(radius * std::sin(angle)) + "]";
  }
  const std::string pair =
      R"("a":{"polygon":[)" + star + R"(]},"b":{"polygon":[)" + star + R"(],"at":[2.5,1]})";
  const Answers answers = answers_of(throng(
      "pairs --work " + write("pairs.jsonl", "{" + pair + "}\n{" + pair + R"(,"epsilon":0.1})" + "\n")));
  const json exact = answers.lines.at(0), rough = answers.lines.at(1);
  EXPECT_EQ(exact["lower"], exact["upper"]);
  EXPECT_LE(rough["lower"], exact["distance"]);
  EXPECT_GE(rough["upper"], exact["distance"]);
  EXPECT_EQ(rough["upper"], rough["distance"]);
  EXPECT_LE(rough["upper"].get<double>(), 1.1 * rough["lower"].get<double>() * (1 + 1e-15));
  EXPECT_LT(rough["lower"], rough["upper"]);
  EXPECT_LT(rough["work"]["nodes"], exact["work"]["nodes"]);
}

TEST_F(Pairs, SaysInItsHelpWhatEveryKeyMeans) {
  const std::string help = throng("pairs --help").out;
  const std::string line =
      R"({"id":1,"epsilon":0,"a":)" + kSquare + R"(,"b":{"polygon":)" +
      R"([[0,0],[1,0],[1,0],[1,1]],"radius":0,"at":[0,0],"angle":0,"velocity":[0,0],"spin":0},"until":0})";
  const Answers answers = answers_of(throng("pairs --work " + write("pairs.jsonl", line + "\n7\n")));
  EXPECT_EQ(answers.lines.at(0).size(), 16u) << answers.lines[0];
  for (const json& answer : {answers.lines[0], answers.lines[0]["work"], answers.lines[1]})
    for (const auto& item : answer.items()) EXPECT_THAT(help, HasSubstr('"' + item.key() + '"'));
  for (const char* key : {"way_out", "epsilon", "polygon", "holes", "disc", "discs", "segment", "radius",
                          "at", "angle", "velocity", "spin", "until"})
    EXPECT_THAT(help, HasSubstr('"' + std::string(key) + '"'));
}

TEST_F(Pairs, EndsWithTwoWhereThereIsNoFile) {
  for (const std::string& file : {path("absent"), path("")}) {
    const Result result = throng("pairs " + file);
    EXPECT_EQ(result.exit_code, 2);
    EXPECT_EQ(result.out, "");
    EXPECT_THAT(result.err, HasSubstr("can't be read"));
  }
}

TEST_F(Pairs, ReadsStandardInputWhereTheFileIsAHyphen) {
  write("in", R"({"id":7,"a":)" + kDisc + R"(,"b":)" + kDisc + "}");
  const Result result = throng("pairs - <" + path("in"));
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_THAT(result.out, HasSubstr("{\"id\":7,\"distance\":-2.0,"));
}

// A segment of 1e-200 m against a disc: "distance": null, and exit code 0.
TEST_F(Pairs, RefusesACoordinateTooSmallToBeSquared) {
  const Answers answers =
      ask(R"({"a":{"segment":[[0,0],[1e-200,0]]},"b":{"disc":{"at":[0,3],"radius":1}}})" + std::string("\n"));
  EXPECT_EQ(answers.exit_code, 2);
  EXPECT_EQ(answers.lines.at(0)["line"], 1);
  EXPECT_THAT(answers.lines.at(0)["error"].get<std::string>(), HasSubstr("a.segment[1][0]"));
  for (const char* disc : {R"({"disc":{"at":[0,1e-141],"radius":1}})", R"({"discs":[[-1e-300,0,1]]})",
                           R"({"disc":{"radius":1},"at":[0,5e-324]})"}) {
    const json answer = ask_one(R"({"a":)" + kDisc + R"(,"b":)" + disc + "}");
    EXPECT_THAT(answer.value("error", ""), HasSubstr("1e-140")) << disc;
  }
}

bool holds_null(const json& value) {
  if (!value.is_structured()) return value.is_null();
  return std::any_of(value.begin(), value.end(), holds_null);
}

/// Shapes of about a size, by their JSON.
std::vector<std::string> shapes_of_size(const std::string& x) {
  return {R"({"disc":{"at":[)" + x + ",0],\"radius\":" + x + "}}",
          R"({"disc":{"radius":)" + x + R"(},"at":[0,)" + x + R"(],"angle":)" + x + "}",
          R"({"discs":[[)" + x + ",0," + x + "],[0,-" + x + ",0]]}",
          R"({"segment":[[0,0],[)" + x + R"(,0]],"angle":)" + x + "}",
          R"({"segment":[[)" + x + ",-" + x + "],[0," + x + R"(]],"radius":)" + x + "}",
          R"({"polygon":[[0,0],[)" + x + ",0],[0," + x + R"(]],"radius":)" + x + "}",
          R"({"polygon":[[0,0],[)" + x + ",0],[" + x + "," + x + "],[0," + x + "],[0,0]]}",
          R"({"polygon":[[0,0],[2e0,0],[2e0,1],[1,1],[1,2],[0,2]],"at":[-)" + x + "," + x + "]}"};
}

TEST_F(Pairs, AnswersInNumbersOrRefusesWhateverTheSizes) {
  std::vector<std::string> shapes;
  for (const char* size : {"1e-320", "1e-200", "1e-141", "1e-140", "1e-60", "1", "1e60", "1e100", "1e101"})
    for (const std::string& shape : shapes_of_size(size)) shapes.push_back(shape);
  std::string text;
  for (const std::string& a : shapes)
    for (const std::string& b : shapes) text += R"({"a":)" + a + R"(,"b":)" + b + "}\n";
  const Answers answers = ask(text);
  ASSERT_EQ(answers.lines.size(), shapes.size() * shapes.size());
  std::size_t refused = 0;
  for (std::size_t i = 0; i < answers.lines.size(); ++i) {
    const json& answer = answers.lines[i];
    refused += answer.contains("error");
    EXPECT_FALSE(holds_null(answer)) << shapes[i / shapes.size()] << " " << shapes[i % shapes.size()];
    if (answer.contains("error")) continue;
    EXPECT_NEAR(std::hypot(answer["normal"][0].get<double>(), answer["normal"][1].get<double>()), 1.0, 1e-15);
    EXPECT_LE(answer["lower"], answer["upper"]);
  }
  EXPECT_GT(refused, answers.lines.size() / 3);
  EXPECT_LT(refused, answers.lines.size() * 3 / 4);
}

TEST_F(Pairs, RefusesMoreVerticesThanItAnswersInSeconds) {
  std::string vertices = "[0,0]";
  for (int i = 0; i < 20000; ++i) vertices += ",[0,0]";
  const json answer = ask_one(R"({"a":)" + kDisc + R"(,"b":{"polygon":[)" + vertices + "]}}");
  EXPECT_THAT(answer.value("error", ""), HasSubstr("b.polygon: at most 20000"));
}

TEST_F(Pairs, RefusesMoreDiscsThanItAnswersInSeconds) {
  std::string discs;
  for (int i = 0; i < 20000; ++i) discs += "[" + std::to_string(i) + ",0,1],";
  const auto line = [&](const std::string& last) {
    return R"({"a":)" + kDisc + R"(,"b":{"discs":[)" + discs + last + "]}}";
  };
  EXPECT_THAT(ask_one(line("[0,5,1]")).value("error", ""), HasSubstr("b.discs: at most 20000"));
  discs.erase(discs.size() - std::string("[19999,0,1],").size());
  EXPECT_EQ(ask_one(line("[0,0.5,1]"))["distance"], -2.0);
}

// The limit on memory, which sanitizers can't live with, proves that a line of any length is not held.
#ifdef THRONG_SANITIZED
const std::string kLittleMemory;
#else
const std::string kLittleMemory = "ulimit -v 300000; ";
#endif

TEST_F(Pairs, RefusesALineOfAnyLengthAndGoesOn) {
  const std::string good = R"({"a":)" + kDisc + R"(,"b":)" + kDisc + "}";
  const std::string rest = write("rest", "\n" + good + "\n" + std::string(17 << 20, '['));
  const Answers answers =
      answers_of(throng("pairs -", kLittleMemory + "(head -c 400000000 /dev/zero; cat " + rest + ") | "));
  EXPECT_EQ(answers.exit_code, 2);
  ASSERT_EQ(answers.lines.size(), 3u);
  EXPECT_THAT(answers.lines[0].value("error", ""), HasSubstr("longer than 16 MB"));
  EXPECT_EQ(answers.lines[1].value("distance", 0.0), -2.0);
  EXPECT_EQ(answers.lines[2]["line"], 3);
  EXPECT_EQ(ask(std::string((16 << 20) - good.size(), ' ') + good).exit_code, 0);
}

}  // namespace
}  // namespace throng
