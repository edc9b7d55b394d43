// SPDX-License-Identifier: MIT
// throng motion --margin, --clearance, --waypoint and --summary, as users ask them.
#include <gmock/gmock.h>

#include <cmath>
#include <random>

#include "tests/tools/motion_program.h"

namespace throng {
namespace {

using testing::HasSubstr;

/// A disc passes a post at 0.25 m, half way through the second segment.
const std::string kPassing = R"(durations = [1, 2]
shapes.ball.disc.radius = 0.5
[[obstacles]]
name = "post"
shape = "ball"
at = [4, 1.25]
[[bodies]]
name = "ball"
shape = "ball"
waypoints = [[0, 0], [3, 0], [5, 0]]
)";

TEST_F(MotionCommand, CallsFreeWhatIsFreeByTheMargin) {
  const auto verdict = [&](const std::string& margin) {
    return ask(kPassing, "--margin " + margin).at("verdict").get<std::string>();
  };
  EXPECT_EQ(verdict("0"), "free");
  EXPECT_EQ(verdict("0.249999"), "free");
  EXPECT_NE(verdict("0.25"), "free");
  EXPECT_EQ(verdict("0.250001"), "hit");
  EXPECT_EQ(verdict("3"), "hit");
}

// The two come as near as the margin x before the post: (1 + 0.4)^2 = 1.25^2 + x^2.
TEST_F(MotionCommand, TellsWhenAMarginIsFirstViolated) {
  const json answer = ask("margin = 0.4\n" + kPassing);
  EXPECT_EQ(answer.at("margin"), 0.4);
  EXPECT_EQ(answer.at("segments").at(0).at("verdict"), "free");
  const json& second = answer.at("segments").at(1);
  EXPECT_EQ(second.at("pair"), json({"ball", "post"}));
  const double x = std::sqrt(1.4 * 1.4 - 1.25 * 1.25);
  EXPECT_NEAR(second.at("fraction").get<double>(), (1 - x) / 2, 1e-9);
  EXPECT_NEAR(second.at("point").at(0).get<double>(), 4 - x / 2, 1e-9);  // half way
  EXPECT_NEAR(second.at("point").at(1).get<double>(), 0.625, 1e-9);
  EXPECT_EQ(ask("margin = 0.4\n" + kPassing, "--margin 0.1").at("verdict"), "free") << "the option wins";
  EXPECT_FALSE(ask(kPassing).contains("margin"));
}

// A margin is a rounding of both shapes by half of it, of polygons too.
TEST_F(MotionCommand, KeepsAMarginAsRoundedShapesDo) {
  const auto scene = [](const std::string& radius) {
    return "shapes.box = { polygon = [[0, 0], [1, 0], [1, 1], [0, 1]], radius = " + radius +
           " }\nshapes.rod = { segment = [[-1, 0], [1, 0]], radius = " + radius + R"( }
[[obstacles]]
shape = "box"
at = [0.5, 1]
[[bodies]]
shape = "rod"
waypoints = [[-5, 0, 0], [5, 0.5, 4]]
)";
  };
  const json grown = ask(scene("0.25")), kept = ask(scene("0"), "--margin 0.5");
  EXPECT_EQ(grown.at("verdict"), "hit");
  EXPECT_NEAR(grown.at("segments").at(0).at("fraction").get<double>(),
              kept.at("segments").at(0).at("fraction").get<double>(), 1e-10);
}

TEST_F(MotionCommand, KeepsAMarginBetweenLinksToo) {
  const std::string arm = R"(shapes.rod.segment = [[0, 0], [1, 0]]
[[robots]]
links = [{ shape = 'rod' }, { at = [1, 0], shape = 'rod' }, { at = [1, 0], shape = 'rod' }]
waypoints = [[0, 0, 0], [0, 2.2, 1.2]]
)";
  EXPECT_EQ(ask(arm).at("verdict"), "free");
  EXPECT_EQ(ask(arm, "--margin 0.9").at("verdict"), "hit");
}

