// SPDX-License-Identifier: MIT
// Whoever begins a step on one side of a wall, or of another body, ends it there: swept over speeds, spins,
// time steps and angles of incidence. Contacts alone hold most of them: each test counts the steps that were
// guarded.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <optional>
#include <random>
#include <sstream>
#include <string>
#include <utility>

#include "sim/contact/contact.h"
#include "sim/recording/checkpoint.h"
#include "tests/sim/recording/scenes.h"
#include "tests/sim/trial.h"

namespace throng {
namespace {

const char* const kThrownShapes =
    "[shapes]\n"
    "disc = { disc = { radius = 0.1 } }\n"
    "bar = { polygon = [[-0.5, -0.01], [0.5, -0.01], [0.5, 0.01], [-0.5, 0.01]] }\n"
    "triangle = { polygon = [[0, 0], [0.2, 0], [0.1, 0.17]] }\n"
    "square = { polygon = [[-0.1, -0.1], [0.1, -0.1], [0.1, 0.1], [-0.1, 0.1]] }\n"
    "bell = { discs = [[-0.15, 0, 0.1], [0.15, 0, 0.1]] }\n"
    "hook = { polygon = [[0, 0], [0.4, 0], [0.4, 0.05], [0.05, 0.05], [0.05, 0.4], [0, 0.4]] }\n"
    "tile = { polygon = [[-0.5, -0.05], [0.5, -0.05], [0.5, 0.05], [-0.5, 0.05]] }\n"
    "flat = { polygon = [[-3, -0.01], [3, -0.01], [3, 0.01], [-3, 0.01]] }\n"
    "tall = { polygon = [[-0.01, -3], [0.01, -3], [0.01, 3], [-0.01, 3]] }\n";

std::string thrown_with(double dt, double restitution, double friction) {
  std::ostringstream out;
  out.precision(17);
  out << "time = { dt = " << dt << ", until = 1 }\n" << material(restitution, friction) << kThrownShapes;
  return out.str();
}

std::string thrown(const std::string& shape, const Vec& at, const Vec& velocity, double spin = 0.0,
                   const std::string& more = "") {
  std::ostringstream out;
  out.precision(17);
  out << "[[bodies]]\nshape = \"" << shape << "\"\nat = [" << at.x() << ", " << at.y() << "]\nvelocity = ["
      << velocity.x() << ", " << velocity.y() << "]\nspin = " << spin << "\n"
      << more;
  return out.str();
}

/// Where a domain that repeats every 40 m upwards, with its border at 2.5 m, has that place.
Vec folded(const Vec& at) {
  return {at.x(), at.y() < 2.5 ? at.y() + 40.0 : at.y()};
}

/// A closed box of 5 m, its lower left corner at that x; of bars that are static, or, folded, that are static
/// or kinematic.
enum class Box { polygon, polyline, segments, bars, folded_bars, folded_kinematic };
bool is_folded(Box kind) {
  return kind == Box::folded_bars || kind == Box::folded_kinematic;
}
std::string closed_box(Box kind, double x) {
  std::ostringstream out;
  const double r = x + 5.0;
  if (kind == Box::bars || is_folded(kind)) {
    const std::string still =
        kind == Box::folded_kinematic ? "kind = \"kinematic\"\n" : "kind = \"static\"\n";
    const auto bar = [&](const std::string& shape, const Vec& at) {
      out << thrown(shape, is_folded(kind) ? folded(at) : at, {0, 0}, 0, still);
    };
    bar("flat", {x + 2.5, -0.01}), bar("flat", {x + 2.5, 5.01});
    bar("tall", {x - 0.01, 2.5}), bar("tall", {r + 0.01, 2.5});
  } else if (kind == Box::segments) {
    for (const auto& [p, q] : {std::pair{Vec(x, 0), Vec(r, 0)}, std::pair{Vec(r, 0), Vec(r, 5)},
                               std::pair{Vec(r, 5), Vec(x, 5)}, std::pair{Vec(x, 5), Vec(x, 0)}})
      out << "[[walls]]\nsegment = [[" << p.x() << ", " << p.y() << "], [" << q.x() << ", " << q.y()
          << "]]\n";
  } else {
    out << "[[walls]]\n"
        << (kind == Box::polygon ? "polygon" : "polyline") << " = [[" << x << ", 0], [" << r << ", 0], [" << r
        << ", 5], [" << x << ", 5]" << (kind == Box::polygon ? "" : ", [" + std::to_string(x) + ", 0]")
        << "]\n";
  }
  return out.str();
}

struct Throw {
  std::string shape;
  double speed, spin, dt, restitution;
  Box box;
};

std::int64_t guarded(const Trial& run) {
  return run.work.guard->guarded_steps();
}

/// Of `count` bodies, each thrown in a box of its own somewhere, who is outside after a second. Adds to
/// `steps` how many were guarded.
std::vector<std::size_t> escaped(const Throw& t, std::size_t count, unsigned seed, std::int64_t& steps) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  std::string bodies, boxes;
  for (std::size_t i = 0; i < count; ++i) {
    const double angle = 2.0 * std::numbers::pi * unit(random), x = 10.0 * static_cast<double>(i);
    const Vec at{x + 2.0 + unit(random), 2.0 + unit(random)};  // drawn in this order
    bodies += thrown(t.shape, is_folded(t.box) ? folded(at) : at,
                     t.speed * Vec(std::cos(angle), std::sin(angle)), t.spin);
    boxes += closed_box(t.box, x);
  }
  const std::string domain = is_folded(t.box) ? "domain = { periodic = [[-20, 2.5], [" +
                                                    std::to_string(10 * count + 20) + ", 42.5]] }\n"
                                              : "";
  Trial run(domain + thrown_with(t.dt, t.restitution, 0.5) + bodies + boxes);
  run.steps(static_cast<int>(std::ceil(1.0 / t.dt)));
  steps += guarded(run);
  std::vector<std::size_t> out;
  for (std::size_t i = 0; i < count; ++i) {
    Vec at = run.state.position[i] - Vec(10.0 * static_cast<double>(i), 0.0);
    if (is_folded(t.box)) at.y() = 2.5 + std::remainder(at.y() - 2.5, 40.0);
    if (!(at.x() > 0.0 && at.x() < 5.0 && at.y() > 0.0 && at.y() < 5.0)) out.push_back(i);
  }
  return out;
}

TEST(Guard, NobodyGetsOutOfABox) {
  std::int64_t steps = 0;
  for (const double dt : {0.01, 1.0 / 60.0})
    for (const auto& [shape, spin] : std::vector<std::pair<std::string, double>>{
             {"disc", 0.0}, {"disc", 100.0}, {"bar", 0.0}, {"bar", 30.0}, {"bar", 100.0}, {"triangle", 30.0}})
      for (const double restitution : {0.0, 0.5})
        for (const double speed : {20.0, 80.0, 160.0, 300.0})
          for (const Box kind : {Box::polygon, Box::bars})
            EXPECT_EQ(escaped({shape, speed, spin, dt, restitution, kind}, 60, 1, steps),
                      std::vector<std::size_t>())
                << shape << ", spin " << spin << ", e = " << restitution << ", " << speed << " m/s, dt " << dt
                << ", box " << static_cast<int>(kind);
  EXPECT_GT(steps, 100);
}

TEST(Guard, NobodyOfSeveralPartsGetsOutOfABox) {
  std::int64_t steps = 0;
  for (const std::string shape : {"bell", "hook"})
    for (const double restitution : {0.0, 0.5})
      for (const double speed : {40.0, 160.0, 300.0})
        for (const Box kind : {Box::polygon, Box::bars, Box::segments})
          EXPECT_EQ(escaped({shape, speed, 20.0, 1.0 / 60.0, restitution, kind}, 60, 4, steps),
                    std::vector<std::size_t>())
              << shape << ", e = " << restitution << ", " << speed << " m/s, box " << static_cast<int>(kind);
  EXPECT_GT(steps, 20);
}

/// Static bars are obstacles, kinematic ones bodies: both are met where their images are.
TEST(Guard, NobodyGetsOutOfABoxAcrossTheBorderOfADomainThatRepeats) {
  for (const Box kind : {Box::folded_bars, Box::folded_kinematic}) {
    std::int64_t steps = 0;
    for (const auto& [shape, spin] :
         std::vector<std::pair<std::string, double>>{{"bar", 30.0}, {"bar", 100.0}, {"hook", 20.0}})
      for (const double speed : {80.0, 160.0, 300.0})
        EXPECT_EQ(escaped({shape, speed, spin, 1.0 / 60.0, 0.0, kind}, 60, 5, steps),
                  std::vector<std::size_t>())
            << shape << ", spin " << spin << ", " << speed << " m/s, box " << static_cast<int>(kind);
    EXPECT_GT(steps, 5) << static_cast<int>(kind);
  }
}

TEST(Guard, NobodyGetsOutOfABoxOfSegmentsOrOfAPolyline) {
  std::int64_t steps = 0;
  for (const std::string shape : {"disc", "bar", "triangle"})
    for (const double speed : {40.0, 200.0})
      for (const Box kind : {Box::polyline, Box::segments})
        EXPECT_EQ(escaped({shape, speed, 20.0, 1.0 / 60.0, 0.0, kind}, 60, 2, steps),
                  std::vector<std::size_t>())
            << shape << ", " << speed << " m/s, box " << static_cast<int>(kind);
  EXPECT_GT(steps, 5);
}

/// It spun by 1.67 rad a step, and the points where it was to meet the wall, halfway from there, with it.
TEST(Guard, ABarThatSpinsAt200MetresASecondStaysInItsBox) {
  for (const Box kind : {Box::polygon, Box::bars}) {
    Trial run(thrown_with(1.0 / 60.0, 0.0, 0.5) + thrown("bar", {2.5, 2.5}, {200, 0}, 100.0) +
              closed_box(kind, 0.0));
    for (int step = 0; step < 60; ++step) {
      run.steps(1);
      ASSERT_TRUE((run.state.position[0].array() > 0.0).all() && (run.state.position[0].array() < 5.0).all())
          << "step " << step << " at " << run.state.position[0].transpose();
    }
    EXPECT_GT(guarded(run), 0);
  }
}

/// Two corners that hit a wall, one after the other, and sweeps that hadn't got far.
TEST(Guard, ABarAt20MetresASecondDoesntSinkThroughAWall) {
  Trial run(thrown_with(0.01, 0.0, 0.5) + thrown("bar", {2.78872, 2.09386}, {-11.59317, -16.29719}) +
            closed_box(Box::polygon, 0.0));
  for (int step = 0; step < 100; ++step) {
    run.steps(1);
    ASSERT_GT(run.state.position[0].y(), 0.0) << "step " << step;
  }
}

/// In the corner, what the floor's friction set in motion went into the wall.
TEST(Guard, ADiscThatRollsIntoACornerAt100MetresASecondStaysBeforeTheWall) {
  for (const Box kind : {Box::polygon, Box::bars}) {
    Trial run(thrown_with(0.01, 0.0, 0.5) + thrown("disc", {2.03059, 2.02545}, {162.85124, -116.10113}) +
              closed_box(kind, 0.0));
    for (int step = 0; step < 30; ++step) {
      run.steps(1);
      ASSERT_LT(run.state.position[0].x(), 5.0) << "step " << step;
    }
  }
}

/// From both sides at once: the sum of their velocities is up to 400 m/s.
TEST(Guard, ThinBarsThatSpinDontPassEachOther) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  std::int64_t steps = 0;
  for (int i = 0; i < 150; ++i) {
    const double spin = 20.0 * unit(random);
    Trial run(
        thrown_with(1.0 / 60.0, 0.0, 0.0) + thrown("tall", {0.5 + 0.5 * unit(random), 0}, {-200.0, 0.0}) +
        thrown(i % 2 ? "square" : "bar", {-2.0 + unit(random), 0.3 * unit(random)}, {200.0, 0.0}, spin));
    for (int step = 0; step < 4; ++step) {
      run.steps(1);
      const Vec way = run.state.position[1] - run.state.position[0];
      const double angle = run.state.angle[0];
      ASSERT_LT(std::cos(angle) * way.x() + std::sin(angle) * way.y(), 0.0)
          << "run " << i << ", step " << step;
    }
    steps += guarded(run);
  }
  EXPECT_GT(steps, 5);
}

