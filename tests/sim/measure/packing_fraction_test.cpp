// SPDX-License-Identifier: MIT
#include "sim/measure/packing_fraction.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "tests/sim/scene_from.h"

namespace throng {
namespace {

using std::numbers::pi;
using Box = Eigen::AlignedBox2d;

TEST(PackingFraction, OfADiscCutByLines) {
  const Vec o(0, 0);
  EXPECT_NEAR(area_within(o, 2.0, Box(Vec(-3, -3), Vec(3, 3))), 4 * pi, 1e-14);
  EXPECT_NEAR(area_within(o, 2.0, Box(Vec(0, -3), Vec(3, 3))), 2 * pi, 1e-14);
  EXPECT_NEAR(area_within(o, 2.0, Box(Vec(0, 0), Vec(3, 3))), pi, 1e-14);
  EXPECT_NEAR(area_within(o, 2.0, Box(Vec(-0.1, -0.1), Vec(0.1, 0.1))), 0.04, 1e-14) << "all of the box";
  EXPECT_NEAR(area_within(o, 1.0, Box(Vec(0.5, -3), Vec(3, 3))), pi / 3 - std::sqrt(3.0) / 4, 1e-14);
  EXPECT_EQ(area_within(o, 1.0, Box(Vec(0.8, 0.8), Vec(3, 3))), 0.0) << "in the corner between";
  EXPECT_EQ(area_within(o, 1.0, Box(Vec(2, -1), Vec(3, 1))), 0.0);
}

/// The definition: strips, each as high as the disc and the box share there.
double by_strips(const Vec& centre, double radius, const Box& box) {
  constexpr int n = 200'000;
  double sum = 0.0;
  const double width = 2.0 * radius / n;
  for (int i = 0; i < n; ++i) {
    const double x = -radius + (i + 0.5) * width, half = std::sqrt(radius * radius - x * x);
    if (centre.x() + x < box.min().x() || centre.x() + x > box.max().x()) continue;
    sum += std::max(0.0,
                    std::min(centre.y() + half, box.max().y()) - std::max(centre.y() - half, box.min().y()));
  }
  return sum * width;
}

TEST(PackingFraction, OfADiscIsThatOfItsStrips) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> anywhere(-2.0, 2.0);
  int cut = 0;
  for (int i = 0; i < 60; ++i) {
    const Vec a(anywhere(random), anywhere(random)), b(anywhere(random), anywhere(random));
    const Box box(a.cwiseMin(b), a.cwiseMax(b));
    const Vec centre(0.3, -0.2);
    const double area = area_within(centre, 1.3, box);
    EXPECT_NEAR(area, by_strips(centre, 1.3, box), 2e-5) << i;
    cut += area > 0.0 && area < 0.99 * pi * 1.69;
  }
  EXPECT_GT(cut, 30);
}

TEST(PackingFraction, OfAPolygonCutByLines) {
  const std::vector<Vec> diamond{{1, 0}, {0, 1}, {-1, 0}, {0, -1}};
  EXPECT_NEAR(area_within(diamond, Box(Vec(-2, -2), Vec(2, 2))), 2.0, 1e-15);
  EXPECT_NEAR(area_within(diamond, Box(Vec(0, 0), Vec(2, 2))), 0.5, 1e-15);
  EXPECT_NEAR(area_within(diamond, Box(Vec(-0.5, -0.5), Vec(0.5, 0.5))), 1.0, 1e-15);
  EXPECT_EQ(area_within(diamond, Box(Vec(2, 2), Vec(3, 3))), 0.0);
}

TEST(PackingFraction, CountsDynamicBodiesAlone) {
  const Scene scene = scene_from(
      "domain = { box = [[0, 0], [10, 4]] }\n[shapes]\nball = { disc = { radius = 1 } }\n"
      "block = { polygon = [[0, 0], [2, 0], [2, 2], [0, 2]] }\ntwo = { discs = [[0, 0, 0.5], [1, 0, 0.5]] }\n"
      "[[bodies]]\nshape = \"ball\"\nat = [1, 1]\n[[bodies]]\nshape = \"block\"\nat = [4, 2]\nangle = 0.7\n"
      "[[bodies]]\nshape = \"two\"\nat = [7, 2]\n[[bodies]]\nshape = \"ball\"\nat = [9, 3]\nkind = "
      "\"static\"\n");
  const State state = initial_state(scene);
  EXPECT_NEAR(packing_fraction(scene, state, Box(Vec(0, 0), Vec(10, 4))), (pi + 4 + 0.5 * pi) / 40, 1e-14);
  EXPECT_NEAR(packing_fraction(scene, state, Box(Vec(4, 0), Vec(7, 4))), (2 + 0.25 * pi) / 12, 1e-14);
}

TEST(PackingFraction, SeesThroughTheBordersOfADomainThatRepeats) {
  const Scene scene = scene_from(
      "domain = { periodic = [[0, 0], [6, 6]] }\n[shapes]\nball = { disc = { radius = 1 } }\n"
      "[[bodies]]\nshape = \"ball\"\nat = [0, 0]\n");
  const State state = initial_state(scene);
  EXPECT_NEAR(packing_fraction(scene, state, Box(Vec(0, 0), Vec(6, 6))), pi / 36, 1e-15);
  EXPECT_NEAR(packing_fraction(scene, state, Box(Vec(5, 5), Vec(6, 6))), pi / 4, 1e-15);
}

}  // namespace
}  // namespace throng