TEST_F(MotionCommand, BracketsTheLeastClearance) {
  const json answer = ask(kPassing, "--clearance"), clearance = answer.at("clearance");
  EXPECT_EQ(answer.at("verdict"), "free");
  EXPECT_LE(clearance.at("bracket").at(0), 0.25);
  EXPECT_GE(clearance.at("bracket").at(0), 0.24975 - 1e-12);
  EXPECT_NEAR(clearance.at("bracket").at(1).get<double>(), 0.25, 1e-12);
  EXPECT_EQ(clearance.at("segment"), 1);
  EXPECT_NEAR(clearance.at("fraction").get<double>(), 0.5, 1e-6);
  EXPECT_EQ(clearance.at("pair"), json({"ball", "post"}));
  EXPECT_NEAR(clearance.at("points").at(0).at(1).get<double>(), 0.5, 1e-9);
  EXPECT_NEAR(clearance.at("points").at(1).at(1).get<double>(), 0.75, 1e-9);
  EXPECT_FALSE(ask(kPassing, "--clearance --margin 0.3").contains("clearance")) << "of free paths alone";
  EXPECT_TRUE(ask("shapes.s.disc.radius = 1\n[[bodies]]\nshape = 's'\nwaypoints = [[0, 0], [1, 1]]\n", "--clearance")
                  .at("clearance")
                  .is_null());
}

TEST_F(MotionCommand, FindsAClearanceOfATenthOfAMillimetre) {
  const json bracket = ask_file(kExamples + "post.toml", "--clearance").at("clearance").at("bracket");
  EXPECT_LE(bracket.at(0), 1e-4);
  EXPECT_GE(bracket.at(0), 0.999e-4 - 1e-12);
  EXPECT_NEAR(bracket.at(1).get<double>(), 1e-4, 1e-10);
}

/// Rods, boxes and discs that turn on their way through three obstacles.
std::string random_scene(std::mt19937& random) {
  std::uniform_real_distribution<double> place(-4, 4), turn(-4, 4);
  std::uniform_int_distribution<int> shape(0, 2);
  const char* const shapes[] = {"rod", "box", "disc"};
  std::ostringstream text;
  text.precision(17);
  text << "shapes.rod = { segment = [[-1, 0], [1, 0]], radius = 0.05 }\nshapes.disc.disc.radius = 0.3\n"
          "shapes.box.polygon = [[0, 0], [1, 0], [0.5, 0.5], [0, 1]]\n";
  for (int i = 0; i < 3; ++i)
    text << "[[obstacles]]\nshape = '" << shapes[shape(random)] << "'\nat = [" << place(random) << ", "
         << place(random) << "]\nangle = " << turn(random) << "\n";
  text << "[[bodies]]\nshape = '" << shapes[shape(random)] << "'\nwaypoints = [";
  for (int i = 0; i < 3; ++i)
    text << "[" << place(random) << ", " << place(random) << ", " << turn(random) << "], ";
  text << "]\n";
  return text.str();
}

TEST_F(MotionCommand, ProvesClearancesThatSamplesAndMarginsAgreeWith) {
  constexpr unsigned kSeed = 7;
  std::mt19937 random(kSeed);
  constexpr int kTrials = 40, kSamples = 400;
  int free = 0;
  for (int trial = 0; trial < kTrials; ++trial) {
    SCOPED_TRACE("seed " + std::to_string(kSeed) + ", trial " + std::to_string(trial));
    const std::string scene = random_scene(random);
    const json answer = ask(scene, "--clearance");
    if (answer.at("verdict") != "free") continue;
    ++free;
    const json& clearance = answer.at("clearance");
    const double low = clearance.at("bracket").at(0), high = clearance.at("bracket").at(1);
    EXPECT_LE(0.999 * high, low + 1e-12);
    EXPECT_LE(low, high);
    const MotionTask task = load_motion_text("motion = 1\n" + scene, "m.toml").task;
    EXPECT_NEAR(least_distance(task, clearance.at("segment"), clearance.at("fraction")), high, 1e-12);
    double least = 1e300;
    for (int i = 0; i <= 2 * kSamples; ++i)
      least = std::min(least, least_distance(task, i > kSamples, (i > kSamples ? i - kSamples : i) / 1.0 / kSamples));
    EXPECT_GE(least, low);
    std::ostringstream below, above;
    below.precision(17), above.precision(17);
    below << "--margin " << low;
    above << "--margin " << high * (1 + 1e-9);
    EXPECT_EQ(ask(scene, below.str()).at("verdict"), "free");
    EXPECT_EQ(ask(scene, above.str()).at("verdict"), "hit");
  }
  EXPECT_GT(free, kTrials / 5);
  EXPECT_LT(free, kTrials * 4 / 5);
}