/// Bars that whirl among hooks, both so fast that one drives the other through a side of the box.
std::string thrown_at_sides(unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  std::string text = "domain = { box = [[-20, -20], [30, 20]] }\n" + thrown_with(0.01, 0.0, 0.5);
  const auto turned = [&] { return "angle = " + std::to_string(6.0 * unit(random)) + "\n"; };
  for (int k = 0; k < 10; ++k) {
    const double y = 3.6 * k - 18.0;
    text +=
        thrown("hook", {2.0, y}, {-40.0 - 60.0 * unit(random), 0.0}, 100.0 * unit(random) - 50.0, turned());
    text += thrown("bar", {5.0, y + 0.6 * unit(random) - 0.3}, {-80.0 - 60.0 * unit(random), 0.0},
                   100.0 * unit(random) - 50.0, turned());
  }
  return text;
}

TEST(Guard, NobodyIsDrivenThroughASideOfTheDomain) {
  std::int64_t steps = 0;
  for (unsigned seed = 1; seed <= 12; ++seed) {
    Trial run(thrown_at_sides(seed));
    for (int step = 0; step < 70; ++step) {
      run.steps(1);
      for (std::size_t i = 0; i < run.state.position.size(); ++i) {
        const Vec& at = run.state.position[i];
        ASSERT_GT(std::min({at.x() + 20.0, 30.0 - at.x(), 20.0 - std::abs(at.y())}), 0.0)
            << "seed " << seed << ", step " << step << ", body " << i + 1;
      }
    }
    steps += guarded(run);
  }
  EXPECT_GT(steps, 5);
}

