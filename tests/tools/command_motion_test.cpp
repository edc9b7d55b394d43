// SPDX-License-Identifier: MIT
// throng motion, as its users run it.
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tests/tools/motion_program.h"

namespace throng {
namespace {

using testing::HasSubstr;
using testing::Not;

constexpr double kPi = std::numbers::pi;

void expect_near(const json& point, double x, double y, double error) {
  EXPECT_NEAR(point.at(0).get<double>(), x, error);
  EXPECT_NEAR(point.at(1).get<double>(), y, error);
}

/// A hit at the first contact: bracketed, narrowly, by what is true.
void expect_first(const json& segment, double fraction) {
  EXPECT_EQ(segment.at("verdict"), "hit");
  const double low = segment.at("bracket").at(0), high = segment.at("bracket").at(1);
  EXPECT_LE(low, fraction + 1e-15);
  EXPECT_GE(high, fraction - 1e-15);
  EXPECT_LE(high - low, 1e-9);
  EXPECT_EQ(segment.at("fraction"), high);
}

// (2.5 - u)^2 + (1.5 - u)^2 = 1 for u = 4.5 t: u = 1.5.
TEST_F(MotionCommand, FindsWhenTwoDiscsCross) {
  const json answer = ask_file(kExamples + "crossing.toml");
  EXPECT_EQ(answer.at("motion"), "crossing");
  EXPECT_EQ(answer.at("verdict"), "hit");
  const json& segment = answer.at("segments").at(0);
  expect_first(segment, 1.0 / 3);
  EXPECT_NEAR(segment.at("time").get<double>(), 1.0, 1e-8);
  EXPECT_EQ(segment.at("pair"), json({"east", "north"}));
  expect_near(segment.at("point"), 0.5, 0.0, 1e-8);
  expect_near(segment.at("normal"), 1.0, 0.0, 1e-8);
  EXPECT_GT(segment.at("evaluations"), 0);
}

// sin(angle) = 0.5 at a third of a right angle.
TEST_F(MotionCommand, FindsWhenATurningRodMeetsAWall) {
  const json answer = ask(R"(shapes.rod.segment = [[0, 0], [1, 0]]
[[walls]]
segment = [[-5, 0.5], [5, 0.5]]
[[bodies]]
shape = "rod"
waypoints = [[0, 0, 0], [0, 0, 1.5707963267948966]]
)");
  const json& segment = answer.at("segments").at(0);
  expect_first(segment, 1.0 / 3);
  EXPECT_EQ(segment.at("pair"), json({"bodies[0]", "walls[0]"}));
  expect_near(segment.at("point"), std::sqrt(0.75), 0.5, 1e-8);
  EXPECT_FALSE(segment.contains("time"));  // without durations
}

// The tip of an arm, and |tip - (0, 1.5)| = 0.6: sin(angle) = 2.89 / 3.
TEST_F(MotionCommand, FindsWhenAnArmMeetsADisc) {
  const json answer = ask(R"(shapes.rod.segment = [[0, 0], [1, 0]]
shapes.post.disc.radius = 0.6
[[obstacles]]
name = "far"
shape = "post"
at = [9, 9]
[[obstacles]]
name = "post"
shape = "post"
at = [1, 3.5]
[[robots]]
name = "arm"
base = [1, 2]
links = [{ name = "rod", shape = "rod" }]
waypoints = [[0], [1.5707963267948966]]
)");
  expect_first(answer.at("segments").at(0), std::asin(2.89 / 3) / (kPi / 2));
  EXPECT_EQ(answer.at("segments").at(0).at("pair"), json({"arm.rod", "post"}));
}

TEST_F(MotionCommand, FindsWhenASlideMeetsADisc) {
  const json answer = ask(R"(shapes.post.disc.radius = 0.5
[[obstacles]]
shape = "post"
at = [0, 3]
[[robots]]
links = [{ joint = "prismatic", axis = [0, 2], shape = "post" }]
waypoints = [[0], [4]]
)");
  expect_first(answer.at("segments").at(0), 0.5);
  expect_near(answer.at("segments").at(0).at("point"), 0.0, 2.5, 1e-8);
}

const std::string kTwoSegments = R"(durations = [10, 4]
[shapes]
ball = { disc = { radius = 0.5 } }
[[obstacles]]
name = "post"
shape = "ball"
at = [2, 4]
[[obstacles]]
name = "rail"
shape = "ball"
at = [-9, 0]
[[bodies]]
name = "ball"
shape = "ball"
waypoints = [[0, 0], [2, 0], [2, 4]]
)";

TEST_F(MotionCommand, AnswersEachSegmentOfAPath) {
  const json answer = ask(kTwoSegments);
  EXPECT_EQ(answer.at("verdict"), "hit");
  ASSERT_EQ(answer.at("segments").size(), 2u);
  EXPECT_EQ(answer.at("segments").at(0).at("verdict"), "free");
  EXPECT_FALSE(answer.at("segments").at(0).contains("pair"));
  const json& second = answer.at("segments").at(1);
  expect_first(second, 0.75);
  EXPECT_NEAR(second.at("time").get<double>(), 13.0, 1e-8);
  EXPECT_EQ(answer.at("evaluations").get<int>(),
            answer.at("segments").at(0).at("evaluations").get<int>() + second.at("evaluations").get<int>());
}

TEST_F(MotionCommand, StopsAtAnyContactWhereThatIsAsked) {
  const json answer = ask(kTwoSegments, "--any");
  EXPECT_EQ(answer.at("verdict"), "hit");
  ASSERT_EQ(answer.at("segments").size(), 1u);
  const json& found = answer.at("segments").at(0);
  EXPECT_EQ(found.at("segment"), 1);
  EXPECT_GE(found.at("fraction").get<double>(), 0.75 - 1e-9);
  EXPECT_EQ(found.at("bracket").at(0), found.at("bracket").at(1));
  EXPECT_LT(answer.at("evaluations").get<int>(), ask(kTwoSegments).at("evaluations").get<int>());
}

TEST_F(MotionCommand, LetsTouchWhoMay) {
  const auto verdict = [&](const std::string& pairs) {
    return ask("may_touch = [" + pairs + "]\n" + kTwoSegments).at("verdict").get<std::string>();
  };
  EXPECT_EQ(verdict(""), "hit");
  EXPECT_EQ(verdict("['ball', 'post']"), "free");
  EXPECT_EQ(verdict("['post', 'ball']"), "free");
  EXPECT_EQ(verdict("['ball', 'rail']"), "hit");
  EXPECT_EQ(verdict("['obstacles', 'ball']"), "free");
}

// It happened: what some other may touch had its own row, and "obstacles" no longer meant it.
TEST_F(MotionCommand, LetsTouchAllObstaclesThoughAnotherMayTouchOneOfThem) {
  const std::string other =
      kTwoSegments + "[[bodies]]\nname = 'other'\nshape = 'ball'\nwaypoints = [[9, 9]]\n";
  const auto verdict = [&](const std::string& pairs) {
    return ask("may_touch = [" + pairs + "]\n" + other).at("verdict").get<std::string>();
  };
  EXPECT_EQ(verdict("['other', 'post']"), "hit");
  EXPECT_EQ(verdict("['ball', 'obstacles'], ['other', 'post']"), "free");
  EXPECT_EQ(verdict("['other', 'post'], ['obstacles', 'ball']"), "free");
  EXPECT_EQ(verdict("['other', 'obstacles'], ['other', 'post']"), "hit");
}

TEST_F(MotionCommand, NamesAnObstacleThatOthersMayTouch) {
  const json answer = ask("may_touch = [['other', 'post']]\n" + kTwoSegments +
                          "[[bodies]]\nname = 'other'\nshape = 'ball'\nwaypoints = [[2, 4.5]]\n");
  EXPECT_EQ(answer.at("segments").at(0).at("verdict"), "free");  // though the other stands in the post
  EXPECT_EQ(answer.at("segments").at(1).at("pair"), json({"ball", "post"}));
}

// The bar stands upright below the post at 3/7 of the way, and just touches it: only rounding could tell.
TEST_F(MotionCommand, CallsUndecidedWhatRoundingOrEpsilonHides) {
  const std::string touching = R"(shapes.bar = { segment = [[-1, 0], [1, 0]], radius = 0.05 }
shapes.post.disc.radius = 0.1
[[obstacles]]
shape = "post"
at = [0, 1.15]
[[bodies]]
name = "bar"
shape = "bar"
waypoints = [[-3, 0, 0], [4, 0, 10.995574287564276]]
)";
  const json fine = ask(touching), rough = ask(touching, "--epsilon 0.001");
  EXPECT_NE(fine.at("verdict"), "free");
  EXPECT_EQ(rough.at("verdict"), "undecided");
  EXPECT_LE(rough.at("evaluations"), fine.at("evaluations"));
  const json& segment = rough.at("segments").at(0);
  EXPECT_NEAR(segment.at("in_doubt").at(0).get<double>(), 3.0 / 7, 0.01);
  EXPECT_EQ(segment.at("pair").at(0), "bar");
  EXPECT_FALSE(segment.contains("fraction"));
  EXPECT_FALSE(segment.contains("point"));
}

