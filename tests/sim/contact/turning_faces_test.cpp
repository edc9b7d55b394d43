// SPDX-License-Identifier: MIT
// Who is pushed by a face that turns goes with it, however far that turns in a step.
#include "sim/contact/turning_faces.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <numbers>

#include "tests/sim/trial.h"

namespace throng {
namespace {

constexpr double kStep = 1.0 / 60.0;  // s
constexpr double kOver = 0.06;        // m, from the blade's middle to that of who lies on it

const char* const kHead =
    "time = { dt = 0.016666666666666667, until = 10 }\n[materials.default]\nfriction = 0\n[shapes]\n"
    "blade = { polygon = [[-3, -0.01], [3, -0.01], [3, 0.01], [-3, 0.01]] }\n"
    "disc = { disc = { radius = 0.05 } }\n"
    "box = { polygon = [[-0.2, -0.05], [0.2, -0.05], [0.2, 0.05], [-0.2, 0.05]] }\n";

std::string body(const std::string& shape, const Vec& at, const std::string& more = "") {
  char text[160];
  std::snprintf(text, sizeof text, "[[bodies]]\nshape = \"%s\"\nat = [%.17g, %.17g]\n", shape.c_str(), at.x(),
                at.y());
  return text + more;
}

std::string blade(double spin, const Vec& at = {0.0, 0.0}) {
  return body("blade", at, "kind = \"kinematic\"\nspin = " + std::to_string(spin) + "\n");
}

/// m, of the second body: along the blade, and over its surface on that side of it.
Vec on_blade(const Trial& run, double side) {
  const double angle = run.state.angle[0];
  const Vec along(std::cos(angle), std::sin(angle)), way = run.state.position[1] - run.state.position[0];
  return {along.dot(way), side * tangent(along).dot(way) - kOver};
}

/// From rest: r'' = ω² r along the blade, and the first push leaves the spin's share of the way from the
/// blade's middle.
double slid_to(double start, double spin, double time) {
  return start * std::cosh(spin * time) + kOver * std::sinh(spin * time);
}

class ADiscBeforeABlade : public testing::TestWithParam<double> {};

/// It sags as soft contacts do under 2 w times its speed. When faces stood as the step began it got in by 2,
/// 8, 16 and 48 mm, and fell behind by 0.4 to 2.7 %; by up to 1.3 mm and 1e-3 when they turned by Turn.
TEST_P(ADiscBeforeABlade, SlidesOutAlongItsFace) {
  const double spin = GetParam();
  for (const double side : {1.0, -1.0}) {
    Trial run(kHead + blade(side * spin) + body("disc", {1.0, side * kOver}));
    const int steps = static_cast<int>(1.2 / (spin * kStep));
    for (int step = 0; step < steps; ++step) {
      run.steps(1);
      const Vec where = on_blade(run, side);
      EXPECT_GT(where.y(), -2e-5 - 2.5e-5 * spin * spin) << spin << ", step " << step;
      EXPECT_NEAR(where.x() / slid_to(1.0, spin, (step + 1) * kStep), 1.0, 3e-5 * spin)
          << spin << ", step " << step;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Spins, ADiscBeforeABlade, testing::Values(1.0, 2.0, 3.0, 6.0));

/// A box lies flat on the blade, by two points, whichever of the two comes first. It is pressed on by up to
/// 40 m/s², and sags by that over the square of its contacts' frequency, some 450/s, times a few.
TEST(TurningFaces, ABoxStaysFlatOnABlade) {
  for (const bool box_first : {false, true}) {
    const std::string box = body("box", {0.5, kOver});
    Trial run(kHead + (box_first ? box + blade(3.0) : blade(3.0) + box));
    const std::size_t of_box = box_first ? 0 : 1, of_blade = 1 - of_box;
    for (int step = 0; step < 24; ++step) {
      run.steps(1);
      const double angle = run.state.angle[of_blade];
      const Vec across(-std::sin(angle), std::cos(angle));
      EXPECT_GT(across.dot(run.state.position[of_box]) - kOver, -8e-4) << "step " << step;
      EXPECT_NEAR(run.state.angle[of_box], angle, 2e-3) << "step " << step;
    }
  }
}

/// Nothing falls: each nearing is a hit. When hits met the face as it stood, and sweeps as it was felt, each
/// undid what the other did, and the box sank in by 5.6 mm.
TEST(TurningFaces, ABoxThatGoesAlongStaysFlat) {
  Trial run(kHead + blade(6.0) + body("box", {1.0, kOver}, "velocity = [-0.36, 6]\nspin = 6\n"));
  for (int step = 0; step < 10; ++step) {
    run.steps(1);
    const Vec where = on_blade(run, 1.0);
    EXPECT_GT(where.y(), -6e-4) << "step " << step;
    EXPECT_NEAR(where.x() / std::cosh(6.0 * (step + 1) * kStep), 1.0, 3e-4) << "step " << step;
    EXPECT_NEAR(run.state.spin[1], 6.0, 0.04) << "step " << step;
  }
}

/// Five discs as one body in the corner of a frame, the middle one in touch with nothing. By two of its
/// points it is apart by less than it comes nearer in a step: their planes stood, and its spin was 10.57
/// rad/s.
TEST(TurningFaces, TakeACompositeAlongInACorner) {
  Trial run(std::string(kHead) +
            "five = { discs = [[-0.1, -0.1, 0.1], [0.1, 0.1, 0.1], [-0.1, 0.1, 0.1], [0.1, -0.1, 0.1], [0, "
            "0, 0.1]] }\n"
            "frame = { polygon = [[-1.2, -1.2], [1.2, -1.2], [1.2, 1.2], [-1.2, 1.2]], "
            "holes = [[[-1, -1], [-1, 1], [1, 1], [1, -1]]] }\n" +
            body("five", {0.8, 0.8}, "velocity = [-8, 8]\nspin = 10\n") +
            body("frame", {0.0, 0.0}, "kind = \"kinematic\"\nspin = 10\n"));
  for (int step = 0; step < 120; ++step) {
    run.steps(1);
    if (step > 60) {
      EXPECT_NEAR(run.state.spin[0], 10.0, 0.01) << step;
    }
  }
  EXPECT_NEAR(run.state.angle[0], run.state.angle[1], 1e-3);
}

std::string rubs(const char* friction) {
  std::string head = kHead;
  return head.replace(head.find("friction = 0"), 12, std::string("friction = ") + friction);
}

/// Its two sides strike it one after the other: where the first one's friction wasn't asked again once the
/// second had turned the disc, it turned by 0.33 rad in 3 s, by 0.14 at 2 ms, and where faces rubbed who goes
/// along with them by chords by 0.68.
TEST(TurningFaces, HardlyTurnADiscThatRubsInACorner) {
  for (const double dt : {kStep, 0.002}) {
    Scene scene = scene_from(
        rubs("0.5") +
        "ball = { disc = { radius = 0.2 } }\nframe = { polygon = [[-1.2, -1.2], [1.2, -1.2], [1.2, 1.2], "
        "[-1.2, 1.2]], holes = [[[-1, -1], [-1, 1], [1, 1], [1, -1]]] }\n" +
        body("ball", {0.8, 0.8}, "velocity = [-8, 8]\nspin = 10\n") +
        body("frame", {0.0, 0.0}, "kind = \"kinematic\"\nspin = 10\n"));
    scene.time.dt = dt;
    Trial run(scene);
    run.steps(static_cast<int>(std::lround(3.0 / dt)));
    EXPECT_NEAR(run.state.angle[0], run.state.angle[1], 5e-3) << dt;
  }
}

/// It spins against the face as it rolls, and isn't rubbed for that: it was spun up by a tenth.
TEST(TurningFaces, LetADiscRollOn) {
  for (const double spin : {-0.05, 0.0, 0.05}) {
    Trial run("gravity = [0, -9.81]\n" + rubs("1") +
              "plank = { polygon = [[-20, -0.5], [20, -0.5], [20, 0.5], [-20, 0.5]] }\n"
              "ball = { disc = { radius = 0.02 } }\n" +
              body("plank", {0.0, -0.5}, "kind = \"kinematic\"\nspin = " + std::to_string(spin) + "\n") +
              body("ball", {-1.0, 0.02}, "velocity = [4, 0]\nspin = -200\n"));
    run.steps(30);
    const Vec way = run.state.position[1] - run.state.position[0];
    const Vec slip = run.state.velocity[1] - spin * tangent(way);
    EXPECT_NEAR((run.state.spin[1] - spin) * 0.02 / -slip.norm(), 1.0, 1e-3) << spin;
  }
}

/// What lands flush on a floor turns, but it is the floor's plane that it meets: it was thrown aside.
TEST(TurningFaces, AreNotThoseOfWhoLandsFlushOnAFloor) {
  for (const char* floor :
       {"[[walls]]\nsegment = [[-10, 0], [10, 0]]\n", "[domain]\nbox = [[-10, 0], [10, 10]]\n",
        "[[bodies]]\nshape = \"slab\"\nat = [0, -1]\nkind = \"static\"\n",
        "[[bodies]]\nshape = \"slab\"\nat = [0, -1]\nkind = \"kinematic\"\n"})
    for (const char* more : {"spin = 3\n", "spin = 20\nvelocity = [0, -4]\n"}) {
      Trial run("gravity = [0, -9.81]\nsleep = false\n" + std::string(kHead) +
                "slab = { polygon = [[-10, -1], [10, -1], [10, 1], [-10, 1]] }\n" +
                body("box", {0, 0.05}, more) + floor);
      run.steps(60);
      EXPECT_NEAR(run.state.velocity[0].x(), 0.0, 1e-13) << floor << more;
    }
}

/// Over the border of a domain that repeats as anywhere else.
TEST(TurningFaces, PushAnImageAsItself) {
  const auto run = [&](double x) {
    Trial trial("domain = { periodic = [[-10, -10], [10, 10]] }\n" + std::string(kHead) +
                blade(3.0, {x, 0.0}) + body("disc", {x + 1.0, kOver}));
    trial.steps(20);
    Vec way = trial.state.position[1] - trial.state.position[0];
    way.x() -= 20.0 * std::round(way.x() / 20.0);
    return way;
  };
  const Vec whole = run(0.0), over_border = run(9.5);
  EXPECT_LT((over_border - whole).norm(), 1e-9);
}

/// Nor when it has been left: planes that went on turning threw a disc on by 1.3 m/s.
TEST(TurningFaces, LetGoWhoSlidesOffTheirEnd) {
  const auto leaves_at = [](double dt) {
    Scene scene = scene_from(kHead + blade(6.0) + body("disc", {2.9, kOver}, "velocity = [5, 17.4]\n"));
    scene.time.dt = dt;
    Trial run(scene);
    run.steps(static_cast<int>(std::lround(2.0 * kStep / dt)));
    return run.state.velocity[1];
  };
  EXPECT_LT((leaves_at(kStep) - leaves_at(kStep / 100.0)).norm(), 0.4);
}

/// A disc at rest in the hollow between two facets of a drum stays there: it began to roll and gained energy.
TEST(TurningFaces, TakeADiscAlongInADrum) {
  constexpr int kFacets = 256;
  constexpr double kHalf = std::numbers::pi / kFacets;
  std::string rim, hole;
  for (int i = 0; i < kFacets; ++i) {
    const Vec at(std::cos(2.0 * i * kHalf), std::sin(2.0 * i * kHalf)), in = at / std::cos(kHalf);
    char text[80];
    std::snprintf(text, sizeof text, "[%.15g, %.15g],", 1.2 * at.x(), 1.2 * at.y());
    rim += text;
    std::snprintf(text, sizeof text, "[%.15g, %.15g],", in.x(), in.y());
    hole += text;
  }
  const double at = 0.9 / std::cos(kHalf);
  Trial run("time = { dt = 0.01, until = 3 }\n" + material(0.0, 0.5) +
            "[shapes]\nball = { disc = { radius = 0.1 } }\ndrum = { polygon = [" + rim + "], holes = [[" +
            hole + "]] }\n" + body("drum", {0.0, 0.0}, "kind = \"kinematic\"\nspin = 5\n") +
            body("ball", {at, 0.0}, "velocity = [0, " + std::to_string(5.0 * at) + "]\nspin = 5\n"));
  for (int step = 0; step < 300; ++step) {
    run.steps(1);
    const double angle = run.state.angle[0];
    ASSERT_LT((run.state.position[1] - at * Vec(std::cos(angle), std::sin(angle))).norm(), 0.01)
        << "step " << step;
  }
}

/// Whether contacts are known from the steps before or looked for anew: a brick that topples on a slab.
TEST(TurningFaces, GoOnWithTheSameBitsFromAnyStep) {
  Trial whole(
      "gravity = [0, -9.81]\nsleep = false\ntime = { dt = 0.016666666666666667, until = 2, substeps = 4 }\n" +
      material(0.0, 0.9) +
      "[shapes]\nslab = { polygon = [[-0.6, -0.3], [0.6, -0.3], [0.6, 0.3], [-0.6, 0.3]] }\n"
      "brick = { polygon = [[-0.1, -0.2], [0.1, -0.2], [0.1, 0.2], [-0.1, 0.2]] }\n" +
      body("slab", {0.0, -0.3}, "kind = \"kinematic\"\n") +
      body("brick", {0.0, 0.223606}, "angle = -0.47\n"));
  for (int step = 0; step < 70; ++step) {
    Trial resumed(whole.scene);
    resumed.state = whole.state;
    whole.steps(1), resumed.steps(1);
    ASSERT_EQ(hash(resumed.state), hash(whole.state)) << "step " << step;
  }
}

/// Nobody's plane turns before it is touched: it would go on beyond the blade's end.
TEST(TurningFaces, WhoPassesABladesEndIsntStopped) {
  for (int i = 0; i < 20; ++i) {
    const double spin = 6.0, y = 0.1 + 0.02 * i;
    Trial run(kHead + blade(spin) + body("disc", {3.2, y}, "velocity = [0, -40]\n"));
    run.steps(3);
    EXPECT_EQ(run.state.velocity[1], Vec(0.0, -40.0)) << y;
  }
}

}  // namespace
}  // namespace throng
