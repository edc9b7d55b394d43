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

TEST(Shapes, MayHaveHoles) {
  const Loaded loaded = load_shape(
      "{ polygon = [[10, 20], [14, 20], [14, 24], [10, 24]], holes = [[[12, 21], [13, 21], [13, 23], [12, "
      "23]]] }");
  ASSERT_EQ(faults(loaded), "");
  const Shape& shape = loaded.scene.shapes.at(0);
  EXPECT_EQ(shape.kind, ShapeKind::polygon);
  EXPECT_DOUBLE_EQ(shape.area, 14.0);
  EXPECT_DOUBLE_EQ(shape.centre.x(), 10.0 + (16 * 2.0 - 2 * 2.5) / 14);
  EXPECT_DOUBLE_EQ(shape.centre.y(), 22.0);
  const double off = 12.0 - shape.centre.x(), hole_off = 12.5 - shape.centre.x();
  EXPECT_DOUBLE_EQ(shape.gyration2,
                   (16 * (32.0 / 12 + off * off) - 2 * (5.0 / 12 + hole_off * hole_off)) / 14);
  ASSERT_EQ(shape.holes.size(), 1u);
  const std::vector<Vec> clockwise{{12, 21}, {12, 23}, {13, 23}, {13, 21}};
  for (std::size_t i = 0; i < 4; ++i) EXPECT_EQ(shape.holes[0][i], clockwise[i] - shape.centre);
  double area = 0.0;
  for (const narrowphase::Convex& part : shape.parts)
    area += narrowphase::mass_properties(part.vertices).area;
  EXPECT_DOUBLE_EQ(area, 14.0);
  EXPECT_TRUE(
      load_shape("{ polygon = [[0, 0], [1, 0], [1, 1]], holes = [] }").scene.shapes.at(0).holes.empty());
}

TEST(Shapes, WhoseHolesCantBeHadSayWhichAndWhere) {
  const std::pair<std::string, std::string> cases[] = {
      {"[[[2, 2], [3, 2], [4, 2]]]", "s.toml:3:61: error: shapes.s.holes[0]: all vertices lie on a line"},
      {"[[[2, 2], [3, 2], [2, 3]], [[7, 6], [9, 6], [7, 7]]]",
       "s.toml:3:87: error: shapes.s.holes[1]: edge 0-1 meets edge 1-2 of the outline"},
      {"[[[2, 2], [3, 2], [2, 3]], [[1, 1], [6, 1], [1, 6]]]",
       "s.toml:3:61: error: shapes.s.holes[0]: lies in hole 1"},
      {"[[[9, 9], [10, 9], [9, 10]]]", "s.toml:3:61: error: shapes.s.holes[0]: lies outside the outline"},
      {"[[[2, 2], [2, 2], [3, 2], [2, 3]]]", "s.toml:3:61: warning: shapes.s.holes[0]: vertex 1 repeats"},
      {"[[[2, 2], [3, 2], [3, 2.0000000000001]]]", "s.toml:3:61: error: shapes.s.holes[0]: has points 9.99"},
  };
  for (const auto& [holes, fault] : cases)
    EXPECT_EQ(faults(load_shape("{ polygon = [[0, 0], [8, 0], [8, 8], [0, 8]],  holes = " + holes + " }"))
                  .rfind(fault, 0),
              0u)
        << faults(load_shape("{ polygon = [[0, 0], [8, 0], [8, 8], [0, 8]],  holes = " + holes + " }"));
}

// The centre of a rim 1e-11 m wide came out 0.03 mm off.
TEST(Shapes, MustBeLeftSomethingByTheirHoles) {
  const auto framed = [](const std::string& low, const std::string& high) {
    const std::string corners[] = {low + ", " + low, high + ", " + low, high + ", " + high,
                                   low + ", " + high};
    std::string hole;
    for (const std::string& corner : corners) hole += (hole.empty() ? "[" : ", [") + corner + "]";
    return faults(load_shape("{ polygon = [[0, 0], [8, 0], [8, 8], [0, 8]],  holes = [[" + hole + "]] }"));
  };
  const std::string fault = framed("1e-11", "7.99999999999");
  EXPECT_NE(fault.find("s.toml:3:60: error: shapes.s.holes: must leave at least 1e-10 of the polygon's area"),
            std::string::npos)
      << fault;
  EXPECT_EQ(framed("1e-9", "7.999999999"), "");
}

TEST(Shapes, CountTheVerticesOfTheirHoles) {
  std::string holes;
  for (int i = 0; i < 1000; ++i) {
    holes += i > 0 ? ", [" : "[";
    for (int k = 0; k < 10; ++k)
      holes += (k > 0 ? ", [" : "[") + std::to_string(2 * i + 1 + (k > 4)) + ", " +
               std::to_string(k > 4 ? 15 - k : k + 1) + "." + std::to_string(k * k % 5) + "]";
    holes += "]";
  }
  const std::string shape = "{ polygon = [[0, 0], [3000, 0], [3000, 99], [0, 99]], holes = [" + holes + "] }";
  EXPECT_NE(faults(load_shape(shape)).find("shapes.s.holes: makes more than 10000 vertices"),
            std::string::npos);
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

TEST(Shapes, LeaveRoomInTheirHoles) {
  const std::string frame =
      "throng = 1\n[shapes]\nframe = { polygon = [[-3, -3], [3, -3], [3, 3], [-3, 3]], holes = [[[-2, -2], "
      "[2, -2], "
      "[2, 2], [-2, 2]]] }\nball = { disc = { radius = 1.5 } }\n[[bodies]]\nshape = 'frame'\nat = [0, "
      "0]\n[[bodies]]\nshape = 'ball'\n";
  EXPECT_EQ(faults(load_text(frame + "at = [0.5, 0.5]\n")), "");
  EXPECT_NE(faults(load_text(frame + "at = [0.75, 0.5]\n")).find("overlap"), std::string::npos);
  const Loaded placed = load_text(frame + "place = { random = { within = [[-2, -2], [2, 2]] } }\n");
  EXPECT_EQ(faults(placed), "");
  EXPECT_LE(placed.scene.bodies.position.at(1).cwiseAbs().maxCoeff(), 0.5);
}

}  // namespace throng::scenarios
