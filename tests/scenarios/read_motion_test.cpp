// SPDX-License-Identifier: MIT
// Motion files: what they may say, and each fault found at its place and named.
#include "scenarios/read_motion.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "scenarios/motion_grammar.h"
#include "scenarios/reference.h"
#include "scenarios/schema.h"

namespace throng {
namespace {

constexpr const char* kWholeMotion = R"toml(motion = 1
name = "everything"
description = "All fields of the grammar"
durations = [2.0, 0.5]
may_touch = [["bar", "post"], ["arm.hand", "obstacles"], ["arm", "robots[1]"]]
[shapes]
ball = { disc = { radius = 0.4 } }
frame = { polygon = [[0, 0], [4, 0], [4, 4], [0, 4]], holes = [[[1, 1], [2, 1], [2, 2]]] }
rod = { segment = [[0, 0], [1, 0]], radius = 0.1 }
soft = { polygon = [[0, 0], [1, 0], [1, 1]], radius = 0.1 }
pair = { discs = [[0, 0, 0.3], [0.4, 0, 0.2]] }
[[obstacles]]
name = "post"
shape = "ball"
at = [1, 2]
angle = 0.5
[[obstacles]]
shape = "soft"
[[walls]]
polyline = [[0, -5], [1, -5], [1, -6]]
[[walls]]
polygon = [[5, 5], [6, 5], [6, 6]]
[[bodies]]
name = "bar"
shape = "rod"
waypoints = [[0, 0, 0.5], [1, 0], [2, 0, 6.5]]
[[bodies]]
shape = "frame"
waypoints = [[7, 8]]
[[robots]]
name = "arm"
base = [1, 2, 0.25]
links = [
  { shape = "rod", limits = [-1, 1] },
  { name = "slide", joint = "prismatic", at = [1, 0], axis = [0, 5] },
  { name = "hand", shape = "pair", parent = 0, angle = 0.125 },
  { parent = "slide" },
  { parent = "base" },
]
waypoints = [[0, 1, 2, 3, 4], [0.5, 1, 2, 3, 4], [1, 1, 2, 3, 4]]
[[robots]]
links = [{}]
waypoints = [[0]]
)toml";

LoadedMotion load(const std::string& text) {
  return load_motion_text(text, "m.toml");
}

std::string faults(const LoadedMotion& loaded) {
  return to_string(loaded.diagnostics, "m.toml");
}

TEST(ReadMotion, TakesAllThatTheGrammarHas) {
  const LoadedMotion loaded = load(kWholeMotion);
  ASSERT_EQ(faults(loaded), "");
  const MotionTask& task = loaded.task;
  EXPECT_EQ(task.name, "everything");
  EXPECT_EQ(task.durations, (std::vector<double>{2.0, 0.5}));
  EXPECT_EQ(task.waypoints(), 3u);
  ASSERT_EQ(task.movers.size(), 4u);
  ASSERT_EQ(task.obstacles.size(), 4u);
  EXPECT_EQ(task.obstacles[0].at, Vec(1, 2));
  EXPECT_EQ(task.obstacles[0].angle, 0.5);
  EXPECT_EQ(task.obstacles[1].name, "obstacles[1]");
  EXPECT_EQ(task.obstacles[3].name, "walls[1]");
  EXPECT_EQ(task.shapes[task.obstacles[2].shape].parts.size(), 2u);  // a line of three points
  EXPECT_EQ(task.shapes[task.obstacles[3].shape].parts.size(), 3u);  // a closed one
}

TEST(ReadMotion, LeavesShapesWhereTheirOriginsAre) {
  const MotionTask task = load(kWholeMotion).task;
  EXPECT_EQ(task.shapes[1].name, "frame");
  ASSERT_EQ(task.shapes[1].rings.size(), 2u);
  EXPECT_EQ(task.shapes[1].rings[0][0], Vec(0, 0));
  EXPECT_EQ(task.shapes[0].parts[0].radius, 0.4);
  EXPECT_EQ(task.shapes[3].parts[0].vertices[1], Vec(1, 0));  // "rod"
  EXPECT_EQ(task.shapes[3].parts[0].radius, 0.1);
  EXPECT_EQ(task.shapes[4].parts[0].radius, 0.1);  // "soft", which looks as its parts
  EXPECT_TRUE(task.shapes[4].rings.empty());
}

TEST(ReadMotion, MakesABodyOfTwoSlidesAndATurn) {
  const Mover bar = load(kWholeMotion).task.movers[0];
  ASSERT_EQ(bar.links.size(), 3u);
  EXPECT_EQ(bar.links[0].axis, Vec(1, 0));
  EXPECT_EQ(bar.links[1].axis, Vec(0, 1));
  EXPECT_EQ(bar.links[1].shape, MotionLink::kNone);
  EXPECT_EQ(bar.links[2].joint, narrowphase::Joint::revolute);
  EXPECT_EQ(bar.links[2].shape, 3u);
  EXPECT_EQ(bar.waypoints, (std::vector<std::vector<double>>{{0, 0, 0.5}, {1, 0, 0.5}, {2, 0, 6.5}}));
}

TEST(ReadMotion, KeepsWhoHasOneWaypointThere) {
  const Mover frame = load(kWholeMotion).task.movers[1];
  EXPECT_EQ(frame.name, "bodies[1]");
  EXPECT_EQ(frame.waypoints, std::vector<std::vector<double>>(3, {7, 8, 0}));
}

TEST(ReadMotion, FindsTheParentsOfLinks) {
  const Mover arm = load(kWholeMotion).task.movers[2];
  ASSERT_EQ(arm.links.size(), 5u);
  EXPECT_EQ(arm.base_angle, 0.25);
  EXPECT_EQ(arm.links[0].parent, MotionLink::kNone);
  EXPECT_EQ(arm.links[0].name, "arm.links[0]");
  EXPECT_EQ(arm.links[1].parent, 0u);
  EXPECT_EQ(arm.links[1].axis, Vec(0, 1));
  EXPECT_EQ(arm.links[2].parent, 0u);
  EXPECT_EQ(arm.links[2].name, "arm.hand");
  EXPECT_EQ(arm.links[3].parent, 1u);
  EXPECT_EQ(arm.links[4].parent, MotionLink::kNone);
  EXPECT_EQ(arm.links[0].upper, 1.0);
}

TEST(ReadMotion, GivesFixedJointsNoValueInWaypoints) {
  const LoadedMotion loaded = load(R"(motion = 1
[[robots]]
links = [{ joint = "fixed", at = [1, 2], angle = 0.5 }, {}, { joint = "fixed" }, { joint = "prismatic" }]
waypoints = [[1, 2], [3, 4]]
)");
  ASSERT_EQ(faults(loaded), "");
  const Mover& robot = loaded.task.movers[0];
  EXPECT_EQ(robot.waypoints, (std::vector<std::vector<double>>{{0, 1, 0, 2}, {0, 3, 0, 4}}));
  EXPECT_EQ(robot.links[0].at, Vec(1, 2));
  EXPECT_EQ(robot.links[0].angle, 0.5);
  EXPECT_EQ(robot.links[2].lower, 0.0);
  EXPECT_EQ(robot.links[2].upper, 0.0);
}

TEST(ReadMotion, LetsAllStandStill) {
  const LoadedMotion loaded = load(
      "motion = 1\nmargin = 0.5\nshapes.ball.disc.radius = 1\n[[bodies]]\nshape = 'ball'\nwaypoints = [[1, "
      "2]]\n");
  ASSERT_EQ(faults(loaded), "");
  EXPECT_EQ(loaded.task.waypoints(), 2u);
  EXPECT_EQ(loaded.task.movers[0].waypoints[1], (std::vector<double>{1, 2, 0}));
  EXPECT_EQ(loaded.task.margin, 0.5);
}

TEST(ReadMotion, SaysWhatAScenarioIs) {
  EXPECT_EQ(faults(load("throng = 1\nbodys = 3\n")),
            "m.toml:1:10: error: throng: this is a scenario; throng run runs it\n");
}

TEST(ReadMotion, CountsNamesThrough) {
  const MotionTask task = load(kWholeMotion).task;  // 3 + 3 + 5 + 1 links, then the obstacles
  ASSERT_EQ(task.may_touch.size(), 3u);
  EXPECT_EQ(task.may_touch[0].first.first, 0u);
  EXPECT_EQ(task.may_touch[0].first.count, 3u);
  EXPECT_EQ(task.may_touch[0].second.first, 12u);
  EXPECT_EQ(task.may_touch[1].first.first, 8u);
  EXPECT_EQ(task.may_touch[1].first.count, 1u);
  EXPECT_EQ(task.may_touch[1].second.first, 12u);
  EXPECT_EQ(task.may_touch[1].second.count, 4u);
  EXPECT_EQ(task.may_touch[2].first.first, 6u);
  EXPECT_EQ(task.may_touch[2].first.count, 5u);
  EXPECT_EQ(task.may_touch[2].second.first, 11u);
}

TEST(ReadMotion, TakesAScenarioForSurroundings) {
  const std::filesystem::path folder = std::filesystem::temp_directory_path() / "throng-read-motion";
  std::filesystem::create_directories(folder);
  std::ofstream(folder / "room.toml") << R"(throng = 1
domain = { box = [[0, 0], [9, 9]] }
[shapes]
ball = { disc = { radius = { uniform = [0.1, 0.2] } } }
brick = { polygon = [[0, 0], [2, 0], [2, 2], [0, 2]] }
[[bodies]]
shape = "ball"
count = 50
place = { random = { within = [[0, 0], [9, 5]] } }
[[bodies]]
shape = "brick"
at = [7, 7]
[[walls]]
segment = [[1, 8], [2, 8]]
)";
  std::ofstream(folder / "m.toml") << R"(motion = 1
surroundings = "room.toml"
shapes.a.disc.radius = 1
[[bodies]]
shape = "a"
waypoints = [[0, 0], [1, 1]]
)";
  const LoadedMotion loaded = load_motion((folder / "m.toml").string());
  ASSERT_EQ(faults(loaded), "");
  const std::vector<Obstacle>& obstacles = loaded.task.obstacles;
  ASSERT_EQ(obstacles.size(), 53u);
  EXPECT_EQ(obstacles[50].name, "surroundings.bodies[50]");
  EXPECT_EQ(obstacles[50].at, Vec(7, 7));  // of the centre of mass, as scenarios have it
  EXPECT_EQ(loaded.task.shapes[obstacles[50].shape].rings[0][0], Vec(-1, -1));
  EXPECT_EQ(obstacles[51].name, "surroundings.walls[0]");
  EXPECT_EQ(loaded.task.shapes[obstacles[52].shape].parts.size(), 4u);
  std::ofstream(folder / "room.toml") << "throng = 2\n";
  EXPECT_NE(faults(load_motion((folder / "m.toml").string()))
                .find("2:16: error: surroundings: can't be used, with 1 error: " +
                      (folder / "room.toml").string() + ":1:10: error: throng: must be 1"),
            std::string::npos);
  std::filesystem::remove_all(folder);
}

