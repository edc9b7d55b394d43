// SPDX-License-Identifier: MIT
#include "sim/contact/parts.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "sim/observe.h"
#include "sim/simulation_error.h"
#include "tests/sim/trial.h"

namespace throng {
namespace {

/// Discs and squares that fall on each other and to the side, `columns` of 90 each.
std::string heap(int columns, const std::string& more = "") {
  const std::string count = std::to_string(columns / 2);
  return "seed = 5\nsleep = false\ngravity = [1, -9.81]\ntime = { dt = 0.01, substeps = 4 }\n"
         "domain = { box = [[0, 0], [" +
         std::to_string(columns + 2) +
         ", 200]] }\n[shapes]\nball = { disc = { radius = { uniform = [0.4, 0.45] } } }\n"
         "box = { polygon = [[-0.45, -0.45], [0.45, -0.45], [0.45, 0.45], [-0.45, 0.45]] }\n"
         "[[bodies]]\nshape = \"ball\"\nplace = { lattice = { origin = [1, 0.5], spacing = [2, 0.905], size "
         "= [" +
         count +
         ", 90] } }\n[[bodies]]\nshape = \"box\"\nplace = { lattice = { origin = [2, 0.5], spacing = [2, "
         "0.905], "
         "size = [" +
         count + ", 90] } }\n" + more;
}

/// One step more of each, of `afresh` as if nothing had been before: have they equal bits?
bool stay_alike(Trial& one, Trial& two, Trial& afresh) {
  one.steps(1), two.steps(1);
  Workspace work(afresh.scene, afresh.plan, 1);
  work.sleepers.look(afresh.state, work.candidates);
  step(afresh.scene, afresh.plan, afresh.state, work);
  return hash(one.state) == hash(two.state) && hash(one.state) == hash(afresh.state);
}

TEST(Parts, AreOneWhereThereAreFewBodies) {
  const Scene scene = scene_from(heap(20));
  Parts parts(scene, plan_for(scene));
  EXPECT_EQ(parts.count(), 1u);
  EXPECT_EQ(parts.groups(), 1u);
  EXPECT_FALSE(parts.place(initial_state(scene), Rows::all(scene.bodies.size())));
  EXPECT_EQ(parts.group(3, 1700), 0u);
}

TEST(Parts, AreCutAcrossTheGroundAndTellWhoLeavesThem) {
  const Scene scene = scene_from(heap(100));
  Parts parts(scene, plan_for(scene));
  ASSERT_EQ(parts.count(), 2u);
  ASSERT_EQ(parts.groups(), 3u);
  State state = initial_state(scene);
  const Rows all = Rows::all(scene.bodies.size());
  parts.place(state, all);
  std::size_t left = 0;
  std::uint32_t first = 0, second = 0;  // somebody in each
  for (std::uint32_t i = 0; i < state.position.size(); ++i) {
    const bool in_first = parts.group(i) == 0;
    EXPECT_EQ(in_first, state.position[i].x() < 51.0) << i;
    left += in_first;
    (in_first ? first : second) = i;
  }
  EXPECT_NEAR(static_cast<double>(left), 4500.0, 100.0);
  EXPECT_EQ(parts.group(first, first), 0u);
  EXPECT_EQ(parts.group(second, second), 1u);
  EXPECT_EQ(parts.group(first, second), 2u) << "what joins them";
  const auto obstacles = static_cast<std::uint32_t>(scene.bodies.size());  // rows behind all bodies
  EXPECT_EQ(parts.group(first, obstacles), 0u);
  EXPECT_EQ(parts.group(second, obstacles + 1), 1u);
  EXPECT_FALSE(parts.place(state, all));
  state.position[first].x() = 90.0;
  EXPECT_TRUE(parts.place(state, all));
  EXPECT_EQ(parts.group(first), 1u);
}

TEST(Parts, ListThoseAwakeEachInItsPart) {
  const Scene scene = scene_from(heap(100));
  Parts parts(scene, plan_for(scene));
  const State state = initial_state(scene);
  std::vector<std::uint32_t> third;
  for (std::uint32_t i = 0; i < state.position.size(); i += 3) third.push_back(i);
  parts.place(state, Rows::all(state.position.size()));
  parts.place(state, Rows::of(third));
  std::vector<std::uint32_t> listed;
  for (const std::size_t part : {0, 1}) {
    const std::size_t before = listed.size();
    parts.rows(part).for_each([&](std::uint32_t row) {
      EXPECT_EQ(parts.group(row), part) << row;
      listed.push_back(row);
    });
    EXPECT_TRUE(std::ranges::is_sorted(std::span(listed).subspan(before)));
  }
  std::ranges::sort(listed);
  EXPECT_EQ(listed, third);
}

// A cut through a column's centres would have its bodies change sides with each rounding.
TEST(Parts, AreCutBetweenColumns) {
  const Scene scene = scene_from(heap(100));
  Parts parts(scene, plan_for(scene));
  ASSERT_EQ(parts.count(), 2u);
  State state = initial_state(scene);
  const Rows all = Rows::all(scene.bodies.size());
  parts.place(state, all);
  for (const double tremor : {-1e-9, 1e-9, -0.1, 0.2}) {
    for (Vec& position : state.position) position.x() += tremor;
    EXPECT_FALSE(parts.place(state, all)) << tremor;
  }
}

TEST(Parts, AreOneWhereAllStandInOneColumn) {
  const Scene scene =
      scene_from("gravity = [0, -9.81]\n" + std::string(kDisc) +
                 "[[bodies]]\nshape = \"ball\"\nplace = { lattice = { origin = [1, 1], spacing "
                 "= [1, 1.1], size = [1, 9000] } }\n");
  Parts parts(scene, plan_for(scene));
  EXPECT_EQ(parts.count(), 1u);
  EXPECT_EQ(parts.groups(), 1u);
  EXPECT_FALSE(parts.place(initial_state(scene), Rows::all(scene.bodies.size())));
}

// Three columns for four parts.
TEST(Parts, AreFewerWhereCutsCoincide) {
  const Scene scene = scene_from(
      "gravity = [0, -9.81]\n" + std::string(kDisc) +
      "[[bodies]]\nshape = \"ball\"\nplace = { lattice = { origin = [1, 1], spacing = [1.1, 1.1], size = [3, "
      "6000] } }\n");
  Parts parts(scene, plan_for(scene));
  ASSERT_EQ(parts.count(), 3u);
  State state = initial_state(scene);
  parts.place(state, Rows::all(scene.bodies.size()));
  for (std::uint32_t i = 0; i < state.position.size(); ++i)
    ASSERT_EQ(parts.group(i), static_cast<std::size_t>(std::lround((state.position[i].x() - 1.0) / 1.1)));
}

TEST(Parts, AreOneWhereDiscsFly) {
  const Scene scene =
      scene_from("domain = { box = [[0, 0], [400, 400]] }\n" + material(1, 0) + kDisc +
                 "[[bodies]]\nshape = \"ball\"\nplace = { lattice = { origin = [1, 1], spacing "
                 "= [3, 3], size = [100, 100] } }\n");
  EXPECT_EQ(Parts(scene, plan_for(scene)).groups(), 1u);
}

/// A body that is driven stands in both parts' way, and some are thrown from one part into the other.
TEST(Parts, GiveTheSameBitsForAnyNumberOfThreadsAndWhateverWasBefore) {
  const Scene scene = scene_from(
      heap(100,
           "[[bodies]]\nshape = \"box\"\nat = [51, 95]\nkind = \"kinematic\"\nvelocity = [0, "
           "-3]\nspin = 2\n[[bodies]]\nshape = \"ball\"\ncount = 200\nvelocity = [20, 0]\nplace = { "
           "random = { within = [[20, 100], [60, 150]] } }\n"));
  Trial one(scene, 1), two(scene, 2), afresh(scene, 1);
  ASSERT_EQ(one.work.finder.parts().count(), 2u);
  for (int i = 0; i < 30; ++i) {
    ASSERT_TRUE(stay_alike(one, two, afresh)) << "step " << i;
  }
  EXPECT_GT(one.state.disc_contacts.size(), 100u);
  EXPECT_GT(one.state.point_contacts.size(), 1000u);
  EXPECT_FALSE(one.work.contacts.discs.blocks(2).empty() && one.work.contacts.faces.blocks(2).empty())
      << "nothing joined the parts";
}

/// What stands at the seam meets an image of who is in the part at the other end.
TEST(Parts, GiveTheSameBitsForAnyNumberOfThreadsWhereTheDomainRepeats) {
  std::string text =
      heap(100,
           "[[walls]]\nsegment = [[0, 0], [101, 0]]\n[[bodies]]\nshape = \"ball\"\ncount = 100\n"
           "velocity = [40, -20]\nplace = { random = { within = [[80, 83], [100, 100]] } }\n");
  const std::string box = "box = [[0, 0], [102, 200]]";
  ASSERT_NE(text.find(box), std::string::npos);
  text.replace(text.find(box), box.size(), "periodic = [[0.5, -20], [100.5, 200]]");
  const Scene scene = scene_from(text);
  Trial one(scene, 1), two(scene, 2);
  ASSERT_EQ(one.work.finder.parts().count(), 2u);
  one.steps(25), two.steps(25);
  EXPECT_EQ(hash(one.state), hash(two.state));
  EXPECT_GT(one.work.contacts.discs.blocks(2).size() + one.work.contacts.faces.blocks(2).size(), 0u);
  EXPECT_GT(one.state.point_contacts.size(), 100u);
}

/// Some sleep while others fall on them, and each step of one of the runs begins afresh.
TEST(Parts, GiveTheSameBitsWhereSomeSleep) {
  const Scene scene = scene_from(
      "gravity = [0, -9.81]\ntime = { dt = 0.01, substeps = 4 }\ndomain = { box = [[0, 0], [9100, 9]] }\n" +
      std::string(kDisc) +
      "box = { polygon = [[-0.5, -0.5], [0.5, -0.5], [0.5, 0.5], [-0.5, 0.5]] }\n"
      "[[bodies]]\nshape = \"ball\"\nplace = { lattice = { origin = [1, 0.5], spacing = [1.1, 1], size = "
      "[8192, 1] } }\n[[bodies]]\nshape = \"box\"\nplace = { lattice = { origin = [4400, 7], spacing = "
      "[1.3, 1], size = [200, 1] } }\nspin = 1\n");
  Trial one(scene, 1), two(scene, 2), afresh(scene, 1);
  ASSERT_EQ(one.work.finder.parts().count(), 2u);
  std::size_t most = 0;
  for (int i = 0; i < 130; ++i) {
    ASSERT_TRUE(stay_alike(one, two, afresh)) << "step " << i;
    most = std::max(most, asleep(one.state.sleep));
  }
  EXPECT_GT(most, 7000u);
  EXPECT_GT(one.state.disc_contacts.size() + one.state.point_contacts.size(), 20u);
}

/// Two get too far, far from each other: the first of them is named, whoever stores it first.
TEST(Parts, NameTheSameBodyThatCantGoOnForAnyNumberOfThreads) {
  const Scene scene =
      scene_from("gravity = [0, -9.81]\ntime = { dt = 0.01, substeps = 4 }\n" + std::string(kDisc) +
                 "[[bodies]]\nshape = \"ball\"\nplace = { lattice = { origin = [0, 0], spacing = [2, 2], "
                 "size = [100, 90] } }\n");
  for (const int threads : {1, 2}) {
    Trial run(scene, threads);
    ASSERT_EQ(run.work.finder.parts().count(), 2u);
    for (const auto& [row, x] : {std::pair(4608u, 10.0), std::pair(4607u, 190.0)}) {
      run.state.position[row] = {x, 1e12 - 100.0};
      run.state.velocity[row] = {0.0, 1e9};
    }
    try {
      run.steps(1);
      FAIL() << "went on";
    } catch (const SimulationError& error) {
      EXPECT_NE(std::string(error.what()).find("body 4608 is at"), std::string::npos) << error.what();
    }
  }
}

TEST(Parts, NameTheSameBodyThatReachesTooFarForAnyNumberOfThreads) {
  const Scene scene =
      scene_from("gravity = [0, -9.81]\ntime = { dt = 0.01, substeps = 4 }\n" + std::string(kDisc) +
                 "[[bodies]]\nshape = \"ball\"\nplace = { lattice = { origin = [0, 0], "
                 "spacing = [2, 2], size = [100, 90] } }\n");
  for (const int threads : {1, 2}) {
    Trial run(scene, threads);
    run.state.velocity[4608] = run.state.velocity[4607] = {1e308, 1e308};
    try {
      run.steps(1);
      FAIL() << "went on";
    } catch (const SimulationError& error) {
      EXPECT_NE(std::string(error.what()).find("body 4608 gets infinitely far"), std::string::npos)
          << error.what();
    }
  }
}

// Once nobody asked for seats, and then there were blocks of one group alone.
TEST(Parts, AreThereWhereNobodyMeetsAnybody) {
  Trial run(
      "gravity = [0, -9.81]\ntime = { dt = 0.01, substeps = 4 }\ndomain = { box = [[0, 0], [9100, 9]] }\n" +
      std::string(kDisc) +
      "[[bodies]]\nshape = \"ball\"\nplace = { lattice = { origin = [1, 0.5], spacing = [1.1, 1], "
      "size = [8192, 1] } }\n");
  ASSERT_EQ(run.work.finder.parts().count(), 2u);
  for (int i = 0; i < 100 && asleep(run.state.sleep) < run.state.id.size(); ++i) run.steps(1);
  ASSERT_EQ(asleep(run.state.sleep), run.state.id.size());
  const std::vector<Vec> before = run.state.position;
  Workspace resumed(run.scene, run.plan, 1);
  resumed.sleepers.look(run.state, resumed.candidates);
  step(run.scene, run.plan, run.state, resumed);
  EXPECT_EQ(resumed.contacts.discs.groups(), 3u);
  EXPECT_EQ(resumed.contacts.discs.blocks(2).size(), 0u);
  EXPECT_EQ(run.state.position, before);
}

TEST(Parts, AreThereWhereAllAreInTheFirstAndNoneIsADisc) {
  Trial run(
      "gravity = [0, -9.81]\ntime = { dt = 0.01, substeps = 4 }\ndomain = { box = [[0, 0], [9100, 9]] }\n" +
      std::string(kDisc) +
      "box = { polygon = [[-0.5, -0.5], [0.5, -0.5], [0.5, 0.5], [-0.5, 0.5]] }\n"
      "[[bodies]]\nshape = \"box\"\nplace = { lattice = { origin = [1, 0.5], spacing = [1, 1], "
      "size = [2, 3] } }\n[[bodies]]\nshape = \"ball\"\nkind = \"static\"\n"
      "place = { lattice = { origin = [10, 0.5], spacing = [1, 1], size = [8192, 1] } }\n");
  ASSERT_EQ(run.work.finder.parts().count(), 2u);
  run.steps(1);
  EXPECT_EQ(run.work.contacts.discs.groups(), 3u);
  EXPECT_GT(run.work.contacts.faces.blocks(0).size(), 0u);
  EXPECT_EQ(run.work.contacts.faces.blocks(2).size(), 0u);
}

}  // namespace
}  // namespace throng
