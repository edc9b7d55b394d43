// SPDX-License-Identifier: MIT
// What is known of contacts without a search has the bits of a search, whatever the machine's vectors.
#include "sim/contact/held_faces.h"

#include <gtest/gtest.h>
#include <hwy/targets.h>

#include "tests/sim/trial.h"

namespace throng {
namespace {

const char* const kPolygons =
    "sleep = false\ngravity = [0, -9.81]\ntime = { dt = 0.016, until = 60, substeps = 3 }\n"
    "[materials.default]\nfriction = 0.5\n"
    "[shapes]\n"
    "box = { polygon = [[-0.4, -0.4], [0.4, -0.4], [0.4, 0.4], [-0.4, 0.4]] }\n"
    "three = { polygon = [[0.45, -0.21], [-0.2, 0.44], [-0.05, -0.47]] }\n"
    "seven = { polygon = [[0.5, 0], [0.34, 0.31], [-0.21, 0.38], [-0.41, 0.24], [-0.46, -0.17], "
    "[-0.17, -0.4], [0.33, -0.32]] }\n";

std::string placed(const char* shape, const char* within) {
  return std::string("[[bodies]]\nshape = \"") + shape +
         "\"\ncount = 12\nplace = { random = { within = " + within + ", gap = 0.01 } }\n";
}

std::string all_placed(const char* within) {
  return placed("box", within) + placed("three", within) + placed("seven", within);
}

class HeldFacesOnEachTarget : public ::testing::TestWithParam<std::int64_t> {
 protected:
  HeldFacesOnEachTarget() { choose(GetParam()); }
  ~HeldFacesOnEachTarget() override { choose(0); }

  static void choose(std::int64_t targets) {
    hwy::SetSupportedTargetsForTest(targets);
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
  }

  /// Goes on beside a run that knows nothing in any step.
  static void expect_bits_of_a_search(const Scene& scene, int steps) {
    Trial holds(scene, 2), searches(scene);
    std::size_t known = 0, named = 0, known_afresh = 0;
    for (int i = 0; i < steps; ++i) {
      holds.steps(1);
      Trial afresh(scene);
      afresh.state = searches.state;
      afresh.steps(1);
      searches.state = afresh.state;
      ASSERT_EQ(hash(holds.state), hash(searches.state)) << "step " << i;
      if (i < steps - 100) continue;
      known_afresh += afresh.work.finder.held().known();  // where the step was taken again
      known += holds.work.finder.held().known(), named += holds.work.finder.held().named();
    }
    EXPECT_GT(named, 2'000u);
    EXPECT_GT(4 * known, 3 * named);
    EXPECT_LT(10 * known_afresh, named);
  }
};

TEST_P(HeldFacesOnEachTarget, HaveTheBitsOfASearchInAPile) {
  expect_bits_of_a_search(
      scene_from(kPolygons + all_placed("[[0, 0], [6, 12]]") + "[domain]\nbox = [[0, 0], [6, 12]]\n"), 500);
}

TEST_P(HeldFacesOnEachTarget, HaveTheBitsOfASearchAcrossASeam) {
  expect_bits_of_a_search(
      scene_from(kPolygons + all_placed("[[0, 1], [6, 11]]") +
                 "[[walls]]\nsegment = [[-3, 0.5], [9, 0.5]]\n[domain]\nperiodic = [[0, 0], [6, 24]]\n"),
      500);
}

TEST_P(HeldFacesOnEachTarget, HaveTheBitsOfASearchOnWhatTurns) {
  expect_bits_of_a_search(
      scene_from(kPolygons + all_placed("[[0, 2], [6, 12]]") + "[domain]\nbox = [[0, 0], [6, 12]]\n" +
                 "[[bodies]]\nshape = \"seven\"\nat = [3, 1]\nkind = \"kinematic\"\nspin = 0.02\n"),
      500);
}

const auto name_of = [](const auto& target) { return std::string(hwy::TargetName(target.param)); };
INSTANTIATE_TEST_SUITE_P(, HeldFacesOnEachTarget, ::testing::ValuesIn(hwy::SupportedAndGeneratedTargets()),
                         name_of);

// Boxes in a row that are named, left out for a while, and named again.
TEST(HeldFaces, KeepsTheLaneOfWhoComesBackSoon) {
  HeldFaces held;
  const auto name = [&](std::initializer_list<std::uint64_t> keys) {
    held.start();
    std::vector<std::uint32_t> lanes;
    for (const std::uint64_t key : keys)
      lanes.push_back(held.lane_of(key, {0, static_cast<std::uint32_t>(key)}));
    held.finish();
    return lanes;
  };
  using Lanes = std::vector<std::uint32_t>;
  EXPECT_EQ(name({1, 3, 5}), (Lanes{0, 1, 2}));
  EXPECT_EQ(name({1, 5}), (Lanes{0, 2}));
  EXPECT_EQ(name({1, 2, 3, 5}), (Lanes{0, 3, 1, 2}));
  for (int i = 0; i < 20; ++i) name({1, 2, 5});
  EXPECT_EQ(name({1, 2, 5, 7}), (Lanes{0, 3, 2, 1})) << "who is away for long gives up the lane";
  EXPECT_EQ(held.named(), 4u);
  EXPECT_EQ(held.known(), 0u);
}

}  // namespace
}  // namespace throng
