// SPDX-License-Identifier: MIT
#include "sim/contact/find_contacts.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/sim/trial.h"

namespace throng {
namespace {

using narrowphase::Reference;

/// A box of that kind and another that presses on it, tilted so little that their faces are equally wide but
/// for a millionth: the sign says whose is the wider.
std::string stack(const std::string& kind, const std::string& sign) {
  return "gravity = [0, -9.81]\ntime = { dt = 0.01, substeps = 4 }\n"
         "[shapes]\nbox = { polygon = [[-0.5, -0.5], [0.5, -0.5], [0.5, 0.5], [-0.5, 0.5]] }\n"
         "[[bodies]]\nshape = \"box\"\nat = [0, 0]\nkind = \"" +
         kind + "\"\n[[bodies]]\nshape = \"box\"\nat = [0.25, 0.9999]\nangle = " + sign + "2e-6\n";
}

/// The reference of the contact that pressed in the last step.
Reference reference(const Trial& trial) {
  const auto& shape = trial.scene.shapes.at(0).parts.at(0);
  EXPECT_EQ(trial.state.point_contacts.size(), 2u);
  return narrowphase::reference(trial.state.point_contacts.at(0).feature, shape, shape);
}

/// More touches than one thread takes at a time, of boxes that bounce, or that meet faces fast and don't.
TEST(FindContacts, ListsBouncesInOneOrderForAnyNumberOfThreads) {
  for (const char* bounces : {"0.5", "0"}) {
    const Scene scene = scene_from(
        "gravity = [0, -9.81]\ntime = { dt = 0.01, substeps = 4 }\nsleep = false\n"
        "[materials.default]\nrestitution = " +
        std::string(bounces) +
        "\n[shapes]\nbox = { polygon = [[-0.5, -0.5], [0.5, -0.5], [0.5, 0.5], [-0.5, 0.5]] }\n"
        "[[walls]]\nsegment = [[-5, 0], [50, 0]]\n"
        "[[bodies]]\nshape = \"box\"\nvelocity = [0, -60]\nplace = { lattice = { origin = [0, 0.6], "
        "spacing = [1.1, 1.05], size = [40, 30] } }\n");
    Trial one(scene, 1), two(scene, 2);
    std::size_t listed = 0;
    for (int i = 0; i < 20; ++i) {
      one.steps(1), two.steps(1);
      ASSERT_EQ(hash(one.state), hash(two.state)) << "step " << i;
      listed += one.work.contacts.point_bounces.size();
    }
    EXPECT_GT(listed, 50u) << bounces;
    EXPECT_GT(one.work.contacts.faces.size(), 512u);
  }
}

// Boxes that rock on each other: now one face is the wider, now the other.
TEST(FindContacts, KeepsTheReferenceOfTheLastStep) {
  for (const char* kind : {"kinematic", "static"})
    for (bool left : {true, false}) {
      Trial rocking(stack(kind, left ? "+" : "-")), afresh(stack(kind, left ? "-" : "+"));
      rocking.steps(1), afresh.steps(1);
      const Reference first = reference(rocking), other = reference(afresh);
      EXPECT_NE(first.of_b, other.of_b) << "nothing to hold against";
      const State tilted = initial_state(afresh.scene);
      rocking.state.position = tilted.position, rocking.state.angle = tilted.angle;
      rocking.steps(1);
      EXPECT_EQ(reference(rocking).of_b, first.of_b) << kind << " " << left;
      EXPECT_EQ(reference(rocking).edge, first.edge) << kind << " " << left;
    }
}

TEST(FindContacts, ForgetsTheReferenceOfBoxesThatLetGo) {
  Trial rocking(stack("kinematic", "+")), afresh(stack("kinematic", "-"));
  rocking.steps(1), afresh.steps(1);
  const State tilted = initial_state(afresh.scene);
  rocking.state.position[1].y() = 5.0;
  rocking.steps(1);
  EXPECT_TRUE(rocking.state.point_contacts.empty());
  rocking.state.position = tilted.position, rocking.state.angle = tilted.angle;
  rocking.state.velocity = tilted.velocity, rocking.state.spin = tilted.spin;
  rocking.steps(1);
  EXPECT_EQ(reference(rocking).of_b, reference(afresh).of_b);
}

/// Bodies that go where they will, and contacts that are found as if nothing had been before in one of two
/// runs: seats that outlive a step must not show.
TEST(FindContacts, SeatsOfEarlierStepsDontShow) {
  for (const char* domain : {"box = [[0, 0], [12, 14]]", "periodic = [[0, 0], [12, 14]]"}) {
    const std::string text =
        "seed = 3\ngravity = [0, -9.81]\ntime = { dt = 0.01, substeps = 4 }\n[domain]\n" +
        std::string(domain) +
        "\n[shapes]\ngrain = { disc = { radius = { uniform = [0.3, 0.5] } } }\n"
        "stone = { polygon = [[-0.4, -0.3], [0.4, -0.3], [0, 0.5]] }\n"
        "[[bodies]]\nshape = \"grain\"\ncount = 110\n"
        "place = { random = { within = [[0, 0], [12, 12]], gap = 0.01 } }\n"
        "[[bodies]]\nshape = \"stone\"\ncount = 5\n"
        "place = { random = { within = [[0, 0], [12, 12]], gap = 0.01 } }\n";
    Trial kept(text), afresh(text);
    for (int i = 0; i < 400; ++i) {
      kept.steps(1);
      Workspace work(afresh.scene, afresh.plan, 1);
      work.sleepers.look(afresh.state, work.candidates);
      step(afresh.scene, afresh.plan, afresh.state, work);
      ASSERT_EQ(hash(kept.state), hash(afresh.state)) << "step " << i;
    }
  }
}

/// Two that fall side by side and meet in the third step, each at that many times the speed at which what
/// nears hits, and whatever else there is.
std::string meeting(const std::string& shape, double share, const std::string& more = "") {
  const double speed = share * 4.0 * kG * 0.0025, half = shape == "ball" ? 0.5 * std::sqrt(0.96) : 0.5;
  const double far = half + 0.025 * speed;
  const auto one = [&](const std::string& x, const std::string& y, double vx) {
    return "[[bodies]]\nshape = \"" + shape + "\"\nmaterial = \"stone\"\nat = [" + x + ", " + y +
           "]\nvelocity = [" + std::to_string(vx) + ", 0]\n";
  };
  return "gravity = [0, -9.81]\ntime = { dt = 0.01, substeps = 4 }\n[materials.stone]\nfriction = 0.3\n"
         "[materials.rubber]\nrestitution = 0.9\nfriction = 0.3\n"
         "[shapes]\nball = { disc = { radius = 0.5 } }\n"
         "box = { polygon = [[-0.5, -0.5], [0.5, -0.5], [0.5, 0.5], [-0.5, 0.5]] }\n" +
         one(std::to_string(-far), "0", speed) + one(std::to_string(far), "0.2", -speed) + more;
}

std::string far_away(const std::string& material, const std::string& shape, double speed) {
  return "[[bodies]]\nshape = \"" + shape + "\"\nmaterial = \"" + material +
         "\"\nat = [500, 500]\nvelocity = [" + std::to_string(speed) + ", 0]\n";
}

/// Rubber that isn't.
std::string without_bounces(std::string scene) {
  return scene.replace(scene.find("restitution = 0.9"), 17, "restitution = 0.0");
}

void expect_the_same_of_two(const std::string& alone, const std::string& with_another) {
  Trial one(alone), other(with_another);
  for (int step = 0; step < 6; ++step) {
    one.steps(1), other.steps(1);
    for (int i : {0, 1}) {
      EXPECT_EQ(one.state.position[i], other.state.position[i]) << "step " << step;
      EXPECT_EQ(one.state.velocity[i], other.state.velocity[i]) << "step " << step;
      EXPECT_EQ(one.state.spin[i], other.state.spin[i]) << "step " << step;
    }
  }
  EXPECT_LT(one.state.velocity[0].x(), 0.9 * one.scene.bodies.velocity[0].x()) << "they didn't meet";
}

// Each slower than what is fast, and yet they close fast.
TEST(FindContacts, WhoClosesFastIsStoppedHoweverFastOthersAre) {
  for (const double share : {0.3, 0.6, 0.9, 1.5})
    expect_the_same_of_two(without_bounces(meeting("box", share, far_away("stone", "box", 0.0))),
                           without_bounces(meeting("box", share, far_away("stone", "box", 300.0))));
}

/// One that is slower than that, and two that close faster.
TEST(FindContacts, FacesHitFromTheSpeedOnThatGravityGivesInFourSubsteps) {
  for (const double share : {0.45, 0.55, 0.9, 1.5}) {
    Trial run(without_bounces(meeting("box", share)));
    int hit = 0, met = 0;
    for (int step = 0; step < 3; ++step) {
      run.steps(1);
      met += run.work.contacts.faces.size() == 2;
      hit += run.work.contacts.point_bounces.size() == 2;
    }
    EXPECT_GT(met, 0) << share;
    EXPECT_EQ(hit, 2.0 * share > 1.0 ? met : 0) << share;
  }
}

TEST(FindContacts, WhatDoesntBounceIsStoppedAlikeWhereOthersBounceAndWhereNone) {
  for (const std::string shape : {"ball", "box"})
    for (const double share : {0.3, 0.9, 1.5, 4.0}) {
      const std::string here = meeting(shape, share, far_away("stone", shape, 300.0));
      expect_the_same_of_two(without_bounces(here), here);
    }
}

const char* const kFloor =
    "gravity = [0, -9.81]\ntime = { dt = 0.016666666666666666, substeps = 4 }\n"
    "[materials.default]\nfriction = 0.5\n"
    "[shapes]\nball = { disc = { radius = 0.5 } }\n"
    "box = { polygon = [[-0.5, -0.5], [0.5, -0.5], [0.5, 0.5], [-0.5, 0.5]] }\n"
    "[[walls]]\nsegment = [[-50, 0], [50, 0]]\n";

std::string falling(const std::string& shape, double y, double speed = 0.0) {
  return "[[bodies]]\nshape = \"" + shape + "\"\nat = [0, " + std::to_string(y) + "]\nvelocity = [0, -" +
         std::to_string(speed) + "]\n";
}

/// m/s, the fastest that one of them goes up, who lie on the floor in the end.
double throws_up(const std::string& bodies) {
  Trial run(kFloor + bodies);
  double fastest = 0.0;
  for (int step = 0; step < 120; ++step) {
    run.steps(1);
    for (const Vec& velocity : run.state.velocity) fastest = std::max(fastest, velocity.y());
  }
  EXPECT_LT(run.state.position[0].y(), 0.51) << "it didn't land";
  return fastest;
}

/// Of the speed at which so many on one another land, the part that comes back at worst.
double worst_of_stacks(const std::string& shape, int n) {
  double worst = 0.0;
  for (const double gap : {0.0, 0.03, 0.1})
    for (const double height : {0.5, 1.5, 2.3, 5.0}) {
      std::string stack;
      for (int i = 0; i < n; ++i) stack += falling(shape, height + 0.5 + i * (1.0 + gap));
      worst = std::max(worst, throws_up(stack) / std::sqrt(2.0 * kG * height));
    }
  return worst;
}

/// More would take more sweeps.
TEST(FindContacts, StacksThatDontBounceStayDown) {
  for (const std::string shape : {"ball", "box"}) {
    EXPECT_LT(worst_of_stacks(shape, 1), 1e-4) << shape;
    EXPECT_LT(worst_of_stacks(shape, 2), 0.02) << shape;
    EXPECT_LT(worst_of_stacks(shape, 3), 0.05) << shape;
    EXPECT_LT(worst_of_stacks(shape, 5), 0.12) << shape;
  }
}

// In the step in which the lower one lands.
TEST(FindContacts, WhoOvertakesOneThatLandsIsStoppedWithHim) {
  for (const std::string shape : {"ball", "box"})
    for (const double speed : {10.0, 20.0, 30.0}) {
      EXPECT_LT(throws_up(falling(shape, 0.55, 10.0) + falling(shape, 1.6, speed)), 0.1) << shape << speed;
      EXPECT_LT(throws_up(falling(shape, 1.0, 10.0) + falling(shape, 2.1, speed)), 0.1) << shape << speed;
    }
}

}  // namespace
}  // namespace throng
