// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "narrowphase/polygon.h"
#include "tests/scenarios/scenario_texts.h"

namespace throng::scenarios {

using throng::testing::faults;
using throng::testing::load_text;

namespace {

Loaded load_shape(const std::string& shape) {
  return load_text("throng = 1\n[shapes]\ns = " + shape + "\n");
}

}  // namespace

TEST(Shapes, ArePutOntoTheirCentreOfMass) {
  const Loaded loaded = load_shape("{ polygon = [[10, 20], [14, 20], [14, 22], [10, 22]] }");
  ASSERT_EQ(faults(loaded), "");
  const Shape& shape = loaded.scene.shapes.at(0);
  EXPECT_EQ(shape.kind, ShapeKind::polygon);
  EXPECT_EQ(shape.centre, Vec(12.0, 21.0));
  EXPECT_EQ(shape.outline, (std::vector<Vec>{{-2, -1}, {2, -1}, {2, 1}, {-2, 1}}));
  EXPECT_DOUBLE_EQ(shape.area, 8.0);
  EXPECT_DOUBLE_EQ(shape.gyration2, (16.0 + 4.0) / 12.0);
  EXPECT_DOUBLE_EQ(shape.radius, std::sqrt(5.0));
  ASSERT_EQ(shape.parts.size(), 1u);
  EXPECT_EQ(shape.parts[0].vertices.size(), 4u);
}

TEST(Shapes, OfACornerAreCutIntoConvexParts) {
  const Loaded loaded = load_shape("{ polygon = [[0, 0], [2, 0], [2, 1], [1, 1], [1, 2], [0, 2]] }");
  ASSERT_EQ(faults(loaded), "");
  const Shape& shape = loaded.scene.shapes.at(0);
  EXPECT_GE(shape.parts.size(), 2u);
  double area = 0.0;
  for (const narrowphase::Convex& part : shape.parts)
    area += narrowphase::mass_properties(part.vertices).area;
  EXPECT_DOUBLE_EQ(area, 3.0);
  EXPECT_EQ(shape.outline.size(), 6u);
  EXPECT_DOUBLE_EQ(shape.area, 3.0);
  EXPECT_DOUBLE_EQ(shape.centre.x(), 5.0 / 6.0);
}

TEST(Shapes, OfSeveralDiscsHaveTheMassOfTheirUnion) {
  const Loaded loaded = load_shape("{ discs = [[5, 0, 1], [9, 0, 1], [9, 0, 0.5]] }");
  ASSERT_EQ(faults(loaded), "");
  const Shape& shape = loaded.scene.shapes.at(0);
  EXPECT_EQ(shape.kind, ShapeKind::composite);
  EXPECT_NEAR(shape.area, 2.0 * std::numbers::pi, 1e-12);
  EXPECT_NEAR(shape.centre.x(), 7.0, 1e-12);
  EXPECT_NEAR(shape.gyration2, 0.5 + 4.0, 1e-12);
  EXPECT_NEAR(shape.radius, 3.0, 1e-12);
  ASSERT_EQ(shape.parts.size(), 3u);
  EXPECT_EQ(shape.parts[0].radius, 1.0);
  EXPECT_TRUE(shape.outline.empty());
}

TEST(Shapes, ThatAreClockwiseAreMendedWithAWarning) {
  const Loaded loaded = load_shape("{ polygon = [[0, 0], [0, 1], [1, 1], [1, 0]] }");
  EXPECT_EQ(loaded.errors(), 0);
  EXPECT_EQ(faults(loaded).rfind("s.toml:3:17: warning: shapes.s.polygon: ", 0), 0u) << faults(loaded);
  EXPECT_DOUBLE_EQ(loaded.scene.shapes.at(0).area, 1.0);
}

TEST(Shapes, ThatAreTooSmallAreToldByWhat) {
  EXPECT_NE(faults(load_shape("{ polygon = [[0, 0], [2e-10, 0], [2e-10, 2e-10], [0, 2e-10]] }"))
                .find("must have a squared radius of gyration of at least 1e-20 m^2, and has 6.66"),
            std::string::npos);
  EXPECT_NE(faults(load_shape("{ polygon = [[0, 0], [2e-11, 0], [2e-11, 2e-11], [0, 2e-11]] }"))
                .find("must have an area of at least 1e-20 m^2, and has "),
            std::string::npos);
}

TEST(Shapes, WithVerticesTooManyAreMendedWithAWarning) {
  for (const char* points :
       {"[[0, 0], [0, 0], [1, 0], [1, 1], [0, 1]]", "[[0, 0], [0.5, 0], [1, 0], [1, 1], [0, 1]]"}) {
    const Loaded loaded = load_shape(std::string("{ polygon = ") + points + " }");
    EXPECT_EQ(loaded.errors(), 0);
    EXPECT_NE(faults(loaded).find("warning: shapes.s.polygon: "), std::string::npos) << points;
    EXPECT_EQ(loaded.scene.shapes.at(0).outline.size(), 4u) << points;
  }
}

TEST(Shapes, ThatCrossThemselvesOrHaveNoAreaAreRefused) {
  for (const char* points :
       {"[[0, 0], [1, 1], [1, 0], [0, 1]]", "[[0, 0], [1, 0], [2, 0]]", "[[1, 1], [1, 1], [1, 1]]",
        "[[0, 0], [2, 0], [1, 0], [1, 1]]", "[[0, 0], [1e-12, 0], [0, 1e-12]]"}) {
    const Loaded loaded = load_shape(std::string("{ polygon = ") + points + " }");
    EXPECT_EQ(loaded.errors(), 1) << points;
    EXPECT_EQ(faults(loaded).rfind("s.toml:3:17: error: shapes.s.polygon: ", 0), 0u) << faults(loaded);
  }
}

TEST(Shapes, PlaceTheirCentreOfMassWhereTheBodyStands) {
  const Loaded loaded = load_text(
      "throng = 1\n[shapes]\ns = { polygon = [[10, 20], [14, 20], [14, 22]] }\n[[bodies]]\nshape = 's'\nat = "
      "[1, 2]\n");
  ASSERT_EQ(faults(loaded), "");
  EXPECT_EQ(loaded.scene.bodies.position.at(0), Vec(1.0, 2.0));
  EXPECT_EQ(loaded.scene.bodies.radius.at(0), loaded.scene.shapes.at(0).radius);
}

}  // namespace throng::scenarios
