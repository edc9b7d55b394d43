// SPDX-License-Identifier: MIT
#include "sim/contact/seat_book.h"

#include <gmock/gmock.h>

namespace throng {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

constexpr std::uint32_t kNew = kNoLane;

std::vector<std::uint32_t> lanes_of(SeatBook& book, std::initializer_list<std::uint64_t> keys) {
  std::vector<std::uint32_t> lanes;
  book.start();
  for (const std::uint64_t key : keys) lanes.push_back(book.lane_of(key));
  book.finish();
  return lanes;
}

SeatBook book_of_three() {
  SeatBook book;
  book.add(10, 0), book.add(30, 1), book.add(50, 2);
  return book;
}

TEST(SeatBook, KnowsTheLanesThatWereGiven) {
  SeatBook book = book_of_three();
  EXPECT_THAT(lanes_of(book, {10, 20, 30, 50, 60}), ElementsAre(0, kNew, 1, 2, kNew));
  EXPECT_THAT(book.unnamed(), IsEmpty());
}

TEST(SeatBook, KeepsTheLaneOfWhoIsAway) {
  SeatBook book = book_of_three();
  lanes_of(book, {30});
  EXPECT_THAT(book.unnamed(), ElementsAre(0, 2));
  lanes_of(book, {});
  EXPECT_THAT(book.unnamed(), ElementsAre(0, 1, 2));
  EXPECT_THAT(lanes_of(book, {10, 30, 50}), ElementsAre(0, 1, 2));
}

TEST(SeatBook, GivesLanesOnTheWay) {
  SeatBook book = book_of_three();
  book.start();
  EXPECT_EQ(book.lane_of(20), kNew);
  book.add(20, 7);
  EXPECT_EQ(book.lane_of(30), 1u);
  book.finish();
  EXPECT_THAT(lanes_of(book, {10, 20, 30, 50}), ElementsAre(0, 7, 1, 2));
}

TEST(SeatBook, ChangesALaneOrGivesOneLate) {
  SeatBook book = book_of_three();
  book.change(30, 8), book.change(40, 9), book.change(60, 10), book.change(5, 11);
  EXPECT_THAT(lanes_of(book, {5, 10, 30, 40, 50, 60}), ElementsAre(11, 0, 8, 9, 2, 10));
}

TEST(SeatBook, ForgetsAll) {
  SeatBook book = book_of_three();
  book.forget_all();
  EXPECT_THAT(lanes_of(book, {10, 30, 50}), ElementsAre(kNew, kNew, kNew));
  EXPECT_THAT(book.unnamed(), IsEmpty());
}

}  // namespace
}  // namespace throng