/// So fast that they are pressed through one another's surfaces.
std::string poured_into_a_cup(double speed) {
  std::ostringstream pour;
  pour << "gravity = [0, -9.81]\nseed = 1\n"
       << thrown_with(1.0 / 60.0, 0.0, 0.5) << "pebble = { disc = { radius = { uniform = [0.05, 0.1] } } }\n"
       << "[[bodies]]\nshape = \"pebble\"\ncount = 150\nplace = { random = { within = [[0.2, 3], [3.8, 8]] "
          "} }\n"
       << "velocity = [0, " << -speed << "]\n"
       << "[[bodies]]\nshape = \"triangle\"\ncount = 100\nplace = { random = { within = [[0.2, 3], [3.8, "
          "8]] } }\n"
       << "velocity = [0, " << -speed << "]\nangle = { uniform = [0, 6.28] }\n"
       << "[[walls]]\npolyline = [[0, 90], [0, 0], [4, 0], [4, 90]]\n";
  return pour.str();
}

TEST(Guard, ACupHoldsAllThatIsPouredIntoIt) {
  for (const double speed : {30.0, 60.0, 100.0}) {
    Trial run(poured_into_a_cup(speed));
    run.steps(60);
    for (std::size_t i = 0; i < run.state.position.size(); ++i) {
      const Vec& at = run.state.position[i];
      EXPECT_TRUE(at.x() > 0.0 && at.x() < 4.0 && at.y() > 0.0)
          << speed << " m/s, body " << i + 1 << " at " << at.transpose();
    }
    EXPECT_GT(guarded(run), 0) << speed << " m/s: nobody is held";
  }
}

