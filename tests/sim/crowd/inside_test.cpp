// SPDX-License-Identifier: MIT
#include "sim/crowd/inside.h"

#include <gtest/gtest.h>

#include <cmath>

#include "narrowphase/crossing.h"
#include "sim/random.h"

namespace throng {
namespace {

/// Says the same as the definition at random places and at the heights of all corners, where strips meet.
void expect_agreement(const Region& region, int points) {
  const Inside inside(region);
  const Eigen::AlignedBox2d box = bounds(region);
  Random random(3, 0, 1, Purpose::place);
  int in = 0;
  std::vector<Vec> asked;
  for (int i = 0; i < points; ++i) {
    const double x = random.uniform(box.min().x() - 1.0, box.max().x() + 1.0);
    asked.push_back({x, random.uniform(box.min().y() - 1.0, box.max().y() + 1.0)});
    const auto& ring = region.rings[static_cast<std::size_t>(i) % region.rings.size()];
    const Vec& corner = ring[static_cast<std::size_t>(i) % ring.size()];
    asked.push_back(corner);
    asked.push_back({x, corner.y()});
    asked.push_back({x, std::nextafter(corner.y(), 1e9)});
    asked.push_back({x, std::nextafter(corner.y(), -1e9)});
  }
  for (const Vec& p : asked) {
    ASSERT_EQ(inside(p), contains(region, p)) << p.transpose();
    in += inside(p);
  }
  EXPECT_GT(in, static_cast<int>(asked.size()) / 20);
  EXPECT_LT(in, static_cast<int>(asked.size()) * 19 / 20);
}

Region star(int corners, const Vec& centre) {
  Region region{{{}}};
  for (int i = 0; i < corners; ++i) {
    const double turn = 6.283185307179586 * i / corners, reach = i % 2 ? 3.0 : 5.0;
    region.rings[0].push_back(centre + reach * Vec(std::cos(turn), std::sin(turn)));
  }
  return region;
}

TEST(Inside, AgreesWithTheDefinition) {
  expect_agreement({{{{0, 0}, {4, 0}, {4, 3}, {0, 3}}, {{1, 1}, {2, 1}, {2, 2}, {1, 2}}}}, 500);
  expect_agreement(star(7, {-20, 3}), 500);
  expect_agreement(star(1000, {1e6, -1e6}), 300);
  Region many = star(50, {0, 0});
  for (int i = 0; i < 30; ++i) many.rings.push_back(star(9, {12.0 * i, 11.0 * (i % 5 + 1)}).rings[0]);
  expect_agreement(many, 500);
}

/// The definition: some edge meets the way.
bool meets_some_edge(const Region& region, const Vec& a, const Vec& b) {
  bool meets = false;
  for (const std::vector<Vec>& ring : region.rings)
    for (std::size_t i = 0; i < ring.size(); ++i)
      meets = meets || narrowphase::segments_meet(a, b, ring[i], ring[(i + 1) % ring.size()]);
  return meets;
}

TEST(Inside, FindsWaysThatMeetTheBorder) {
  const Inside strip(Region{{{{0, 0}, {4, 0}, {4, 0.01}, {0, 0.01}}}});
  EXPECT_TRUE(strip.meets_border({1, -1}, {1, 1})) << "over it, through its level edges alone";
  EXPECT_TRUE(strip.meets_border({-1, 0.005}, {5, 0.005})) << "along it";
  EXPECT_TRUE(strip.meets_border({1, 0.01}, {1, 1})) << "from it";
  EXPECT_TRUE(strip.meets_border({3, -1}, {5, 1})) << "its corner (4, 0)";
  EXPECT_FALSE(strip.meets_border({3, -1}, {std::nextafter(5.0, 9.0), 1})) << "past its corner";
  EXPECT_FALSE(strip.meets_border({1, 0.003}, {2, 0.007})) << "in it";
  EXPECT_FALSE(strip.meets_border({1, 0.02}, {1, 1}));
  EXPECT_FALSE(Inside(Region{}).meets_border({-1, -1}, {1, 1}));
  for (const Region& region : {star(7, {-20, 3}), star(1000, {1e6, -1e6})}) {
    const Inside inside(region);
    const Eigen::AlignedBox2d box = bounds(region);
    Random random(4, 0, 1, Purpose::place);
    const auto place = [&](const Vec& about, double reach) {
      const double x = random.uniform(-reach, reach);
      return Vec(about + Vec(x, random.uniform(-reach, reach)));
    };
    int met = 0;
    for (int i = 0; i < 2000; ++i) {
      const Vec a = place(box.center(), 5.5), b = place(a, i % 2 ? 0.5 : 6.0);
      ASSERT_EQ(inside.meets_border(a, b), meets_some_edge(region, a, b)) << a.transpose();
      met += inside.meets_border(a, b);
    }
    EXPECT_GT(met, 400);
    EXPECT_LT(met, 1600);
  }
}

TEST(Inside, HoldsNothingOfNothing) {
  EXPECT_FALSE(Inside(Region{})({0, 0}));
  EXPECT_FALSE(Inside(Region{{{{0, 0}, {1, 0}, {2, 0}}}})({1, 0})) << "flat";
}

TEST(Inside, ForgetsWhatItHeldBefore) {
  Inside inside(star(100, {0, 0}));
  inside.set({{{{10, 10}, {11, 10}, {11, 11}}}});
  EXPECT_FALSE(inside({0, 0}));
  EXPECT_TRUE(inside({10.9, 10.5}));
}

}  // namespace
}  // namespace throng