const std::string kTwoDoubts = R"(shapes.ball.disc.radius = 0.5
[[obstacles]]
shape = "ball"
at = [0.1, 1]
[[bodies]]
shape = "ball"
waypoints = [[-3, 0], [3, 0], [-3, 0], [-4, 0]]
)";

// There and back, without a hit that would end it: all was asked, and all is told.
TEST_F(MotionCommand, TellsOfAllSegmentsInDoubtWhereAnyContactWillDo) {
  const json answer = ask(kTwoDoubts, "--any --epsilon 0.01");
  EXPECT_EQ(answer.at("verdict"), "undecided");
  std::vector<std::string> verdicts;
  for (const json& segment : answer.at("segments")) verdicts.push_back(segment.at("verdict"));
  EXPECT_THAT(verdicts, testing::ElementsAre("undecided", "undecided", "free"));
}

TEST_F(MotionCommand, SaysAtOnceWhatTouchesAtTheStart) {
  const json answer = ask(R"(shapes.ball.disc.radius = 1
[[bodies]]
shape = "ball"
waypoints = [[0, 0], [0, 0]]
[[bodies]]
shape = "ball"
waypoints = [[0.5, 0], [3, 0]]
)");
  EXPECT_EQ(answer.at("segments").at(0).at("bracket"), json({0.0, 0.0}));
}