/// Its floor is covered with tiles that sleep when the first of them come: they are woken, and held, too.
TEST(Guard, ACupWhoseTilesSleepHoldsAllThatFallsIntoIt) {
  std::string scene = "gravity = [0, -9.81]\nsleep = true\n" + thrown_with(1.0 / 60.0, 0.0, 0.5) +
                      "[[walls]]\npolyline = [[0, 300], [0, 0], [5, 0], [5, 300]]\n";
  for (int i = 0; i < 4; ++i) scene += thrown("tile", {0.6 + 1.2 * i, 0.05}, {0.0, 0.0});
  for (int i = 0; i < 120; ++i)
    scene +=
        thrown(i % 2 ? "triangle" : "bell", {0.5 + i % 6 * 0.8, 200.0 + 0.5 * (i / 6)}, {0.0, -80.0}, i % 5);
  Trial run(scene);
  std::size_t most = 0;
  for (int step = 0; step < 180; ++step) {
    run.steps(1);
    if (guarded(run) == 0) most = std::max(most, asleep(run.state.sleep));
  }
  EXPECT_EQ(most, 4u) << "nobody slept before anybody was guarded";
  for (std::size_t i = 0; i < run.state.position.size(); ++i) {
    const Vec& at = run.state.position[i];
    EXPECT_TRUE(at.x() > 0.0 && at.x() < 5.0 && at.y() > 0.0) << "body " << i << " at " << at.transpose();
  }
  EXPECT_GT(guarded(run), 5);
}

