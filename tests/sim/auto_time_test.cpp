// SPDX-License-Identifier: MIT
// time.dt = "auto": what is promised is kept, and not by far too short steps.
#include "sim/auto_time.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "sim/observe.h"
#include "tests/sim/trial.h"

namespace throng {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

std::string wanted(double error, double until) {
  return "time = { dt = \"auto\", error = " + std::to_string(error) + ", until = " + std::to_string(until) +
         " }\n";
}

const double kErrors[] = {0.1, 0.01, 1e-3};
const std::string kFalls = "sleep = false\ngravity = [0, -9.81]\n";

TEST(AutoTime, KeepsAThrowOnItsWay) {
  for (const double error : kErrors) {
    Trial run(wanted(error, 2) + kFalls + kDisc + ball(0, 1, 3, 8));
    run.steps(static_cast<int>(run.scene.time.steps()));
    EXPECT_NEAR(run.scene.time.dt * static_cast<double>(run.scene.time.steps()), 2.0, 1e-12) << "whole steps";
    const double off = (run.state.position[0] - Vec(6, 1 + 16 - 0.5 * 9.81 * 4)).norm() / 0.5;
    EXPECT_LE(off, 1e-12);
    EXPECT_GE(run.scene.time.dt, 0.03) << "and no shorter steps than to look at it";
  }
}

TEST(AutoTime, KeepsADiscThatRollsOnItsWay) {
  const std::string slope =
      "sleep = false\ngravity = [4.905, -8.4957]\n[[walls]]\nsegment = [[-9, 0], [99, 0]]\n";
  for (const double error : kErrors) {
    Trial run(wanted(error, 2) + slope + kDisc + ball(0, 0.5, 0, 0));
    run.steps(static_cast<int>(run.scene.time.steps()));
    EXPECT_LE(std::abs(run.state.position[0].x() - 2.0 / 3.0 * 0.5 * 4.905 * 4) / 0.5, error);
  }
}

/// Of restitutions from those that stop nearly all to those that keep all, at eight phases of a step.
TEST(AutoTime, KeepsTheRestitutionOfSoftImpacts) {
  for (const char* model : {"model = \"spring\", stiffness = 1e4", "model = \"hertz\", youngs_modulus = 1e6"})
    for (const double e : {0.05, 0.1, 0.2, 0.35, 0.5, 0.8, 0.95, 1.0})
      for (const double error : {0.01, 1e-3, 1e-4}) {
        double worst = 0.0;
        for (int phase = 0; phase < 8; ++phase) {
          Scene scene = scene_from(wanted(error, 0.6) + "contact = { " + model + " }\n" + material(e, 0) +
                                   kDisc + ball(0, 0, 1, 0) + ball(1.1, 0, -1, 0));
          scene.bodies.position[1].x() += 2.0 * scene.time.dt / scene.time.substeps * phase / 8;
          Trial run(std::move(scene));
          run.steps(static_cast<int>(run.scene.time.steps()));
          EXPECT_LT(run.state.velocity[0].x(), 0.0);
          worst = std::max(worst, std::abs(-run.state.velocity[0].x() - e) / std::max(e, 0.2));
        }
        EXPECT_LE(worst, error) << model << ", e " << e << ", " << error;
      }
}

TEST(AutoTime, LetsAColumnStandWhereItStands) {
  for (const double error : {0.003, 0.001}) {
    Trial run(
        wanted(error, 2) + kFalls +
        "shapes.box.polygon = [[0, 0], [1, 0], [1, 1], [0, 1]]\n[[walls]]\nsegment = [[-9, 0], [9, 0]]\n"
        "[[bodies]]\nshape = \"box\"\nplace.lattice = { origin = [0, 0.5], spacing = [1, 1], size = [1, 10] "
        "}\n");
    run.steps(static_cast<int>(run.scene.time.steps()));
    double farthest = 0.0;
    for (std::size_t i = 0; i < 10; ++i)
      farthest = std::max(farthest, (run.state.position[i] - run.scene.bodies.position[i]).norm());
    EXPECT_LE(farthest / std::sqrt(0.5), error);
    EXPECT_GE(farthest / std::sqrt(0.5), 0.02 * error);
  }
}

/// Those who stand a hair apart fall on each other, and those who overlap are driven apart: nothing is
/// promised of where they get.
TEST(AutoTime, PromisesNoPlacesWhereBodiesDontTouch) {
  for (const auto& [spacing, stands] : {std::pair{"1", true}, {"1.00001", false}, {"0.99999", false}}) {
    const Scene scene = scene_from(
        wanted(0.01, 2) + kFalls +
        "shapes.box.polygon = [[0, 0], [1, 0], [1, 1], [0, 1]]\n[[walls]]\nsegment = [[-9, 0], [9, 0]]\n"
        "[[bodies]]\nshape = \"box\"\nplace.lattice = { origin = [0, 0.5], spacing = [1, " +
        std::string(spacing) + "], size = [1, 10] }\n");
    EXPECT_EQ(auto_time(scene).promise.find("stand") != std::string::npos, stands) << spacing;
  }
}

/// Two that touch at rest on a slope of 20 degrees, and where one of them is after 2 s, m down the slope.
struct OnASlope {
  const char* name;
  std::string bodies;
  double friction, way;
};
std::vector<OnASlope> on_a_slope() {
  const double down = 9.81 * std::sin(std::numbers::pi / 9), press = 9.81 * std::cos(std::numbers::pi / 9);
  const auto boxes = [](const char* size) {
    return "[shapes]\nbox.polygon = [[0, 0], [1, 0], [1, 1], [0, 1]]\n[[bodies]]\nshape = \"box\"\n"
           "place.lattice = { origin = [0, 0.5], spacing = [3, 1], size = " +
           std::string(size) + " }\n";
  };
  return {{"side by side", boxes("[2, 1]"), 0.05, 2.0 * (down - 0.05 * press)},
          {"discs that roll", kDisc + ball(0, 0.5, 0, 0) + ball(5, 0.5, 0, 0), 0.5, 2.0 * down * 2.0 / 3.0},
          {"discs that slip", kDisc + ball(0, 0.5, 0, 0) + ball(5, 0.5, 0, 0), 0.05,
           2.0 * (down - 0.05 * press)}};
}

// It happened: of several bodies it was promised that they stay where they are, whether they do or slide.
TEST(AutoTime, KeepsSeveralThatSlideOnTheirWays) {
  for (const OnASlope& one : on_a_slope())
    for (const double error : {0.01, 1e-3}) {
      Trial run(wanted(error, 2) + "gravity = [3.355197606, -9.218384989]\n" + material(0, one.friction) +
                "[[walls]]\nsegment = [[-9, 0], [99, 0]]\n" + one.bodies);
      EXPECT_THAT(auto_time(run.scene).promise, HasSubstr("off its exact way")) << one.name;
      run.steps(static_cast<int>(run.scene.time.steps()));
      for (std::size_t row = 0; row < 2; ++row) {
        const double off = (run.state.position[row] - run.scene.bodies.position[row]).x() - one.way;
        EXPECT_LE(std::abs(off) / run.scene.bodies.radius[row], error) << one.name << ", row " << row;
      }
    }
}

/// Who slides down with another on top may lose it.
TEST(AutoTime, PromisesNoWayOfAStackThatSlides) {
  const Scene scene = scene_from(
      wanted(0.01, 2) + "gravity = [3.355197606, -9.218384989]\n" + material(0, 0.05) +
      "[[walls]]\nsegment = [[-9, 0], [99, 0]]\n[shapes]\nbox.polygon = [[0, 0], [1, 0], [1, 1], [0, 1]]\n"
      "[[bodies]]\nshape = \"box\"\nplace.lattice = { origin = [0, 0.5], spacing = [1, 1], size = [1, 2] "
      "}\n");
  EXPECT_EQ(auto_time(scene).promise.find("way"), std::string::npos) << auto_time(scene).promise;
}

TEST(AutoTime, TellsWhoStaysFromWhoBeginsToMove) {
  const auto standing = [](double slope, double friction, const char* size) {
    const Scene scene = scene_from(
        wanted(0.01, 2) + "gravity = [" + std::to_string(9.81 * slope) + ", -9.81]\n" +
        material(0, friction) +
        "[shapes]\nbox.polygon = [[0, 0], [1, 0], [1, 1], [0, 1]]\n[[walls]]\nsegment = [[-9, 0], [9, 0]]\n"
        "[[bodies]]\nshape = \"box\"\nplace.lattice = { origin = [0, 0.5], spacing = [1, 1], size = " +
        size + " }\n");
    return auto_time(scene).promise.find("those that stand") != std::string::npos;
  };
  for (const char* size : {"[1, 2]", "[1, 20]", "[3, 4]"}) {
    EXPECT_TRUE(standing(0, 0.5, size)) << size;
    EXPECT_TRUE(standing(0.02, 0.5, size)) << size << " held by friction";
    EXPECT_FALSE(standing(0.02, 0.01, size)) << size << " slides";
  }
  EXPECT_FALSE(standing(0.004, 0, "[1, 2]")) << "slides by 78 mm, 7 are allowed";
  EXPECT_TRUE(standing(0.0003, 0, "[1, 2]")) << "slides by 6 mm";
}

/// However large an error is allowed, it doesn't fall.
TEST(AutoTime, LetsATallColumnStand) {
  Trial run(
      wanted(0.5, 4) + kFalls +
      "shapes.box.polygon = [[0, 0], [1, 0], [1, 1], [0, 1]]\n[[walls]]\nsegment = [[-9, 0], [9, 0]]\n"
      "[[bodies]]\nshape = \"box\"\nplace.lattice = { origin = [0, 0.5], spacing = [1, 1], size = [1, 25] "
      "}\n");
  run.steps(static_cast<int>(run.scene.time.steps()));
  EXPECT_NEAR(run.state.position[24].y(), run.scene.bodies.position[24].y(), 0.01);
  EXPECT_NEAR(run.state.position[24].x(), run.scene.bodies.position[24].x(), 0.01);
}

/// Towers of boxes, so wide and 1 m high, this far apart.
std::string towers(double width, int layers, int count, double apart) {
  std::ostringstream out;
  out << kFalls << "shapes.box.polygon = [[0, 0], [" << width << ", 0], [" << width
      << ", 1], [0, 1]]\n[[walls]]\nsegment = [[-99, 0], [99, 0]]\n"
      << "[[bodies]]\nshape = \"box\"\nplace.lattice = { origin = [0, 0.5], spacing = [" << apart
      << ", 1], size = [" << count << ", " << layers << "] }\n";
  return out.str();
}

/// They swayed by up to six times as much on the way to rest; and beside a heavy block they fell.
TEST(AutoTime, LetsTowersSwayByNoMore) {
  struct Case {
    double width, apart;
    int layers, count;
    std::string beside;
  };
  const std::string heavy =
      "[shapes.block]\npolygon = [[0, 0], [9, 0], [9, 9], [0, 9]]\n"
      "[[bodies]]\nshape = \"block\"\nat = [-20, 4.5]\n";
  for (const auto& [width, apart, layers, count, beside] :
       {Case{0.5, 1, 20, 1, ""}, Case{1, 10, 20, 2, ""}, Case{2, 20, 20, 4, ""}, Case{0.25, 1, 20, 1, ""},
        Case{4, 1, 40, 1, ""}, Case{0.5, 0.5, 20, 4, ""}, Case{1, 1, 20, 3, ""}, Case{1, 1, 30, 1, heavy}}) {
    const double error = 1e-3;
    Trial run(wanted(error, 1.5) + towers(width, layers, count, apart) + beside);
    double most = 0.0;
    for (std::int64_t i = 0; i < run.scene.time.steps(); ++i) {
      run.steps(1);
      for (std::size_t row = 0; row < run.scene.bodies.size(); ++row)
        most = std::max(most, (run.state.position[row] - run.scene.bodies.position[row]).norm());
    }
    EXPECT_LT(most, error * run.scene.bodies.radius[0]) << width << " m wide, " << layers << " layers";
    EXPECT_GT(most, 0.002 * error * run.scene.bodies.radius[0])
        << width << " m wide, " << layers << " layers";
  }
}

TEST(AutoTime, LetsAPileOverlapByNoMore) {
  for (const double error : {0.1, 0.01, 0.001}) {
    Trial run(
        "seed = 3\n" + wanted(error, 3) + kFalls + "domain = { box = [[0, 0], [10, 30]] }\n" + kDisc +
        "[[bodies]]\nshape = \"ball\"\ncount = 120\nplace = { random = { within = [[0, 0], [10, 29]] } }\n");
    run.steps(static_cast<int>(run.scene.time.steps()));
    const double mean = overlap(run.scene, run.state).mean / 0.5;
    EXPECT_LE(mean, error);
    if (run.scene.time.dt < 0.0166) {  // the longest step isn't bound by the error
      EXPECT_GE(mean, 0.02 * error);
    }
  }
}

TEST(AutoTime, LooksAtMaterialsThatMeetAlone) {
  const auto substep = [](const std::string& materials) {
    const Scene scene = scene_from(wanted(0.01, 2) + kFalls + materials +
                                   "[materials.clay]\nrestitution = 0.1\n[[walls]]\nsegment = [[-9, 0], [9, "
                                   "0]]\nmaterial = \"clay\"\n" +
                                   kDisc + ball(0, 3, 0, 0) + "material = \"clay\"\n");
    return scene.time.dt / scene.time.substeps;
  };
  EXPECT_EQ(substep(material(0.9, 0.5)), substep("")) << "nobody is of the default";
}

// It happened: what a fall adds to a body's speed was counted half.
TEST(AutoTime, LetsNobodyMoveByMoreThanARadiusInAStep) {
  const Scene scene = scene_from(wanted(0.5, 2) + kFalls + "[[walls]]\nsegment = [[-9, 0], [9, 0]]\n" +
                                 kDisc + ball(0, 20, 0, 0));
  EXPECT_LE(scene.time.dt * std::sqrt(2 * 9.81 * 19.5), 0.5) << "as it meets the floor";
}

TEST(AutoTime, TakesLongStepsWhereTheyCostNothing) {
  const Scene gas =
      scene_from(wanted(1e-3, 2) + material(1, 0) + kDisc + ball(0, 0, 1, 0) + ball(3, 0, -1, 0));
  EXPECT_EQ(gas.time.dt, 0.1);
  EXPECT_THAT(auto_time(gas).promise, HasSubstr("nothing is off but rounding"));
}

/// What was chosen makes the same run again, wherever that ends.
TEST(AutoTime, StandsInTheResolvedScenario) {
  const Loaded chosen =
      load_scenario_text("throng = 1\n" + wanted(1e-3, 2) + kFalls + kDisc + ball(0, 1, 3, 8), "a");
  const Loaded again = load_scenario_text(chosen.resolved, "b");
  EXPECT_EQ(again.errors(), 0) << chosen.resolved;
  EXPECT_EQ(again.scene.time.dt, chosen.scene.time.dt);
  EXPECT_EQ(again.scene.time.substeps, chosen.scene.time.substeps);
  EXPECT_EQ(again.scene.time.error, 0.0);
}

TEST(AutoTime, RefusesWhatNobodyCanPromise) {
  const auto said = [](const std::string& scene) {
    return to_string(load_scenario_text("throng = 1\n" + scene, "a").diagnostics, "a");
  };
  const std::string good = wanted(1e-3, 2), floor = "[[walls]]\nsegment = [[-9, 0], [9, 0]]\n";
  const std::string one = kDisc + ball(0, 1, 0, 0), near = one + ball(3, 1, -2, 0),
                    far = one + ball(9, 1, 0, 0);
  const std::string wide = "[[walls]]\nsegment = [[-99, 0], [99, 0]]\n";
  EXPECT_EQ(said(good + kFalls + one + floor), "");
  EXPECT_EQ(said(good + kFalls + material(0.5, 0) + far + wide), "") << "each bounces alone";
  EXPECT_THAT(said(good + kFalls + material(0.5, 0) + near + wide),
              AllOf(HasSubstr("errors grow at each collision"),
                    HasSubstr("or take engine event_driven, which stops where discs come to rest")));
  EXPECT_THAT(said(good + kFalls + material(1, 0) + near + wide), HasSubstr("or take engine event_driven\n"));
  EXPECT_EQ(said(good + far), "") << "nothing moves";
  EXPECT_THAT(said(good + near), HasSubstr("errors grow at each collision"));
  EXPECT_EQ(
      said(good + "domain = { box = [[-2, 0], [2, 3]] }\n" + material(0.5, 0) + kDisc + ball(0, 1, 1, 0)), "")
      << "from wall to wall without gravity";
  EXPECT_THAT(said(good + "engine = \"box2d\"\n" + one), HasSubstr("nothing is known of Box2D's error"));
  EXPECT_THAT(said(good + kFalls + near + "kind = \"kinematic\"\n" + wide), HasSubstr("kinematic bodies"));
  EXPECT_THAT(said(good + kFalls + one + ball(0, -3, 0, 0) + "kind = \"static\"\n"),
              HasSubstr("corners or are round"));
  EXPECT_EQ(said(good + kFalls + one + ball(5, -3, 0, 0) + "kind = \"static\"\n"), "")
      << "it falls beside it";
  EXPECT_THAT(said(good + kFalls + one + floor + "[[walls]]\nsegment = [[0, 0], [9, 3]]\n"),
              HasSubstr("not square"));
  const std::string room = "[[walls]]\npolygon = [[-9, 0], [9, 0], [9, 9], [-9, 9]]\n";
  EXPECT_EQ(said(good + kFalls + one + room), "");
  EXPECT_THAT(said(good + kFalls + one + "[[walls]]\npolygon = [[-9, 0], [9, 0], [9, 9]]\n"),
              HasSubstr("not square"))
      << "its third side leads back";
  EXPECT_THAT(said(good + "gravity = [1, -9]\n" + material(0.5, 0) + one + wide), HasSubstr("askew"));
  EXPECT_THAT(said(good + kFalls + kDisc + ball(0, 1, 9, 0) + floor), HasSubstr("the end of a wall"));
  EXPECT_THAT(said("time = { dt = \"auto\", until = 2 }\n" + one), HasSubstr("time.error: is missing"));
  EXPECT_THAT(said("time = { error = 0.1, until = 2 }\n" + one), HasSubstr("needs dt = \"auto\""));
  EXPECT_THAT(said("time = { dt = \"auto\", error = 0.1, substeps = 4 }\n" + one), HasSubstr("is chosen"));
  EXPECT_THAT(said("time = { dt = \"auto\", error = 1e-12, until = 1e5 }\n" + kFalls + one + floor),
              HasSubstr("allow a larger error"));
}

// It happened: a square that tips or lands on a corner was promised to keep its way, and was off by up to a
// thousand times as much; a disc in a corner was the farther off the shorter its steps were.
TEST(AutoTime, RefusesWhatIsSensitive) {
  const auto said = [](const std::string& scene) {
    return to_string(load_scenario_text("throng = 1\n" + wanted(1e-3, 1) + scene, "a").diagnostics, "a");
  };
  const std::string floor = "[[walls]]\nsegment = [[-99, 0], [99, 0]]\n";
  const auto square = [](const char* more) {
    return std::string(
               "[shapes]\nbox.polygon = [[0, 0], [1, 0], [1, 1], [0, 1]]\n[[bodies]]\nshape = \"box\"\n") +
           more;
  };
  EXPECT_THAT(said(kFalls + floor + square("at = [0, 1.5]\nangle = 0.3\n")), HasSubstr("land on a corner"));
  EXPECT_THAT(said("gravity = [7.5, -6.3]\n" + material(0, 2) + floor + square("at = [0, 0.5]\n")),
              AllOf(HasSubstr("tip over"), Not(HasSubstr("event_driven"))));
  EXPECT_EQ(said("gravity = [7.5, -6.3]\n" + material(0, 0.5) + floor + square("at = [0, 0.5]\n")), "");
  EXPECT_THAT(said(kFalls + material(0, 1.2) + floor + square("at = [0, 0.5]\nvelocity = [3, 0]\n")),
              HasSubstr("tip over"));
  EXPECT_EQ(said(kFalls + material(0, 0.8) + floor + square("at = [0, 0.5]\nvelocity = [3, 0]\n")), "");
  EXPECT_THAT(said(kFalls + material(0.5, 0.8) + floor + square("at = [0, 0.5]\n")), HasSubstr("bounces"));
  EXPECT_THAT(said(kFalls + "[[walls]]\nsegment = [[-99, 0], [1, 0]]\n" +
                   square("at = [0, 0.5]\nvelocity = [3, 0]\n")),
              HasSubstr("the end of a wall"));
  const std::string box = std::string("domain = { box = [[0, 0], [4, 4]] }\n") + kDisc;
  EXPECT_THAT(said(kFalls + box + ball(1, 0.5, 2.9, 0)), HasSubstr("two walls at once"));
  EXPECT_EQ(said(kFalls + box + ball(1, 0.5, 2.4, 0)), "") << "it doesn't get there";
  EXPECT_EQ(said(kFalls + box + ball(1, 0.5, 2.9, 0) + material(0, 0)), "");
  const std::string kinked = "[[walls]]\npolyline = [[-5, 0], [0, 1e-9], [5, 0]]\n",
                    boxes =
                        square("place.lattice = { origin = [0, 0.5], spacing = [1, 1], size = [1, 2] }\n");
  EXPECT_THAT(said(kFalls + kinked + square("at = [0, 0.5]\n")), HasSubstr("end of a wall"));
  EXPECT_THAT(said(kFalls + kinked + boxes), HasSubstr("end of a wall")) << "the same of two";
  EXPECT_EQ(said(kFalls + floor + boxes), "");
  EXPECT_EQ(said(towers(0.25, 5, 1, 1)), "");
  EXPECT_THAT(said(towers(0.24, 5, 1, 1)), HasSubstr("four times as high as wide"));
  EXPECT_THAT(said(towers(0.24, 5, 3, 0.24)), HasSubstr("four times as high as wide"));
}

// It happened: a disc that spins left the domain, and two met behind its border, whom nobody had looked for.
TEST(AutoTime, LooksForNothingBehindAPeriodicBorder) {
  const auto said = [](double x) {
    const std::string text = "throng = 1\n" + wanted(1e-2, 1) + kFalls +
                             "domain = { periodic = [[0, -5], [10, 15]] }\n" + material(0, 0.5) + kDisc +
                             ball(x, 0.5, 0, 0, -3) + "[[walls]]\nsegment = [[-99, 0], [99, 0]]\n";
    return to_string(load_scenario_text(text, "a").diagnostics, "a");
  };
  EXPECT_EQ(said(5.0), "");
  EXPECT_THAT(said(9.2), HasSubstr("may leave the periodic domain"));
  const auto promised = [](double x, double other) {
    return auto_time(
               Trial("time = { dt = \"auto\", error = 0.01, until = 0.5 }\ngravity = [0, -1]\ndomain = { "
                     "periodic = [[0, 0], [10, 20]] }\n" +
                     material(0, 0) + kDisc + ball(x, 10.4, 8, 0) + ball(other, 10, 0, 0))
                   .scene)
        .promise;
  };
  EXPECT_THAT(promised(9, 1), Not(HasSubstr("off its exact way")));
  EXPECT_THAT(promised(4, 6), Not(HasSubstr("off its exact way")));
}

// It happened: two that fell apart in the void counted as a heap, which bears longer steps than a fall.
TEST(AutoTime, TakesTheStricterOfWhatApplies) {
  for (const std::string& more : {ball(3, 0, 0, 0), ball(300, 20, 0, 0) + ball(300, 21, 0, 0)}) {
    Trial run(wanted(1e-3, 2) + kFalls + kDisc + ball(0, 0, 0, 0) + more);
    EXPECT_THAT(auto_time(run.scene).promise, HasSubstr("off its exact way"));
    run.steps(static_cast<int>(run.scene.time.steps()));
    EXPECT_LE((run.state.position[0] - Vec(0, -0.5 * 9.81 * 4)).norm() / 0.5, 1e-3);
  }
}

}  // namespace
}  // namespace throng