// --- the examples, by samples of the definition: no neighbourhoods, no hierarchies, no bounds ---

class MotionExample : public MotionCommand,
                      public testing::WithParamInterface<std::pair<const char*, const char*>> {};

TEST_P(MotionExample, IsWhatSamplesSay) {
  const auto [name, verdict] = GetParam();
  const LoadedMotion loaded = load_motion(kExamples + name + ".toml");
  ASSERT_EQ(loaded.errors(), 0);
  const json answer = ask_file(kExamples + name + ".toml");
  EXPECT_EQ(answer.at("verdict"), verdict);
  for (const json& segment : answer.at("segments")) {
    const std::size_t row = segment.at("segment");
    const bool free = segment.at("verdict") == "free";
    const double end = free ? 1.0 : segment.at("bracket").at(0).get<double>();
    constexpr int kSamples = 400;
    for (int i = 0; i <= kSamples && (free || end > 0.0); ++i)
      ASSERT_GT(least_distance(loaded.task, row, end * i / kSamples), i == kSamples && !free ? -1e-12 : 0.0)
          << row << " at " << end * i / kSamples;
    if (free) continue;
    EXPECT_LE(least_distance(loaded.task, row, segment.at("fraction")), 1e-12);
  }
}

INSTANTIATE_TEST_SUITE_P(All, MotionExample,
                         testing::Values(std::pair("sofa", "free"), std::pair("large_sofa", "hit"),
                                         std::pair("post", "free"), std::pair("arm", "free"),
                                         std::pair("crossing", "hit"), std::pair("gears", "free")),
                         [](const auto& example) { return std::string(example.param.first); });

