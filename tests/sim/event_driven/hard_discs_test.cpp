// SPDX-License-Identifier: MIT
// Hard discs from collision to collision, against closed forms; how they come to rest, and what is refused.
#include "sim/event_driven/hard_discs.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "sim/input_error.h"
#include "sim/simulation_error.h"
#include "tests/sim/event_driven/flown.h"

namespace throng {
namespace {

using ::testing::HasSubstr;

TEST(HardDiscs, TwoDiscsMeetAndPartAsMomentumAndEnergySay) {
  Flown run(setting(1, 0, 10) + ball(0, 0, 3, 0) + ball(100, 0.6, -1, 0));  // 99.2 apart along x at the touch
  run.steps(3);
  const double meet = 99.2 / 4;
  const Vec n(0.8, 0.6);
  const Vec v0 = Vec(3, 0) - 3.2 * n, v1 = Vec(-1, 0) + 3.2 * n;
  EXPECT_NEAR((run.velocity(0) - v0).norm(), 0.0, 1e-13);
  EXPECT_NEAR((run.velocity(1) - v1).norm(), 0.0, 1e-13);
  EXPECT_NEAR((run.at(0) - (meet * Vec(3, 0) + (30 - meet) * v0)).norm(), 0.0, 1e-12);
  EXPECT_EQ(run.simulation->collisions()->pairs, 1);
}

TEST(HardDiscs, ThreeDiscsInARowPassTheSpeedOnAndBack) {
  // The middle one is between two: it goes to and fro until all three fly apart.
  Flown run(setting(1, 0, 1) + ball(0, 0, 2, 0) + ball(3, 0, 0, 0) + ball(8, 0, -1, 0));
  run.steps(9);
  // 2 reaches the middle after 1 s; the middle, with 2, and the third, with -1, meet 4 - 2 + ... at t = 1 +
  // 3/3 = 2 s; the middle, now with -1, runs away from the first, which stands: they meet at x = 2, after 2 s
  // more.
  EXPECT_EQ(run.simulation->collisions()->pairs, 3);
  EXPECT_NEAR(run.velocity(0).x(), -1.0, 1e-14);
  EXPECT_NEAR(run.velocity(1).x(), 0.0, 1e-14);
  EXPECT_NEAR(run.velocity(2).x(), 2.0, 1e-14);
  EXPECT_NEAR(run.at(1).x(), 3.0, 1e-13);
}

TEST(HardDiscs, ABilliardInABoxUnfoldsToAStraightLine) {
  Flown run("time = { dt = 7.3, until = 73 }\ndomain = { box = [[-3, -2], [3, 2]] }\n" + material(1, 0) +
            kDisc + ball(0.3, -0.7, 1.37, 0.91));
  run.steps(10);
  const auto folded = [](double x, double low, double high) {
    const double way = std::fmod(x - low, 2 * (high - low));
    return low + (way <= high - low ? way : 2 * (high - low) - way);
  };
  EXPECT_NEAR(run.at(0).x(), folded(0.3 + 73 * 1.37 + 200 * 5, -2.5, 2.5), 1e-12);
  EXPECT_NEAR(run.at(0).y(), folded(-0.7 + 73 * 0.91 + 200 * 3, -1.5, 1.5), 1e-12);
  EXPECT_GT(run.simulation->collisions()->walls, 20);
}

TEST(HardDiscs, ABouncingDiscRisesAsItsRestitutionSays) {
  // From 1.25 m in 10 m/s^2: down after 0.5 s with 5 m/s; then up for 0.4, 0.32, ... s, each 0.64 as high.
  Flown run("gravity = [0, -10]\n" + setting(0.8, 0, 0.5) + ball(0, 1.75, 0.25, 0) +
            "[[walls]]\nsegment = [[-99, 0], [99, 0]]\n");
  run.steps(8);
  double left = 3.5, up = 4.0;  // s since the first bounce, m/s after it
  int bounces = 1;
  while (left > 2 * up / 10) left -= 2 * up / 10, up *= 0.8, ++bounces;
  EXPECT_EQ(run.simulation->collisions()->walls, bounces);
  EXPECT_NEAR(run.at(0).y(), 0.5 + up * left - 5 * left * left, 1e-12);
  EXPECT_NEAR(run.at(0).x(), 0.25 * 4.0, 1e-14);
}

TEST(HardDiscs, BouncesThatNeverEndAreRecognized) {
  Flown run("gravity = [0, -10]\n" + setting(0.8, 0, 0.5) + ball(0, 1.75, 0.25, 0) +
            "[[walls]]\nsegment = [[-99, 0], [99, 0]]\n");
  try {
    run.steps(20);  // at 0.5 + 0.8 / (1 - 0.8) = 4.5 s it lies still
    FAIL() << "it bounces for ever";
  } catch (const SimulationError& error) {
    EXPECT_THAT(error.what(), HasSubstr("at 4.5"));
    EXPECT_THAT(error.what(), HasSubstr("body 1 and a wall"));
    EXPECT_THAT(error.what(), HasSubstr("inelastic collapse"));
  }
}

// "Inelastic collapse" was said of elastic discs, too.
TEST(HardDiscs, WithoutRoomAreToldToLeaveGaps) {
  const std::string walls =
      "[[walls]]\nsegment = [[-0.5, -9], [-0.5, 9]]\n[[walls]]\nsegment = [[0.5, -9], [0.5, 9]]\n";
  Flown run(setting(1, 0, 0.5) + ball(0, 0, 1, 0) + walls);
  try {
    run.steps(1);
    FAIL() << "it bounces for ever";
  } catch (const SimulationError& error) {
    EXPECT_THAT(error.what(), HasSubstr("body 1 and a wall"));
    EXPECT_THAT(error.what(), HasSubstr("leave gaps"));
    EXPECT_THAT(error.what(), ::testing::Not(HasSubstr("inelastic")));
  }
}

/// Lets a disc bounce on that until it must have come to rest. Returns what is said then.
std::string coming_to_rest(double floor, double restitution, const std::string& ground) {
  Flown run("gravity = [0, -9.81]\ntime = { dt = 0.1, until = 60 }\n" + material(restitution, 0) +
            "[shapes]\nball = { disc = { radius = 0.1 } }\n" + ball(0.05, floor + 1.37, 0, 0) + ground);
  try {
    for (int i = 0; i < 600; ++i) {
      run.steps(1);
      if (run.at(0).y() < floor + 0.1 - 1e-9) return "fell to " + std::to_string(run.at(0).y());
    }
  } catch (const SimulationError& error) {
    return error.what();
  }
  return "flew on";
}

// It happened: on most of these floors rounding let it fall through, or bounce 1e8 times a second for ever.
TEST(HardDiscs, ComeToRestOnFloorsWhereverTheseAre) {
  for (const double floor : {0.0, 0.3, 1.1, -2.7, 100.3})
    for (const double restitution : {0.5, 0.7, 0.9}) {
      const std::string y = std::to_string(floor),
                        box = "[-5, " + y + "], [5, " + std::to_string(floor + 9) + "]";
      const std::string grounds[] = {"[domain]\nbox = [" + box + "]\n",
                                     "[[walls]]\nsegment = [[-9, " + y + "], [9, " + y + "]]\n",
                                     "[[walls]]\npolyline = [[0.05, -200], [0.05, " + y + "]]\n",
                                     "[[bodies]]\nshape = \"ball\"\nkind = \"static\"\nat = [0.05, " +
                                         std::to_string(floor - 0.1) + "]\n"};
      for (const std::string& ground : grounds)
        EXPECT_THAT(coming_to_rest(floor, restitution, ground), HasSubstr("inelastic collapse"))
            << ground << "restitution " << restitution;
    }
}

TEST(HardDiscs, WhoStaysWithSomebodyHasCollidedOnce) {
  // A hundred pairs, and a hundred discs and walls, in as many directions; then speed and gap are rounding's.
  Scene scene = scene_from("engine = \"event_driven\"\n" + setting(0, 0, 1.01) + ball(0, 0, 0, 0));
  Bodies& bodies = scene.bodies;
  const auto add = [&](const Vec& at, const Vec& velocity) {
    for (auto* all : {&bodies.shape, &bodies.material}) all->push_back(0);
    bodies.kind.push_back(BodyKind::dynamic), bodies.radius.push_back(0.5);
    bodies.position.push_back(at), bodies.velocity.push_back(velocity);
    bodies.angle.push_back(0.0), bodies.spin.push_back(0.0);
  };
  for (int i = 1; i <= 100; ++i) {
    const Vec n(std::cos(0.3 * i), std::sin(0.3 * i)), t(-n.y(), n.x()), pair(10 * i, 9), wall(10 * i, 30);
    add(pair - n, 0.5 * n), add(pair + n, -0.5 * n);
    add(wall - 1.5 * n, n);
    scene.walls.push_back({{wall - 3 * t, wall + 3 * t}, false, 0});
  }
  Flown run(std::move(scene));
  run.steps(1);
  EXPECT_EQ(run.simulation->collisions()->pairs, 100);
  EXPECT_EQ(run.simulation->collisions()->walls, 100);
}

TEST(HardDiscs, CollapseWhereNothingPulls) {
  // A heavy disc squeezes a light one against a wall: it stops after infinitely many collisions.
  Flown run("time = { dt = 1, until = 20 }\n" + material(0.5, 0) +
            "[shapes]\nball = { disc = { radius = 5 } }\nsmall = { disc = { radius = 0.5 } }\n" +
            ball(10, 0, -1, 0) + "[[bodies]]\nshape = \"small\"\nat = [1, 0]\n" +
            "[[walls]]\nsegment = [[0, -9], [0, 9]]\n");
  EXPECT_THROW(run.steps(20), SimulationError);
  EXPECT_LT(run.simulation->collisions()->walls, 1200) << "a thousand times without time between";
}

TEST(HardDiscs, TurnBackAtTheBorderOfACell) {
  // 200 discs in 24 x 11 cells, thrown up so that they come as high as a border, but for rounding.
  const double g = 9.81, border = 5 * (10.0 / 11);
  std::string text =
      "gravity = [0, -9.81]\ntime = { dt = 0.1, until = 1 }\ndomain = { box = [[0, 0], [20, 10]] }\n" +
      material(1, 0) + "[shapes]\nball = { disc = { radius = 0.04 } }\n";
  for (int i = 0; i < 200; ++i) text += ball(0.05 + 0.1 * i, 1, 0, 0);
  Scene scene = scene_from(text);
  for (std::size_t i = 0; i < 200; ++i) {
    const double y = border - 0.1 - 0.004 * static_cast<double>(i);
    scene.bodies.position[i].y() = y;
    scene.bodies.velocity[i].y() = std::sqrt(2 * g * (border - y));
  }
  scene.engine = Engine::event_driven;
  Flown run(scene);
  run.steps(8);
  for (std::size_t i = 0; i < 200; ++i)
    EXPECT_NEAR(run.at(i).y(), scene.bodies.position[i].y() + 0.8 * scene.bodies.velocity[i].y() - 0.32 * g,
                1e-14);
}

// It happened: two collisions at one time, each time the outer one comes, were counted as a thousand.
TEST(HardDiscs, MayCollideTwiceAtATimeAsOftenAsTheyLike) {
  Flown run("domain = { box = [[0, 0], [10, 10]] }\n" + setting(1, 0, 100) + ball(5, 5, 1, 0) +
            ball(9.5, 5, 0, 0));
  run.steps(400);  // 16 s there and back
  EXPECT_EQ(run.simulation->collisions()->pairs, 2 * 2500);
  EXPECT_EQ(run.at(0), Vec(5, 5));
}

TEST(HardDiscs, DiscsThatLoseAllSpeedStayTogether) {
  Flown run(setting(0, 0) + ball(0, 0, 1, 0) + ball(2, 0, 0, 0));
  run.steps(30);
  EXPECT_EQ(run.velocity(0), Vec(0.5, 0));
  EXPECT_NEAR((run.at(1) - run.at(0)).norm(), 1.0, 1e-15);
  EXPECT_EQ(run.simulation->collisions()->pairs, 1);
}

TEST(HardDiscs, FlyAnyDistanceInTheOpenPlane) {
  // Two pairs start together and end in cells that fold onto each other, one of them 20 km away.
  Flown run(setting(1, 0, 1) + ball(0, 0, 900, 3) + ball(21000, 0, 10, 3) + ball(0, 5, 0, 0) +
            ball(3, 5, -1, 0));
  run.steps(30);
  EXPECT_EQ(run.simulation->collisions()->pairs, 2);
  EXPECT_NEAR(run.velocity(0).x(), 10.0, 1e-9);
  EXPECT_NEAR(run.velocity(2).x(), -1.0, 1e-12);
}

TEST(HardDiscs, RefuseWhatIsNoHardDiscAndSayWhy) {
  const std::string one = std::string(kDisc) + ball(0, 2, 0, 0);
  EXPECT_EQ(engine_refusal(Engine::event_driven, one), "");
  EXPECT_THAT(engine_refusal(Engine::event_driven, "contact = { model = \"none\" }\n" + one),
              HasSubstr("contact.model"));
  EXPECT_THAT(engine_refusal(Engine::event_driven, one + "kind = \"kinematic\"\n"),
              HasSubstr("body 1 is kinematic"));
  EXPECT_THAT(engine_refusal(Engine::event_driven, "[materials.default]\nrolling_resistance = 0.1\n" + one),
              HasSubstr("rolling_resistance"));
  const std::string tar = "[materials]\ntar = { rolling_resistance = 0.1 }\n";
  EXPECT_THAT(engine_refusal(Engine::event_driven,
                             tar + one + "[[walls]]\nsegment = [[-9, -9], [9, -9]]\nmaterial = \"tar\"\n"),
              HasSubstr("materials.tar.rolling_resistance"));
  EXPECT_THAT(engine_refusal(Engine::event_driven,
                             "domain = { box = [[-9, -9], [9, 9]] }\n[materials]\nice = { friction = 0 }\n"
                             "default = { rolling_resistance = 0.1 }\n" +
                                 one + "material = \"ice\"\n"),
              HasSubstr("materials.default.rolling_resistance"))
      << "of the box";
  EXPECT_EQ(engine_refusal(Engine::event_driven, tar + one), "") << "of nobody";
  EXPECT_THAT(
      engine_refusal(Engine::event_driven, "domain = { periodic = [[0, 0], [3.9, 9]] }\n" + one),
      HasSubstr("domain.periodic: must be at least 4 m wide and high, four times the largest disc (1 m "
                "across), and it is 3.9 m; native needs 2.5 times"));
  EXPECT_THAT(engine_refusal(Engine::event_driven,
                             "[shapes]\nbox = { polygon = [[0, 0], [1, 0], [1, 1]] }\n[[bodies]]\nshape = "
                             "\"box\"\nat = [0, 0]\n"),
              HasSubstr("shapes.box"));
  EXPECT_THAT(engine_refusal(Engine::event_driven, one + ball(0.9, 2, 0, 0)),
              HasSubstr("body 1 and body 2 overlap by 0.1"));
  EXPECT_THAT(engine_refusal(Engine::event_driven, one + ball(0.99999, 2, 0, 0)),
              HasSubstr("overlap by 1e-05 m"));
  EXPECT_THAT(engine_refusal(Engine::event_driven, one + "[[walls]]\nsegment = [[-1, 1.8], [1, 1.8]]\n"),
              HasSubstr("overlap by 0.3"));
}

TEST(HardDiscs, BounceAsTheirTwoMaterialsSay) {
  Flown run(
      "time = { dt = 1, until = 9 }\n[materials]\nsoft = { restitution = 0.25, friction = 0 }\n"
      "hard = { restitution = 0.75, friction = 0 }\n" +
      std::string(kDisc) + ball(0, 0, 1, 0) + "material = \"soft\"\n" + ball(3, 0, 0, 0) +
      "material = \"soft\"\n" + ball(0, 9, 1, 0) + "material = \"soft\"\n" +
      "[[walls]]\nsegment = [[3, 8], [3, 10]]\nmaterial = \"hard\"\n");
  run.steps(4);
  EXPECT_NEAR(run.velocity(1).x() - run.velocity(0).x(), 0.25, 1e-15);
  EXPECT_NEAR(run.velocity(2).x(), -0.75, 1e-15);
}

TEST(HardDiscs, TellTheCollisionsOfTheLastStep) {
  // The second one flies from the left: its row comes first. Masses 1 to 4, so it comes back with -0.6.
  Flown run("time = { dt = 1, until = 9 }\n" + material(1, 0) +
            "[shapes]\nball = { disc = { radius = 1 } }\nsmall = { disc = { radius = 0.5 } }\n" +
            ball(4, 0, 0, 0) + "[[bodies]]\nshape = \"small\"\nat = [1, 0]\nvelocity = [1, 0]\n" +
            "[[walls]]\nsegment = [[0, -5], [0, 5]]\n");
  std::vector<ContactRow> rows;
  run.steps(1);
  run.simulation->list_contacts(rows);
  EXPECT_TRUE(rows.empty());
  run.steps(1);
  run.simulation->list_contacts(rows);
  ASSERT_EQ(rows.size(), 1u);
  const double impulse = 1.6 * 0.25 * 3.14159265358979324;  // kg m/s
  EXPECT_EQ(rows[0].a, 1u);
  EXPECT_EQ(rows[0].b, 2u);
  EXPECT_NEAR(rows[0].impulse, impulse, 1e-14);
  EXPECT_NEAR((rows[0].point - Vec(3, 0)).norm(), 0.0, 1e-15);
  EXPECT_NEAR(run.simulation->collisions()->virial, 1.5 * impulse, 1e-14);
  run.steps(3);
  run.simulation->list_contacts(rows);
  ASSERT_EQ(rows.size(), 1u) << "of the wall, after 1.5 + 2 / 0.6 s";
  EXPECT_EQ(run.simulation->contacts(), 1u);
  EXPECT_EQ(rows[0].a, 2u);
  EXPECT_EQ(rows[0].b, 0u);
  EXPECT_NEAR(rows[0].point.norm(), 0.0, 1e-14);
  EXPECT_EQ(run.simulation->collisions()->pairs, 1);
  EXPECT_EQ(run.simulation->collisions()->walls, 1);
}

}  // namespace
}  // namespace throng
