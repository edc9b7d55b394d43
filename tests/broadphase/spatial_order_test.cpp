// SPDX-License-Identifier: MIT
#include "broadphase/spatial_order.h"

#include <gmock/gmock.h>

#include <numeric>

#include "tests/broadphase/clouds.h"

namespace throng::broadphase {
namespace {

using Order = std::vector<std::uint32_t>;

Order order_of(const Points& points) {
  SpatialOrder spatial;
  Order order{9, 9, 9};
  spatial.sort(points, order);
  return order;
}

double length(const Points& points, const Order& order) {
  double sum = 0.0;
  for (std::size_t i = 1; i < order.size(); ++i) sum += (points[order[i]] - points[order[i - 1]]).norm();
  return sum;
}

TEST(SpatialOrder, WalksTheCurveThatHilbertDrew) {
  // The sixteen cells of its second step, drawn from left to right, bottom to top.
  Points points;
  for (int y = 0; y < 4; ++y)
    for (int x = 0; x < 4; ++x) points.push_back({x, y});
  const Order order = order_of(points);
  EXPECT_DOUBLE_EQ(length(points, order), 15.0);  // from cell to cell beside it, always
  EXPECT_THAT(Order(order.begin(), order.begin() + 4), testing::UnorderedElementsAre(0, 1, 4, 5));
}

TEST(SpatialOrder, HoldsEveryRowOnceAndCoincidentOnesAscending) {
  EXPECT_EQ(order_of({}), Order{});
  EXPECT_EQ(order_of({{1, 2}}), Order{0});
  Order rows(3000);
  std::iota(rows.begin(), rows.end(), 0);
  EXPECT_EQ(order_of(Points(3000, Point(1e9, -7.0))), rows);
  Random random(1);
  for (const Spread how : kSpreads) {
    Order order = order_of(spread(random, how, 3000, 5.0));
    std::sort(order.begin(), order.end());
    EXPECT_EQ(order, rows);
  }
}

// A walk through n even points is about sqrt(n) sides long; one in random order n / 2.
TEST(SpatialOrder, IsShortWhateverTheScales) {
  Random random(2);
  for (const double blob : {1.0, 1e-6, 1e-12}) {
    Points points;
    for (int i = 0; i < 4000; ++i) points.push_back(blob * random.in_square(1.0));
    points.push_back({1.0, 1.0});
    EXPECT_LT(length(points, order_of(points)), 100.0 * blob + 3.0) << blob;
    points.pop_back();
    EXPECT_LT(length(points, order_of(moved(points, {blob, blob}))), 100.0 * blob) << blob;
    points.push_back({1.0, 1.0});
    const Order order = order_of(points);
    double inside = 0.0;
    for (std::size_t i = 1; i < order.size(); ++i)
      if (order[i] < 4000 && order[i - 1] < 4000) inside += (points[order[i]] - points[order[i - 1]]).norm();
    EXPECT_LT(inside, 100.0 * blob) << blob;
  }
}

TEST(SpatialOrder, EndsForNumbersAtTheEndsOfTheirRange) {
  EXPECT_EQ(order_of(Points{{1e150, 1e150}, {-1e150, -1e150}, {5e-324, 0}, {0, 0}}).size(), 4u);
  Points tiny;
  for (int i = 0; i < 100; ++i) tiny.push_back({5e-324 * i, 0.0});
  EXPECT_EQ(order_of(tiny).size(), 100u);
}

}  // namespace
}  // namespace throng::broadphase