// The bar comes as near as 0.1 mm while it turns: no bound that forgets how it turns can tell.
TEST_F(MotionCommand, TellsAClearanceOfATenthOfAMillimetre) {
  const json answer = ask_file(kExamples + "post.toml");
  EXPECT_EQ(answer.at("verdict"), "free");
  EXPECT_GT(answer.at("evaluations"), 3);
  const LoadedMotion loaded = load_motion(kExamples + "post.toml");
  EXPECT_NEAR(least_distance(loaded.task, 0, 2.0 / 3), 1e-4, 1e-9);
}

// --- files ---

const std::string kHostile = R"(name = "</script><script>alert(1)</script><b>&"
description = "<img src=x onerror=alert(1)>"
[shapes]
ball = { disc = { radius = 0.5 } }
[[obstacles]]
name = "<i>post</i>"
shape = "ball"
at = [2, 0]
[[bodies]]
name = "<u>ball</u>"
shape = "ball"
waypoints = [[0, 0], [4, 0]]
)";

TEST_F(MotionCommand, DrawsAPicture) {
  const std::string png = path("m.png");
  ask(kHostile, "--png " + png + " --width 400");
  EXPECT_EQ(read(png).substr(0, 8), "\x89PNG\r\n\x1a\n");
  EXPECT_THAT(read(png), HasSubstr("IEND"));
  write("m.png", "old");
  ask(kHostile, "--any --png " + png);
  EXPECT_EQ(read(png).substr(1, 3), "PNG");
}

json given(const std::string& page) {
  const std::string opening = "<script id=\"given\" type=\"application/json\">";
  const std::size_t begin = page.find(opening) + opening.size();
  return json::parse(page.substr(begin, page.find("</script>", begin) - begin));
}

TEST_F(MotionCommand, ShowsTheFirstOfSeveralDoubts) {
  ask("name = 'x'\n" + kTwoDoubts, "--epsilon 0.01 --html " + path("m.html"));
  EXPECT_THAT(given(read(path("m.html"))).at("summary"), HasSubstr("of segment 0"));
}

// It happened: of more than 2048 segments each second waypoint was looked at.
TEST_F(MotionCommand, FramesEveryWaypointOfALongPath) {
  std::string waypoints;
  for (int i = 0; i < 3001; ++i) waypoints += i == 1501 ? "[0, 50]," : "[0, 0],";
  ask("shapes.ball.disc.radius = 0.5\n[[bodies]]\nshape = 'ball'\nwaypoints = [" + waypoints + "]\n",
      "--html " + path("m.html"));
  const json extent = given(read(path("m.html"))).at("extent");
  EXPECT_GE(extent.at(3).get<double>() - extent.at(1).get<double>(), 51.0);
}

TEST_F(MotionCommand, WritesAPageInWhichStrangersWordsAreOnlyText) {
  const std::string file = path("m.html");
  ask(kHostile, "--html " + file);
  const std::string page = read(file);
  EXPECT_THAT(page, Not(HasSubstr("<script>alert")));
  EXPECT_THAT(page, Not(HasSubstr("<img")));
  EXPECT_THAT(page, Not(HasSubstr("<u>")));
  const json given = throng::given(page);
  EXPECT_EQ(given.at("name"), "</script><script>alert(1)</script><b>&");
  EXPECT_EQ(given.at("segments").at(0).at("pair"), json({"<u>ball</u>", "<i>post</i>"}));
  EXPECT_EQ(given.at("obstacles").size(), 1u);
  EXPECT_GE(given.at("lanes").at(0).at("strips").size(), 1u);
  EXPECT_THAT(page, Not(HasSubstr("@GIVEN@")));
}