// --- one configuration ---

TEST_F(MotionCommand, AnswersForOneWaypoint) {
  const json answer = ask(kPassing, "--waypoint 1");  // (3, 0) and (4, 1.25)
  EXPECT_EQ(answer.at("waypoint"), 1);
  EXPECT_EQ(answer.at("verdict"), "free");
  EXPECT_NEAR(answer.at("distance").get<double>(), std::sqrt(1 + 1.25 * 1.25) - 1, 1e-15);
  EXPECT_EQ(answer.at("pair"), json({"ball", "post"}));
  EXPECT_GT(answer.at("normal").at(0), 0.0);
  EXPECT_FALSE(answer.contains("segments"));
  EXPECT_EQ(ask(kPassing, "--waypoint 1 --margin 0.7").at("verdict"), "hit");
  const json last = ask(kPassing, "--waypoint 2");
  EXPECT_NEAR(last.at("distance").get<double>(), std::sqrt(1 + 1.25 * 1.25) - 1, 1e-15);
  EXPECT_LT(last.at("normal").at(0), 0.0);
  const Result beyond = throng("motion " + path("m.toml") + " --waypoint 3");
  EXPECT_EQ(beyond.exit_code, 2);
  EXPECT_THAT(beyond.err, HasSubstr("--waypoint 3: the last one is 2"));
  EXPECT_EQ(throng("motion " + path("m.toml") + " --waypoint 1 --clearance").exit_code, 2);
}

TEST_F(MotionCommand, SaysHowDeepAConfigurationOverlaps) {
  const std::string standing = R"(shapes.ball.disc.radius = 0.5
[[obstacles]]
shape = "ball"
at = [0.75, 0]
[[bodies]]
shape = "ball"
waypoints = [[0, 0]]
)";
  const json one = ask(standing, "--waypoint 0"), path = ask(standing);
  EXPECT_EQ(one.at("verdict"), "hit");
  EXPECT_NEAR(one.at("distance").get<double>(), -0.25, 1e-15);
  EXPECT_EQ(path.at("verdict"), "hit") << "and who stands still is a path too";
  EXPECT_EQ(path.at("segments").at(0).at("fraction"), 0.0);
}

// --- in and out ---

TEST_F(MotionCommand, SumsUpInALine) {
  const auto line = [&](const std::string& options) {
    return throng("motion " + write("m.toml", "motion = 1\n" + kPassing) + " --summary " + options).out;
  };
  EXPECT_EQ(line(""), "free\n");
  EXPECT_EQ(line("--clearance --margin 0.2").substr(0, 40), "free at a margin of 0.2 m, clearance 0.2");
  EXPECT_THAT(line("--margin 0.4"), testing::StartsWith("hit at a margin of 0.4 m: ball – post at 0.18"));
  EXPECT_EQ(line("--waypoint 1"), "free: ball – post 0.600781 m\n");
}

TEST_F(MotionCommand, ReadsTheStandardInput) {
  const std::string file = write("m.toml", "motion = 1\n" + kPassing);
  const Result piped = throng("motion - <" + file);
  EXPECT_EQ(piped.exit_code, 0) << piped.err;
  json expected = ask(kPassing);
  expected["motion"] = "standard input";
  EXPECT_EQ(json::parse(piped.out), expected);
  const Result faulty = throng("motion - <" + write("bad.toml", "motion = 1\nbodys = 3\n"));
  EXPECT_EQ(faulty.exit_code, 2);
  EXPECT_THAT(faulty.err, HasSubstr("standard input:2:1: error: bodys: unknown key"));
}

TEST_F(MotionCommand, SaysWhichCommandAFileIsFor) {
  const Result scenario = throng("motion " THRONG_SOURCE_DIR "/scenarios/pile.toml");
  EXPECT_EQ(scenario.exit_code, 2);
  EXPECT_THAT(scenario.err, HasSubstr("throng: this is a scenario; throng run runs it\n"));
  EXPECT_THAT(scenario.err, HasSubstr(": 1 error\n"));
  const Result motion = throng("run " + kExamples + "post.toml");
  EXPECT_EQ(motion.exit_code, 2);
  EXPECT_THAT(motion.err, HasSubstr("motion: this is a motion file; throng motion answers it\n"));
  EXPECT_THAT(motion.err, HasSubstr(": 1 error\n"));
}

}  // namespace
}  // namespace throng