/// Who was held before in a step goes on as one with whom it meets, or along a floor, which doesn't rub.
TEST(Guard, MomentumStaysWhereManyMeetAgainAndAgain) {
  std::int64_t guarded = 0;
  for (const char* floor : {"", "[[walls]]\nsegment = [[-200, 0], [200, 0]]\n"})
    for (int seed = 1; seed <= 8; ++seed) {
      const double restitution = seed > 6 ? 0.5 : 0.0;
      std::string text = "seed = " + std::to_string(seed) + "\n" + thrown_with(0.01, restitution, 0) +
                         "chip = { polygon = [[0, 0], [0.6, 0], [0.3, 0.6]] }\n" + floor;
      for (const char* velocity : {"[200, -50]", "[-150, -50]"})
        text +=
            "[[bodies]]\nshape = \"chip\"\ncount = 10\nangle = { uniform = [0, 6.28] }\nplace = { random = { "
            "within = [[-4, 0.5], [4, 8.5]] } }\nvelocity = " +
            std::string(velocity) + "\n";
      Trial run(text);
      const auto momentum = [&] {
        double sum = 0.0;
        for (const Vec& velocity : run.state.velocity) sum += velocity.x();
        return sum;
      };
      const double before = momentum();
      run.steps(20);
      EXPECT_NEAR(momentum(), before, 1e-8) << floor << seed;
      guarded += run.work.guard->guarded_steps();
    }
  EXPECT_GT(guarded, 12);
}

TEST(Guard, APlateThatRunsIntoManyIsPassedByNobody) {
  for (const auto& [speed, restitution] :
       {std::pair(150.0, 0.0), std::pair(150.0, 1.0), std::pair(300.0, 0.0), std::pair(300.0, 0.3)}) {
    Trial run(
        thrown_with(0.01, restitution, 0) +
        "brick = { polygon = [[0, 0], [0.4, 0], [0.4, 0.3], [0, 0.3]] }\nball = { disc = { radius = 0.2 } }\n"
        "plate = { polygon = [[-0.1, -60], [0.1, -60], [0.1, 60], [-0.1, 60]] }\n" +
        thrown("plate", {0, 0}, {speed, 0}, 0, "kind = \"kinematic\"\n") +
        "[[bodies]]\nshape = \"brick\"\ncount = 60\nangle = { uniform = [0, 6.28] }\n"
        "place = { random = { within = [[1, -4], [9, 4]] } }\n"
        "[[bodies]]\nshape = \"ball\"\ncount = 60\nplace = { random = { within = [[1, -4], [9, 4]] } }\n");
    run.steps(30);
    for (std::size_t i = 1; i < run.state.position.size(); ++i)
      EXPECT_GT(run.state.position[i].x(), run.state.position[0].x()) << i << " at " << speed;
    EXPECT_GT(run.work.guard->guarded_steps(), 1);
  }
}

/// Driven, it gives way to nobody: who is in its way is taken along.
TEST(Guard, ABladeThatIsDrivenTakesAlongWhoeverItMeets) {
  for (const std::string shape : {"disc", "square"})
    for (const double speed : {20.0, 100.0, 200.0}) {
      std::string crowd;
      for (int i = 0; i < 15; ++i)
        crowd += thrown(shape, {0.5 + 0.8 * (i % 3), -1.0 + 0.5 * (i / 3)}, {0.0, 0.0});
      Trial run(thrown_with(0.01, 0.0, 0.5) +
                thrown("tall", {0, 0}, {speed, 0.0}, 0.0, "kind = \"kinematic\"\n") + crowd);
      run.steps(20);
      for (std::size_t i = 1; i < run.state.position.size(); ++i)
        if (std::abs(run.state.position[i].y()) < 3.0) {
          EXPECT_GT(run.state.position[i].x(), run.state.position[0].x())
              << shape << ", " << speed << " m/s, " << i;
        }
    }
}

/// By up to 0.7 rad a step. With faces that stood as the step began it passed two of these 46 at 0.3, nine at
/// 0.5.
TEST(Guard, ABladeThatIsTurnedPassesNobody) {
  std::int64_t steps = 0;
  for (const std::string shape : {"disc", "square"})
    for (const double spin : {10.0, 20.0, 30.0, 50.0, 70.0})
      for (int i = 2; i < 25; ++i) {
        const double at = 0.06 * i;
        Trial run(thrown_with(0.01, 0.0, 0.5) +
                  thrown("flat", {0, 0}, {0, 0}, spin, "kind = \"kinematic\"\n") +
                  thrown(shape, {2.0 * std::cos(at), 2.0 * std::sin(at)}, {0, 0}));
        for (int step = 0; step < 4; ++step) {
          run.steps(1);
          const double angle = run.state.angle[0];
          const Vec along(std::cos(angle), std::sin(angle)), where = run.state.position[1];
          if (std::abs(along.dot(where)) > 2.9) break;
          ASSERT_GT(tangent(along).dot(where), 0.0)
              << shape << " at " << at << ", spin " << spin << ", step " << step;
        }
        steps += guarded(run);
      }
  EXPECT_GT(steps, 2);
}