TEST(MotionSchema, IsWhatTheCheckedInFileSays) {
  std::ifstream file(THRONG_SOURCE_DIR "/scenarios/motions/motion.schema.json");
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  EXPECT_EQ(text, scenarios::motion_schema())
      << "run: throng motion --schema > scenarios/motions/motion.schema.json";
}

TEST(MotionReference, HasEveryFieldOfTheRoot) {
  const std::string text = scenarios::reference(scenarios::motion_grammar(), scenarios::kAboutMotions);
  for (const scenarios::Field& field : scenarios::motion_grammar().fields)
    EXPECT_NE(text.find("\n" + field.key + " "), std::string::npos) << field.key;
}

struct FaultyMotion {
  const char* text;  ///< after "motion = 1" and two shapes
  const char* fault;
};

#define BALL "[[bodies]]\nshape = 'ball'\n"
#define ROBOT "[[robots]]\nlinks = [{ limits = [-1, 1] }, { shape = 'rod' }]\n"

const FaultyMotion kFaultyMotions[] = {
    // keys and names
    {"naem = 'x'", "m.toml:5:1: error: naem: unknown key, did you mean \"name\"?"},
    {"obstacels = []", "unknown key, did you mean \"obstacles\"?"},
    {BALL "waypoint = [[0, 0]]",
     "m.toml:7:1: error: bodies[0].waypoint: unknown key, did you mean \"waypoints\"?"},
    {BALL "at = [0, 0]\nwaypoints = [[0, 0], [1, 1]]", "bodies[0].at: unknown key"},
    {"[[bodies]]\nshape = 'bal'\nwaypoints = [[0, 0]]",
     "m.toml:6:9: error: bodies[0].shape: there is no \"bal\" in [shapes], did you mean \"ball\"?"},
    {"[[bodies]]\nwaypoints = [[0, 0], [1, 1]]", "bodies[0].shape: is missing"},
    {BALL, "bodies[0].waypoints: is missing: a list of 1 to 10000 poses"},
    {"[[obstacles]]\nat = [0, 0]", "obstacles[0].shape: is missing"},
    {"may_touch = [['ball', 'post']]\n" BALL "waypoints = [[0, 0], [1, 1]]\nname = 'bal'",
     "m.toml:5:15: error: may_touch[0][0]: nothing is called \"ball\", did you mean \"bal\"?"},
    {BALL "name = 'x'\nwaypoints = [[0, 0], [1, 1]]\n" BALL "name = 'x'\nwaypoints = [[0, 0], [1, 1]]",
     "m.toml:9:1: error: bodies[1]: is called \"x\", as something before it"},
    {BALL "name = 'obstacles'\nwaypoints = [[0, 0], [1, 1]]",
     "m.toml:5:1: error: bodies[0]: is called \"obstacles\", which stands for all obstacles"},
    // counts
    {"", "error: bodies: is missing: what moves, as [[bodies]] or [[robots]]"},
    {BALL "waypoints = []", "bodies[0].waypoints: must be a list of 1 to 10000 poses"},
    {BALL "waypoints = [[0, 0], [1]]",
     "m.toml:7:22: error: bodies[0].waypoints[1]: must be a pose [x, y] or [x, y, angle], and is a list of "
     "1"},
    {BALL "waypoints = [[0, 0], [1, 2, 3, 4]]", "must be a pose [x, y] or [x, y, angle], and is a list of 4"},
    {BALL "waypoints = [[0, 0], [1, 1]]\n" BALL "waypoints = [[0, 0], [1, 1], [2, 2]]",
     "m.toml:7:13: error: bodies[0].waypoints: must be 1, or 3 as those of bodies[1], and are 2"},
    {BALL "waypoints = [[0, 0], [1, 1], [2, 2]]\n" BALL "name = 'bar'\nwaypoints = [[0, 0], [1, 1]]",
     "m.toml:11:13: error: bodies[1].waypoints: must be 1, or 3 as those of bodies[0], and are 2"},
    {ROBOT "waypoints = [[0, 0], [1, 1], [0, 0]]\n" BALL "waypoints = [[0, 0], [1, 1]]",
     "m.toml:10:13: error: bodies[0].waypoints: must be 1, or 3 as those of robots[0], and are 2"},
    {BALL
     "waypoints = [[0, 0], [1, 1], [2, 2]]\n[[robots]]\nname = 'arm'\nlinks = [{}]\nwaypoints = [[0], [1]]",
     "m.toml:11:13: error: robots[0].waypoints: must be 1, or 3 as those of bodies[0], and are 2"},
    {"durations = [1, 2]\n" BALL "waypoints = [[0, 0], [1, 1]]",
     "m.toml:5:13: error: durations: must be as many as segments: 1, and are 2"},
    {"durations = [0]\n" BALL "waypoints = [[0, 0], [1, 1]]", "durations[0]: must be a number from 1e-12"},
    {ROBOT "waypoints = [[0, 0], [1, 1, 1]]",
     "m.toml:7:22: error: robots[0].waypoints[1]: must be a list of joint values, one a joint that moves: 2, "
     "and is of "
     "3"},
    {"[[robots]]\nlinks = [{}, { joint = 'fixed' }]\nwaypoints = [[0, 0]]",
     "must be a list of joint values, one a joint that moves: 1, and is of 2"},
    {"[[robots]]\nlinks = [{ joint = 'fixed', limits = [0, 1] }]\nwaypoints = [[]]",
     "robots[0].links[0].limits: a fixed joint has no limits"},
    {"[[robots]]\nlinks = [{ joint = 'fixed', axis = [0, 1] }]\nwaypoints = [[]]",
     "only a prismatic joint has an axis"},
    {"margin = -1\n" BALL "waypoints = [[0, 0]]", "margin: must be a number from 0 to 1e+09"},
    {"[[robots]]\nlinks = []\nwaypoints = [[0]]", "robots[0].links: must have one or more"},
    // numbers
    {BALL "waypoints = [[0, 0], [nan, 1]]",
     "bodies[0].waypoints[1][0]: must be a number from -1e+09 to 1e+09"},
    {BALL "waypoints = [[0, 0], [0, 0, inf]]", "bodies[0].waypoints[1][2]: must be a number"},
    {BALL "waypoints = [[0, 0], ['a', 1]]", "bodies[0].waypoints[1][0]: must be a number"},
    {ROBOT "waypoints = [[0, 0], [1.5, 0]]",
     "m.toml:7:23: error: robots[0].waypoints[1][0]: must be within the limits of robots[0].links[0], -1 to "
     "1, "
     "and is 1.5"},
    {"[[robots]]\nlinks = [{ limits = [1, -1] }]\nwaypoints = [[0]]",
     "robots[0].links[0].limits: must have its lower bound first"},
    {"[[robots]]\nlinks = [{ axis = [1, 0] }]\nwaypoints = [[0]]", "only a prismatic joint has an axis"},
    {"[[robots]]\nlinks = [{ joint = 'prismatic', axis = [0, 0] }]\nwaypoints = [[0]]", "must not be [0, 0]"},
    {"[[robots]]\nlinks = [{ joint = 'hinge' }]\nwaypoints = [[0]]",
     "must be one of \"revolute\", \"prismatic\""},
    {"[[robots]]\nlinks = [{ parent = 0 }]\nwaypoints = [[0]]",
     "robots[0].links[0].parent: must be the number of a link before this one"},
    {"[[robots]]\nlinks = [{ name = 'upper' }, { parent = 'uper' }]\nwaypoints = [[0, 0]]",
     "there is no \"uper\" among the links before this one, did you mean \"upper\"?"},
    // shapes
    {"[shapes.s]\ndisc.radius = 1\nradius = 1", "shapes.s.radius: only a polygon or a segment is rounded"},
    {"[shapes.s]\nsegment = [[0, 0], [0, 0]]", "shapes.s.segment: must have two different ends"},
    {"[shapes.s]\nsegment = [[0, 0], [1e-13, 0]]", "shapes.s.segment: has points 1e-13 m apart"},
    {"[shapes.s]\ndisc.radius = 1\nholes = []", "shapes.s.holes: only a polygon has holes"},
    {"[shapes.s]\npolygon = [[0, 0], [1, 1], [1, 0], [0, 1]]", "error: shapes.s.polygon: "},
    {"[shapes.s]\ndisc.radius = -1", "shapes.s.disc.radius: must be a number"},
    {"[shapes.s]\ndisc.radius = 1\nsegment = [[0, 0], [1, 0]]",
     "needs exactly one of disc, polygon, segment, discs"},
    {"surroundings = 'no_such.toml'",
     "surroundings: can't be used, with 1 error: no_such.toml: error: there is no"},
    {"[[walls]]\nsegment = [[0, 0], [0, 0]]", "walls[0].segment: must have at least 2 different points"},
};

#undef BALL
#undef ROBOT

void PrintTo(const FaultyMotion& c, std::ostream* out) {
  *out << c.fault;
}

class BadMotion : public ::testing::TestWithParam<FaultyMotion> {};

TEST_P(BadMotion, IsFoundAtItsPlaceAndNamed) {
  const LoadedMotion loaded = load(std::string("motion = 1\n\nshapes.ball.disc.radius = 1\n") +
                                   "shapes.rod.segment = [[0, 0], [1, 0]]\n" + GetParam().text);
  EXPECT_GE(loaded.errors(), 1);
  EXPECT_NE(faults(loaded).find(GetParam().fault), std::string::npos)
      << GetParam().text << "\nsays: " << faults(loaded) << "wanted: " << GetParam().fault;
}

INSTANTIATE_TEST_SUITE_P(All, BadMotion, ::testing::ValuesIn(kFaultyMotions));

}  // namespace
}  // namespace throng
