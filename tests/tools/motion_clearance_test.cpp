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
  EXPECT_TRUE(
      ask("shapes.s.disc.radius = 1\n[[bodies]]\nshape = 's'\nwaypoints = [[0, 0], [1, 1]]\n", "--clearance")
          .at("clearance")
          .is_null());
}

// It happened: a doubt at the first margin asked ended the search, with nothing proven.
TEST_F(MotionCommand, ProvesWhatIsBelowADoubt) {
  std::string scene = kPassing;
  scene.replace(scene.find("[4, 1.25]"), 9, "[4.03, 1.25]");
  const json answer = ask(scene, "--clearance --epsilon 0.2");
  ASSERT_EQ(answer.at("verdict"), "free");
  EXPECT_GE(answer.at("clearance").at("bracket").at(0), 0.999 * (0.25 - 0.2))
      << "what epsilon leaves no doubt of";
  EXPECT_LE(answer.at("clearance").at("bracket").at(0), 0.25);
  EXPECT_NEAR(answer.at("clearance").at("bracket").at(1).get<double>(), 0.25, 1e-12);
}

// It happened: three looks a segment at least, and 30,000 here.
TEST_F(MotionCommand, LooksAtALongPathHereAndThere) {
  std::string waypoints;
  for (int i = 0; i < 9000; ++i) waypoints += "[0, 0],";
  const json answer =
      ask("shapes.ball.disc.radius = 0.5\n[[obstacles]]\nshape = 'ball'\nat = [0, 1.25]\n"
          "[[bodies]]\nshape = 'ball'\nwaypoints = [" +
              waypoints + "]\n",
          "--clearance");
  const json& clearance = answer.at("clearance");
  EXPECT_NEAR(clearance.at("bracket").at(1).get<double>(), 0.25, 1e-12);
  EXPECT_LE(clearance.at("evaluations").get<int>(), answer.at("evaluations").get<int>() + 1200);
}

/// A chain of three rods that its limits keep nearly straight: the outer ones are 1 m apart, or a little
/// less.
const std::string kStraight = R"(shapes.rod.segment = [[0, 0], [1, 0]]
[[robots]]
name = "arm"
links = [{ shape = 'rod' }, { shape = 'rod', at = [1, 0], limits = [-0.1, 0.1] },
         { shape = 'rod', at = [1, 0], limits = [-0.1, 0.1] }]
waypoints = [[0, 0, 0]]
)";

// It happened: what the limits keep apart was not compared, however large the margin.
TEST_F(MotionCommand, MeasuresLinksThatTheirLimitsKeepApart) {
  EXPECT_EQ(ask(kStraight, "--margin 1.5").at("verdict"), "hit");
  const json one = ask(kStraight, "--waypoint 0 --margin 1.5");
  EXPECT_EQ(one.at("verdict"), "hit");
  EXPECT_NEAR(one.at("distance").get<double>(), 1.0, 1e-15);
  EXPECT_EQ(one.at("pair"), json({"arm.links[0]", "arm.links[2]"}));
  const json clearance = ask(kStraight, "--clearance").at("clearance");
  ASSERT_TRUE(clearance.is_object()) << clearance;
  EXPECT_NEAR(clearance.at("bracket").at(1).get<double>(), 1.0, 1e-15);
  EXPECT_GE(clearance.at("bracket").at(0), 0.999);
}

// Between two looks the ball passes the post; at all of them the wall is nearer.
TEST_F(MotionCommand, FindsAClearanceThatNoLookMeets) {
  const json bracket = ask(R"(shapes.ball.disc.radius = 0.01
[[walls]]
segment = [[-9, -0.5], [109, -0.5]]
[[obstacles]]
shape = "ball"
at = [50.78, 0.05]
[[bodies]]
shape = "ball"
waypoints = [[0, 0], [100, 0]]
)",
                           "--clearance")
                           .at("clearance")
                           .at("bracket");
  EXPECT_LE(bracket.at(0), 0.03);
  EXPECT_GE(bracket.at(0), 0.999 * 0.03 - 1e-12);
  EXPECT_NEAR(bracket.at(1).get<double>(), 0.03, 1e-6);
}

