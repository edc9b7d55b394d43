// SPDX-License-Identifier: MIT
#include "sim/sleepers.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <numbers>

#include "sim/recording/checkpoint.h"
#include "sim/simulation.h"
#include "tests/sim/recording/scenes.h"
#include "tests/sim/trial.h"

namespace throng {
namespace {

const char* const kWorld =
    "gravity = [0, -10]\ntime = { dt = 0.01, until = 100 }\ndomain = { box = [[0, 0], [60, 60]] }\n"
    "[shapes]\nball = { disc = { radius = 0.5 } }\nbrick = { polygon = [[0, 0], [1, 0], [1, 1], [0, 1]] }\n"
    "plank = { polygon = [[0, 0], [6, 0], [6, 0.5], [0, 0.5]] }\n"
    "pair = { discs = [[0, 0, 0.3], [0.5, 0, 0.2]] }\n";

std::string body(const std::string& shape, double x, double y, const std::string& more = "") {
  return "[[bodies]]\nshape = \"" + shape + "\"\nat = [" + std::to_string(x) + ", " + std::to_string(y) +
         "]\n" + more;
}

/// Three bricks, two of them side by side below, and a composite in the lap of the ball beside them: six
/// bodies that lean on each other from x - 0.5 to x + 2.7.
constexpr std::size_t kHeap = 5;
std::string heap_at(double x) {
  return body("brick", x, 0.5) + body("brick", x + 1, 0.5) + body("brick", x + 0.5, 1.5) +
         body("ball", x + 2, 0.5) + body("pair", x + 2.6, 0.3);
}

std::size_t sleepers(const State& state) {
  return asleep(state.sleep);
}

/// Steps until so many sleep, at most for 20 s.
void steps_until_asleep(Trial& run, std::size_t count) {
  for (int i = 0; i < 2000 && sleepers(run.state) < count; ++i) run.steps(1);
  ASSERT_EQ(sleepers(run.state), count);
}

/// Steps until row `body` is awake. Returns how many.
int steps_until_awake(Trial& run, std::size_t body, int most = 1000) {
  for (int i = 1; i <= most; ++i) {
    run.steps(1);
    if (run.state.sleep.island[body] == 0) return i;
  }
  ADD_FAILURE() << "it sleeps on";
  return most;
}

// It happened: who is driven out of another has no velocity, and fell asleep before he was out.
TEST(Sleepers, AreNotThoseWhoAreDrivenOutOfOneAnother) {
  for (const char* dt : {"0.002", "0.005"}) {
    Trial run(std::string("gravity = [0, -10]\ntime = { until = 100, dt = ") + dt +
              " }\n[shapes]\nball = { disc = { radius = 0.5 } }\n[[walls]]\nsegment = [[-5, 0], [30, 0]]\n" +
              body("ball", 0, 0.5) + body("ball", 0.3, 0.5));
    for (int i = 0; i < 10000 && sleepers(run.state) < 2; ++i) run.steps(1);
    EXPECT_EQ(sleepers(run.state), 2u);
    EXPECT_LT(overlap(run.scene, run.state).max, 1e-4) << dt;
  }
}

TEST(Sleepers, LeaveTheLoop) {
  Trial run(kWorld + heap_at(10));
  steps_until_asleep(run, kHeap);
  EXPECT_EQ(kinetic_energy(run.scene, run.state), 0.0);
  const std::vector<Vec> before = run.state.position;
  run.steps(1);
  EXPECT_EQ(run.work.contacts.discs.size() + run.work.contacts.faces.size(), 0u) << "contacts are solved";
  EXPECT_EQ(run.work.candidates.pairs().size() + run.work.candidates.obstacle_pairs().size(), 0u);
  run.steps(300);
  EXPECT_EQ(run.state.position, before);
}

TEST(Sleepers, AreNotThoseWhoWereSlowForLessThanHalfASecond) {
  Trial run(kWorld + body("brick", 10, 0.5));
  run.steps(49);
  EXPECT_EQ(sleepers(run.state), 0u);
  run.steps(31);
  EXPECT_EQ(sleepers(run.state), 1u);
}

TEST(Sleepers, AreNoneBesideOneWhoMoves) {
  const std::string text = kWorld + body("brick", 10, 0.5) + body("brick", 11, 0.5);
  Trial calm(text), stirred(text + body("ball", 11, 1.5, "spin = 5\n"));
  calm.steps(100), stirred.steps(100);
  EXPECT_EQ(sleepers(calm.state), 2u);
  EXPECT_GT(stirred.state.spin[2], 0.05);
  EXPECT_EQ(sleepers(stirred.state), 0u);
}

TEST(Sleepers, KeepPressing) {
  const Scene scene = scene_from(kWorld + heap_at(10));
  const auto run = simulation(scene);
  for (int i = 0; i < 2000 && sleepers(run->state()) < kHeap; ++i) run->step();
  ASSERT_EQ(sleepers(run->state()), kHeap);
  std::vector<ContactRow> now, later;
  run->list_contacts(now);
  EXPECT_EQ(now.size(), run->contacts());
  for (int i = 0; i < 10; ++i) run->step();
  run->list_contacts(later);
  EXPECT_EQ(later, now);
  double floor = 0.0, weight = 0.0;
  for (const ContactRow& row : now)
    if (row.b == 0) floor += row.impulse;
  for (std::size_t i = 0; i < kHeap; ++i) weight += 10.0 * mass(scene, i);
  EXPECT_NEAR(floor, weight * scene.time.dt, 0.02 * floor) << "N s in a step";
}

/// Two heaps; a brick falls on the second. Balls stop: else one may roll on for a minute.
std::string two_heaps() {
  return kWorld + std::string("[materials.default]\nrolling_resistance = 0.02\n") + heap_at(10) +
         heap_at(20) + body("brick", 20.5, 50);
}

TEST(Sleepers, WakeWithTheirIslandWhenSomethingMayTouchThemAndNoneElse) {
  Trial run(two_heaps());
  steps_until_asleep(run, 2 * kHeap);
  EXPECT_EQ(run.state.sleep.island[0], 1u);
  EXPECT_EQ(run.state.sleep.island[kHeap + 2], kHeap + 1);
  const std::vector<Vec> before = run.state.position;
  State last = run.state;
  while (run.state.sleep.island[kHeap] != 0 && run.state.step < 1000) last = run.state, run.steps(1);
  const double gap = (last.position[2 * kHeap] - last.position[kHeap + 2]).y() - 1.0;
  EXPECT_GT(gap, 0.0) << "it woke too late";
  const double circles = std::numbers::sqrt2 - 1.0;  // m, so far apart two bricks' circles meet
  EXPECT_LT(gap, -last.velocity[2 * kHeap].y() * 0.01 + 0.06 + circles) << "it woke too early";
  for (std::size_t i = 0; i < 2 * kHeap; ++i) {
    EXPECT_EQ(run.state.sleep.island[i] == 0, i >= kHeap) << i;
    if (i < kHeap) {
      EXPECT_EQ(run.state.position[i], before[i]);
    }
  }
  run.steps(30);
  EXPECT_LT(overlap(run.scene, run.state).max, 0.05);
  EXPECT_NE(run.state.position[kHeap], before[kHeap]);
  steps_until_asleep(run, 2 * kHeap + 1);
}

/// The speed of what wakes, and would lie still, half a step after: contacts push as they did.
TEST(Sleepers, WakeWithTheImpulsesThatTheyFellAsleepWith) {
  std::string tower = kWorld;
  for (int i = 0; i < 12; ++i) tower += body("brick", 10, 0.5 + i);
  Trial run(tower + body("ball", 5, 0.5, "kind = \"kinematic\"\nvelocity = [0.5, 0]\n"));
  steps_until_asleep(run, 12);
  const std::size_t kept = run.state.sleep.point_contacts.size();
  EXPECT_GE(kept, 24u);
  steps_until_awake(run, 0);
  EXPECT_TRUE(run.state.sleep.point_contacts.empty());
  EXPECT_GE(run.state.point_contacts.size(), kept) << "some stood before";
  double fastest = 0.0;
  for (std::size_t i = 0; i < 12; ++i) fastest = std::max(fastest, run.state.velocity[i].norm());
  EXPECT_LT(fastest, 1e-3) << "m/s: they fell in on waking";
}

TEST(Sleepers, WakeBeforeAWallThatMovesReachesThem) {
  for (const bool fast : {true, false}) {
    const std::string motion = fast ? "velocity = [1, 0]\n" : "velocity = [0.01, 0]\n";
    Trial run(kWorld + body("brick", 10, 0.5) +
              body("brick", fast ? 6 : 8.95, 0.5, "kind = \"kinematic\"\n" + motion));
    steps_until_asleep(run, 1);
    steps_until_awake(run, 0);
    EXPECT_LT(overlap(run.scene, run.state).max, 1e-3) << motion;
    run.steps(100);
    EXPECT_GT((run.state.position[0] - run.state.position[1]).x(), 0.99) << "the wall went into it";
    EXPECT_EQ(sleepers(run.state), 0u) << "it sleeps beside the wall";
  }
}

TEST(Sleepers, RestOnADrivenBodyThatStandsAndNotOnOneThatTurns) {
  Trial standing(kWorld + body("plank", 10, 5, "kind = \"kinematic\"\n") + body("brick", 10, 5.75));
  steps_until_asleep(standing, 1);
  standing.steps(100);
  EXPECT_EQ(sleepers(standing.state), 1u);
  Trial turning(kWorld + body("plank", 10, 5, "kind = \"kinematic\"\nspin = 1e-4\n") +
                body("brick", 10, 5.75));
  for (int i = 0; i < 300; ++i) {
    turning.steps(1);
    ASSERT_EQ(sleepers(turning.state), 0u) << "step " << i;
  }
}

// It happened: discs on slopes up to 0.2 % fell asleep half a second after they had begun to roll.
TEST(Sleepers, AreNoneThatBeginToRollOrToSlide) {
  for (const double slope : {1e-3, 1e-5}) {
    std::string world = kWorld;
    world.replace(world.find("[0, -10]"), 8, "[" + std::to_string(10 * slope) + ", -10]");
    Trial rolls(world + body("ball", 10, 0.5));
    Trial slide(world + body("brick", 10, 0.5) + body("brick", 10, 1.5) +
                "[materials.default]\nfriction = 0\n");
    rolls.steps(400), slide.steps(400);
    EXPECT_NEAR(rolls.state.position[0].x() - 10, 10 * slope * 16 / 3, 0.01 * 10 * slope * 16 / 3) << slope;
    for (const std::size_t brick : {0u, 1u})
      EXPECT_NEAR(slide.state.position[brick].x() - 10, 10 * slope * 8, 0.01 * 10 * slope * 8) << slope;
  }
}

/// Friction holds it: the same push, and no speed.
TEST(Sleepers, AreThoseThatASlopeHolds) {
  std::string world = kWorld;
  world.replace(world.find("[0, -10]"), 8, "[1, -10]");
  Trial run(world + body("brick", 10, 0.5) + body("brick", 10, 1.5));
  run.steps(100);
  EXPECT_EQ(sleepers(run.state), 2u);
}

TEST(Sleepers, AreNoneThatSpinInTheirPlaces) {
  Trial run(kWorld + body("ball", 10, 0.5, "spin = 1\n") + "[materials.default]\nfriction = 0\n");
  run.steps(200);
  EXPECT_EQ(run.state.position[0].x(), 10.0);
  EXPECT_EQ(sleepers(run.state), 0u);
}

/// The second brick slides to its rest a millimetre before the first, which rests from the start.
TEST(Sleepers, WaitForTheLastOfTheirIsland) {
  Trial run(kWorld + body("brick", 10, 0.5) + body("brick", 11.1, 0.5, "velocity = [-1, 0]\n"));
  run.steps(80);
  const double gap = run.state.position[1].x() - run.state.position[0].x() - 1.0;
  ASSERT_TRUE(gap > 0.0 && gap < 0.002) << gap << " m";
  EXPECT_EQ(sleepers(run.state), 0u);
  run.steps(20);
  EXPECT_EQ(run.state.sleep.island, (std::vector<std::uint32_t>{1, 1}));
}

/// The bounding discs overlap: it is the shapes that count.
TEST(Sleepers, DoNotWakeForWhatPassesByWithoutTouching) {
  Trial run(kWorld + body("plank", 10, 0.25) + "[[walls]]\nsegment = [[5, 1], [25, 1]]\n" +
            body("ball", 20, 1.5, "velocity = [-6, 0]\n"));
  bool near = false;
  steps_until_asleep(run, 1);
  for (int i = 0; i < 1000 && run.state.position[1].x() > 6; ++i) {
    run.steps(1);
    ASSERT_EQ(run.state.sleep.island[0], 1u) << "at x = " << run.state.position[1].x();
    near |= (run.state.position[1] - run.state.position[0]).norm() < 1.5;
  }
  EXPECT_TRUE(near) << "it never came near";
}

TEST(Sleepers, WakeForWhatComesAcrossTheBorderOfADomainThatRepeats) {
  for (const char* shape : {"ball", "brick", "pair"}) {
    std::string world = kWorld;
    const std::string box = "domain = { box = [[0, 0], [60, 60]] }";
    world.replace(world.find(box), box.size(), "domain = { periodic = [[0, 0], [20, 20]] }");
    Trial run(world + body("brick", 0.7, 5.5) + body(shape, 13, 5.5, "velocity = [6, 0]\n") +
              "[[walls]]\nsegment = [[0, 5], [20, 5]]\n[materials.default]\nfriction = 0.05\n");
    run.steps(75);
    ASSERT_EQ(run.state.sleep.island[0], 1u);
    steps_until_awake(run, 0);
    EXPECT_LT(overlap(run.scene, run.state).max, 0.01) << shape;
    const double x = run.state.position[1].x();
    EXPECT_TRUE(x > 18 || x < 1) << x;
  }
}

TEST(Sleepers, AreNoneInTheAirWhereHardlyAnythingPulls) {
  std::string world = kWorld;
  world.replace(world.find("[0, -10]"), 8, "[0, -1e-5]");
  Trial run(world + body("ball", 10, 30));
  run.steps(300);
  EXPECT_EQ(sleepers(run.state), 0u);
  EXPECT_LT(run.state.velocity[0].y(), -2.9e-5);
}

TEST(Sleepers, AreNoneWhereTheSceneSaysSoAndAllGoesOnAsIfNobodySlept) {
  const Scene may = scene_from(kWorld + heap_at(10)),
              never = scene_from("sleep = false\n" + (kWorld + heap_at(10)));
  EXPECT_FALSE(plan_for(never).sleep);
  Trial sleeping(may), awake(never);
  EXPECT_TRUE(awake.state.sleep.calm.empty());
  while (sleepers(sleeping.state) == 0 && sleeping.state.step < 1000) {
    ASSERT_EQ(hash(sleeping.state), hash(awake.state)) << "step " << sleeping.state.step;
    sleeping.steps(1), awake.steps(1);
  }
  EXPECT_EQ(sleepers(sleeping.state), kHeap);
  awake.steps(300);
  EXPECT_TRUE(awake.state.sleep.island.empty());
  EXPECT_GT(awake.state.disc_contacts.size() + awake.state.point_contacts.size(), 8u);
  EXPECT_EQ(sleeping.state.position.size(), awake.state.position.size());
  for (std::size_t i = 0; i < kHeap; ++i)
    EXPECT_LT((sleeping.state.position[i] - awake.state.position[i]).norm(), 1e-3) << "m, body " << i;
}

bool same(const SleepState& a, const SleepState& b) {
  const auto contacts = [](const std::vector<SleepingContact>& x, const std::vector<SleepingContact>& y) {
    return std::ranges::equal(x, y, [](const SleepingContact& p, const SleepingContact& q) {
      return p.impulse.key == q.impulse.key && p.impulse.feature == q.impulse.feature &&
             p.impulse.normal == q.impulse.normal && p.impulse.tangent == q.impulse.tangent &&
             p.impulse.rolling == q.impulse.rolling && p.island == q.island && p.a == q.a && p.b == q.b &&
             p.point == q.point;
    });
  };
  return a.calm == b.calm && a.squared_speed == b.squared_speed && a.island == b.island &&
         contacts(a.disc_contacts, b.disc_contacts) && contacts(a.point_contacts, b.point_contacts);
}

/// A run that another one, of two threads, takes over at each of these steps, from a file.
TEST(Sleepers, SleepOnAndWakeTheSameAfterACheckpoint) {
  const Scene scene = scene_from(two_heaps());
  const auto run = simulation(scene);
  const testing_recordings::Folder folder;
  std::vector<std::unique_ptr<Simulation>> others;
  std::size_t most = 0;
  bool woke = false;
  for (int i = 0; i < 1000; ++i) {
    if (i == 40 || i == 150 || i == 313) {
      recording::write_checkpoint(folder / "a.ckpt", {"0.1.0", "", 0, 0}, run->state());
      const State state = recording::read_checkpoint(folder / "a.ckpt").state;
      ASSERT_TRUE(fits(state, scene));
      ASSERT_TRUE(same(state.sleep, run->state().sleep));
      others.push_back(simulation(scene, 2));
      ASSERT_TRUE(others.back()->restore(state));
    }
    run->step();
    woke |= i > 313 && sleepers(run->state()) < most;
    most = std::max(most, sleepers(run->state()));
    std::vector<ContactRow> rows, same_rows;
    run->list_contacts(rows);
    for (const auto& other : others) {
      other->step();
      ASSERT_EQ(hash(other->state()), hash(run->state())) << "step " << run->state().step;
      ASSERT_TRUE(same(other->state().sleep, run->state().sleep));
      other->list_contacts(same_rows);
      ASSERT_EQ(same_rows, rows);
    }
  }
  EXPECT_TRUE(woke);
  EXPECT_EQ(sleepers(run->state()), 2 * kHeap + 1);
}

TEST(Sleepers, AreTheSameOnTwoThreads) {
  const Scene scene = scene_from(two_heaps());
  Trial one(scene), two(scene, 2);
  bool slept = false, woke = false;
  for (int i = 0; i < 500; ++i) {
    one.steps(1), two.steps(1);
    ASSERT_EQ(hash(one.state), hash(two.state)) << "step " << i;
    ASSERT_TRUE(same(one.state.sleep, two.state.sleep));
    slept |= one.state.sleep.island[kHeap] != 0;
    woke |= slept && one.state.sleep.island[kHeap] == 0;
  }
  EXPECT_TRUE(woke);
}

TEST(Sleepers, DoNotFitASceneWhereTheyCannotSleepSo) {
  Trial run(two_heaps());
  steps_until_asleep(run, 2 * kHeap);
  ASSERT_TRUE(fits(run.state, run.scene));
  const auto refused = [&](auto change) {
    State state = run.state;
    change(state);
    return !fits(state, run.scene);
  };
  EXPECT_TRUE(refused([](State& s) { s.sleep = {}; }));
  EXPECT_TRUE(refused([](State& s) { s.sleep.calm.pop_back(); }));
  EXPECT_TRUE(refused([](State& s) { s.sleep.squared_speed.pop_back(); }));
  EXPECT_TRUE(refused([](State& s) { s.sleep.island[0] = 1000; }));
  EXPECT_TRUE(refused([](State& s) { s.sleep.island[0] = 2; }));
  EXPECT_TRUE(refused([](State& s) { s.velocity[1].x() = 1e-9; }));
  EXPECT_TRUE(refused([](State& s) { s.spin[1] = 1e-9; }));
  EXPECT_TRUE(refused([](State& s) { s.sleep.point_contacts[0].island = 0; }));
  EXPECT_TRUE(refused([](State& s) { s.sleep.point_contacts[0].a = 0; }));
  EXPECT_TRUE(refused([](State& s) { s.sleep.point_contacts[0].b = 1000; }));
  Scene never = run.scene;
  never.sleep = false;
  EXPECT_FALSE(fits(run.state, never));
}

/// While they sleep a list is made of who is awake; it is of no use once all are.
TEST(Sleepers, AreFoundAgainByThoseThatWakeThemAll) {
  Trial run(
      "gravity = [0, -9.81]\ntime = { dt = 0.01, until = 8, substeps = 4 }\n[materials.default]\nfriction = "
      "0.5\n[shapes]\nball = { disc = { radius = 0.2 } }\n" +
      ball(-1.6, 0.2, 0.3, 0, -1.5) + ball(-2.001, 0.2, 0.3, 0, -1.5) + ball(0, 0.2, 0, 0) +
      ball(0.4, 0.2, 0, 0) + ball(0.8, 0.2, 0, 0) +
      "[[walls]]\npolyline = [[-9, 2], [-9, 0], [1.0, 0], [1.0, 3]]\n");
  bool slept = false, woke = false;
  for (int i = 0; i < 800; ++i) {
    run.steps(1);
    ASSERT_EQ(run.work.contacts.discs.size(), run.work.contacts.disc_key.size()) << i;
    slept |= run.work.sleepers.bodies().size() == 2;
    woke |= slept && run.work.sleepers.bodies().size() == 5;
  }
  EXPECT_TRUE(slept);
  EXPECT_TRUE(woke);
}

}  // namespace
}  // namespace throng
