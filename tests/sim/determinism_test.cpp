// SPDX-License-Identifier: MIT
// Same again: equal input gives equal bits, for any number of threads, compiler and build.
#include <gtest/gtest.h>

#include <ostream>

#include "sim/simulation.h"
#include "tests/sim/scene_from.h"

namespace throng {
namespace {

std::uint64_t hash_after(const Scene& scene, int steps, int threads) {
  const auto run = simulation(scene, threads);
  for (int i = 0; i < steps; ++i) run->step();
  return hash(run->state());
}

/// A scene, how long it runs (enough that bodies meet), and the hash that every build of throng must then
/// reach. A change of the physics changes it: then, and only then, it is to be replaced, in the commit that
/// says why.
struct Golden {
  const char* scene;
  int steps;
  std::uint64_t hash;
};

void PrintTo(const Golden& golden, std::ostream* out) {
  *out << golden.scene;
}

constexpr Golden kGallery[] = {
    {"gas", 400, 0xf4c6010f6a9ebe12},       {"pile", 60, 0xf3f377d3f71d51},
    {"polygons", 40, 0x203df4b28373e05},    {"pyramid", 10, 0xe12225595388ff2a},
    {"hopper", 100, 0x922c24dd4e64bca8},    {"gears", 100, 0xe4e88ff2785d1831},
    {"billiard", 1500, 0xc39891314a486ed1}, {"cradle", 2000, 0x7d1d3bfa5a6ce43a},
    {"mixed", 200, 0xe05462a3e1df6ef3},
};

class EveryScene : public ::testing::TestWithParam<Golden> {};

TEST_P(EveryScene, ReachesTheSameBitsInEveryBuildAndOnTwoThreads) {
  const auto [name, steps, golden] = GetParam();
  const Scene scene = gallery_scene(name);
  const std::uint64_t once = hash_after(scene, steps, 1);
  EXPECT_EQ(once, golden) << "reached 0x" << std::hex << once;
  EXPECT_EQ(hash_after(scene, steps, 2), once);
}

TEST_P(EveryScene, HasContactsToTest) {
  const Scene scene = gallery_scene(GetParam().scene);
  const auto run = simulation(scene);
  std::size_t contacts = 0;
  for (int i = 0; i < GetParam().steps; ++i) {
    run->step();
    contacts += run->contacts();
  }
  // A bounce leaves no contact behind: in scenes that nothing else accelerates, velocities tell.
  const bool weightless = scene.gravity == Vec(0.0, 0.0);
  EXPECT_TRUE(contacts > 0 || (weightless && run->state().velocity != scene.bodies.velocity));
}

INSTANTIATE_TEST_SUITE_P(Gallery, EveryScene, ::testing::ValuesIn(kGallery),
                         [](const auto& scene) { return std::string(scene.param.scene); });

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
