// SPDX-License-Identifier: MIT
// What the laboratory makes of its rows: observed orders, and what the same error costs.
#include <gtest/gtest.h>

#include <cmath>

#include "tools/bench/accuracy/convergence.h"
#include "tools/bench/accuracy/equal_error.h"

namespace throng::bench {
namespace {

Row row(const char* engine, double dt, double error, double ms, bool peer = false) {
  Row made{"accuracy", "case", engine, 1, {ms}, 1.0, "what"};
  made.error = {{"error", error}, {"dt", dt}, {"setting", ""}};
  if (peer) made.error["peer"] = true;
  return made;
}

TEST(ObservedOrder, IsTheExponentOfThePower) {
  for (const double order : {1.0, 2.0, 4.0}) {
    std::vector<std::pair<double, double>> points;
    for (double h = 0.5; h > 0.06; h *= 0.5) points.push_back({h, 1.5 * std::pow(h, order)});
    EXPECT_NEAR(observed_order(points).value(), order, 1e-12);
  }
}

TEST(ObservedOrder, LeavesOutRoundingAndErrorsAsLargeAsTheBody) {
  const std::pair<double, double> points[] = {
      {0.8, 50.0}, {0.4, 0.04}, {0.2, 0.01}, {0.1, 0.0025}, {0.05, 3e-6}};
  EXPECT_NEAR(observed_order(points).value(), 2.0, 1e-12);
  EXPECT_FALSE(observed_order(std::span(points).first(3)).has_value()) << "two points make no order";
}

TEST(ObservedOrder, IsExactWhereErrorsAreRounding) {
  std::vector<Row> rows{row("a", 0.1, 1e-14, 1.0), row("a", 0.05, 2e-14, 2.0), row("b", 0.1, 0.1, 1.0),
                        row("b", 0.05, 0.05, 2.0), row("b", 0.025, 0.025, 4.0)};
  add_orders(rows);
  EXPECT_TRUE(rows[0].error.contains("exact") && rows[0].error["order"].is_null());
  EXPECT_NEAR(rows[2].error["order"].get<double>(), 1.0, 1e-12);
  EXPECT_FALSE(rows[2].error.contains("exact"));
}

TEST(EqualError, ComparesWithTheFastestSettingThatIsGoodEnough) {
  std::vector<Row> rows{row("native", 0.1, 0.1, 1.0),          row("native", 0.05, 0.02, 2.0),
                        row("native", 0.01, 0.03, 1.5),        row("box2d", 0.1, 0.03, 6.0, true),
                        row("box2d", 0.05, 0.01, 9.0, true),   row("chipmunk", 0.1, 0.2, 3.0, true),
                        row("chipmunk", 0.05, 0.15, 7.0, true)};
  EXPECT_EQ(least_ms(rows, "native", 0.05), 1.5);
  EXPECT_EQ(least_ms(rows, "native", 0.01), std::nullopt);
  add_native_ms(rows);
  EXPECT_EQ(rows[3].error["native_ms"], 1.5);
  EXPECT_TRUE(rows[4].error["native_ms"].is_null());
  EXPECT_FALSE(rows[0].error.contains("native_ms"));
  const Advantage found = advantage(rows).value();
  EXPECT_DOUBLE_EQ(found.least, 3.0) << "Chipmunk at 0.2; at 0.15 Box2D is the better peer";
  EXPECT_DOUBLE_EQ(found.most, 4.0);
  EXPECT_EQ(found.beyond, std::vector<double>{0.01});
}

TEST(EqualError, DoesNotTellRoundingApart) {
  std::vector<Row> rows{row("native", 0.1, 1e-13, 1.0), row("box2d", 0.1, 1e-17, 3.0, true)};
  add_native_ms(rows);
  EXPECT_EQ(rows[1].error["native_ms"], 1.0);
  const Advantage found = advantage(rows).value();
  EXPECT_EQ(found.least, 3.0);
  EXPECT_TRUE(found.beyond.empty());
}

TEST(EqualError, IsNothingWherePeersDontPlay) {
  Row refused = row("box2d", 0.1, 0.0, 0.0, true);
  refused.error["error"] = nullptr;
  EXPECT_FALSE(advantage({row("native", 0.1, 0.1, 1.0), refused}).has_value());
}

}  // namespace
}  // namespace throng::bench