/// In a square frame of walls 0.1 m thick that is free and turns, thrown against them from all sides, then
/// pressed on them. Faces that stood as the step began were sunk into, deeper with each step.
TEST(Guard, NobodyCreepsOutOfAFrameThatTurns) {
  std::mt19937 random(4);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  for (int i = 0; i < 24; ++i) {
    std::string scene = thrown_with(1.0 / 60.0, 0.6, 0.3) +
                        "frame = { polygon = [[-2, -2], [2, -2], [2, 2], [-2, 2]],"
                        " holes = [[[-1.9, -1.9], [1.9, -1.9], [1.9, 1.9], [-1.9, 1.9]]] }\n"
                        "ball = { disc = { radius = 0.05 } }\n" +
                        thrown("frame", {0, 0}, {0, 0}, 6.0);
    for (int k = 0; k < 4; ++k)
      scene += thrown(i % 2 ? "bar" : "ball", {-1.2 + 0.8 * k, -1.2},
                      {100.0 * unit(random), 100.0 * unit(random)}, 50.0 * unit(random));
    Trial run(scene);
    for (int step = 0; step < 60; ++step) {
      run.steps(1);
      const Vec along(std::cos(run.state.angle[0]), std::sin(run.state.angle[0]));
      for (std::size_t k = 1; k < 5; ++k) {
        const Vec way = run.state.position[k] - run.state.position[0];
        ASSERT_LT(std::max(std::abs(along.dot(way)), std::abs(tangent(along).dot(way))), 2.0)
            << "run " << i << ", step " << step << ", body " << k;
      }
    }
  }
}

/// Two hundred in a box, at 100 m/s in all directions.
std::string crowded_box() {
  std::string scene = thrown_with(1.0 / 60.0, 0.0, 0.5);
  for (int i = 0; i < 200; ++i)
    scene += thrown(i % 2 ? "bar" : "disc", {1.1 * (i % 20), 1.1 * (i / 20)},
                    {100.0 * std::cos(i), 100.0 * std::sin(i)}, i % 7);
  return scene + "[[walls]]\npolygon = [[-1, -1], [23, -1], [23, 12], [-1, 12]]\n";
}

TEST(Guard, FastOnesEndAlikeForAnyNumberOfThreads) {
  Trial one(scene_from(crowded_box()), 1), two(scene_from(crowded_box()), 2);
  one.steps(20), two.steps(20);
  EXPECT_EQ(hash(one.state), hash(two.state));
  EXPECT_GT(guarded(one), 10);
  EXPECT_EQ(guarded(one), guarded(two));
}

/// A guarded step begins with nothing but the state: from a checkpoint between two of them all goes on alike.
TEST(Guard, FastOnesGoOnAlikeFromACheckpointBetweenGuardedSteps) {
  const testing_recordings::Folder folder;
  int between = 0;
  for (const double speed : {100.0, 150.0, 200.0}) {
    Trial whole(poured_into_a_cup(speed));
    std::optional<Trial> resumed;
    for (int step = 0; step < 30; ++step) {
      const std::int64_t before = guarded(whole);
      whole.steps(1);
      if (resumed) {
        resumed->steps(1);
        EXPECT_EQ(hash(resumed->state), hash(whole.state)) << "step " << step;
        EXPECT_EQ(guarded(*resumed), guarded(whole) - before) << "step " << step;
        between += guarded(*resumed) > 0;
        resumed.reset();
      }
      if (guarded(whole) == before) continue;
      recording::write_checkpoint(folder / "a.ckpt", {"0", "", 1, 0}, whole.state);
      resumed.emplace(whole.scene).state = recording::read_checkpoint(folder / "a.ckpt").state;
    }
  }
  EXPECT_GT(between, 5);
}

}  // namespace
}  // namespace throng
