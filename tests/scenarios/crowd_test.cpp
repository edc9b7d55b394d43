// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <set>

#include "scenarios/region_sets.h"
#include "sim/crowd/model.h"
#include "tests/scenarios/scenario_texts.h"

namespace throng {

using testing::faults;
using testing::load_text;

namespace {

const std::string kFloor =
    "throng = 1\nwalkable = 'POLYGON ((0 0, 10 0, 10 5, 0 5, 0 0), (4 2, 5 2, 5 3, 4 3, 4 2))'\n"
    "[areas]\nstart = [[0, 0], [3, 0], [3, 5], [0, 5]]\nexit = 'POLYGON ((9 2, 10 2, 10 3, 9 3, 9 2))'\n";
const std::string kGroup = "[[agents]]\nmodel = 'social_force'\ngoal = 'exit'\n";
const std::string kRandom = "place = { random = { within = 'start' } }\n";

std::string faults_of(const std::string& text) {
  const Loaded loaded = load_text(text);
  EXPECT_GE(loaded.errors(), 1) << text;
  return faults(loaded);
}

void expect_fault(const std::string& text, const std::string& fault) {
  EXPECT_NE(faults_of(text).find(fault), std::string::npos) << text << "\nsays: " << faults_of(text);
}

}  // namespace

TEST(Crowd, IsReadWithItsFloorItsAreasAndItsAgents) {
  const Loaded loaded =
      load_text(kFloor + kGroup + kRandom + "count = 20\nradius = 0.25\nsocial_force = { mass = 70 }\n");
  ASSERT_EQ(loaded.errors(), 0) << faults(loaded);
  const Scene& scene = loaded.scene;
  ASSERT_EQ(scene.crowd.walkable.rings.size(), 2u);
  EXPECT_EQ(scene.walls.size(), 2u) << "the edges of the floor";
  ASSERT_EQ(scene.crowd.areas.size(), 2u);
  ASSERT_EQ(scene.crowd.size(), 20u);
  ASSERT_EQ(scene.bodies.size(), 20u);
  const AgentGroup& group = scene.crowd.groups.at(0);
  EXPECT_STREQ(walking_models()[group.model].name, "social_force");
  EXPECT_EQ(scene.crowd.goals[group.journey.back().options.at(0)].name, "\"exit\"");
  EXPECT_EQ(group.parameters[0], 70.0);
  EXPECT_EQ(group.parameters[1], 0.5) << "what is absent has its default";
  for (std::size_t i = 0; i < 20; ++i) {
    EXPECT_EQ(scene.bodies.kind[i], BodyKind::agent);
    EXPECT_EQ(scene.bodies.radius[i], 0.25);
    EXPECT_EQ(scene.crowd.desired_speed[i], 1.34);
    const Vec& p = scene.bodies.position[i];
    EXPECT_TRUE(p.x() >= 0.25 && p.x() <= 2.75 && p.y() >= 0.25 && p.y() <= 4.75) << "all of it within";
    for (std::size_t k = 0; k < i; ++k) EXPECT_GE((p - scene.bodies.position[k]).norm(), 0.5);
  }
}

TEST(Crowd, KnowsWhatItsAreasAreFor) {
  const Loaded loaded = load_text(std::string(R"(throng = 1
walkable = [[0, 0], [10, 0], [10, 5], [0, 5]]
[areas]
a = [[1, 1], [2, 1], [2, 2], [1, 2]]
b = [[3, 1], [4, 1], [4, 2], [3, 2]]
c = [[5, 1], [6, 1], [6, 2], [5, 2]]
d = [[7, 1], [8, 1], [8, 2], [7, 2]]
[[agents]]
at = [1.5, 1.5]
model = "orca"
goal = [{ wait = "b", for = 2 }, { weights = { c = 1, b = 2 } }, "d"]
)"));
  ASSERT_EQ(loaded.errors(), 0) << faults(loaded);
  std::vector<AreaUse> uses;
  for (const Area& area : loaded.scene.crowd.areas) uses.push_back(area.use);
  EXPECT_EQ(uses, (std::vector{AreaUse::none, AreaUse::wait, AreaUse::goal, AreaUse::goal}));
}

TEST(Crowd, StartsFromAPresetOfItsModel) {
  const Loaded loaded = load_text(kFloor + kGroup + kRandom +
                                  "social_force = { preset = \"calibrated\", reaction_time = 0.7 }\n");
  ASSERT_EQ(loaded.errors(), 0) << faults(loaded);
  const AgentGroup& group = loaded.scene.crowd.groups.at(0);
  const ModelKind& kind = walking_models()[group.model];
  ASSERT_EQ(kind.presets.size(), 2u);
  for (std::size_t i = 0; i < kind.parameters.size(); ++i)
    EXPECT_EQ(group.parameters[i],
              std::string(kind.parameters[i].key) == "reaction_time" ? 0.7 : kind.presets[0].values[i]);
  for (const auto& [preset, time_gap] : {std::pair("calibrated", 1.0), std::pair("bottleneck", 0.5)}) {
    const Loaded other =
        load_text(kFloor + "[[agents]]\ncount = 20\ngoal = \"exit\"\nmodel = \"collision_free_speed\"\n" +
                  kRandom + "collision_free_speed = { preset = \"" + preset + "\" }\n");
    ASSERT_EQ(other.errors(), 0) << faults(other);
    EXPECT_EQ(other.scene.crowd.groups.at(0).parameters[0], time_gap) << preset << ", s";
    EXPECT_EQ(other.scene.crowd.groups.at(0).parameters[2], 0.14) << preset << ", m, the range";
  }
  expect_fault(kFloor + kGroup + kRandom + "social_force = { preset = \"calibrate\" }\n",
               "agents[0].social_force.preset");
}

TEST(Crowd, DrawsParametersOfModelsForEachAgent) {
  const Loaded loaded =
      load_text(kFloor + kGroup + kRandom +
                "count = 20\nsocial_force = { preset = 'calibrated', mass = { normal = [75, 10], within = "
                "[60, 90] }, range = { uniform = [0.05, 0.1] } }\n" +
                kGroup + "at = [1, 1]\n");
  ASSERT_EQ(loaded.errors(), 0) << faults(loaded);
  const AgentGroup& group = loaded.scene.crowd.groups.at(0);
  ASSERT_TRUE(group.own);
  std::set<double> masses, ranges;
  for (std::uint32_t agent = 0; agent < 20; ++agent) {
    const auto own = group.parameters_of(agent);
    ASSERT_EQ(own.size(), 7u);
    EXPECT_TRUE(own[0] >= 60.0 && own[0] <= 90.0 && own[3] >= 0.05 && own[3] <= 0.1);
    EXPECT_EQ(own[1], 1.31) << "s, of the preset";
    EXPECT_EQ(mass(loaded.scene, agent), own[0]) << "in the scene";
    masses.insert(own[0]), ranges.insert(own[3]);
  }
  EXPECT_EQ(masses.size(), 20u);
  EXPECT_EQ(ranges.size(), 20u);
  EXPECT_FALSE(loaded.scene.crowd.groups.at(1).own);
  EXPECT_EQ(loaded.scene.crowd.groups.at(1).parameters_of(0)[0], 80.0);
}

TEST(Crowd, RefusesParametersWhoseDrawsAModelDoesntBear) {
  const auto group = [](const std::string& parameters) {
    return kFloor + kGroup + kRandom + "count = 20\nsocial_force = { " + parameters + " }\n";
  };
  expect_fault(group("mass = { uniform = [0.5, 90] }"), "agents[0].social_force.mass.uniform");
  expect_fault(group("mass = { normal = [75, 10], within = [90, 60] }"), "agents[0].social_force.mass");
  for (const Diagnostic& one :
       load_text(group("mass = { normal = [75, 10], within = [90, 60] }")).diagnostics)
    EXPECT_GT(one.line, 0);
  expect_fault("time.dt = 0.02\n" + group("mass = { uniform = [10, 80] }"), "needs time.dt to be at most");
  expect_fault(group("mass = { uniform = [60, 90], within = [70, 80] }"), "no `within` beside `uniform`");
  const Loaded narrow = load_text(kFloor + kGroup + kRandom + "social_force.mass = { normal = [75, 0.5] }\n");
  EXPECT_EQ(narrow.errors(), 0) << "a deviation less than the least mass: " << faults(narrow);
  const std::string whole = kFloor + "[[agents]]\ncount = 20\ngoal = 'exit'\nmodel = 'orca'\n" + kRandom;
  expect_fault(whole + "orca = { neighbours = { uniform = [5, 10] } }\n", "agents[0].orca.neighbours");
}

TEST(Crowd, WalksOnTheDomainsBoxWhereNoFloorIsGiven) {
  const Loaded loaded =
      load_text("throng = 1\ndomain.box = [[0, 0], [9, 9]]\nareas.exit = [[8, 0], [9, 0], [9, 9]]\n" +
                kGroup + "at = [1, 1]\n");
  ASSERT_EQ(loaded.errors(), 0) << faults(loaded);
  EXPECT_TRUE(contains(loaded.scene.crowd.walkable, {4, 4}));
  EXPECT_TRUE(loaded.scene.walls.empty());
}

TEST(Crowd, AFloorWithoutAgentsHoldsNobodyWhoPassesThroughAll) {  // it happened: no wall to name, and it fell
  const Loaded loaded = load_text(kFloor +
                                  "[contact]\nmodel = 'none'\n[shapes]\nball.disc.radius = 0.1\n[[bodies]]\n"
                                  "shape = 'ball'\nat = [1, 1]\n");
  EXPECT_EQ(loaded.errors(), 0) << faults(loaded);
}

TEST(Crowd, EachAreaThatAgentsAreToGoToIsOnTheFloor) {
  for (const char* off : {"[[12, 0], [13, 0], [13, 5], [12, 5]]", "[[10, 0], [11, 0], [11, 5], [10, 5]]",
                          "[[4, 2], [5, 2], [5, 3], [4, 3]]"}) {
    const std::string text = kFloor + "off = " + off + "\n[[agents]]\nmodel = 'orca'\n" + kRandom;
    expect_fault(text + "goal = { nearest = ['exit', 'off'] }\n", "areas.off: has nothing in common with");
    expect_fault(text + "goal = [{ wait = 'off', for = 1 }, 'exit']\n", "areas.off: has nothing");
    EXPECT_EQ(load_text(text + "goal = 'exit'\n").errors(), 0) << "where nobody goes";
  }
}

TEST(Crowd, FindsRoomInAnAreaThatFillsLittleOfItsBox) {
  const Loaded loaded = load_text(
      "throng = 1\nwalkable = 'POLYGON ((0 0, 1200 0, 1200 1200, 0 1200, 0 0))'\n[areas]\n"
      "start = 'MULTIPOLYGON (((0 0, 20 0, 20 20, 0 20, 0 0)), ((1180 1180, 1200 1180, 1200 1200, 1180 1200, "
      "1180 1180)))'\nexit = [[600, 600], [610, 600], [610, 610]]\n" +
      kGroup + kRandom + "count = 2000\n");
  ASSERT_EQ(loaded.errors(), 0) << faults(loaded);
  double left = 0.0;
  for (const Vec& p : loaded.scene.bodies.position) left += p.x() < 20.0 ? 1.0 : 0.0;
  EXPECT_NEAR(left / 2000.0, 0.5, 0.04) << "of two squares, half in each";
}

TEST(Crowd, DrawsSpeedsOfEachKind) {
  const auto mean = [](const std::string& speed) {
    const Loaded loaded = load_text(
        "throng = 1\ndomain.box = [[0, 0], [99, 99]]\nareas.exit = [[98, 0], [99, 0], [99, 9]]\n" + kGroup +
        "place = { random = { within = [[0, 0], [99, 99]] } }\ncount = 4000\nradius = 0.1\ndesired_speed = " +
        speed);
    EXPECT_EQ(loaded.errors(), 0) << faults(loaded);
    double sum = 0.0, sum2 = 0.0;
    for (const double v : loaded.scene.crowd.desired_speed) sum += v, sum2 += v * v;
    const double m = sum / 4000;
    return std::pair(m, std::sqrt(sum2 / 4000 - m * m));
  };
  EXPECT_NEAR(mean("{ uniform = [0.97, 1.62] }").first, 1.295, 0.01);
  EXPECT_NEAR(mean("{ normal = [1.34, 0.26] }").first, 1.34, 0.015);
  EXPECT_NEAR(mean("{ normal = [1.34, 0.26] }").second, 0.26, 0.01);
  EXPECT_NEAR(mean("{ lognormal = [1.34, 0.26] }").first, 1.34, 0.015);
  EXPECT_NEAR(mean("{ lognormal = [1.34, 0.26] }").second, 0.26, 0.01);
  EXPECT_NEAR(mean("{ normal = [1, 1], within = [1, 9] }").first, 1.0 + 0.7979, 0.04)
      << "half a normal distribution";
}

TEST(Crowd, PlacesUniformlyWhatTheSeedSays) {
  const std::string text = kFloor + kGroup + kRandom + "count = 30\n";
  EXPECT_EQ(load_text(text).scene.bodies.position, load_text(text).scene.bodies.position);
  EXPECT_NE(load_text(text).scene.bodies.position,
            load_text("throng = 1\nseed = 9" + text.substr(10)).scene.bodies.position);
}

// It happened: they were placed in the order of the file, and a later one with a place stood in them.
TEST(Crowd, FindsRandomPlacesBesideThoseWhoHaveTheirs) {
  const std::string many = kFloor + kGroup + kRandom + "count = 50\n", one = kGroup + "at = [1.5, 2.5]\n";
  const Loaded loaded = load_text(many + one), without = load_text(many);
  EXPECT_EQ(faults(loaded), "");
  ASSERT_EQ(loaded.scene.bodies.size(), 51u);
  EXPECT_EQ(loaded.scene.bodies.position[50], Vec(1.5, 2.5));
  int moved = 0;
  for (std::size_t i = 0; i < 50; ++i) {
    EXPECT_GE((loaded.scene.bodies.position[i] - Vec(1.5, 2.5)).norm(), 0.4) << i;
    moved += (without.scene.bodies.position[i] - Vec(1.5, 2.5)).norm() < 0.4;
  }
  EXPECT_GT(moved, 0) << "else nobody would have been in the way";
}

TEST(Crowd, IsRefusedWhereItsFloorIsNoPolygon) {
  expect_fault("throng = 1\nwalkable = 'POLYGON ((0 0, 4 4, 4 0, 0 4, 0 0))'",
               "s.toml:2:12: error: walkable: is no polygon: Self-intersection at [2, 2]");
  expect_fault("throng = 1\nwalkable = 'POLYGON ((0 0, 4 0, 4 4, 0 4, 0 0), (5 5, 6 5, 6 6, 5 5))'",
               "error: walkable: is no polygon: Hole lies outside shell at [5, 5]");
  expect_fault("throng = 1\nwalkable = 'POLYGON ((0 0, 4 0, 4 4, 0 4))'",
               "walkable: a ring must end with its first point");
  expect_fault("throng = 1\nwalkable = 'LINESTRING (0 0, 4 0, 4 4)'",
               "walkable: must begin with POLYGON or MULTIPOLYGON, and begins with \"LINESTRING");
  expect_fault(
      "throng = 1\nwalkable = 'POINT (0 0)'",
      "walkable: must begin with POLYGON or MULTIPOLYGON, and begins with \"POINT (0 0)\" (character");
  expect_fault("throng = 1\nareas.a = [[0, 0], [4, 4], [4, 0], [0, 4]]",
               "s.toml:2:11: error: areas.a: is no polygon: Self-inter");
}

/// m², and what was said of it.
std::pair<double, std::string> floor_of(const std::string& wkt) {
  const Loaded loaded =
      load_text("throng = 1\nwalkable = '" + wkt + "'\n[areas]\nexit = [[9, 2], [10, 2], [10, 3], [9, 3]]\n" +
                kGroup + "at = [1, 1]\n");
  const Region& floor = loaded.scene.crowd.walkable;
  return {floor.empty() ? 0.0 : scenarios::common_area(floor, floor),
          to_string(loaded.diagnostics, "s.toml")};
}

TEST(Crowd, FloorsAreRepairedWhereWhatIsMeantIsPlain) {
  const std::string shell = "POLYGON ((0 0, 10 0, 10 5, 0 5, 0 0), ";
  const std::tuple<std::string, double, const char*> all[] = {
      {shell + "(4 1, 6 1, 6 3, 4 3, 4 1), (5 2, 7 2, 7 4, 5 4, 5 2))", 43.0, "Self-intersection at [6, 2]"},
      {shell + "(4 1, 5 1, 5 3, 4 3, 4 1), (5 1, 6 1, 6 3, 5 3, 5 1))", 46.0, "Self-intersection at [5, 3]"},
      {shell + "(4 3, 6 3, 6 8, 4 8, 4 3))", 46.0, "Self-intersection at [4, 5]"},
      {shell + "(4 1, 6 1, 6 3, 4 3, 4 1), (4.5 1.5, 5 1.5, 5 2, 4.5 1.5))", 46.0,
       "Holes are nested at [4.5, 1.5]"},
      {"MULTIPOLYGON (((0 0, 6 0, 6 5, 0 5, 0 0)), ((4 0, 10 0, 10 5, 4 5, 4 0)))", 50.0,
       "Self-intersection at"},
      {"POLYGON ((0 0, 10 0, 10 5, 5 5, 4 2, 6 2, 5 5, 0 5, 0 0))", 47.0,
       "Ring Self-intersection at [5, 5]"}};
  for (const auto& [wkt, area, fault] : all) {
    const auto [found, said] = floor_of(wkt);
    EXPECT_NEAR(found, area, 1e-12) << wkt;
    EXPECT_EQ(said.find("s.toml:2:12: warning: walkable: is no polygon: " + std::string(fault)), 0u) << said;
    EXPECT_NE(said.find("; repaired: what is in its outer rings and in none of their holes, " +
                        std::to_string(static_cast<int>(area)) + " m²"),
              std::string::npos)
        << said;
  }
}

TEST(Crowd, FloorsThatTouchThemselvesByTheRulesAreSound) {
  for (const char* wkt : {"POLYGON ((0 0, 10 0, 10 5, 0 5, 0 0), (5 0, 6 2, 4 2, 5 0))",
                          "POLYGON ((0 0, 0 0, 10 0, 10 5, 10 5, 0 5, 0 0), (4 3, 6 3, 6 4, 4 4, 4 3))"})
    EXPECT_EQ(floor_of(wkt), std::pair(48.0, std::string())) << wkt;
}

TEST(Crowd, IsRefusedWhereItLacksSomething) {
  expect_fault(kFloor + "[[agents]]\nmodel = 'social_force'\nat = [1, 1]\n", "agents[0].goal: is missing");
  expect_fault(kFloor + "[[agents]]\nmodel = 'social_forse'\ngoal = 'exit'\nat = [1, 1]\n",
               "did you mean \"social_force\"?");
  expect_fault(kFloor + "[[agents]]\nmodel = 'social_force'\ngoal = 'exti'\nat = [1, 1]\n",
               "there is no \"exti\" in [areas], did you mean \"exit\"?");
  expect_fault("throng = 1\nareas.exit = [[0, 0], [4, 0], [4, 4]]\n" + kGroup + "at = [1, 1]\n",
               "agents: need a floor to walk on");
  expect_fault(kFloor + kGroup + "at = [1, 1]\ncollision_free_speed = { time_gap = 1 }\n",
               "agents[0].collision_free_speed: belongs to another model");
  expect_fault(kFloor + kGroup + "at = [1, 1]\nsocial_force = { mas = 70 }\n", "did you mean \"mass\"?");
}

TEST(Crowd, IsRefusedWhereAnOptionStandsTwice) {
  for (const char* kind : {"nearest", "least_crowded"})
    expect_fault(
        kFloor + "[[agents]]\nmodel = 'orca'\nat = [1, 1]\ngoal." + kind + " = ['exit', 'start', 'exit']\n",
        "agents[0].goal." + std::string(kind) + ": \"exit\" stands there twice");
}

TEST(Crowd, IsRefusedWhereItHasNoRoom) {
  expect_fault(kFloor + kGroup + kRandom + "count = 300\n", "agents[0].place.random: agent ");
  const std::string second = kFloor + kGroup + "at = [6, 1]\n" + kGroup + "radius = 1\ncount = 9\n";
  expect_fault(second + kRandom, " of 9 (id ");
  expect_fault(second + kRandom, ", radius 1 m) found no free place in \"start\": take a larger");
  expect_fault(kFloor + kGroup + "place.random = { within = 'start', gap = 2 }\n",
               ": take a larger `within`, a smaller `gap`, or fewer or smaller agents");
  expect_fault(second + "place.random.within = [[0, 0], [3, 5]]\n",
               " found no free place in [[0, 0], [3, 5]]: ");
  expect_fault(kFloor + "off = [[20, 0], [23, 0], [23, 5]]\n" + kGroup + "place.random.within = 'off'\n",
               "found no free place in \"off\", which has nothing in common with the walkable area");
  expect_fault(kFloor + kGroup + "at = [4.5, 2.5]\n",
               "agents[0].at: an agent of radius 0.2 m at [4.5, 2.5] is not wholly on");
  expect_fault(kFloor + kGroup + "at = [0.1, 2.5]\n",
               "is not wholly on the walkable area, or overlaps a wall");
  expect_fault(kFloor + "[[walls]]\nsegment = [[1, 0], [1, 5]]\n" + kGroup + "at = [1.1, 2.5]\n",
               "or overlaps a wall");
}

TEST(Crowd, IsRefusedWhereAStepIsTooLongForItsModel) {
  const auto said = [](const char* model, double dt) {
    return faults(load_text(kFloor + "[time]\ndt = " + std::to_string(dt) +
                            "\n[[agents]]\ngoal = 'exit'\nat = [1, 1]\nmodel = '" + model + "'\n"));
  };
  const std::string why = "agents[0].model: needs time.dt to be at most ";
  for (const char* model : {"social_force", "orca", "collision_free_speed"}) {
    const std::string refusal = said(model, 0.9);
    const std::size_t at = refusal.find(why);
    ASSERT_NE(at, std::string::npos) << model << ": " << refusal;
    const double most = std::stod(refusal.substr(at + why.size()));
    EXPECT_EQ(said(model, 0.999 * most).find(why), std::string::npos) << model << " with " << most;
    EXPECT_NE(said(model, 1.001 * most).find(why), std::string::npos) << model << " with " << most;
  }
}

TEST(Crowd, IsRefusedWhereDistributionsMakeNoSense) {
  const std::string group = kFloor + kGroup + "at = [1, 1]\n";
  expect_fault(group + "radius = { uniform = [0.3, 0.2] }\n",
               "agents[0].radius: must have its lower bound first");
  expect_fault(group + "desired_speed = { normal = [1, 0.1], within = [3, 4] }\n",
               "agents[0].desired_speed: must have a range");
  expect_fault(group + "desired_speed = { mean = 1 }\n", "agents[0].desired_speed.mean: unknown key");
  for (const char* lognormal : {"[0, 1]", "[0, 0]", "[1e-7, 1]"})
    expect_fault(
        group + "desired_speed = { lognormal = " + lognormal + " }\n",
        "agents[0].desired_speed: must have a mean above 0 and a standard deviation of at most 1e+06 "
        "times the mean, to be lognormal");
  expect_fault(group + "desired_speed = -1\n", "agents[0].desired_speed: must be a number from 0");
}

TEST(Crowd, BlamesAFaultyFloorAlone) {
  const std::string said = faults_of(
      "throng = 1\nwalkable = 'POLGON ((0 0, 4 0, 4 4, 0 0))'\n"
      "areas.exit = [[0, 0], [4, 0], [4, 4]]\n" +
      kGroup + "at = [1, 1]\n");
  EXPECT_NE(said.find("did you mean \"POLYGON\"?"), std::string::npos) << said;
  EXPECT_EQ(said.find("need a floor"), std::string::npos) << said;
}

TEST(Crowd, IsWarnedOfWhatWontBeAsItSays) {
  const auto said = [](const std::string& fields, const std::string& before = "") {
    return faults(load_text("throng = 1\n" + before + kFloor.substr(11) +
                            "[[agents]]\ngoal = 'exit'\nat = [1, 1]\n" + fields +
                            "[[measure]]\nname = 'start'\narea = 'start'\n"));
  };
  const std::string orca = "model = 'orca'\n";
  EXPECT_NE(said(orca + "desired_speed = 3\n")
                .find("warning: agents[0].desired_speed: is 3 m/s for some, and nobody "
                      "goes beyond orca.top_speed, which is 2"),
            std::string::npos)
      << said(orca + "desired_speed = 3\n");
  EXPECT_EQ(said(orca + "desired_speed = 3\norca = { top_speed = 3 }\n"), "");
  EXPECT_EQ(said(orca + "desired_speed = { normal = [1.34, 0.26] }\n"), "");
  EXPECT_NE(said(orca + "desired_speed = { uniform = [1, 2.5] }\n").find("is 2.5 m/s for some"),
            std::string::npos);
  EXPECT_NE(said(orca + "desired_speed = { normal = [0.5, 0.5] }\n").find("the mean is above 0.5"),
            std::string::npos);
  EXPECT_EQ(said(orca + "desired_speed = { normal = [0.5, 0.5], within = [0, 2] }\n"), "");
  EXPECT_NE(
      said(orca + "[[agents]]\ngoal = 'exit'\nat = [1.3, 1]\n" + orca)
          .find("warning: agents[1].at: an agent of radius 0.2 m at [1.3, 1] overlaps by 0.1 m one that "
                "stands at [1, 1]"),
      std::string::npos);
  EXPECT_EQ(said(orca + "[[agents]]\ngoal = 'exit'\nat = [1.4, 1]\n" + orca), "") << "touches";
  EXPECT_NE(said(orca + "[[agents]]\ngoal = 'exit'\nat = [1.7, 1]\n" + orca +
                 "[[agents]]\ngoal = 'exit'\nat = [1.35, 1]\n" + orca)
                .find("agents[2].at: an agent of radius 0.2 m at [1.35, 1] overlaps 2, by 0.05 m one that "
                      "stands at [1.7, 1]"),
            std::string::npos)
      << "the deepest";
  EXPECT_NE(said(orca, "gravity = [0, -9.81]\n").find("warning: gravity: has no meaning"), std::string::npos);
  EXPECT_EQ(said(orca, "gravity = [0, 0]\n"), "");
  const std::string none = said(orca, "contact.model = 'none'\n");
  EXPECT_NE(none.find("warning: contact: has no meaning"), std::string::npos);
  EXPECT_EQ(none.find("walls"), std::string::npos) << "walls hold agents: " << none;
  EXPECT_NE(said(orca, "contact.model = 'spring'\ncontact.stiffness = 1e5\n")
                .find("warning: contact: has no meaning"),
            std::string::npos);
  EXPECT_NE(said(orca, "time.substeps = 4\n").find("warning: time.substeps: has no meaning"),
            std::string::npos);
  EXPECT_NE(said(orca + "orca = { top_speed = 1 }\n").find("is 1.34 m/s for some, and nobody goes beyond"),
            std::string::npos);
  EXPECT_NE(said(orca + "desired_speed = 1.9\norca = { top_speed = { uniform = [0.5, 2] } }\n")
                .find("orca.top_speed, which is 0.5 for some"),
            std::string::npos);
  EXPECT_NE(
      said(orca + "orca = { neighbours = 2.5 }\n").find("agents[0].orca.neighbours: must be an integer"),
      std::string::npos);
}

TEST(Crowd, BearsNoBodiesThatItWouldPush) {
  const std::string beside =
      "at = [1, 1]\n[shapes]\nb.disc.radius = 1\n[[bodies]]\nshape = 'b'\nat = [1.5, 1.5]\n";
  expect_fault(
      kFloor + kGroup + beside,
      "bodies[0].kind: not supported yet: dynamic bodies beside agents; give it kind = \"static\" or");
  expect_fault(
      kFloor + kGroup + beside + "kind = 'static'\n",
      "agents[0].at: an agent of radius 0.2 m at [1, 1] is not wholly on the walkable area, or overlaps");
  expect_fault(
      kFloor + kGroup +
          "at = [1, 1]\n[shapes]\nb.disc.radius = 1\n[[bodies]]\nshape = 'b'\nat = [7, 4]\n"
          "kind = 'kinematic'\nspin = -60\n",
      "bodies[0].spin: turns by 0.6 rad in a step; beside agents it must be at most 0.5, so time.dt at most "
      "0.008333");
  expect_fault("throng = 1\nengine = 'box2d'\n" + kFloor.substr(11) + kGroup + "at = [1, 1]\n",
               "engine: box2d: agents: ");
}

TEST(Crowd, IsMeasuredAtLinesAndInAreas) {
  const Loaded sound = load_text(kFloor + "middle = [[3, 1], [6, 1], [6, 9], [3, 9]]\n" + kGroup + kRandom +
                                 "[[measure]]\nname = 'door'\nline = [[9, 2], [9, 3]]\nfrom = 5\nuntil = 60\n"
                                 "[[measure]]\nname = 'middle'\narea = 'middle'\n");
  ASSERT_EQ(sound.errors(), 0) << faults(sound);
  const std::vector<Measure>& measures = sound.scene.crowd.measures;
  ASSERT_EQ(measures.size(), 2u);
  EXPECT_EQ(measures[0].line[1], Vec(9, 3));
  EXPECT_EQ(measures[0].after, 500);
  EXPECT_EQ(measures[0].last, 6000);
  EXPECT_EQ(measures[1].after, 0);
  EXPECT_FALSE(measures[1].area.empty());
  EXPECT_DOUBLE_EQ(measures[1].size, 3 * 4 - 1)
      << "what of it is floor: the pillar and what is outside are not";
}

TEST(Crowd, IsMeasuredInAnAreaThatOnlyTouchesTheFloorBeyondAPillar) {
  // What the two have in common is a rectangle, and the pillar's far side, which is a line.
  const Loaded loaded =
      load_text(kFloor + "upto = [[3, 2], [5, 2], [5, 3], [3, 3]]\n" + kGroup + kRandom +
                "count = 3\n[[measure]]\nname = 'x'\narea = 'upto'\nvoronoi = { cutoff = 1 }\n");
  ASSERT_EQ(loaded.errors(), 0) << faults(loaded);
  const Measure& measure = loaded.scene.crowd.measures.at(0);
  EXPECT_DOUBLE_EQ(measure.size, 1.0);
  ASSERT_EQ(measure.ground.rings.size(), 1u);
  EXPECT_EQ(measure.ground.rings[0].size(), 4u);
}

TEST(Crowd, IsRefusedWhereStaticBodiesLeaveNoFloor) {
  const std::string crowd = kFloor + kGroup + "at = [1, 1]\n[[measure]]\nname = 'x'\narea = 'exit'\n";
  const auto slab = [](const char* width) {
    return std::string("[shapes]\nslab.polygon = [[0, 0], [") + width + ", 0], [" + width +
           ", 30], [0, 30]]\n[[bodies]]\nshape = 'slab'\nkind = 'static'\n";
  };
  expect_fault(crowd + slab("60") + "at = [5, 2]\n",
               "bodies[0]: static bodies cover all of the walkable area");
  expect_fault(crowd + slab("4") + "at = [10, 2]\n",
               "bodies[0]: static bodies cover all that measure \"x\" looks at");
  expect_fault(kFloor + kGroup + "at = [1, 1]\n[[measure]]\nname = 'x'\nline = [[9, 0], [9, 5]]\n" +
                   slab("4") + "at = [10, 2]\n",
               "bodies[0]: static bodies cover all that measure \"x\" looks at");
}

TEST(Crowd, IsNotMeasuredWhereTheMeasureSaysNothing) {
  const std::string crowd =
      kFloor + "far = [[20, 0], [21, 0], [21, 1]]\n" + kGroup + "at = [1, 1]\n[[measure]]\n";
  expect_fault(crowd + "name = 'x'\n", "measure[0]: needs exactly one of line, area");
  expect_fault(crowd + "line = [[0, 0], [1, 0]]\n", "measure[0].name: is missing");
  expect_fault(crowd + "name = 'x'\nline = [[1, 0], [1, 0]]\n",
               "measure[0].line: must have two different ends");
  expect_fault(crowd + "name = 'x'\nline = [[1, 0], [1, 2], [1, 3]]\n",
               "measure[0].line: must be two points");
  expect_fault(crowd + "name = 'x'\narea = 'far'\n",
               "measure[0].area: has nothing in common with the walkable area");
  expect_fault(crowd + "name = 'x'\narea = 'nowhere'\n", "measure[0].area: ");
  for (const char* line :
       {"[[20, 0], [20, 5]]", "[[0, 5], [10, 5]]", "[[4.2, 2], [4.8, 3]]", "[[4, 2], [5, 3]]"})
    expect_fault(crowd + "name = 'x'\nline = " + line + "\n", "is nowhere inside the walkable area");
  expect_fault(crowd + "name = 'x'\nline = [[20, 0], [20, 5]]\n",
               "measure[0].line: from [20, 0] to [20, 5] is nowhere inside the walkable area: nobody "
               "can cross it");
  const Loaded endless =
      load_text("throng = 1\ntime = { dt = 1e-8, until = 1 }\n" + crowd.substr(crowd.find("walkable")) +
                "name = 'x'\narea = 'start'\nuntil = 1e12\n");
  ASSERT_EQ(endless.errors(), 0) << faults(endless);
  EXPECT_NEAR(static_cast<double>(endless.scene.crowd.measures.at(0).last), 1e12, 1e3);
  expect_fault(crowd + "name = 'x'\narea = 'start'\nfrom = 3\nuntil = 3\n",
               "measure[0].until: must be at least a step after `from`, which is 3 s");
  expect_fault(crowd + "name = 'x'\narea = 'start'\n[[measure]]\nname = 'x'\narea = 'exit'\n",
               "measure[1].name: \"x\" is the name of another measure too");
}

TEST(Crowd, MayAppearInTimeSetOutLateAndGoFromGoalToGoal) {
  const Loaded loaded = load_text(
      kFloor + "middle = [[3, 1], [6, 1], [6, 9], [3, 9]]\n" +
      "[[agents]]\nmodel = 'social_force'\ncount = 7\ngoal = ['middle', { nearest = ['start', 'exit'] }]\n" +
      "appear = { rate = 2, from = 10, together = 3 }\npremovement = 4\n" + kRandom +
      "[[agents]]\nmodel = 'social_force'\ngoal = 'middle'\nappear.times = [1, 5]\n" + kRandom);
  ASSERT_EQ(loaded.errors(), 0) << faults(loaded);
  const Crowd& crowd = loaded.scene.crowd;
  ASSERT_EQ(crowd.size(), 9u);
  EXPECT_EQ(crowd.due, (std::vector<double>{10, 10, 10, 11.5, 11.5, 11.5, 13, 1, 5}));
  EXPECT_EQ(crowd.start[8], 5.0);
  EXPECT_EQ(crowd.start[6], 17.0);
  ASSERT_EQ(crowd.goals.size(), 2u) << "the second group shares the first one's";
  ASSERT_EQ(crowd.groups[0].journey.size(), 2u);
  EXPECT_EQ(crowd.groups[0].journey[0], crowd.groups[1].journey[0]);
  EXPECT_EQ(crowd.groups[0].journey[1].options, std::vector<std::uint32_t>{1});
  EXPECT_EQ(crowd.groups[1].journey.size(), 1u);
  EXPECT_EQ(crowd.groups[1].first, 7u);
  EXPECT_EQ(crowd.groups[1].count, 2u);
  EXPECT_TRUE(contains(crowd.goals[1].region, Vec(1, 1)) && contains(crowd.goals[1].region, Vec(9.5, 2.5)));
  EXPECT_FALSE(contains(crowd.goals[1].region, Vec(5, 1)));
}

TEST(Crowd, TakesAreasThatOverlapAsOneGoal) {
  const Loaded loaded =
      load_text(kFloor + "more = [[2, 0], [3.5, 0], [3.5, 5], [2, 5]]\n" +
                "[[agents]]\nmodel = 'social_force'\nat = [7, 1]\ngoal.nearest = ['start', 'more']\n");
  ASSERT_EQ(loaded.errors(), 0) << faults(loaded);
  const Loaded twice =
      load_text(kFloor + "more = [[2, 0], [3.5, 0], [3.5, 5], [2, 5]]\n" +
                "[[agents]]\nmodel = 'orca'\nat = [7, 1]\ngoal.nearest = ['start', 'more']\n"
                "[[agents]]\nmodel = 'orca'\nat = [7, 4]\ngoal.nearest = ['more', 'start', 'more']\n");
  EXPECT_EQ(twice.scene.crowd.goals.size(), 1u) << faults(twice);
  for (const double x : {1.0, 2.5, 3.2}) EXPECT_TRUE(contains(loaded.scene.crowd.goals[0].region, Vec(x, 2)));
}

TEST(Crowd, IsRefusedWhereItsGoalsOrTimesMakeNoSense) {
  const std::string agents = kFloor + "[[agents]]\nmodel = 'social_force'\n";
  expect_fault(agents + kRandom + "goal = ['exit', 'nowhere']\n", "agents[0].goal[1]");
  expect_fault(agents + kRandom + "goal = []\n",
               "agents[0].goal: must be a list of goals, one or more, and is an empty list");
  expect_fault(agents + kRandom + "goal.nearest = ['nowhere']\n", "agents[0].goal.nearest[0]");
  expect_fault(agents + kRandom + "goal.weights = { exit = 1, nowhere = 2 }\n",
               "agents[0].goal.weights.nowhere: is not the name of an entry of [areas]");
  expect_fault(agents + kRandom + "goal.weights = { exit = 0 }\n",
               "agents[0].goal.weights: must hold a number above 0");
  const std::string timed = agents + kRandom + "goal = 'exit'\n";
  expect_fault(timed + "appear = { times = [5, 4] }\n", "agents[0].appear.times: must be ascending");
  expect_fault(timed + "count = 5\nappear = { times = [4, 5], together = 2 }\n",
               "agents[0].appear.times: make 4 agents appear, and count is 5");
  expect_fault(timed + "count = 2\nappear = { times = [4, 5, 6] }\n",
               "agents[0].appear.times: make 3 agents appear, and count is 2");
  expect_fault(timed + "appear = { times = [4, 5], together = 10000000 }\n", "agents in all");
  expect_fault(timed + "appear = { rate = 2 }\n", "agents[0].appear.rate: needs count");
  expect_fault(timed + "appear = { times = [4, 5], from = 2 }\n", "agents[0].appear.from: belongs to a rate");
  expect_fault(timed + "appear = { from = 2 }\n", "agents[0].appear: needs exactly one of rate, times");
  expect_fault(kFloor + kGroup + "at = [1, 1]\nappear = { rate = 1 }\n",
               "agents[0].appear: needs place.random");
  expect_fault(kFloor + kGroup + "count = 1\nradius = 2\nappear = { rate = 1 }\n" + kRandom,
               "found no free place");
}

TEST(Crowd, MayWaitLineUpAndChoose) {
  const std::string queues =
      "[queues]\ngate = { line = [[7, 4], [6, 4]], service = 2 }\nside = { line = [[7, 1], [6, 1]], service "
      "= 0, "
      "spacing = 0.5 }\n";
  const Loaded loaded =
      load_text(kFloor + queues + "[[agents]]\nmodel = 'orca'\ncount = 3\n" + kRandom +
                "goal = [{ wait = 'start', for = { uniform = [1, 2] } }, { wait = 'start', until = 60 }, { "
                "queue = 'gate' }, "
                "{ queue = ['side', 'gate'] }, { least_crowded = { exit = 2.5, start = 1 } }, 'exit']\n");
  ASSERT_EQ(loaded.errors(), 0) << faults(loaded);
  const Crowd& crowd = loaded.scene.crowd;
  ASSERT_EQ(crowd.queues.size(), 2u);
  EXPECT_EQ(crowd.queues[0].spacing, 0.6);
  EXPECT_TRUE(contains(crowd.goals[crowd.queues[0].goal].region, Vec(6.5, 4.1)));
  EXPECT_FALSE(contains(crowd.goals[crowd.queues[0].goal].region, Vec(6.5, 4.2)));
  const Journey& journey = crowd.groups[0].journey;
  ASSERT_EQ(journey.size(), 6u);
  ASSERT_EQ(journey[0].times.size(), 3u);
  for (const double time : journey[0].times) EXPECT_TRUE(time >= 1 && time <= 2);
  EXPECT_NE(journey[0].times[0], journey[0].times[1]);
  EXPECT_TRUE(!journey[0].until && journey[1].until);
  EXPECT_EQ(journey[1].times, (std::vector<double>{60, 60, 60}));
  EXPECT_EQ(journey[2].options.size(), 1u);
  EXPECT_EQ(journey[3].options, (std::vector<std::uint32_t>{1, 0}));
  EXPECT_EQ(journey[3].capacity[1], 0.5);
  EXPECT_EQ(journey[4].capacity, (std::vector<double>{2.5, 1}));
}

TEST(Crowd, IsRefusedWhereItsJourneyMakesNoSense) {
  const std::string agents = kFloor + "[queues]\ngate = { line = [[7, 4], [6, 4]], service = 2 }\n" +
                             "[[agents]]\nmodel = 'orca'\n" + kRandom + "goal = ";
  expect_fault(agents + "[{ queue = 'gate' }]",
               "agents[0].goal: must end with an area where the agents leave");
  expect_fault(agents + "{ wait = 'start', for = 3 }", "agents[0].goal: must end with an area");
  expect_fault(agents + "[{ wait = 'start' }, 'exit']",
               "agents[0].goal: goes on after a `wait` that has no end: it needs `for` or `until`");
  expect_fault(agents + "[{ wait = 'start', for = 3, until = 4 }, 'exit']",
               "agents[0].goal[0].until: must not stand beside `for`");
  expect_fault(agents + "[{ queue = 'gate', for = 3 }, 'exit']", "agents[0].goal[0].for: belongs to `wait`");
  expect_fault(agents + "[{ queue = 'gaet' }, 'exit']", "did you mean \"gate\"?");
  expect_fault(agents + "[{ queue = 'gate', wait = 'start' }, 'exit']",
               "needs exactly one of nearest, weights");
  expect_fault(agents + "{ least_crowded = { exit = 0 } }", "goal.least_crowded: must hold a number above 0");
  expect_fault(agents + "{ least_crowded = { gate = 1 } }",
               "goal.least_crowded.gate: is not the name of an entry");
  const auto queue = [](const std::string& line) {
    return kFloor + "[queues]\ngate = { service = 1, line = " + line + " }\n" + kGroup + kRandom;
  };
  expect_fault(queue("[[7, 4], [7, 4]]"), "queues.gate.line: must not hold a point twice in a row");
  expect_fault(queue("[[7, 4], [7, 9]]"),
               "queues.gate.line: its place 3 at [7, 5.2] is not on the walkable area");
  expect_fault(queue("[[4.5, 1.7], [4.5, 3.2]]"), "queues.gate.line: its place 2 at [4.5, 2.3] is not on");
  expect_fault(queue("[[5, 2.5], [7, 2.5]]"), "is o");
  expect_fault(queue("[[7, 4], [6, 4]]") + "[[walls]]\nsegment = [[6.7, 0], [6.7, 5]]\n",
               "queues.gate.line: its place 2 at [6.4, 4] is behind a wall, seen from the one before it");
  const auto narrow = [](const std::string& spacing) {
    return kFloor + "[queues]\ngate = { service = 1, line = [[7, 4.875], [6, 4.875]], spacing = " + spacing +
           " }\n" + kGroup.substr(0, kGroup.find("goal")) + kRandom + "goal = [{ queue = 'gate' }, 'exit']\n";
  };
  expect_fault(narrow("0.39"),
               "queues.gate.spacing: must be at least 0.4 m, as wide as one who lines up there");
  EXPECT_EQ(load_text(narrow("0.4")).errors(), 0);
  expect_fault(
      queue("[[7, 4], [6, 4]]") + "[queues.long]\nservice = 1\nspacing = 0.01\nline = [[0, 1], [1e6, 1]]\n",
      "queues.long.line: has places for 1e+08 agents, must have at most 1e+06");
}

TEST(Crowd, IsRefusedWhereAQueueComesBackToItself) {
  const auto queue = [](const std::string& line, const std::string& more = "") {
    return kFloor + "[queues]\ngate = { service = 1, line = " + line + more + " }\n" +
           kGroup.substr(0, kGroup.find("goal")) + kRandom +
           "radius = 0.2\ngoal = [{ queue = 'gate' }, 'exit']\n";
  };
  // It happened: seven places between two of which were 0.2 m were taken for a queue.
  expect_fault(queue("[[8, 1], [6, 1], [8, 1.1]]"),
               "queues.gate.line: its places 4 at [6.2, 1] and 5 at [6.3995, 1.01998] are 0.200498 m apart: "
               "the line folds back, and one who lines up there is 0.4 m wide");
  expect_fault(queue("[[8, 1], [6, 1], [6, 1.3], [8, 1.3]]"), "queues.gate.line: its places ");
  expect_fault(queue("[[8, 1], [6, 1], [6, 0.5], [7, 0.5], [7, 2]]"), "one who lines up there is 0.4 m wide");
  expect_fault(queue("[[8, 1], [5.9, 1], [6.25, 1]]"), "its places 4 at [6.2, 1] and 5 at [6.2, 1] are");
  for (const char* line :
       {"[[8, 1], [6, 1], [6, 1.4], [8, 1.4]]", "[[8, 1], [6.2, 1], [6.2, 1.6], [8, 1.6]]"})
    EXPECT_EQ(load_text(queue(line)).errors(), 0) << line << faults(load_text(queue(line)));
  // So was this: where a line bends, two who follow one another stand nearer than elsewhere.
  const std::string bent = queue("[[8, 3], [5.3, 3], [5.3, 1]]", ", spacing = 0.5");
  EXPECT_EQ(load_text(bent).errors(), 0) << faults(load_text(bent));
  EXPECT_EQ(load_text(queue("[[9, 1], [7.1, 1.7]]", ", spacing = 0.4")).errors(), 0) << "as wide as they are";
}

TEST(Opening, IsReadAsPhasesOfItsGoals) {
  const std::string two =
      kFloor + "other = [[0, 0], [1, 0], [1, 1], [0, 1]]\n" +
      "[open]\nexit = { from = 2, until = 8 }\nother = { until = 5 }\n[[agents]]\nmodel = "
      "'orca'\ngoal.nearest = ['exit', 'other']\nat = [5, 1]\n";
  const Loaded loaded = load_text(two);
  ASSERT_EQ(loaded.errors(), 0) << faults(loaded);
  const std::vector<GoalPhase>& phases = loaded.scene.crowd.goals[0].phases;
  ASSERT_EQ(phases.size(), 4u);
  const double from[] = {0, 2, 5, 8};
  const bool exit[] = {false, true, true, true},
             other[] = {true, true, false, true};  // all where none is open
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(phases[i].from, from[i]);
    EXPECT_EQ(phases[i].is_open, i < 3);
    EXPECT_EQ(contains(phases[i].region, Vec(9.5, 2.5)), exit[i]) << i;
    EXPECT_EQ(contains(phases[i].region, Vec(0.5, 0.5)), other[i]) << i;
  }
}

TEST(Opening, IsRefusedWhereItSaysNothing) {
  const std::string agents = "[[agents]]\nmodel = 'orca'\nat = [1, 1]\ngoal = ";
  const auto open = [&](const std::string& what, const std::string& goal = "'exit'\n") {
    return kFloor + "[open]\n" + what + "\n" + agents + goal;
  };
  expect_fault(open("exti = { until = 1 }"), "open.exti: is not the name of an entry of [areas]");
  expect_fault(open("start = { until = 1 }"), "open.start: is no agents' goal");
  expect_fault(open("exit = { from = 2, until = 2 }"), "open.exit: must be open for some time");
  expect_fault(open("start = { until = 1 }", "[{ wait = 'start', for = 1 }, 'exit']\n"),
               "open.start: is an area to wait in, which can't close");
  expect_fault(open("exit = { untill = 1 }"), "open.exit.untill: unknown key");
}

}  // namespace throng
