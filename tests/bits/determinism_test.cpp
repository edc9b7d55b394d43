// SPDX-License-Identifier: MIT
// Same again: equal input gives equal bits, for any number of threads, compiler and build.
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <ostream>

#include "sim/simulation.h"
#include "tests/sim/scene_from.h"

namespace throng {
namespace {

/// Where a scene has got to, and how many contacts it had on the way.
struct End {
  State state;
  std::size_t contacts = 0;
};

End after(const Scene& scene, int steps, int threads) {
  const auto run = simulation(scene, threads);
  std::size_t contacts = 0;
  for (int i = 0; i < steps; ++i) {
    run->step();
    contacts += run->contacts();
  }
  return {run->state(), contacts};
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
    {"gas", 400, 0xb7deb10a72f11b9f},          {"pile", 60, 0x2dbbd5773aa6bf2},
    {"polygons", 40, 0x594fc994ce14686c},      {"pyramid", 10, 0xd65fe5b094eb29fb},
    {"hopper", 100, 0x7534e50fbee17659},       {"gears", 100, 0x89e6a5f5bed797b2},
    {"billiard", 1500, 0x75bdef655f57d91b},    {"cradle", 2000, 0x7db3d1ee537b00be},
    {"mixed", 200, 0x5732d6d678e20e94},        {"corridor", 1200, 0xdd6a7b723dc082a9},
    {"bottleneck", 1200, 0xe17793fdbf77bb3f},  {"circle_swap", 300, 0x3098722b25df02fc},
    {"counterflow", 1200, 0xabe4155417f61517}, {"evacuation", 1500, 0x2cc71b77847dc07f},
    {"station", 200, 0xa9dbe0a7c3cb9d2a},      {"stadium", 6, 0xd8122e71098e5668},
    {"crossing", 500, 0xc71a083234d00b8c},     {"drum", 100, 0x8eb7324841b1bc4e},
};

class EveryScene : public ::testing::TestWithParam<Golden> {};

TEST_P(EveryScene, ReachesTheSameBitsInEveryBuildAndOnTwoThreads) {
  const auto [name, steps, golden] = GetParam();
  const Scene scene = gallery_scene(name);
  const End once = after(scene, steps, 1);
  EXPECT_EQ(hash(once.state), golden) << "reached 0x" << std::hex << hash(once.state);
  // A bounce leaves no contact behind: in scenes that nothing else accelerates, velocities tell.
  const bool weightless = scene.gravity == Vec(0.0, 0.0);
  EXPECT_TRUE(once.contacts > 0 || (weightless && once.state.velocity != scene.bodies.velocity))
      << "there were no contacts to test";
  EXPECT_EQ(hash(after(scene, steps, 2).state), golden);
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

/// Two bodies of different motion.
State two_bodies() {
  State state;
  state.id = {1, 2};
  state.position = {{1, 2.5}, {3, 4}};  // no bit of it makes a zero, of which there are two
  state.angle = {0.1, 0.2};
  state.velocity = {{5, 6}, {7, 8}};
  state.spin = {0.3, 0.4};
  return state;
}

TEST(Hash, DoesNotDependOnTheRowInWhichABodyStands) {
  const State state = two_bodies();
  State moved = state;
  std::swap(moved.id[0], moved.id[1]);
  EXPECT_NE(hash(moved), hash(state)) << "the bodies have changed places";
  std::swap(moved.position[0], moved.position[1]);
  EXPECT_NE(hash(moved), hash(state)) << "the bodies have changed velocities";
  std::swap(moved.angle[0], moved.angle[1]);
  std::swap(moved.velocity[0], moved.velocity[1]);
  std::swap(moved.spin[0], moved.spin[1]);
  EXPECT_EQ(hash(moved), hash(state));
}

TEST(Hash, TellsApartWhatOnlyStandsElsewhere) {
  const State state = two_bodies();
  State other = state;
  std::swap(other.position[0].x(), other.position[0].y());
  EXPECT_NE(hash(other), hash(state));
  other = state;
  std::swap(other.angle[0], other.spin[0]);
  EXPECT_NE(hash(other), hash(state));
  other = state;
  std::swap(other.position[0], other.velocity[0]);
  EXPECT_NE(hash(other), hash(state));
  other = state;
  other.id.pop_back(), other.position.pop_back(), other.angle.pop_back(), other.velocity.pop_back();
  other.spin.pop_back();
  EXPECT_NE(hash(other), hash(state));
}

/// The bits of one body's six numbers, flipped one and two at a time: what mirrors, doubles and halves does
/// so.
TEST(Hash, TellsStatesApartByAnyTwoBits) {
  const State state = two_bodies();
  const auto flip = [](State& s, int bit) {
    double* const numbers[] = {&s.position[0].x(), &s.position[0].y(), &s.angle[0],
                               &s.velocity[0].x(), &s.velocity[0].y(), &s.spin[0]};
    double& x = *numbers[bit / 64];
    x = std::bit_cast<double>(std::bit_cast<std::uint64_t>(x) ^ (std::uint64_t{1} << (bit % 64)));
  };
  std::vector<std::uint64_t> all;
  for (int a = 0; a < 6 * 64; ++a)
    for (int b = 0; b <= a; ++b) {
      State other = state;
      flip(other, a);
      if (b != a) flip(other, b);
      all.push_back(hash(other));
    }
  std::sort(all.begin(), all.end());
  EXPECT_EQ(std::adjacent_find(all.begin(), all.end()), all.end());
  EXPECT_GT(all.size(), 70000u);
}

}  // namespace
}  // namespace throng
