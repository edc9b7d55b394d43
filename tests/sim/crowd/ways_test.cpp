// SPDX-License-Identifier: MIT
// Wide and thin agents with one goal: each has the ways that he fits through.
#include "sim/crowd/ways.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "sim/crowd/walk.h"
#include "sim/crowd/ways_size.h"
#include "sim/input_error.h"
#include "sim/random.h"
#include "sim/simulation.h"
#include "tests/sim/trial.h"

namespace throng {
namespace {

/// A hall that a wall with a gap of that width (m) parts, and at its upper end a way two metres wide or none.
std::string parted(double gap, bool is_open_above, const std::string& agents) {
  const std::string low = std::to_string(5.0 - 0.5 * gap), high = std::to_string(5.0 + 0.5 * gap);
  return "time = { dt = 0.02, until = 1000 }\nwalkable = 'POLYGON ((0 0, 20 0, 20 20, 0 20, 0 0))'\n"
         "areas.e = [[18, 4], [20, 4], [20, 6], [18, 6]]\n[[walls]]\nsegment = [[10, 0], [10, " +
         low + "]]\n[[walls]]\nsegment = [[10, " + high + "], [10, " + (is_open_above ? "18" : "20") +
         "]]\n" + agents;
}

std::string one(const std::string& at, double radius, const std::string& model = "constant_velocity") {
  return "[[agents]]\nat = " + at + "\nradius = " + std::to_string(radius) + "\nmodel = '" + model +
         "'\ndesired_speed = 1\ngoal = 'e'\n";
}

std::string refusal(const Scene& scene) {
  try {
    Walk{scene};
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

/// Of a scene.
WaysSize size_of(const std::string& text) {
  const Scene scene = scene_from(text);
  const Barriers barriers(barrier_lines(scene), 1.0);
  return ways_size(scene, barriers, sizes_by_goal(scene, barriers));
}

TEST(WaysSize, ByHand) {
  const std::string hall =
      "domain.box = [[0, 0], [20, 20]]\nareas.e = [[18, 4], [20, 4], [20, 6], [18, 6]]\n";
  const double nodes = 203 * 203;  // half a radius of 0.2 m apart, and three more
  const WaysSize alone = size_of(hall + one("[5, 5]", 0.2));
  EXPECT_EQ(alone.fields, 1u);
  EXPECT_EQ(alone.plans, 1u);
  EXPECT_EQ(alone.bytes, 5 * nodes) << "4 a node of a field, 1 of a plan";
  const WaysSize opens = size_of(hall + "open.e = { from = 1, until = 2 }\n" + one("[5, 5]", 0.2));
  EXPECT_EQ(opens.fields, 3u);
  EXPECT_EQ(opens.bytes, 13 * nodes);
  const double wide = 53 * 53;  // of 0.8 m
  const WaysSize both = size_of(hall + one("[5, 5]", 0.2) + one("[9, 9]", 0.8));
  EXPECT_EQ(both.fields, 2u);
  EXPECT_EQ(both.plans, 2u);
  EXPECT_EQ(both.bytes, 5 * nodes + 5 * wide);
}

/// A square 2 km wide with so many small areas, all of which one goes for in turn.
std::string many_goals(int count) {
  std::string areas = "domain.box = [[0, 0], [2000, 2000]]\n[areas]\n", goal;
  for (int i = 0; i < count; ++i) {
    const std::string x = std::to_string(3 * i), right = std::to_string(3 * i + 2),
                      name = "a" + std::to_string(i);
    areas += name + " = [[" + x + ", 0], [" + right + ", 0], [" + right + ", 2], [" + x + ", 2]]\n";
    goal += (i > 0 ? ", '" : "'") + name + "'";
  }
  return areas + "[[agents]]\nmodel = 'orca'\nat = [5, 5]\ngoal = [" + goal + "]\n";
}

// Nothing bounded them: these would take 4.2 GB, and larger scenes whatever there is.
TEST(Ways, ThatWouldTakeTooMuchMemoryAreRefusedBeforeAnyIsMade) {
  EXPECT_LT(size_of(many_goals(240)).bytes, kMostWaysBytes);
  EXPECT_EQ(
      refusal(scene_from(many_goals(260))),
      "agents[0]: the ways of all agents to their goals take 260 distance fields, 4.18 GB, and may take at "
      "most 4 GB; goal \"a0\" alone takes 1, one for each class of radii whenever any of it opens or "
      "closes: take fewer goals, times in [open] or radii, or a smaller `walkable`");
}

// He was led to the gap that a thinner one with the same goal fits through, and stood in it for ever.
TEST(Ways, OfWideAgentsAvoidGapsThatThinOnesTake) {
  Trial run(parted(0.5, true, one("[5, 5]", 0.3) + one("[5, 15]", 0.15)));
  run.steps(1600);
  EXPECT_EQ(run.state.crowd.arrived, 2);
}

TEST(Ways, OfAGapAsWideAsTheAgentLeadElsewhere) {
  Trial run(parted(0.5, true, one("[5, 5]", 0.25)));
  run.steps(1600);
  EXPECT_EQ(run.state.crowd.arrived, 1);
}

TEST(Ways, ThatAreTooNarrowForOneOfTheGroupAreRefused) {
  const std::string both = one("[5, 5]", 0.3) + one("[5, 15]", 0.15);
  EXPECT_NE(refusal(scene_from(parted(0.5, false, both))).find("agents[0]: no way wide enough"),
            std::string::npos);
  EXPECT_EQ(refusal(scene_from(parted(0.7, false, both))), "accepted");
}

TEST(Ways, OfACrowdPartAtAGap) {
  Trial run(parted(0.45, true,
                   "[[agents]]\ncount = 20\nradius = { uniform = [0.18, 0.25] }\nmodel = "
                   "'orca'\ngoal = 'e'\nplace.random.within = [[2, 2], [8, 8]]\n"));
  run.steps(8000);
  EXPECT_EQ(run.state.crowd.arrived, 20);
}

// It happened: straight ways of two or three cells led through what a line of one cell closed.
TEST(Ways, DontLeadThroughAGapThatIsTooNarrow) {
  for (const double gap : {0.30, 0.38, 0.399}) {
    const std::string low = std::to_string(5 - 0.5 * gap), high = std::to_string(5 + 0.5 * gap);
    Trial run(
        "time = { dt = 0.05, until = 60 }\nwalkable = 'POLYGON ((0 0, 10 0, 10 10, 0 10, 0 0))'\n"
        "areas.e = [[9, 4.5], [10, 4.5], [10, 5.5], [9, 5.5]]\n[[walls]]\nsegment = [[5, 0], [5, 0.79]]\n"
        "[[walls]]\nsegment = [[5, 1.21], [5, " +
        low + "]]\n[[walls]]\nsegment = [[5, " + high +
        "], [5, 10]]\n[[agents]]\nat = [2, 5]\nradius = 0.2\ndesired_speed = 1\n"
        "model = 'constant_velocity'\ngoal = 'e'\n");
    run.steps(230);  // by the open one it is 10.2 m
    EXPECT_EQ(run.state.crowd.arrived, 1) << gap;
  }
}

/// A corridor, 20 m by 4 m, that ends in the area.
std::string corridor(const std::string& area, const std::string& more, const std::string& model) {
  return "time = { dt = 0.01, until = 1000 }\nwalkable = 'POLYGON ((0 0, 20 0, 20 4, 0 4, 0 0))'\nareas.f = "
         "[[0, 0], [2, 0], [2, 4], [0, 4]]\nareas.e "
         "= " +
         area + "\n[[agents]]\nat = [5, 2]\nradius = 0.2\ndesired_speed = 1\nmodel = '" + model + "'\n" +
         more;
}

// An exit drawn as a strip before the wall let nobody out: his middle is never in it.
TEST(Ways, EndBesideAStripBeforeAWall) {
  for (const char* model : {"constant_velocity", "orca", "collision_free_speed", "social_force"})
    for (const char* area :
         {"[[19.9, 0], [20, 0], [20, 4], [19.9, 4]]", "[[19.75, 0], [20, 0], [20, 4], [19.75, 4]]",
          "[[19.85, 3.85], [20, 3.85], [20, 4], [19.85, 4]]", "[[19.95, 0], [21, 0], [21, 4], [19.95, 4]]"}) {
      SCOPED_TRACE(std::string(model) + " " + area);
      Trial run(corridor(area, "goal = 'e'\n", model));
      run.steps(2500);
      EXPECT_EQ(run.state.crowd.arrived, 1);
    }
}

TEST(Ways, EndInsideAreasThatHaveRoom) {
  for (const char* area :
       {"[[17, 0], [20, 0], [20, 4], [17, 4]]", "[[17, 1.9], [17.1, 1.9], [17.1, 2.1], [17, 2.1]]"}) {
    Trial run(corridor(area, "goal = 'e'\n", "constant_velocity"));
    run.steps(1198);
    EXPECT_EQ(run.state.crowd.arrived, 0) << area;
    run.steps(5);
    EXPECT_EQ(run.state.crowd.arrived, 1) << area;
  }
}

// It happened: somebody wider with the same goal made the area a strip for all of his class.
TEST(Ways, EndWhereHisOwnWidthSays) {
  const std::string exit = "[[19.56, 0], [20, 0], [20, 4], [19.56, 4]]", goal = "goal = 'e'\n";
  const std::string wider =
      "[[agents]]\nat = [1, 3]\nradius = 0.29\ndesired_speed = 0\nmodel = 'constant_velocity'\n" + goal;
  for (const std::string& others : {std::string(), wider}) {
    Trial run(corridor(exit, goal + others, "constant_velocity"));
    run.steps(1450);
    EXPECT_EQ(run.state.crowd.arrived, 0) << others;
    run.steps(20);
    EXPECT_EQ(run.state.crowd.arrived, 1) << others;
  }
}

TEST(Ways, WhoWaitsInAStripWaitsBesideIt) {
  Trial run(corridor("[[19.9, 0], [20, 0], [20, 4], [19.9, 4]]", "goal = [{ wait = 'e', for = 5 }, 'f']\n",
                     "orca"));
  run.steps(3600);
  EXPECT_EQ(run.state.crowd.arrived, 0);
  run.steps(200);
  EXPECT_EQ(run.state.crowd.arrived, 1);
}

TEST(Ways, MayBeReachedFromWhereTheyEnd) {
  const std::string area = "[[19.75, 1], [20, 1], [20, 3], [19.75, 3]]", goal = "goal = 'e'\n";
  const Scene scene = scene_from(corridor(area, goal, "orca"));
  const Barriers barriers(barrier_lines(scene), 1.0);
  const Ways ways(scene, barriers);
  ASSERT_TRUE(ways.has_strips(0));
  int there = 0, may = 0;
  for (std::uint32_t i = 1; i <= 20'000; ++i) {
    Random random(1, 0, i, Purpose::place);
    const double x = random.uniform(18.0, 20.0), y = random.uniform(0.0, 4.0), dx = random.uniform(-1.0, 1.0);
    const Vec p(x, y), from = p - Vec(dx, random.uniform(-1.0, 1.0));
    const bool is_there = ways.is_in(0, p) || ways.meets_border(0, from, p) ||
                          ways.is_at_strip(0, 0.2, p, false) || ways.is_at_strip(0, 0.2, p, true);
    there += is_there, may += ways.may_reach(0, from, p);
    ASSERT_LE(is_there, ways.may_reach(0, from, p)) << from.transpose() << " to " << p.transpose();
  }
  EXPECT_GT(there, 1000);
  EXPECT_LT(may, 15'000) << "it tells nothing";
}

std::vector<double> least(const std::vector<SizeClass>& classes) {
  std::vector<double> result;
  for (const SizeClass& some : classes) result.push_back(some.least);
  return result;
}

TEST(SizeClasses, PartWherePassagesOpenAndWhereSizesDiffer) {
  const std::vector<double> radii{0.25, 0.18, 0.2, 0.22, 0.18};
  EXPECT_EQ(least(size_classes(radii, {})), (std::vector<double>{0.18}));
  EXPECT_EQ(least(size_classes(radii, {0.42, 0.8})), (std::vector<double>{0.18, 0.22}));
  EXPECT_EQ(least(size_classes(radii, {0.41, 0.42})), (std::vector<double>{0.18, 0.22}));
  EXPECT_EQ(least(size_classes(radii, {0.44})), (std::vector<double>{0.18, 0.22})) << "as wide as he is";
  EXPECT_EQ(least(size_classes({0.1, 0.14, 0.16, 0.5}, {})), (std::vector<double>{0.1, 0.16, 0.5}));
  EXPECT_TRUE(size_classes({}, {}).empty());
}

TEST(SizeClasses, AreFewWhateverThePassages) {
  std::vector<double> radii, passages;
  for (int i = 0; i < 1000; ++i) radii.push_back(0.1 + 0.0005 * i), passages.push_back(2.0 * radii[i] + 1e-4);
  const std::vector<SizeClass> classes = size_classes(radii, passages);
  EXPECT_LE(classes.size(), kMostSizes);
  EXPECT_GE(classes.size(), kMostSizes / 2);
  EXPECT_EQ(classes.front().least, 0.1);
  EXPECT_EQ(classes.back().largest, radii.back());
  for (std::size_t i = 1; i < classes.size(); ++i) EXPECT_LT(classes[i - 1].largest, classes[i].least);
}

// It happened: where one alone could be at a time they stood round it in an arch, and who had been there
// didn't get out: of 20 people 8 were through, and 11 stuck, as at a goal where they leave.
TEST(Ways, LetEverybodyThroughAnAreaInWhichOneAloneHasRoom) {
  for (const char* model : {"social_force", "collision_free_speed", "orca"})
    for (const char* goal : {"'m'", "['m', 'e']"})
      for (const double half : {0.05, 0.1}) {
        SCOPED_TRACE(std::string(model) + " " + goal + " " + std::to_string(half));
        const std::string left = std::to_string(6 - half), right = std::to_string(6 + half),
                          low = std::to_string(3 - half), high = std::to_string(3 + half);
        Trial run(
            "time = { dt = 0.02, until = 100 }\nseed = 1\ndomain.box = [[0, 0], [12, 6]]\n[areas]\n"
            "s = [[0, 0], [3, 0], [3, 6], [0, 6]]\ne = [[11, 0], [12, 0], [12, 6], [11, 6]]\nm = [[" +
            left + ", " + low + "], [" + right + ", " + low + "], [" + right + ", " + high + "], [" + left +
            ", " + high + "]]\n[[agents]]\ncount = 20\nplace.random.within = 's'\nradius = 0.2\nmodel = '" +
            model + "'\ngoal = " + goal + "\n");
        run.steps(2000);
        EXPECT_EQ(run.state.crowd.arrived, 20);
      }
}

TEST(Ways, EndBesideWhoStandsInAnAreaInWhichOneAloneHasRoom) {
  for (const double side : {0.2, 0.6}) {
    const std::string right = std::to_string(17 + side), high = std::to_string(2 + side);
    Trial run(corridor("[[17, 2], [" + right + ", 2], [" + right + ", " + high + "], [17, " + high + "]]",
                       "goal = 'e'\n", "constant_velocity"));
    int stood = 0;
    while (run.state.crowd.arrived == 0 && run.state.step < 3000) {
      run.steps(1);
      if (run.state.crowd.arrived == 0 && run.state.position[0].x() > 16.7)  // others hold him there
        run.state.position[0] = Vec(16.7, 2), ++stood;
    }
    if (side < 0.25)
      EXPECT_NEAR(stood, 100, 21) << "a second, less what he took for his last radius";
    else
      EXPECT_EQ(run.state.crowd.arrived, 0) << "where two have room he isn't there yet";
  }
}

}  // namespace
}  // namespace throng
