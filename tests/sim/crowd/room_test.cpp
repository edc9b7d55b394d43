// SPDX-License-Identifier: MIT
#include "sim/crowd/room.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/sim/crowd/box.h"

namespace throng {
namespace {

/// In a hall of 100 m by 10 m.
bool has_room_for(double radius, const Region& area) {
  const Region hall = box(0, 0, 100, 10);
  const BarrierLine walls{hall.rings[0], true};
  return has_room(area, hall, Barriers({&walls, 1}, 1.0), radius);
}

TEST(Room, IsWhereAWholeAgentFits) {
  EXPECT_TRUE(has_room_for(0.2, box(99.58, 4, 100, 5)));
  EXPECT_FALSE(has_room_for(0.2, box(99.62, 4, 100, 5)));
  EXPECT_TRUE(has_room_for(0.2, box(99.58, 4, 300, 5)));
  EXPECT_FALSE(has_room_for(0.2, box(99.62, 4, 300, 5))) << "what is behind the wall is none";
}

TEST(Room, IsWhereItsMiddleHasARadiusToSpare) {
  EXPECT_TRUE(has_room_for(0.2, box(50, 5, 50.01, 5.01)));
  EXPECT_TRUE(has_room_for(0.2, box(0, 9.58, 100, 9.62)));
  EXPECT_FALSE(has_room_for(0.2, box(0, 9.62, 100, 9.66)));
  EXPECT_FALSE(has_room_for(0.2, box(0, 9.9, 100, 10))) << "a strip a thousand times as long as wide";
}

TEST(Room, IsNoneOutsideTheFloor) {
  EXPECT_FALSE(has_room_for(0.2, box(102, 2, 106, 6)));
  EXPECT_FALSE(has_room_for(0.2, box(20, 20, 30, 30)));
}

TEST(Span, IsHowFarApartTwoPointsAreAtMost) {
  EXPECT_NEAR(span(box(50, 5, 53, 9)), 5.0, 5e-3);
  EXPECT_LE(span(box(50, 5, 53, 9)), 5.0 * (1 + 1e-12));
  EXPECT_NEAR(span({{{{0, 0}, {0.3, 0.1}, {0, 0.2}}, {{-1, 7}, {-2, 7}, {-1, 8}}}}), std::hypot(1, 8), 8e-3);
  EXPECT_EQ(span({{{{3, 3}}}}), 0.0);
}

}  // namespace
}  // namespace throng
