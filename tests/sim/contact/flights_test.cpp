// SPDX-License-Identifier: MIT
// Elastic discs that nothing pulls, against closed forms and against all pairs looked at after each
// collision.
#include "sim/contact/flights.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

#include "sim/periodic.h"
#include "tests/sim/all_pairs.h"
#include "tests/sim/trial.h"

namespace throng {
namespace {

std::string elastic(double friction = 0.0) {
  return "time = { dt = 0.1, until = 1 }\n" + material(1, friction) + kDisc;
}

TEST(Flights, TwoDiscsMeetAtTheirTimeWithinTheStep) {
  Trial run(elastic() + ball(0, 0, 3, 0) + ball(1.1, 0, -1, 0));  // they meet after 0.025 s
  run.steps(1);
  EXPECT_NEAR(run.state.position[0].x(), 0.075 - 0.075, 1e-15);
  EXPECT_NEAR(run.state.position[1].x(), 1.075 + 0.225, 1e-15);
  EXPECT_EQ(run.state.velocity[0], Vec(-1, 0));
  EXPECT_EQ(run.state.velocity[1], Vec(3, 0));
}

TEST(Flights, AnObliqueHitTurnsOnlyTheSpeedAlongTheNormal) {
  // 0.6 beside each other, they touch with the normal (0.8, 0.6), after 0.2 m of way.
  Trial run(elastic() + ball(0, 0, 4, 0) + ball(1.0, 0.6, 0, 0));
  run.steps(1);
  EXPECT_NEAR((run.state.velocity[1] - 3.2 * Vec(0.8, 0.6)).norm(), 0.0, 1e-14);
  EXPECT_NEAR((run.state.velocity[0] - Vec(1.44, -1.92)).norm(), 0.0, 1e-14);
  EXPECT_NEAR((run.state.position[0] - (Vec(0.2, 0) + 0.05 * Vec(1.44, -1.92))).norm(), 0.0, 1e-14);
}

TEST(Flights, AChainOfCollisionsHappensWithinOneStep) {
  std::string text = elastic() + ball(0, 0, 20, 0);
  for (int i = 1; i < 5; ++i) text += ball(1.01 * i, 0, 0, 0);
  Trial run(text);
  run.steps(1);
  for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR(run.state.velocity[i].norm(), 0.0, 1e-13) << i;
  EXPECT_NEAR(run.state.position[4].x(), 4.04 + 2.0 - 0.04, 1e-13);
}

/// From some 200 a disc and step on, these lost nearly all their energy.
TEST(Flights, HoweverManyCollisionsAStepHasAllAreTaken) {
  const std::string box = "domain = { box = [[0, 0], [10, 10]] }\n";
  Trial bounces(box + "time = { dt = 1, until = 10 }\n" + material(1, 0) + kDisc + ball(5, 5, 3000, 0));
  bounces.steps(10);
  EXPECT_EQ(bounces.state.collisions.walls, 3333);
  EXPECT_EQ(bounces.state.velocity[0].norm(), 3000.0);
  // A disc between a wall and one a million times as heavy: they meet 3141 times (Galperin, 2003).
  Trial pi("time = { dt = 20, until = 20 }\n" + material(1, 0) + "[materials.heavy]\ndensity = 1e6\n" +
           "restitution = 1\nfriction = 0\n" + kDisc + ball(2, 0, 0, 0) +
           "[[bodies]]\nshape = \"ball\"\nmaterial = \"heavy\"\nat = [5, 0]\nvelocity = [-1, 0]\n" +
           "[[walls]]\nsegment = [[0, -3], [0, 3]]\n");
  pi.steps(1);
  EXPECT_EQ(pi.state.collisions.pairs + pi.state.collisions.walls, 3141);
  EXPECT_NEAR(pi.energy() / kinetic_energy(pi.scene, initial_state(pi.scene)), 1.0, 1e-9);
}

TEST(Flights, ARubbingHitFollowsCoulomb) {
  // Radius 0.5, solid: inertia m r^2 / 2, so what stops the slip of two equal discs is m / 6 of it.
  for (const double friction : {0.05, 0.9}) {
    Trial run(elastic(friction) + ball(0, 0, 4, 0) + ball(1.0, 0.6, 0, 0));
    const double m = mass(run.scene, 0), along = 3.2, slip = 4 * 0.6;
    run.steps(1);
    const double rub = std::min(m * slip / 6.0, friction * m * along);
    const Vec n(0.8, 0.6), across(0.6, -0.8);
    EXPECT_NEAR((run.state.velocity[1] - (along * n + rub / m * across)).norm(), 0.0, 1e-14) << friction;
    EXPECT_NEAR(std::abs(run.state.spin[1]), rub * 0.5 / (m * 0.125), 1e-13) << friction;
    EXPECT_EQ(run.state.spin[0], run.state.spin[1]);
  }
}

TEST(Flights, ADiscKeepsItsWayBetweenWallsAndCornersOfAllKinds) {
  // A wall seen from both sides, its end, a box's side, a triangle's corner, a static disc: the speed stays.
  Trial run(std::string("time = { dt = 0.05, until = 1 }\ndomain = { box = [[-5, -5], [5, 5]] }\n") +
            material(1, 0) +
            "[shapes]\nball = { disc = { radius = 0.5 } }\nwedge = { polygon = [[0, 0], [1, 0], [0, 1]] }\n" +
            "[[bodies]]\nshape = \"wedge\"\nat = [-2.5, 2.5]\nkind = \"static\"\n" +
            "[[bodies]]\nshape = \"ball\"\nat = [3, 3]\nkind = \"static\"\n" +
            "[[walls]]\nsegment = [[-1, -2], [1, -1]]\n" + ball(0, 0.3, 7, 3.3) + ball(-4, -4, 1, 9));
  for (int i = 0; i < 2000; ++i) {
    run.steps(1);
    ASSERT_LT(overlap(run.scene, run.state).max, 1e-12) << "step " << i;
  }
  EXPECT_NEAR(run.energy() / kinetic_energy(run.scene, initial_state(run.scene)), 1.0, 1e-12);
}

TEST(Flights, OverlapsOfTheSceneAreTheSolversMatter) {
  Trial run(elastic() + ball(0, 0, 0, 0) + ball(0.9, 0, 0, 0) + ball(9, 0, 1, 0));
  run.steps(100);
  EXPECT_LT(overlap(run.scene, run.state).max, 0.01);
  EXPECT_NEAR(run.state.position[2].x(), 19.0, 1e-9);
}

TEST(Flights, ADiscThatIsHitBeyondWhereItWasLookedForMissesNothing) {
  // The second stands; hit by the first it gets 20 m far within the step, through where the third stands.
  Trial run(elastic() + ball(0, 0, 300, 0) + ball(5, 0, 0, 0) + ball(15, 0, 0, 0));
  run.steps(1);
  EXPECT_NEAR(run.state.velocity[0].norm() + run.state.velocity[1].norm(), 0.0, 1e-9);
  EXPECT_NEAR(run.state.position[2].x(), 15.0 + 30.0 - 13.0, 1e-9);
}

TEST(Flights, AgreeWithAllPairsLookedAtAfterEachCollision) {
  for (const double dt : {0.02, 0.3}) {
    Trial run(
        "seed = 5\ntime = { dt = " + std::to_string(dt) +
        ", until = 1 }\ndomain = { box = [[0, 0], [8, 8]] }\n" + material(1, 0) +
        "[shapes]\ngrain = { disc = { radius = { uniform = [0.2, 0.5] } } }\n"
        "[[bodies]]\nshape = \"grain\"\ncount = 40\nplace = { random = { within = [[0, 0], [8, 8]] } }\n"
        "velocity = { maxwell = 1.0 }\n");
    AllPairs all(run.scene);
    const double until = 1.2;
    run.steps(static_cast<int>(std::lround(until / dt)));
    all.fly(until);
    EXPECT_GT(all.collisions, 60);
    for (std::size_t i = 0; i < run.state.position.size(); ++i)
      EXPECT_NEAR((run.state.position[i] - all.at[i].cast<double>()).norm(), 0.0, 1e-9) << i << " dt " << dt;
  }
}

TEST(Flights, GoOnWithTheSameBitsFromAnyStep) {
  Trial whole(gallery_scene("gas"));
  whole.steps(43);
  Trial rest(whole.scene);
  rest.state = whole.state;
  whole.steps(50), rest.steps(50);
  EXPECT_EQ(hash(rest.state), hash(whole.state));
}

TEST(Flights, PairsServeSeveralStepsUntilSomebodyGetsFarther) {
  Trial run("time = { dt = 0.01, until = 1 }\n" + material(1, 0) + kDisc + ball(0, 0, 4, 0) +
            ball(3, 0, 0, 0));
  run.steps(1);
  const std::uint64_t finds = run.work.candidates.finds();
  run.steps(8);  // 0.36 m of the 0.375 m that was looked for
  EXPECT_EQ(run.work.candidates.finds(), finds);
  run.steps(2);
  EXPECT_EQ(run.work.candidates.finds(), finds + 1);
}

TEST(Flights, AGasRetracesItsWay) {
  Trial run(gallery_scene("gas"));
  run.steps(100);
  for (Vec& v : run.state.velocity) v = -v;
  run.steps(100);
  for (std::size_t i = 0; i < run.state.position.size(); ++i) {
    const Vec d = run.state.position[i] - run.scene.bodies.position[i];
    const Vec period = run.scene.domain.max - run.scene.domain.min;
    EXPECT_NEAR(nearest_image(d, period).norm(), 0.0, 1e-9) << i;
  }
}

}  // namespace
}  // namespace throng
