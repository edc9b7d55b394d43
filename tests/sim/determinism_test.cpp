// SPDX-License-Identifier: MIT
// Same again: equal input gives equal bits, for any number of threads, compiler and build.
#include <gtest/gtest.h>

#include <map>

#include "sim/simulation.h"
#include "tests/sim/scene_from.h"

namespace throng {
namespace {

std::uint64_t hash_after(const Scene& scene, int steps, int threads) {
  const auto run = simulation(scene, threads);
  for (int i = 0; i < steps; ++i) run->step();
  return hash(run->state());
}

/// Steps and the hash that every build of throng must reach. A change of the physics changes them: then, and
/// only then, they are to be replaced, in the commit that says why.
const std::map<std::string, std::uint64_t> kGolden = {};

class EveryScene : public ::testing::TestWithParam<const char*> {};

TEST_P(EveryScene, RunsToTheSameBitsTwiceAndOnTwoThreads) {
  const Scene scene = gallery_scene(GetParam());
  const std::uint64_t once = hash_after(scene, 20, 1);
  EXPECT_EQ(hash_after(scene, 20, 1), once);
  EXPECT_EQ(hash_after(scene, 20, 2), once);
}

TEST_P(EveryScene, ReachesTheHashThatEveryBuildReaches) {
  const std::uint64_t reached = hash_after(gallery_scene(GetParam()), 20, 1);
  const auto golden = kGolden.find(GetParam());
  ASSERT_NE(golden, kGolden.end()) << "reached 0x" << std::hex << reached;
  EXPECT_EQ(reached, golden->second) << "reached 0x" << std::hex << reached;
}

INSTANTIATE_TEST_SUITE_P(Gallery, EveryScene,
                         ::testing::Values("gas", "pile", "polygons", "pyramid", "hopper", "gears",
                                           "billiard", "cradle", "mixed"),
                         [](const auto& scene) { return std::string(scene.param); });

TEST(Hash, TellsStatesApartByEachQuantity) {
  const Scene scene =
      scene_from("[shapes]\nball = { disc = { radius = 0.5 } }\n[[bodies]]\nshape = \"ball\"\nat = [1, 2]\n");
  const State state = initial_state(scene);
  const auto changed = [&](auto change) {
    State other = state;
    change(other);
    return hash(other);
  };
  const std::uint64_t all[] = {hash(state),
                               changed([](State& s) { s.step = 1; }),
                               changed([](State& s) { s.position[0].x() += 1e-15; }),
                               changed([](State& s) { s.position[0].y() += 1e-15; }),
                               changed([](State& s) { s.angle[0] = 1e-300; }),
                               changed([](State& s) { s.velocity[0].x() = 1e-300; }),
                               changed([](State& s) { s.spin[0] = 1e-300; })};
  for (std::size_t i = 0; i < std::size(all); ++i)
    for (std::size_t j = 0; j < i; ++j) EXPECT_NE(all[i], all[j]) << i << ", " << j;
}

TEST(Hash, KnowsOneZero) {
  const Scene scene =
      scene_from("[shapes]\nball = { disc = { radius = 0.5 } }\n[[bodies]]\nshape = \"ball\"\nat = [1, 2]\n");
  State state = initial_state(scene);
  const std::uint64_t before = hash(state);
  state.velocity[0].x() = -0.0;
  EXPECT_EQ(hash(state), before);
}

}  // namespace
}  // namespace throng
