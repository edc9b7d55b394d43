// SPDX-License-Identifier: MIT
// What a crowd's file says and won't get.
#include <gtest/gtest.h>

#include "tests/scenarios/scenario_texts.h"

namespace throng {

using testing::faults;
using testing::load_text;

namespace {

/// What is said of a hall with this in it, that runs for 100 s.
std::string said_of(const std::string& rest, const std::string& dt = "0.01") {
  const Loaded loaded = load_text("throng = 1\ntime = { dt = " + dt +
                                  ", until = 100 }\n"
                                  "walkable = 'POLYGON ((0 0, 20 0, 20 6, 0 6, 0 0))'\n[areas]\n"
                                  "start = [[0, 0], [4, 0], [4, 6], [0, 6]]\n"
                                  "exit = [[19, 0], [20, 0], [20, 6], [19, 6]]\n" +
                                  rest + "[[measure]]\nname = 'start'\narea = 'start'\n");
  EXPECT_EQ(loaded.errors(), 0) << faults(loaded);
  return faults(loaded);
}

std::string group(const std::string& more = "at = [2, 2]\n", const std::string& model = "orca") {
  return "[[agents]]\ngoal = 'exit'\nmodel = '" + model + "'\n" + more;
}

void expect_warning(const std::string& rest, const std::string& warning, const std::string& dt = "0.01") {
  const std::string said = said_of(rest, dt);
  EXPECT_NE(said.find("warning: " + warning), std::string::npos) << rest << "\nsays: " << said;
}

TEST(CheckCrowd, WarnsOfWhatIsMeasuredAfterTheEnd) {
  const std::string measure = "[[measure]]\nname = 'door'\nline = [[9, 0], [9, 6]]\nfrom = ";
  expect_warning(group() + measure + "100\n",
                 "measure[0].from: is 100 s, and the run ends at 100 s (time.until): nothing is measured");
  expect_warning(group() + measure + "200\n",
                 "measure[0].from: is 200 s, and the run ends at 100 s (time.until)");
  EXPECT_EQ(said_of(group() + measure + "99.9\n"), "");
}

TEST(CheckCrowd, WarnsOfMeasuresThatGoOnAfterTheEnd) {
  const std::string measure = "[[measure]]\nname = 'door'\nline = [[9, 0], [9, 6]]\n";
  expect_warning(
      group() + measure + "until = 200\n",
      "measure[0].until: is 200 s, and the run ends at 100 s (time.until): measured is up to that");
  EXPECT_EQ(said_of(group() + measure + "until = 100\n"), "") << "which is the end";
  EXPECT_EQ(said_of(group() + measure + "until = 99.9\n"), "");
  const std::string late = said_of(group() + measure + "from = 150\nuntil = 200\n");
  EXPECT_NE(late.find("measure[0].from"), std::string::npos);
  EXPECT_EQ(late.find("measure[0].until"), std::string::npos) << "said once: " << late;
}

TEST(CheckCrowd, WarnsOfAreasLessThanATenthOfWhichIsWalkable) {
  const auto with = [](const std::string& left, const std::string& rest) {
    return said_of("door = [[" + left + ", 2], [22, 2], [22, 4], [" + left + ", 4]]\n" + rest);
  };
  const std::string goal = "[[agents]]\ngoal = ['exit', 'door']\nmodel = 'orca'\nat = [2, 2]\n";
  const std::string place = group("place.random.within = 'door'\nradius = 0.05\n");
  for (const std::string& use : {goal, place}) {
    EXPECT_EQ(with("19.8", use), "s.toml:7:8: warning: areas.door: 0.4 of its 4.4 m² are walkable\n") << use;
    EXPECT_EQ(with("19.75", use), "") << "a ninth, " << use;
    EXPECT_EQ(with("18", use), "") << "astride the wall, " << use;
  }
  const std::string tenth = "door = [[19.8, 2], [21.8, 2], [21.8, 4], [19.8, 4]]\n";
  EXPECT_EQ(said_of(tenth + goal), "") << "up to rounding";
}

// Density and speed are over what is walkable: nothing is lost.
TEST(CheckCrowd, LetsAreasThatAreOnlyMeasuredLieOffTheFloor) {
  EXPECT_EQ(said_of("door = [[19.8, 2], [22, 2], [22, 4], [19.8, 4]]\n" + group() +
                    "[[measure]]\nname = 'door'\narea = 'door'\n"),
            "");
}

TEST(CheckCrowd, WarnsOfAreasAndQueuesThatNobodyUses) {
  const std::string hall = "hall = [[5, 0], [9, 0], [9, 6], [5, 6]]\n";
  EXPECT_EQ(said_of(hall + group()),
            "s.toml:7:8: warning: areas.hall: is nobody's goal, nobody's place, and not measured: it is only "
            "drawn\n");
  for (const char* use : {"[[measure]]\nname = 'm'\narea = 'hall'\n",
                          "[[agents]]\ngoal = 'hall'\nmodel = 'orca'\nat = [3, 3]\n",
                          "[[agents]]\ngoal = 'exit'\nmodel = 'orca'\nplace.random.within = 'hall'\n",
                          "[[agents]]\ngoal = { wait = 'hall' }\nmodel = 'orca'\nat = [3, 3]\n",
                          "[[agents]]\ngoal = { nearest = ['hall', 'exit'] }\nmodel = 'orca'\nat = [3, 3]\n"})
    EXPECT_EQ(said_of(hall + group() + use), "") << use;
  EXPECT_EQ(said_of(hall + "bar = [[9, 0], [12, 0], [12, 6], [9, 6]]\n" + group()),
            "s.toml:7:8: warning: areas: hall and bar are nobody's goals, nobody's places, and not measured: "
            "they are only drawn\n");
  const std::string till = "[queues]\ntill = { line = [[9, 3], [7, 3]], service = 2 }\n";
  EXPECT_EQ(said_of(group() + till),
            "s.toml:12:8: warning: queues.till: is where nobody lines up: it is only drawn\n");
  EXPECT_EQ(said_of(group() + till +
                    "[[agents]]\ngoal = [{ queue = 'till' }, 'exit']\nmodel = 'orca'\nat = [6, 3]\n"),
            "");
}

TEST(CheckCrowd, WarnsOfThoseWhoAreDueAfterTheEnd) {
  const std::string random = "place.random.within = 'start'\n";
  expect_warning(
      group(random + "count = 9\nappear = { rate = 1, from = 101 }\n"),
      "agents[0].appear: the first is due at 101 s, and the run ends at 100 s (time.until): nobody "
      "of this group ever appears");
  expect_warning(group(random + "appear.times = [100.5, 200]\n"),
                 "agents[0].appear: the first is due at 100.5 s");
  expect_warning(
      group(random + "appear = { times = [1, 99, 100, 100.5, 500], together = 2 }\n"),
      "agents[0].appear: the last is due at 500 s, and the run ends at 100 s (time.until): 4 of this "
      "group's 10 never appear");
  EXPECT_EQ(said_of(group(random + "appear.times = [99, 100]\n")), "");
  EXPECT_EQ(said_of(group(random + "count = 500\nappear.rate = 1\n")), "") << "enough up to the end";
}

TEST(CheckCrowd, WarnsOfThoseWhoSetOutAfterTheEnd) {
  expect_warning(
      group("at = [2, 2]\npremovement = 100\n"),
      "agents[0].premovement: the first sets out at 100 s, and the run ends at 100 s (time.until): "
      "nobody of this group ever walks");
  EXPECT_EQ(said_of(group("at = [2, 2]\npremovement = 99\n")), "");
  EXPECT_EQ(
      said_of(group("place.random.within = 'start'\ncount = 50\npremovement = { uniform = [0, 500] }\n")),
      "");
}

TEST(CheckCrowd, WarnsOfGoalsThatOpenAfterTheEnd) {
  expect_warning(group() + "[open]\nexit.from = 500\n",
                 "open.exit.from: is 500 s, and the run ends at 100 s (time.until): it never opens");
  EXPECT_EQ(said_of(group() + "[open]\nexit.from = 50\n"), "");
}

TEST(CheckCrowd, WarnsOfThoseWhoNeverSetOut) {
  expect_warning(group("at = [2, 2]\ndesired_speed = 0\n"),
                 "agents[0].desired_speed: is 0: they stand, and never get to their goal");
  EXPECT_EQ(said_of(group("at = [2, 2]\ndesired_speed = 0.1\n")), "");
}

// It happened: whoever's way led through one walked against it for ever.
TEST(CheckCrowd, WarnsOfBodiesThatNeverMoveAndAreNotStatic) {
  const std::string post =
      "[shapes]\npost.disc.radius = 0.5\n[[bodies]]\nshape = 'post'\nat = [9, 3]\nkind = ";
  expect_warning(
      group() + post + "'kinematic'\n",
      "bodies[0].kind: is \"kinematic\", and the body never moves: agents don't find their way round it, "
      "as they do round what is \"static\"");
  EXPECT_EQ(said_of(group() + post + "'kinematic'\nspin = 0.1\n"), "");
  EXPECT_EQ(said_of(group() + post + "'kinematic'\nvelocity = [0, 0.1]\n"), "");
  EXPECT_EQ(said_of(group() + post + "'static'\n"), "");
}

}  // namespace
}  // namespace throng
