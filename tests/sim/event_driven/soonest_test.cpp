// SPDX-License-Identifier: MIT
#include "sim/event_driven/soonest.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>

#include "tests/less_when_watched.h"

namespace throng {
namespace {

TEST(Soonest, OfEqualTimesTheLowestRow) {
  Soonest soonest(5);
  EXPECT_EQ(soonest.time(), Soonest::kNever);
  soonest.set(4, 2.0), soonest.set(3, 2.0), soonest.set(1, 3.0);
  EXPECT_EQ(soonest.time(), 2.0);
  EXPECT_EQ(soonest.row(), 3u);
  soonest.set(3, 5.0);
  EXPECT_EQ(soonest.time(), 2.0);
  EXPECT_EQ(soonest.row(), 4u);
}

TEST(Soonest, NobodyIsNeverDue) {
  EXPECT_EQ(Soonest(0).time(), Soonest::kNever);
}

/// A calendar beside a list of all times.
struct Both {
  explicit Both(std::size_t rows) : soonest(rows), times(rows, Soonest::kNever) {}

  void set(std::size_t row, double time) {
    times[row] = time;
    soonest.set(static_cast<std::uint32_t>(row), time);
  }
  /// The row that is due first.
  std::size_t check(int change) {
    const auto least = std::ranges::min_element(times);
    EXPECT_EQ(soonest.time(), *least) << times.size() << " rows, change " << change;
    if (*least < Soonest::kNever) {
      EXPECT_EQ(soonest.row(), least - times.begin()) << times.size() << " rows, change " << change;
    }
    return static_cast<std::size_t>(least - times.begin());
  }

  Soonest soonest;
  std::vector<double> times;
};

TEST(Soonest, AgreesWithLookingAtAllRowsWhateverTimesTheyGet) {
  std::mt19937 random(3);
  for (const std::size_t rows : {1, 2, 3, 64, 1000}) {
    Both both(rows);
    for (int i = 0; i < 3000 && !::testing::Test::HasFailure(); ++i) {
      both.set(random() % rows,
               random() % 7 == 0 ? Soonest::kNever : static_cast<double>(random() % 100) - 20.0);
      both.check(i);
    }
  }
}

/// Time goes on: whoever is due gets another time, and somebody else now and then, too.
void go_on(std::size_t rows, const std::function<double()>& wait) {
  constexpr int kChanges = static_cast<int>(less_when_watched(20000));
  std::mt19937 random(5);
  Both both(rows);
  for (std::size_t row = 0; row < rows; ++row) both.set(row, wait());
  for (int i = 0; i < kChanges && !::testing::Test::HasFailure(); ++i) {
    const std::size_t row = both.check(i);
    const double now = both.times[row];
    if (now == Soonest::kNever) return;
    both.set(row, now + wait());
    if (random() % 2 == 0) both.set(random() % rows, now + wait());
  }
}

TEST(Soonest, AgreesAsTimeGoesOn) {
  std::mt19937 random(7);
  const auto share = [&random] { return (random() + 0.5) / 4294967296.0; };
  for (const std::size_t rows : {1, 5, 11, 12, 13, 300, 3000}) {
    go_on(rows, [&] { return -std::log(share()); });                         // as in a gas
    go_on(rows, [&] { return std::floor(3.0 * share()); });                  // many at once, or at once again
    go_on(rows, [&] { return std::pow(10.0, 300.0 * share() - 200.0); });    // of all sizes
    go_on(rows, [&] { return share() < 0.9 ? 1e-9 * share() : 1e3; });       // some far more often
    go_on(rows, [&] { return share() < 0.5 ? Soonest::kNever : share(); });  // some never
    go_on(rows, [&] { return 1.0; });                                        // in turn
  }
}

TEST(Soonest, SeesWhoIsDueAfter) {
  std::mt19937 random(8);
  Both both(500);
  for (std::size_t row = 0; row < 500; ++row) both.set(row, random() % 100000);
  std::vector<std::size_t> order(500);
  for (std::size_t row = 0; row < 500; ++row) order[row] = row;
  std::ranges::stable_sort(order, {}, [&](std::size_t row) { return both.times[row]; });
  both.check(0);
  for (std::size_t later = 0; later < 10; ++later) EXPECT_EQ(both.soonest.row_after(later), order[later]);
}

TEST(Soonest, CountsTheEntriesThatItPasses) {
  Both both(40);
  for (std::size_t row = 0; row < 40; ++row) both.set(row, static_cast<double>(row));
  for (std::size_t row = 0; row < 20; ++row) {
    both.check(static_cast<int>(row));
    EXPECT_EQ(both.soonest.passed(), row);
    both.set(row, 100.0);
  }
  both.set(20, 100.0), both.set(21, 100.0);
  both.check(22);
  EXPECT_EQ(both.soonest.passed(), 22u) << "two at once";
}

}  // namespace
}  // namespace throng
