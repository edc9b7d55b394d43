// SPDX-License-Identifier: MIT
#include "sim/record.h"

#include <gtest/gtest.h>

namespace throng {
namespace {

TEST(Record, MakesAFrameWhereAnythingIsDue) {
  Record record;
  record.every = 4;
  record.own_every[static_cast<int>(RecordField::velocity)] = 6;
  record.observables = 10;
  std::vector<int> frames;
  for (int step = 0; step <= 24; ++step)
    if (is_frame(record, step)) frames.push_back(step);
  EXPECT_EQ(frames, (std::vector<int>{0, 4, 6, 8, 10, 12, 16, 18, 20, 24}));
}

/// It happened: observables alone, each hundred steps, made a frame of each step.
TEST(Record, MakesNoFrameThatHoldsNothing) {
  Record record;
  record.position = record.angle = record.velocity = false;
  record.observables = 10;
  EXPECT_EQ(rates(record), std::vector<int>{10});
  EXPECT_EQ(count_frames(record, 25), 3);
  record.spin = true;
  record.own_every[index(RecordField::spin)] = 4;
  std::vector<int> frames, of_bodies;
  for (int step = 0; step <= 12; ++step) {
    if (is_frame(record, step)) frames.push_back(step);
    if (has_bodies(record, step)) of_bodies.push_back(step);
  }
  EXPECT_EQ(frames, (std::vector<int>{0, 4, 8, 10, 12}));
  EXPECT_EQ(of_bodies, (std::vector<int>{0, 4, 8, 12}));
}

/// Their hashes still tell one run from another.
TEST(Record, MakesFramesOfNothingWhereNothingIsRecorded) {
  Record record;
  record.position = record.angle = record.velocity = false;
  record.every = 3;
  EXPECT_EQ(rates(record), std::vector<int>{3});
  EXPECT_EQ(count_frames(record, 7), 3);
  for (int step = 0; step < 7; ++step) EXPECT_EQ(is_frame(record, step), step % 3 == 0);
}

TEST(Record, GivesARateOfItsOwnOnlyToWhatIsRecorded) {
  Record record;
  record.every = 3;
  record.own_every[static_cast<int>(RecordField::spin)] = 7;
  EXPECT_EQ(every(record, RecordField::position), 3);
  EXPECT_EQ(every(record, RecordField::spin), 0);
  record.spin = true;
  EXPECT_EQ(every(record, RecordField::spin), 7);
  EXPECT_EQ(rates(record), (std::vector<int>{3, 7}));
}

TEST(Record, CountsTheFramesThatItMakes) {
  Record record;
  record.every = 4;
  record.spin = record.contacts = true;
  record.own_every = {0, 6, 9, 10, 15};
  record.observables = 7;
  for (std::int64_t steps : {0, 1, 59, 60, 1259, 1260, 1261}) {
    std::int64_t count = 0;
    for (std::int64_t step = 0; step <= steps; ++step) count += is_frame(record, step);
    EXPECT_EQ(count_frames(record, steps), count) << steps;
  }
  EXPECT_EQ(count_frames(record, 1'000'000'000'000), 523'809'523'809) << "by the rates' common period";
}

/// Multiplied, these rates are beyond 64 bits.
TEST(Record, CountsFramesOfRatesWithoutACommonPeriod) {
  Record record;
  record.every = 99'991;
  record.own_every = {0, 1'000'003, 922'417'455, 0, 0};
  EXPECT_EQ(count_frames(record, 1'000'000'000'000), 11'001'972);
}

}  // namespace
}  // namespace throng
