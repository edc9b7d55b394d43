// SPDX-License-Identifier: MIT
// Bodies that slide over the seams of walls and of solids in parts: as over one piece.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tests/sim/trial.h"

namespace throng {
namespace {

const char* const kSliders =
    "[shapes]\nball = { disc = { radius = 0.25 } }\n"
    "box = { polygon = [[-0.25, -0.25], [0.25, -0.25], [0.25, 0.25], [-0.25, 0.25]] }\n"
    "ell = { polygon = [[0, 0], [0.8, 0], [0.8, 0.25], [0.4, 0.25], [0.4, 0.75], [0, 0.75]] }\n"
    "tile = { polygon = [[-0.5, -0.5], [0.5, -0.5], [0.5, 0.5], [-0.5, 0.5]] }\n";

std::string pair(const Vec& v) {
  std::ostringstream out;
  out.precision(17);
  out << "[" << v.x() << ", " << v.y() << "]";
  return out.str();
}

/// A plane that is turned by an angle: what stands along and above its floor.
struct Tilted {
  double angle = 0.0;

  Vec operator()(double along, double above) const {
    return {std::cos(angle) * along - std::sin(angle) * above,
            std::sin(angle) * along + std::cos(angle) * above};
  }
  std::string slider(const std::string& shape, double above) const {
    std::ostringstream out;
    out.precision(17);
    out << "gravity = " << pair((*this)(0, -9.81)) << "\n[materials.default]\nfriction = 0\n"
        << kSliders << "[[bodies]]\nshape = \"" << shape << "\"\nangle = " << angle
        << "\nat = " << pair((*this)(1, above)) << "\nvelocity = " << pair((*this)(10, 0)) << "\n";
    return out.str();
  }
};

/// The fastest that the body leaves the floor, from the third second on, when it has come to rest on it,
/// until it has slid over 80 m.
double kick(Trial& trial, const Tilted& tilted, double speed_error = 1e-8) {
  trial.steps(300);
  double most = 0.0;
  for (int i = 0; i < 500; ++i) {
    trial.steps(1);
    most = std::max(most, std::abs(trial.state.velocity[0].dot(tilted(0, 1))));
  }
  EXPECT_NEAR(trial.state.velocity[0].dot(tilted(1, 0)), 10.0, speed_error);
  EXPECT_GT(trial.state.position[0].dot(tilted(1, 0)), 80.0);
  return most;
}

TEST(Seams, OfAPolylineKickNobody) {
  for (const double angle : {0.0, 0.3})
    for (const std::string shape : {"ball", "box", "ell"}) {
      const Tilted tilted{angle};
      std::string floor = "[[walls]]\npolyline = [";
      for (int i = 0; i <= 1000; ++i) floor += pair(tilted(0.1 * i, 0)) + ", ";
      Trial trial(tilted.slider(shape, 0.32) + floor + "]\n");
      EXPECT_LT(kick(trial, tilted), 1e-11) << shape << " at " << angle;  // 1e-12 of its speed
    }
}

TEST(Seams, OfAThousandSegmentsKickNobody) {
  for (const std::string shape : {"ball", "box", "ell"}) {
    const Tilted tilted{0.3};
    std::string floor;
    for (int i = 0; i < 1000; ++i)
      floor +=
          "[[walls]]\nsegment = [" + pair(tilted(0.1 * i, 0)) + ", " + pair(tilted(0.1 * (i + 1), 0)) + "]\n";
    Trial trial(tilted.slider(shape, 0.32) + floor);
    EXPECT_LT(kick(trial, tilted), 1e-11) << shape;
  }
}

/// A floor with a straight top and teeth below: dozens of parts, whose seams reach the top's ends only.
TEST(Seams, OfADecomposedPolygonKickNobody) {
  for (const std::string shape : {"ball", "box", "ell"}) {
    const Tilted tilted;
    std::string floor = "[shapes.comb]\npolygon = [[100, 0], [0, 0], [0, -3]";
    for (int i = 0; i < 100; ++i)
      floor += ", " + pair({i + 0.2, -3}) + ", " + pair({i + 0.5, -1}) + ", " + pair({i + 0.8, -3});
    floor += ", [100, -3]]\n[[bodies]]\nshape = \"comb\"\nkind = \"static\"\nat = [50, -1.2]\n";
    Trial trial(tilted.slider(shape, 0.45) + floor);
    EXPECT_LT(kick(trial, tilted), 1e-11) << shape;
  }
}

std::string tiles(const Tilted& tilted, const std::string& kind, int first) {
  std::ostringstream floor;
  floor.precision(17);
  for (int i = first; i < 100; ++i)
    floor << "[[bodies]]\nshape = \"tile\"\nkind = \"" << kind << "\"\nangle = " << tilted.angle
          << "\nat = " << pair(tilted(i + 0.5, -0.5)) << "\n";
  return floor.str();
}

/// What slides from one body to the next is handed over: nothing stops it, and it doesn't jump. (Once it
/// trembled by hundredths of its speed over static ones, and fell over kinematic ones and where a wall
/// ended.)
TEST(Seams, OfTilesStopNobody) {
  for (const double angle : {0.0, 0.3})
    for (const std::string shape : {"ball", "box", "ell"})
      for (const std::string kind : {"static", "kinematic"}) {
        const Tilted tilted{angle};
        Trial trial(tilted.slider(shape, 0.32) + tiles(tilted, kind, 0));
        EXPECT_LT(kick(trial, tilted, 1e-3), 2e-4) << shape << " at " << angle << " on " << kind << " ones";
      }
}

TEST(Seams, OfAWallAndTilesStopNobody) {
  for (const std::string shape : {"ball", "box", "ell"})
    for (const std::string kind : {"static", "kinematic"}) {
      const Tilted tilted{0.3};
      const std::string wall =
          "[[walls]]\nsegment = [" + pair(tilted(0, 0)) + ", " + pair(tilted(30, 0)) + "]\n";
      Trial trial(tilted.slider(shape, 0.32) + wall + tiles(tilted, kind, 30));
      EXPECT_LT(kick(trial, tilted, 1e-3), 2e-4) << shape << " on " << kind << " ones";
    }
}

/// The surface of a disc that rolls stands where it touches: joints threw it up by 0.02 m/s.
TEST(Seams, OfFlushTilesKickNoDiscThatRolls) {
  for (const double dt : {0.005, 0.001})
    for (const double gap : {0.0, 1e-11, 1e-6}) {
      std::ostringstream text;
      text.precision(17);
      text << "gravity = [0, -10]\ntime = { dt = " << dt << ", until = 3 }\n"
           << material(0.0, 0.5) << "[shapes]\ndisc = { disc = { radius = 0.5 } }\n"
           << "tile = { polygon = [[-10, -1], [10, -1], [10, 1], [-10, 1]] }\n"
           << "[[bodies]]\nshape = \"disc\"\nat = [-1, 0.5]\nvelocity = [1, 0]\nspin = -2\n";
      for (const double x : {-10.0 - gap, 10.0})
        text << "[[bodies]]\nshape = \"tile\"\nat = [" << x << ", -1]\nkind = \"static\"\n";
      Trial trial(text.str());
      for (double time = 0.0; time < 2.0; time += dt) {
        trial.steps(1);
        if (time > 0.2) {
          ASSERT_LT(std::abs(trial.state.velocity[0].y()), 1e-9) << gap << " m, at " << time << " s";
        }
      }
      EXPECT_NEAR(trial.state.velocity[0].x(), 1.0, 1e-6) << gap << " m";
    }
}

/// A frictionless disc that swings in a bowl, of so many pieces, 2 m in radius; `walls` times the same.
std::string bowl(int pieces, double dt, double swing, double radius, int walls = 1) {
  const auto place = [](double r, double angle) { return pair({r * std::sin(angle), -r * std::cos(angle)}); };
  std::ostringstream text, wall;
  text.precision(17);
  text << "gravity = [0, -9.81]\ntime = { dt = " << dt << ", until = 10 }\nsleep = false\n"
       << material(0.0, 0.0) << "[shapes]\nball = { disc = { radius = " << radius << " } }\n"
       << "[[bodies]]\nshape = \"ball\"\nat = " << place(2.0 - radius, swing) << "\n";
  wall << "[[walls]]\npolyline = [";
  for (int i = 0; i <= pieces; ++i)
    wall << place(2.0, std::numbers::pi * (i / double(pieces) - 0.5)) << (i < pieces ? ", " : "]\n");
  for (int i = 0; i < walls; ++i) text << wall.str();
  return text.str();
}

/// It gained 20 to 68 % in ten seconds.
TEST(Seams, OfABowlGiveNoEnergy) {
  for (const double radius : {0.1, 0.3})
    for (const double swing : {0.1, 0.5})
      for (const double dt : {0.002, 0.01, 1.0 / 60.0})
        for (const int pieces : {180, 500, 720, 1440}) {
          Trial trial(bowl(pieces, dt, swing, radius));
          const double lowest = -(2.0 - radius) * kG * mass(trial.scene, 0), before = trial.energy() - lowest;
          trial.steps(static_cast<int>(10.0 / dt));
          EXPECT_LT(trial.energy() - lowest, 1.001 * before)
              << radius << " " << pieces << " " << dt << " " << swing;
          EXPECT_GT(trial.energy() - lowest, 0.7 * before)
              << radius << " " << pieces << " " << dt << " " << swing;
        }
}

/// Of each corner of the second one knew nothing of the bend: the disc was thrown out.
TEST(Seams, OfABowlThatStandsTwiceAreThoseOfOne) {
  Trial once(bowl(500, 0.01, 0.3, 0.1)), twice(bowl(500, 0.01, 0.3, 0.1, 2));
  once.steps(500), twice.steps(500);
  EXPECT_EQ(once.state.position[0], twice.state.position[0]);
}

/// In the step's middle the disc is past the joint, where nothing shows that it is one.
TEST(Seams, OfAWallFlushWithABodyKickNobodyWhoGetsOverThemInHalfAStep) {
  for (const double speed : {5.0, 20.0})
    for (int from = 1; from < 8; ++from) {
      std::ostringstream text;
      text
          << "gravity = [0, -3]\ntime = { dt = 0.01, until = 1 }\n"
          << material(0.0, 0.0) << kDisc << "box = { polygon = [[0, -1], [5, -1], [5, 0], [0, 0]] }\n"
          << ball(0.003 - 0.02 * from, 0.499, speed, -0.9)
          << "[[bodies]]\nshape = \"box\"\nat = [2.5, -0.5]\nkind = \"static\"\n"
          << "[[walls]]\npolyline = [[-50, 0], [-1, 0], [0.5, 0]]\n[[walls]]\npolyline = [[0, 0], [0, -1]]\n";
      Trial trial(text.str());
      trial.steps(3);
      EXPECT_NEAR(trial.state.velocity[0].x(), speed, 1e-9 * speed) << from;
    }
}

TEST(Seams, UnderAWallThatEndsOnTheFloorsOtherSideKickNobody) {
  const Tilted tilted{0.3};
  std::string floor = "[[walls]]\nsegment = [" + pair(tilted(0, 0)) + ", " + pair(tilted(100, 0)) + "]\n";
  for (int i = 1; i < 50; ++i)
    floor += "[[walls]]\nsegment = [" + pair(tilted(2 * i, 0)) + ", " + pair(tilted(2 * i, -1)) + "]\n";
  for (const std::string shape : {"ball", "box", "ell"}) {
    Trial trial(tilted.slider(shape, 0.32) + floor);
    EXPECT_LT(kick(trial, tilted, 1e-5), 1e-4) << shape;
  }
}

/// Two planks that sag into the floor under them, and a step that is one.
TEST(Seams, OfPlanksThatLieOnAFloorStopNobodyButStepsDo) {
  const auto speed_after = [](double step) {
    std::ostringstream text;
    text << "gravity = [0, -9.81]\ntime = { dt = 0.01, until = 2 }\n[materials.default]\nfriction = 0\n"
         << kSliders << "plank = { polygon = [[-5, -0.1], [5, -0.1], [5, 0.1], [-5, 0.1]] }\n"
         << "[[bodies]]\nshape = \"box\"\nat = [-2, 0.45]\nvelocity = [5, 0]\n"
         << "[[bodies]]\nshape = \"plank\"\nat = [-5, 0.1]\n[[bodies]]\nshape = \"plank\"\nat = [5, "
         << 0.1 + step << "]\n[[walls]]\nsegment = [[-20, 0], [0, 0]]\n[[walls]]\nsegment = [[0, " << step
         << "], [20, " << step << "]]\n";
    Trial trial(text.str());
    trial.steps(100);
    return trial.state.velocity[0].x();
  };
  EXPECT_NEAR(speed_after(0.0), 5.0, 1e-4);
  EXPECT_LT(speed_after(0.01), 4.0);
}

/// Slowly over driven slabs that are far larger than the box.
TEST(Seams, OfLongSlabsStopNobodyHoweverSlow) {
  Trial trial("gravity = [0, -9.81]\ntime = { dt = 0.01, until = 9 }\n[materials.default]\nfriction = 0\n" +
              std::string(kSliders) +
              "slab = { polygon = [[-50, -0.5], [50, -0.5], [50, 0.5], [-50, 0.5]] }\n"
              "[[bodies]]\nshape = \"box\"\nat = [-0.4, 0.25]\nvelocity = [0.04, 0]\n"
              "[[bodies]]\nshape = \"slab\"\nkind = \"kinematic\"\nat = [-50, -0.5]\n"
              "[[bodies]]\nshape = \"slab\"\nkind = \"kinematic\"\nat = [50, -0.5]\n");
  trial.steps(800);
  EXPECT_NEAR(trial.state.velocity[0].x(), 0.04, 1e-4);
}

/// What presses is no seam: a bed of pebbles bears what lands on it, a lift lifts who is half on it, and the
/// end of a slab that something far away is sunk in stops who runs against it.
TEST(Seams, AreNotWhatBearsSomebodyOrStopsHim) {
  const std::string ball = "ball = { disc = { radius = 0.25 } }\n",
                    still = "[materials.default]\nfriction = 0\n";
  Trial bed(
      "gravity = [0, -9.81]\ntime = { dt = 0.016666666666666666, until = 2 }\n"
      "[materials.default]\nfriction = 0.5\ndensity = 1\n[materials.lead]\ndensity = 100\n"
      "[shapes]\nbig = { disc = { radius = 1 } }\n"
      "pebble = { polygon = [[-0.015, -0.015], [0.015, -0.015], [0.015, 0.015], [-0.015, 0.015]] }\n"
      "[[bodies]]\nshape = \"big\"\nat = [0, 1.06]\nvelocity = [0, -1]\n"
      "[[bodies]]\nshape = \"pebble\"\nmaterial = \"lead\"\nplace = { lattice = { origin = [-0.62, 0.015], "
      "spacing = [0.031, 0.031], size = [41, 1] } }\n[[walls]]\nsegment = [[-5, 0], [10, 0]]\n");
  bed.steps(18);
  EXPECT_LT(overlap(bed.scene, bed.state).max, 1e-3);

  Trial lift("gravity = [0, -9.81]\ntime = { dt = 0.016666666666666666, until = 1 }\n" + still +
             "[shapes]\n" + ball +
             "lift = { polygon = [[-0.5, -0.5], [0.5, -0.5], [0.5, 0.5], [-0.5, 0.5]] }\n"
             "[[bodies]]\nshape = \"ball\"\nat = [-0.05, 0.25]\n"
             "[[bodies]]\nshape = \"lift\"\nkind = \"kinematic\"\nat = [0.5, -0.5]\nvelocity = [0, 5]\n"
             "[[walls]]\nsegment = [[-3, 0], [0, 0]]\n");
  lift.steps(3);
  EXPECT_GT(lift.state.position[0].y(), 0.47);

  Trial slab("gravity = [0, 0]\ntime = { dt = 0.005, until = 1 }\n" + still +
             "[shapes]\nbox = { polygon = [[-0.03, -0.03], [0.03, -0.03], [0.03, 0.03], [-0.03, 0.03]] }\n"
             "crate = { polygon = [[-0.5, -0.5], [0.5, -0.5], [0.5, 0.5], [-0.5, 0.5]] }\n"
             "slab = { polygon = [[-10, -0.5], [10, -0.5], [10, 0.5], [-10, 0.5]] }\n"
             "[[bodies]]\nshape = \"box\"\nat = [-0.045, -0.03]\nvelocity = [2, 0]\n"
             "[[bodies]]\nshape = \"slab\"\nkind = \"kinematic\"\nat = [10, -0.5]\n"
             "[[bodies]]\nshape = \"crate\"\nat = [15, 0.44]\n");
  slab.steps(80);
  EXPECT_LT(slab.state.position[0].x(), -0.029);
}

/// On waves of many short pieces a body without friction loses the little that a body that
/// doesn't bounce loses in hollows of some thousandths: the turn's square of its energy at each.
TEST(Seams, OfWavesCostLittle) {
  for (const std::string shape : {"ball", "box", "ell"}) {
    const Tilted tilted;
    std::string floor = "[[walls]]\npolyline = [";
    for (int i = 0; i <= 1000; ++i) floor += pair({0.1 * i, 0.3 * std::sin(0.05 * i)}) + ", ";
    Trial trial(tilted.slider(shape, 0.55) + floor + "]\n");
    trial.steps(100);
    const double mass = throng::mass(trial.scene, 0);
    const double before = trial.energy() / mass;
    trial.steps(700);
    EXPECT_GT(trial.state.position[0].x(), 75.0) << shape;
    EXPECT_LT(before - trial.energy() / mass, 0.08 * before) << shape;
  }
}

/// A square that falls on its corner onto a seam, and one beside it: the deepest that it gets.
double deepest(const std::string& floor, double x, double speed) {
  std::ostringstream text;
  text << "gravity = [0, -9.81]\nsleep = false\n"
       << kSliders << "[[bodies]]\nshape = \"box\"\nangle = 0.7853981633974483\nat = [" << x
       << ", 0.40]\nvelocity = [0, " << -speed << "]\n"
       << floor;
  Trial trial(text.str());
  double least = 1.0;
  for (int i = 0; i < 100; ++i) {
    trial.steps(1);
    least = std::min(least, trial.state.position[0].y());
  }
  return least;
}

/// Resting on a face the middle is 0.25 m high, on a corner 0.35 m.
TEST(Seams, HoldCornersThatFallOnThem) {
  const std::string tiles =
      "[[bodies]]\nshape = \"tile\"\nkind = \"static\"\nat = [-0.5, -0.5]\n"
      "[[bodies]]\nshape = \"tile\"\nkind = \"static\"\nat = [0.5, -0.5]\n";
  const std::string ridge = "[[walls]]\npolyline = [[-3, -0.03], [0, 0], [3, -0.03]]\n";
  const std::string valley = "[[walls]]\npolyline = [[-3, 0.03], [0, 0], [3, 0.03]]\n";
  for (const std::string& floor : {tiles, ridge, valley})
    for (const double x : {-0.02, -1e-9, 0.0, 1e-3, 0.02})
      for (const double speed : {0.0, 5.0})
        EXPECT_GT(deepest(floor, x, speed), 0.23) << floor << " at " << x << ", " << speed << " m/s";
}

/// Two rooms that share a side, which so stands there twice.
TEST(Seams, OfWallsThatStandTwiceHold) {
  const std::string rooms =
      "[[walls]]\npolygon = [[-9, -9], [0, -9], [0, 9], [-9, 9]]\n"
      "[[walls]]\npolygon = [[0, -9], [9, -9], [9, 9], [0, 9]]\n";
  for (const std::string shape : {"ball", "box", "ell"})
    for (const double speed : {1.0, 30.0}) {
      std::ostringstream text;
      text << kSliders << "[[bodies]]\nshape = \"" << shape << "\"\nat = [-3, 0]\nvelocity = [" << speed
           << ", 0]\n"
           << rooms;
      Trial trial(text.str());
      double most = -9.0;
      for (int i = 0; i < 400; ++i) {
        trial.steps(1);
        most = std::max(most, trial.state.position[0].x());
      }
      EXPECT_GT(most, -0.6) << shape << " gets there";
      EXPECT_LT(most, -0.2) << shape << " at " << speed;
    }
}

}  // namespace
}  // namespace throng
