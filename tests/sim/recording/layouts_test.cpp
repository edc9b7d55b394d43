// SPDX-License-Identifier: MIT
// Recordings that older versions wrote: tests/sim/recording/layouts holds one of each layout.
#include <gtest/gtest.h>

#include "sim/recording/recording.h"

namespace throng {
namespace {

class Layouts : public testing::TestWithParam<int> {
 protected:
  std::string file() const {
    return THRONG_SOURCE_DIR "/tests/sim/recording/layouts/1." + std::to_string(GetParam()) + ".h5";
  }
};

/// A static brick and two discs that begin at (0.7, 0.4) and (1.7, 0.4) with (1, 0.5) m/s and 2 rad/s, and
/// fall.
TEST_P(Layouts, OfOlderVersionsAreRead) {
  const Recording recording(file());
  EXPECT_EQ(recording.origin().minor, GetParam());
  EXPECT_TRUE(recording.complete());
  const Scene& scene = recording.geometry();
  EXPECT_EQ(scene.name, "three");
  EXPECT_EQ(scene.record.every, 4);
  EXPECT_EQ(every(scene.record, RecordField::spin), 4);
  EXPECT_EQ(every(scene.record, RecordField::contacts), 0);
  EXPECT_EQ(recording.bodies_of_run(), 3u);
  ASSERT_EQ(recording.frames(), 6u);
  for (std::size_t i = 0; i < 6; ++i) {
    const Frame frame = recording.frame(i);
    EXPECT_EQ(frame.step, 4 * static_cast<std::int64_t>(i));
    EXPECT_EQ(frame.time, static_cast<double>(frame.step) * 0.01);
    EXPECT_EQ(frame.id, (std::vector<std::uint32_t>{1, 2, 3}));
    EXPECT_EQ(frame.position[0], Vec(3.4, 0.25));
    EXPECT_FALSE(frame.contacts.has_value());
  }
  const Frame first = recording.frame(0), next = recording.frame(1);
  EXPECT_EQ(first.position[2], Vec(1.7, 0.4));
  EXPECT_EQ(first.velocity[1], Vec(1.0, 0.5));
  EXPECT_EQ(first.spin[2], 2.0);
  EXPECT_NEAR(next.position[1].x(), 0.74, 1e-12);
  EXPECT_NEAR(next.velocity[2].y(), 0.1, 1e-12) << "0.5 m/s less what 0.04 s of gravity take";
  EXPECT_NEAR(next.angle[1], 0.08, 1e-12);
}

INSTANTIATE_TEST_SUITE_P(Since1, Layouts, testing::Values(0, 1),
                         [](const auto& minor) { return "Of1_" + std::to_string(minor.param); });

/// Three discs among x = 0.75 m and 1.8 m. Frame 2, of step 6, has observables only, and yet a row of ids.
TEST(LayoutsOf1_2, MayHaveIdsInEveryFrame) {
  const Recording recording(THRONG_SOURCE_DIR "/tests/sim/recording/layouts/1.2.h5");
  EXPECT_EQ(recording.origin().minor, 2);
  std::vector<std::int64_t> steps;
  std::vector<std::vector<std::uint8_t>> present;
  for (std::size_t i = 0; i < recording.frames(); ++i) {
    const Frame frame = recording.frame(i);
    steps.push_back(frame.step);
    if (!frame.position.empty()) present.push_back(frame.is_present);
  }
  EXPECT_EQ(steps, (std::vector<std::int64_t>{0, 4, 6, 8, 12, 16, 18, 20}));
  const std::vector<std::uint8_t> third{0, 0, 1, 0}, both{0, 1, 1, 0}, second{0, 1, 0, 0};
  EXPECT_EQ(present, (std::vector{third, third, both, second, second, second}));
  EXPECT_EQ(recording.frame(0).position[2], Vec(1.7, 0.4));
  EXPECT_NEAR(recording.frame(3).position[1].x(), 0.78, 1e-12) << "0.08 s at 1 m/s from 0.7 m, in the air";
}

}  // namespace
}  // namespace throng
