// SPDX-License-Identifier: MIT
// Discs that give way, against a plain twin, closed forms and the laws of mechanics.
#include "sim/contact/soft_contacts.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "sim/periodic.h"
#include "sim/simulation_error.h"
#include "sim/soft_timing.h"
#include "tests/sim/contact/soft_twin.h"
#include "tests/sim/trial.h"

namespace throng {
namespace {

const double kMass = std::numbers::pi * 0.25;  // kg, of a disc of radius 0.5 m

std::string steps_of(double dt, int substeps = 1) {
  char text[80];
  std::snprintf(text, sizeof text, "time = { dt = %.17g, until = 1, substeps = %d }\n", dt, substeps);
  return text;
}

std::string surface(double restitution, double friction, double rolling = 0.0) {
  return material(restitution, friction) + "rolling_resistance = " + std::to_string(rolling) + "\n";
}

const char* const kFloor = "[[walls]]\nsegment = [[-100, 0], [100, 0]]\n";
const char* const kGravity = "gravity = [0, -9.81]\n";

/// A heap of discs of different sizes that fall into a box, turning, onto a slope.
std::string heap(const std::string& model) {
  return model + kGravity + steps_of(1e-3, 4) + surface(0.5, 0.4, 0.1) +
         "[domain]\nbox = [[0, 0], [6, 20]]\n"
         "[shapes]\nball = { disc = { radius = { uniform = [0.3, 0.5] } } }\n"
         "[[walls]]\nsegment = [[1, 0.2], [4, 1.5]]\n"
         "[[bodies]]\nshape = \"ball\"\ncount = 30\nspin = 3.0\nvelocity = { maxwell = 1.0 }\n"
         "place = { random = { within = [[0.2, 1.7], [5.8, 7]], gap = 0.01 } }\n";
}

class SoftModels : public ::testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(, SoftModels,
                         ::testing::Values("contact = { model = \"spring\", stiffness = 2e4 }\n",
                                           "contact = { model = \"hertz\", youngs_modulus = 1e6 }\n"));

TEST_P(SoftModels, DoAsThePlainTwinDoes) {
  Trial trial(heap(GetParam()));
  SoftTwin twin(trial.scene, trial.plan.substep);
  std::size_t pairs = 0, walls = 0;
  double worst = 0.0;
  for (int i = 0; i < 600; ++i) {
    trial.steps(1);
    for (int k = 0; k < 4; ++k) twin.step();
    pairs += trial.state.disc_contacts.size(), walls += trial.state.point_contacts.size();
    for (std::size_t row = 0; row < 30; ++row) {
      const Vec there(twin.discs()[row].x, twin.discs()[row].y);
      worst = std::max(worst, (trial.state.position[row] - there).norm());
      worst = std::max(worst, 0.01 * std::abs(trial.state.spin[row] - twin.discs()[row].spin));
    }
  }
  EXPECT_LT(worst, 1e-9);
  EXPECT_GT(pairs, 1000u);
  EXPECT_GT(walls, 300u);
}

/// At rest and in each other, they part with what their springs hold: 2/5 k d^2.5 of Hertz, k d^2 / 2.
/// Substeps follow from that, too: of Hertz it was one, as nothing moved, and 355 times that energy.
TEST_P(SoftModels, ThatBeginInEachOtherPartWithWhatTheyHold) {
  for (const double depth : {1e-6, 5e-4}) {
    const Scene scene = scene_from(std::string(GetParam()) + "time = { dt = 0.01, until = 1 }\n" +
                                   material(1, 0) + kDisc + ball(0, 0, 0, 0) + ball(1.0 - depth, 0, 0, 0));
    const SoftPair pair = soft_pair(scene, 0.5 * mass(scene, 0), 0.25, 0.0);
    const bool linear = scene.contact == ContactModel::spring;
    const double held =
        linear ? 0.5 * pair.stiffness * depth * depth : 0.4 * pair.stiffness * std::pow(depth, 2.5);
    Trial trial(scene);
    trial.steps(linear ? 50 : 200);
    EXPECT_GT((trial.state.position[1] - trial.state.position[0]).norm(), 1.0) << depth;
    EXPECT_NEAR(trial.energy() / held, 1.0, 0.02) << depth;
  }
}

/// Of who is in nobody, however deep others are in each other.
TEST(Hertz, SubstepsAreOfWhatEachIsIn) {
  const auto contact = [](double apart) {
    const Scene scene = scene_from(
        "contact = { model = \"hertz\", youngs_modulus = 1e6 }\n"
        "time = { dt = 0.001, until = 1, substeps = 1000 }\n[shapes]\n"
        "big = { disc = { radius = 5 } }\nsmall = { disc = { radius = 0.01 } }\n"
        "[[bodies]]\nshape = \"big\"\nat = [0, 0]\n[[bodies]]\nshape = \"big\"\nat = [" +
        std::to_string(apart) + ", 0]\n[[bodies]]\nshape = \"small\"\nat = [0, 9]\nvelocity = [0, 1]\n");
    return soft_timing(scene).contact;
  };
  EXPECT_EQ(contact(9.9), contact(10.1));
}

TEST_P(SoftModels, HaveTheSameBitsOnTwoThreadsAndWhereStepsAreResumed) {
  const Scene scene = scene_from(heap(GetParam()));
  Trial one(scene), two(scene, 2);
  one.steps(1000), two.steps(1000);
  EXPECT_EQ(hash(one.state), hash(two.state));
  Trial resumed(scene);
  resumed.state = one.state;
  EXPECT_GT(one.state.disc_contacts.size(), 10u);
  one.steps(100), resumed.steps(100);
  EXPECT_EQ(hash(one.state), hash(resumed.state));
  Trial forgetful(scene);
  forgetful.state = two.state;
  for (ContactImpulse& contact : forgetful.state.disc_contacts) contact.tangent = contact.rolling = 0.0;
  forgetful.steps(100);
  EXPECT_NE(hash(one.state), hash(forgetful.state)) << "springs are a part of the state";
}

/// So many that they are kept by their places in the plane, not by their rows.
TEST_P(SoftModels, AreAsPlainWhereBodiesAreMany) {
  const Scene scene =
      scene_from(std::string(GetParam()) + kGravity + steps_of(5e-4) + surface(0.5, 0.4, 0.1) +
                 "[domain]\nbox = [[0, 0], [60, 40]]\n"
                 "[shapes]\nball = { disc = { radius = { uniform = [0.3, 0.5] } } }\n"
                 "[[bodies]]\nshape = \"ball\"\ncount = 2100\nspin = 3.0\n"
                 "velocity = { maxwell = 10.0 }\n"
                 "place = { random = { within = [[0.6, 0.6], [59.4, 39.4]], gap = 0.01 } }\n");
  Trial trial(scene), two(scene, 2), resumed(scene);
  SoftTwin twin(scene, trial.plan.substep);
  std::size_t pairs = 0;
  double worst = 0.0;
  for (int i = 0; i < 20; ++i) {
    if (i == 12) resumed.state = trial.state;
    trial.steps(1), two.steps(1);
    if (i >= 12) resumed.steps(1);
    twin.step();
    pairs += trial.state.disc_contacts.size();
  }
  for (std::size_t row = 0; row < scene.bodies.size(); ++row) {
    const SoftTwin::Disc& disc = twin.discs()[row];
    worst = std::max(worst, (trial.state.position[row] - Vec(disc.x, disc.y)).norm());
    worst = std::max(worst, 0.01 * std::abs(trial.state.spin[row] - disc.spin));
  }
  EXPECT_LT(worst, 1e-11);
  EXPECT_GT(pairs, 500u);
  EXPECT_EQ(hash(trial.state), hash(two.state));
  EXPECT_EQ(hash(trial.state), hash(resumed.state));
}

/// One disc that hits the floor at an angle: velocity and surface speed after it.
struct Bounce {
  Vec velocity;
  double surface;  // m/s, spin times radius
};

Bounce bounce(const std::string& model, double friction, double vx, double spin = 0.0, double e = 1.0) {
  const double dt = std::numbers::pi * std::sqrt(kMass / 1e8) / 200.0;
  Trial trial(model + steps_of(dt) + surface(e, friction) + kDisc + kFloor +
              ball(0, 0.5 + 20.3 * dt, vx, -1, spin));
  trial.steps(300);
  EXPECT_GT(trial.state.position[0].y(), 0.5);
  return {trial.state.velocity[0], 0.5 * trial.state.spin[0]};
}

TEST(SoftBounce, SlidingDiscsLoseWhatCoulombTakes) {
  // s = v + w r = 3; sliding as |s| / 3 > mu (1 + e) |v_n|: dv = -mu (1 + e) |v_n|, d(w r) = 2 dv.
  const Bounce after = bounce(spring(1e8), 0.2, 3.0);
  EXPECT_NEAR(after.velocity.y(), 1.0, 1e-5);
  EXPECT_NEAR(after.velocity.x(), 3.0 - 0.4, 4e-4);
  EXPECT_NEAR(after.surface, -2.0 * 0.4, 1e-3);
}

TEST(SoftBounce, DiscsThatStickSwingAsTheTangentialSpringDoes) {
  // The slip s obeys s'' = -3 k_t / m s for pi sqrt(m / k): it comes back as s cos(pi sqrt(3 k_t / k)).
  for (const double ratio : {2.0 / 7.0, 1.0 / 3.0, 0.1}) {
    const std::string more = ", tangential_stiffness = " + std::to_string(ratio);
    const Bounce after = bounce(spring(1e8, more), 1000.0, 0.5);
    const double slip = 0.5 * std::cos(std::numbers::pi * std::sqrt(3.0 * ratio));
    EXPECT_NEAR(after.velocity.x(), 0.5 + (slip - 0.5) / 3.0, 5e-4) << ratio;
    EXPECT_NEAR(after.surface, 2.0 * (slip - 0.5) / 3.0, 5e-4) << ratio;
  }
}

TEST_P(SoftModels, KeepMomentumAndAngularMomentumInObliqueImpacts) {
  Trial trial(std::string(GetParam()) + steps_of(1e-4) + surface(0.7, 0.3, 0.2) + kDisc +
              ball(0, 0, 3, 0, 5) + ball(1.05, 0.6, -1, 0.5, -2));
  const auto angular = [&] {
    double sum = 0.0;
    for (std::size_t i = 0; i < 2; ++i)
      sum += mass(trial.scene, i) * cross(trial.state.position[i], trial.state.velocity[i]) +
             inertia(trial.scene, i) * trial.state.spin[i];
    return sum;
  };
  const Vec before = momentum(trial.scene, trial.state);
  const double turning = angular();
  const Vec first = trial.state.velocity[0];
  trial.steps(2000);
  EXPECT_GT((trial.state.velocity[0] - first).norm(), 0.5);
  EXPECT_NEAR((momentum(trial.scene, trial.state) - before).norm(), 0.0, 1e-13);
  EXPECT_NEAR(angular(), turning, 2e-5);  // the point of contact moves by what Verlet's way is off
}

/// Potential energy of normal springs, J.
double elastic_energy(const Trial& trial) {
  double sum = 0.0;
  for (std::size_t i = 0; i < trial.scene.bodies.size(); ++i)
    for (std::size_t j = i + 1; j < trial.scene.bodies.size(); ++j) {
      const double depth = 1.0 - (trial.state.position[i] - trial.state.position[j]).norm();
      if (depth > 0.0) sum += 0.5 * trial.scene.soft.stiffness * depth * depth;
    }
  for (const Vec& p : trial.state.position)
    for (const double distance : {p.x(), p.y(), 8.0 - p.x(), 8.0 - p.y()})
      if (distance < 0.5) sum += 0.5 * trial.scene.soft.stiffness * (0.5 - distance) * (0.5 - distance);
  return sum;
}

TEST(SoftEnergy, OfAnElasticGasStaysWithinVerletsBound) {
  const double dt = std::numbers::pi * std::sqrt(0.5 * kMass / 1e5) / 50.0;
  Trial trial(spring(1e5) + steps_of(dt, 10) + surface(1.0, 0.0) + "[domain]\nbox = [[0, 0], [8, 8]]\n" +
              kDisc +
              "[[bodies]]\nshape = \"ball\"\ncount = 30\nvelocity = { maxwell = 3.0 }\n"
              "place = { random = { within = [[0, 0], [8, 8]], gap = 0.01 } }\n");
  const double before = trial.energy();
  double worst = 0.0;
  std::size_t contacts = 0;
  for (int i = 0; i < 10'000; ++i) {
    trial.steps(1);
    contacts += trial.state.disc_contacts.size();
    worst = std::max(worst, std::abs((trial.energy() + elastic_energy(trial)) / before - 1.0));
  }
  EXPECT_GT(contacts, 5'000u);
  EXPECT_LT(worst, 1e-3);
}

TEST(SoftEnergy, IsKeptByFrictionThatNeverGives) {
  // Two discs that meet off centre and stick: their tangential spring gives all of it back in the end.
  const double dt = std::numbers::pi * std::sqrt(0.5 * kMass / 1e7) / 100.0;
  Trial trial(spring(1e7) + steps_of(dt) + surface(1.0, 1e6) + kDisc + ball(0, 0, 1, 0, 2) +
              ball(1.001, 0.1, -1, 0, -1));
  const double before = trial.energy();
  trial.steps(700);
  EXPECT_TRUE(trial.state.disc_contacts.empty());
  EXPECT_NE(trial.state.spin[0], 2.0);
  // What the tangential spring holds as the discs part is lost: it is no more than its swing, here 2 % of it.
  EXPECT_NEAR(trial.energy() / before, 1.0, 0.02);
}

/// A disc that stands in the floor and swings: where it is after 2 s, by so many steps.
double swung(int steps, double e) {
  Trial trial(spring(100.0) + kGravity + steps_of(2.0 / steps) + surface(e, 0.0) + kDisc + kFloor +
              ball(0, 0.45, 0, 0));
  trial.steps(steps);
  return trial.state.position[0].y();
}

TEST(SoftOrder, IsTwoWithDampingAndWithout) {
  for (const double e : {1.0, 0.5, 0.1}) {
    const double frequency = std::sqrt(100.0 / kMass), ratio = damping_ratio(e);
    const double rate = ratio * frequency, turn = frequency * std::sqrt(1.0 - ratio * ratio);
    const double rest = 0.5 - kMass * 9.81 / 100.0, start = 0.45 - rest;  // it never leaves the floor
    const double exact =
        rest + start * std::exp(-2.0 * rate) * (std::cos(2.0 * turn) + rate / turn * std::sin(2.0 * turn));
    const double coarse = std::abs(swung(400, e) - exact), fine = std::abs(swung(1600, e) - exact);
    EXPECT_NEAR(std::log2(coarse / fine) / 2.0, 2.0, 0.1) << e << ": " << coarse << ", " << fine;
  }
}

/// How far a disc gets that swings in a slope, and how far it turned, by so many steps in 2 s.
Vec rolled(int steps, double friction, double rolling) {
  Trial trial("gravity = [3, -9.81]\n" + spring(100.0) + steps_of(2.0 / steps) +
              surface(0.5, friction, rolling) + kDisc + kFloor + ball(0, 0.45, 0, 0));
  trial.steps(steps);
  return {trial.state.position[0].x(), 0.5 * trial.state.angle[0]};
}

/// The order over a factor of 16 in the step, against one that is finer still.
double rolling_order(double friction, double rolling) {
  const Vec best = rolled(25'600, friction, rolling);
  const double coarse = (rolled(200, friction, rolling) - best).norm();
  return std::log2(coarse / (rolled(3200, friction, rolling) - best).norm()) / 4.0;
}

TEST(SoftOrder, IsTwoOfTangentialSpringsWhileTheContactGetsDeeperAndLess) {
  EXPECT_NEAR(rolling_order(0.9, 0.0), 2.0, 0.1);
  EXPECT_NEAR(rolling_order(0.9, 10.0), 2.0, 0.1) << "the spring against rolling, too";
}

TEST(SoftOrder, IsAboutTwoWhereFrictionGivesNowAndThen) {
  EXPECT_NEAR(rolling_order(0.05, 0.0), 2.0, 0.35);
  EXPECT_NEAR(rolling_order(0.9, 0.3), 2.0, 0.35);
}

TEST(SoftFriction, DiscsRollDownASlopeOrSlideWhereItIsSteep) {
  // tan = 0.3: rolls where mu >= 0.1, a = 2/3 g sin; at mu = 0.05 it slides, a = g (sin - mu cos).
  const auto way = [](double friction) {
    Trial trial("gravity = [3, -10]\n" + spring(1e6) + steps_of(1e-3, 20) + surface(0.1, friction) + kDisc +
                kFloor + ball(0, 0.5 - 10 * kMass / 1e6, 0, 0));
    trial.steps(1000);
    return trial.state.position[0].x();
  };
  EXPECT_NEAR(way(0.2), 1.0, 1e-3);
  EXPECT_NEAR(way(0.11), 1.0, 1e-3);
  EXPECT_NEAR(way(0.05), 0.5 * (3.0 - 0.5), 1.3e-3);
}

TEST(SoftFriction, SlidingDiscsEndUpRolling) {
  // v = 2/3 v0 after v0 / (3 mu g).
  Trial trial(std::string(kGravity) + spring(1e6) + steps_of(1e-3, 20) + surface(0.1, 0.3) + kDisc + kFloor +
              ball(0, 0.5 - 9.81 * kMass / 1e6, 3, 0));
  trial.steps(320);
  EXPECT_GT(trial.state.velocity[0].x() + 0.5 * trial.state.spin[0], 0.15) << "slides still";
  trial.steps(40);
  EXPECT_NEAR(trial.state.velocity[0].x(), 2.0, 1e-3);
  EXPECT_NEAR(trial.state.velocity[0].x(), -0.5 * trial.state.spin[0], 1e-3);
}

TEST(SoftFriction, HoldsDiscsOnASlopeThatTheirRollingResistanceBears) {
  const auto rolled = [](double rolling) {
    Trial trial("gravity = [1, -10]\n" + spring(1e6) + steps_of(1e-3, 20) + surface(0.1, 0.5, rolling) +
                kDisc + kFloor + ball(0, 0.5 - 10 * kMass / 1e6, 0, 0));
    trial.steps(1000);
    const double one = trial.state.position[0].x();
    trial.steps(4000);
    return Vec(one, trial.state.position[0].x() - one);
  };
  const Vec held = rolled(0.11);
  EXPECT_LT(held.x(), 3e-5) << "the springs' own way";
  EXPECT_LT(std::abs(held.y()), 1e-8) << "creeps";
  // a = 2/3 (g sin - mu_r g cos)
  EXPECT_NEAR(rolled(0.04).x(), 0.5 * 2.0 / 3.0 * (1.0 - 0.4), 1e-3);
}

TEST(SoftRest, AColumnBearsItsWeight) {
  std::string text = kGravity + spring(1e5) + steps_of(1e-3, 10) + surface(0.0, 0.0) + kDisc + kFloor;
  for (int i = 0; i < 5; ++i) text += ball(0, 0.5 + i, 0, 0);
  Trial trial(text);
  trial.steps(10'000);
  double height = 0.5;
  for (std::size_t i = 0; i < 5; ++i) {
    height -= static_cast<double>(5 - i) * kMass * 9.81 / 1e5;
    EXPECT_NEAR(trial.state.position[i].y(), height + static_cast<double>(i), 1e-9);
    EXPECT_NEAR(trial.state.velocity[i].norm(), 0.0, 1e-9);
  }
  double impulse = 0.0;
  for (const ContactImpulse& contact : trial.state.point_contacts) impulse += contact.normal;
  EXPECT_NEAR(impulse, 5.0 * kMass * 9.81 * 1e-4, 1e-9) << "per substep";
  std::vector<ContactRow> rows;
  trial.work.soft.list(trial.state, trial.work.bodies.in_order(), rows);
  ASSERT_EQ(rows.size(), 5u);
  EXPECT_EQ(rows.back().b, 0u);
  EXPECT_NEAR(rows.back().point.y(), 0.0, 1e-9);
}

/// How deep a disc of 1 m stands in what is below it, once it rests.
double depth_at_rest(const std::string& below, double x, double y = 0.5, double friction = 0.5) {
  Trial trial(std::string(kGravity) + spring(1e5) + steps_of(1e-3, 10) + surface(0.0, friction) + kDisc +
              below + ball(x, y, 0, 0));
  trial.steps(5000);
  EXPECT_LT(trial.state.velocity[0].norm(), 1e-7);
  return y - trial.state.position[0].y();
}

TEST(SoftSolidsShare, WhatTwoOfThemShareOnce) {
  const double once = kMass * 9.81 / 1e5;
  EXPECT_NEAR(depth_at_rest("[[walls]]\nsegment = [[-5, 0], [5, 0]]\n", 0), once, 1e-9);
  EXPECT_NEAR(
      depth_at_rest("[[walls]]\nsegment = [[-5, 0], [5, 0]]\n[[walls]]\nsegment = [[-4, 0], [4, 0]]\n", 0),
      once, 1e-9)
      << "a wall twice";
  EXPECT_NEAR(
      depth_at_rest("[[walls]]\nsegment = [[-5, 0], [5, 0]]\n[[walls]]\nsegment = [[0, 0], [0, -3]]\n", 0),
      once, 1e-9)
      << "a wall on a wall";
  EXPECT_NEAR(depth_at_rest("[domain]\nbox = [[-5, 0], [5, 5]]\n[[walls]]\nsegment = [[-4, 0], [4, 0]]\n", 0),
              once, 1e-9)
      << "a wall on the box";
  EXPECT_NEAR(depth_at_rest("[[walls]]\npolyline = [[-5, -5], [0, 0], [5, -5]]\n", 0), once, 1e-9)
      << "a ridge";
  EXPECT_NEAR(depth_at_rest("[[walls]]\npolyline = [[-5, 0], [5, 0], [5, 5]]\n", 4.5), once, 1e-9)
      << "a corner whose other wall it only touches";
  EXPECT_NEAR(
      depth_at_rest("[[walls]]\nsegment = [[-5, 0], [-1e-7, 0]]\n[[walls]]\nsegment = [[1e-7, 0], [5, 0]]\n",
                    0),
      once, 1e-9)
      << "two walls with rounding between them";
}

TEST(SoftSolids, PressFromAWedgeAsTwoWalls) {
  // Each wall bears m g / sqrt(2), along its own normal: the depth along y is that times sqrt(2).
  const double y = 0.5 * std::sqrt(2.0);
  EXPECT_NEAR(depth_at_rest("[[walls]]\npolyline = [[-5, 5], [0, 0], [5, 5]]\n", 0, y, 0.0),
              kMass * 9.81 / 1e5, 1e-9);
}

TEST(SoftSolids, SlideOverSeamsWithoutANotch) {
  // A gentle arc of a hundred pieces: what slides on it without friction keeps its energy.
  std::string text =
      kGravity + spring(1e5) + steps_of(1e-3, 10) + surface(1.0, 0.0) + kDisc + "[[walls]]\npolyline = [";
  for (int i = -50; i <= 50; ++i) {
    const double x = 0.1 * i;
    text += (i > -50 ? ", [" : "[") + std::to_string(x) + ", " + std::to_string(-0.02 * x * x) + "]";
  }
  Trial trial(text + "]\n" + ball(-4, 0.5 - 0.32 + 0.01, 4, 0));
  const double before = trial.energy();
  trial.steps(2500);
  EXPECT_GT(trial.state.position[0].x(), 1.0);
  EXPECT_NEAR(trial.energy(), before, 2e-3 * before) << "but for what the springs hold";
}

TEST(SoftSolids, StaticBodiesOfAnyShapeHold) {
  const std::string shapes = std::string(kDisc) +
                             "block = { polygon = [[-3, -1], [3, -1], [3, 1], [-3, 1]] }\n"
                             "dome = { disc = { radius = 2.0 } }\n"
                             "pair = { discs = [[-0.6, 0, 0.5], [0.6, 0, 0.5]] }\n";
  const auto rests = [&](const std::string& shape, double x, double top) {
    Trial trial(std::string(kGravity) + spring(1e5) + steps_of(1e-3, 10) + surface(0.0, 0.0) + shapes +
                ball(x, top + 0.5, 0, 0) + "[[bodies]]\nshape = \"" + shape +
                "\"\nkind = \"static\"\nat = [0, 0]\n");
    trial.steps(3000);
    return top + 0.5 - trial.state.position[0].y();
  };
  EXPECT_NEAR(rests("block", 0.3, 1.0), kMass * 9.81 / 1e5, 1e-9);
  EXPECT_NEAR(rests("dome", 0.0, 2.0), kMass * 9.81 / 1e5, 1e-9);
  // Between two discs: their normals lean by asin(0.6), so each bears m g / (2 * 0.8).
  EXPECT_NEAR(rests("pair", 0.0, 0.8 - 0.5), kMass * 9.81 / (2 * 0.8 * 0.8) / 1e5, 1e-8);
}

TEST(SoftSolids, KinematicBodiesCarryAndPush) {
  const std::string shapes =
      std::string(kDisc) + "belt = { polygon = [[-40, -1], [40, -1], [40, 1], [-40, 1]] }\n";
  for (const bool first : {true, false}) {  // whichever comes first in the file
    const std::string belt =
        "[[bodies]]\nshape = \"belt\"\nkind = \"kinematic\"\nat = [0, -1]\nvelocity = [2, 0.5]\n";
    const std::string disc = ball(0, 0.5, 0, 0);
    Trial trial(std::string(kGravity) + spring(1e6) + steps_of(1e-3, 20) + surface(0.1, 0.5, 0.0) + shapes +
                (first ? belt + disc : disc + belt));
    trial.steps(2000);
    const std::size_t row = first ? 1 : 0;
    EXPECT_NEAR(trial.state.velocity[row].y(), 0.5, 1e-3);
    // A belt that starts under a disc at rest gives it a third of its speed, and spin for the rest.
    EXPECT_NEAR(trial.state.velocity[row].x(), 2.0 / 3.0, 2e-3);
    EXPECT_NEAR(trial.state.spin[row] * 0.5, 4.0 / 3.0, 4e-3);
    EXPECT_EQ(trial.state.velocity[1 - row], Vec(2, 0.5));
  }
}

TEST(SoftSolids, APaddleThatTurnsSweepsDiscsAlong) {
  Trial trial(spring(1e6) + steps_of(1e-3, 20) + surface(1.0, 0.0) + kDisc +
              "bar = { polygon = [[-5, -0.1], [5, -0.1], [5, 0.1], [-5, 0.1]] }\n" + ball(3, 1.0, 0, 0) +
              "[[bodies]]\nshape = \"bar\"\nkind = \"kinematic\"\nat = [0, 0]\nspin = 1.0\n");
  trial.steps(400);
  // It is hit by a surface that goes at w r, and leaves at twice the part along the normal.
  const Vec v = trial.state.velocity[0];
  EXPECT_NEAR(v.norm(), 2.0 * std::sqrt(3.0 * 3.0 + 1.0 - 0.36), 0.02);
  EXPECT_GT(v.y(), 5.0);
}

TEST(SoftPeriodic, DiscsMeetAcrossTheSeamAsAnywhere) {
  const auto run = [](double shift) {
    Trial trial(spring(1e5) + steps_of(1e-3, 10) + surface(0.8, 0.3) +
                "[domain]\nperiodic = [[0, 0], [8, 8]]\n" + kDisc +
                ball(std::fmod(3.0 + shift, 8.0), 4, 1, 0, 2) +
                ball(std::fmod(4.2 + shift, 8.0), 4.3, -1, 0));
    trial.steps(400);
    return trial.state;
  };
  const State inside = run(0.0), seam = run(4.25);
  EXPECT_NE(inside.spin[0], 2.0);
  EXPECT_NEAR((inside.velocity[0] - seam.velocity[0]).norm(), 0.0, 1e-10);
  EXPECT_NEAR(inside.spin[1], seam.spin[1], 1e-9);
}

TEST(SoftPeriodic, ManyMeetAcrossTheSeamsAsAnywhere) {
  const Scene here = scene_from(
      spring(2e4) + steps_of(1e-3, 4) + surface(0.5, 0.4) +
      "[domain]\nperiodic = [[0, 0], [8, 8]]\n"
      "[shapes]\nball = { disc = { radius = { uniform = [0.3, 0.5] } } }\n"
      "[[bodies]]\nshape = \"ball\"\ncount = 64\nspin = 3.0\n"
      "velocity = { maxwell = 5.0 }\nplace = { random = { within = [[0, 0], [8, 8]], gap = 0.01 } }\n");
  Scene elsewhere = here;
  for (Vec& place : elsewhere.bodies.position) place = wrapped(place + Vec(3.0, 4.5), here.domain);
  Trial one(here), other(elsewhere);
  std::size_t most = 0;
  for (int i = 0; i < 150; ++i) {
    one.steps(1), other.steps(1);
    most = std::max(most, one.state.disc_contacts.size());
  }
  EXPECT_GT(most, 8u) << "more than a block";
  for (std::size_t i = 0; i < here.bodies.size(); ++i) {
    EXPECT_LT((one.state.velocity[i] - other.state.velocity[i]).norm(), 1e-9) << i;
    EXPECT_NEAR(one.state.spin[i], other.state.spin[i], 1e-8) << i;
  }
}

TEST(SoftContacts, SayWhereSpringsAreTooWeakToTellInFromOut) {
  Trial trial(spring(10.0) + steps_of(1e-3, 10) + surface(0.5, 0.0) + kDisc + ball(0, 0, 5, 0) +
              ball(1.1, 0, -5, 0));
  try {
    trial.steps(1000);
    ADD_FAILURE() << "went through";
  } catch (const SimulationError& error) {
    EXPECT_THAT(error.what(), ::testing::HasSubstr("body 1 and body 2 are pressed 0.25"));
  }
  Trial wall(spring(10.0) + steps_of(1e-3, 10) + surface(0.5, 0.0) + kDisc + kFloor + ball(0, 0.6, 0, -9));
  EXPECT_THROW(wall.steps(1000), SimulationError);
  Trial inside(spring(1e5) + steps_of(1e-3, 10) + surface(0.5, 0.0) + kDisc + ball(0, 0, 0, 0) +
               ball(0.6, 0, 0, 0));
  try {
    inside.steps(1);
    ADD_FAILURE() << "began";
  } catch (const SimulationError& error) {
    EXPECT_THAT(error.what(), ::testing::HasSubstr("place them apart if they begin so"));
  }
}

/// A triangular lattice, all discs pressed together by walls, that trembles.
double trembles(double part_of_longest, double e, double ratio) {
  Scene scene = scene_from(spring(1e4, ", tangential_stiffness = " + std::to_string(ratio)) + steps_of(1e-4) +
                           surface(e, 0.8) + "[domain]\nbox = [[0, 0], [8, 6.9]]\n" + kDisc);
  for (int row = 0; row < 8; ++row)
    for (int i = 0; i < 8 - row % 2; ++i) {
      Bodies& bodies = scene.bodies;
      bodies.shape.push_back(0), bodies.material.push_back(0), bodies.kind.push_back(BodyKind::dynamic);
      bodies.radius.push_back(0.5), bodies.angle.push_back(0.0);
      bodies.position.emplace_back(0.5 + i + 0.5 * (row % 2), 0.5 + row * 0.842);
      const double sign = (i + row) % 2 == 0 ? 1e-3 : -1e-3;
      bodies.velocity.emplace_back(sign, -sign), bodies.spin.push_back(10.0 * sign);
    }
  scene.time.dt = part_of_longest * soft_timing(scene).longest;
  Trial trial(std::move(scene));
  try {
    trial.steps(3000);
  } catch (const SimulationError&) {
    return 1e9;
  }
  double fastest = 0.0;
  for (std::size_t i = 0; i < trial.state.velocity.size(); ++i)
    fastest = std::max(fastest, trial.state.velocity[i].norm() + 0.5 * std::abs(trial.state.spin[i]));
  return fastest;
}

TEST(SoftTiming, TheLongestSubstepIsStableInTheDensestPackingAndHardlyMore) {
  for (const double e : {0.0, 0.2, 0.9})
    for (const double ratio : {2.0 / 7.0, 1.0}) EXPECT_LT(trembles(1.0, e, ratio), 1.0) << e << ", " << ratio;
  EXPECT_GT(trembles(2.5, 0.9, 2.0 / 7.0), 1.0) << "what is refused is bad";
}

}  // namespace
}  // namespace throng