// The same of an arm that folds between two looks, and that its limits keep off itself.
TEST_F(MotionCommand, FindsHowNearLimitsLetLinksComeThatNoLookMeets) {
  std::string waypoints;
  for (int i = 0; i < 2000; ++i) waypoints += i == 977 ? "[0, 1.7, 1.7]," : "[0, 0, 0],";
  const json bracket = ask("shapes.rod.segment = [[0, 0], [1, 0]]\n[[robots]]\nlinks = [{ shape = 'rod' }, "
                           "{ shape = 'rod', at = [1, 0], limits = [-1.7, 1.7] }, "
                           "{ shape = 'rod', at = [1, 0], limits = [-1.7, 1.7] }]\nwaypoints = [" +
                               waypoints + "]\n",
                           "--clearance")
                           .at("clearance")
                           .at("bracket");
  const double least =
      std::hypot(1 + std::cos(1.7) + std::cos(3.4), std::sin(1.7) + std::sin(3.4));  // of the tip
  EXPECT_LE(bracket.at(0), least);
  EXPECT_GE(bracket.at(0), 0.999 * least - 1e-12);
  EXPECT_NEAR(bracket.at(1).get<double>(), least, 1e-6);
}

// What README says of links between which at most one joint moves.
TEST_F(MotionCommand, ComparesWhatAJointHoldsThatKeepsItsValueNotWhatIsFixed) {
  const auto verdict = [&](const std::string& mast, const std::string& value) {
    return ask("shapes.rod.segment = [[0, 0], [1, 0]]\n[[robots]]\nlinks = [{ shape = 'rod' }, { shape = "
               "'rod', "
               "at = [1, 0] }, { shape = 'rod', at = [0.5, 0], " +
               mast + " }]\nwaypoints = [[0, 0" + value + "], [0, 3.1" + value + "]]\n")
        .at("verdict");
  };
  EXPECT_EQ(verdict("joint = 'fixed', angle = 1.57", ""), "free");
  EXPECT_EQ(verdict("angle = 1.57", ", 0"), "hit");
  EXPECT_THAT(throng("motion --fields").out, HasSubstr("what is fixed on a link counts as that link"));
}

TEST_F(MotionCommand, ShowsAClearanceInItsHelpThatThereIs) {
  EXPECT_THAT(throng("motion --help").out, HasSubstr("post.toml --margin 5e-5 --clearance\n"));
  const json answer = ask_file(kExamples + "post.toml", "--margin 5e-5 --clearance");
  EXPECT_TRUE(answer.at("clearance").is_object());
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
      least = std::min(
          least, least_distance(task, i > kSamples, (i > kSamples ? i - kSamples : i) / 1.0 / kSamples));
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
  EXPECT_THAT(beyond.err, HasSubstr("--waypoint 3: they are 0 to 2"));
  const Result before = throng("motion " + path("m.toml") + " --waypoint -1");
  EXPECT_EQ(before.exit_code, 2);
  EXPECT_THAT(before.err, HasSubstr("--waypoint -1: they are 0 to 2"));
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
  const std::string told = "free at a margin of 0.2 m, clearance ", whole = line("--clearance --margin 0.2");
  EXPECT_EQ(whole.substr(0, told.size()), told);
  EXPECT_GE(std::stod(whole.substr(told.size())), 0.24975 - 1e-6);
  EXPECT_THAT(line("--margin 0.4"), testing::StartsWith("hit at a margin of 0.4 m: ball – post at 0.18"));
  EXPECT_EQ(line("--waypoint 1"), "free: ball – post 0.600781 m apart\n");
  EXPECT_EQ(line("--waypoint 1 --margin 0.7"), "hit at a margin of 0.7 m: ball – post 0.600781 m apart\n");
  write("m.toml",
        "motion = 1\nshapes.ball.disc.radius = 0.5\n[[bodies]]\nname = 'a'\nshape = 'ball'\n"
        "waypoints = [[0, 0]]\n[[bodies]]\nname = 'b'\nshape = 'ball'\nwaypoints = [[0.75, 0]]\n");
  EXPECT_EQ(throng("motion " + path("m.toml") + " --waypoint 0 --summary").out, "hit: a – b 0.25 m deep\n");
}

// It happened: six digits of it, rounded to the nearest, were more than what was proven.
TEST_F(MotionCommand, SumsUpABoundByNoMoreThanIsProven) {
  for (const char* y : {"1.25", "1.3137", "1.7771", "2.0243", "2.9997", "11.00007"}) {
    std::string scene = kPassing;
    scene.replace(scene.find("1.25"), 4, y);
    const double low = ask(scene, "--clearance").at("clearance").at("bracket").at(0);
    const std::string line = throng("motion " + path("m.toml") + " --clearance --summary").out;
    const double shown = std::stod(line.substr(line.find("clearance ") + 10));
    EXPECT_LE(shown, low) << line;
    EXPECT_GE(shown, low * (1.0 - 2e-5)) << line;
  }
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
