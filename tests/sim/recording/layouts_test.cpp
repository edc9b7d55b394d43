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

}  // namespace
}  // namespace throng