TEST_F(MotionCommand, LeavesNoHalfFile) {
  std::filesystem::create_directory(path("folder"));
  const std::string motion = write("m.toml", "motion = 1\n" + kHostile);
  for (const char* option : {"--png ", "--html "}) {
    const Result result = throng("motion " + motion + " " + option + path("folder"));
    EXPECT_EQ(result.exit_code, 2);
    EXPECT_THAT(result.err, HasSubstr("folder"));
    EXPECT_EQ(throng("motion " + motion + " " + option + path("none/there")).exit_code, 2);
  }
  const auto files = std::distance(std::filesystem::directory_iterator(path("")), {});
  EXPECT_EQ(files, 4);  // the folder, m.toml and what the program said
}

// It happened: --png m.toml left a picture in its place.
TEST_F(MotionCommand, OverwritesNeitherWhatItReadsNorWhatItWrites) {
  const std::string motion = write("m.toml", "motion = 1\n" + kHostile), same = write("plain", read(motion));
  const auto refused = [&](const std::string& arguments) {
    const Result result = throng("motion " + arguments);
    EXPECT_EQ(result.exit_code, 2) << arguments;
    EXPECT_EQ(result.out, "") << arguments;
    return result.err;
  };
  for (const char* option : {" --png ", " --html "}) {
    EXPECT_THAT(refused(motion + option + path("./m.toml")), HasSubstr("it is the motion file"));
    EXPECT_THAT(refused(same + option + same), HasSubstr("it is the motion file"));
  }
  EXPECT_THAT(refused(motion + " --png " + path("a") + " --html " + path("./a")),
              HasSubstr("--png and --html name the same file"));
  EXPECT_THAT(refused(motion + " --png " + path("a.html")), HasSubstr("what is written ends in .png"));
  EXPECT_THAT(refused(motion + " --html " + path("b.png")), HasSubstr("what is written ends in .html"));
  EXPECT_EQ(read(motion), "motion = 1\n" + kHostile);
  EXPECT_EQ(read(same), read(motion));
  EXPECT_FALSE(std::filesystem::exists(path("a")));
}

TEST_F(MotionCommand, RefusesABadFileWithItsFaults) {
  const Result result = throng("motion " + write("m.toml", "motion = 1\nshape = 2\nbodys = 3\n"));
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_EQ(result.out, "");
  EXPECT_THAT(result.err, HasSubstr("m.toml:2:1: error: shape: unknown key, did you mean \"shapes\"?"));
  EXPECT_THAT(result.err, HasSubstr("m.toml:3:1: error: bodys: unknown key, did you mean \"bodies\"?"));
  EXPECT_EQ(throng("motion " + path("no.toml")).exit_code, 2);
  EXPECT_EQ(throng("motion").exit_code, 2);
  const std::string motion = write("good.toml", "motion = 1\n" + kHostile);
  for (const char* epsilon : {"-1", "nan", "NaN", "-nan", "inf", "0x1", "1e10", "a"}) {
    const Result refused = throng("motion " + motion + " --epsilon " + epsilon, "timeout 20 ");
    EXPECT_EQ(refused.exit_code, 2) << epsilon << refused.err;
    EXPECT_THAT(refused.err, HasSubstr("--epsilon")) << epsilon;
  }
}

// 60 bodies are 1770 pairs and 180 links; a small file could take all memory.
TEST_F(MotionCommand, RefusesMoreThanFitsIntoMemory) {
  std::string text = "motion = 1\nshapes.ball.disc.radius = 0.1\n";
  for (int i = 0; i < 60; ++i) {
    text += "[[bodies]]\nshape = 'ball'\nwaypoints = [";
    for (int k = 0; k < (i == 0 ? 5130 : 1); ++k) text += "[" + std::to_string(i) + ", 0],";
    text += "]\n";
  }
  const Result result = throng("motion " + write("m.toml", text), "timeout 60 ");
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_THAT(result.err, HasSubstr("180 links and 1770 pairs that may not touch, times 5129 segments"));
}

TEST_F(MotionCommand, PrintsItsFieldsAndItsSchema) {
  EXPECT_THAT(throng("motion --fields").out, HasSubstr("\nrobots[].links[].joint "));
  EXPECT_EQ(throng("motion --schema").out, read(kExamples + "motion.schema.json"));
}

}  // namespace
}  // namespace throng
