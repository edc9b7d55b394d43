// SPDX-License-Identifier: MIT
// The widest face, whatever the machine's vectors, against its definition.
#include "narrowphase/face.h"

#include <gtest/gtest.h>
#include <hwy/targets.h>

#include <limits>
#include <numbers>

#include "narrowphase/relative.h"
#include "random_shapes.h"

namespace throng::narrowphase {
namespace {

/// For each edge the vertex that lies deepest behind it; of those the one that lies least deep. The first of
/// what is equal.
Face definition(const Convex& a, const Convex& b, const Pose& b_in_a) {
  Face widest{-std::numeric_limits<double>::infinity(), 0, 0};
  for (std::size_t i = 0; i < a.normals.size(); ++i) {
    const Vec normal = b_in_a.unrotate(a.normals[i]);
    Face face{std::numeric_limits<double>::infinity(), i, 0};
    for (std::size_t j = 0; j < b.vertices.size(); ++j)
      if (const double height = dot(normal, b.vertices[j]); height < face.separation)
        face.separation = height, face.vertex = j;
    face.separation += dot(a.normals[i], b_in_a.position - a.vertices[i]);
    if (face.separation > widest.separation) widest = face;
  }
  return widest;
}

class WidestFaceOnEachTarget : public ::testing::TestWithParam<std::int64_t> {
 protected:
  WidestFaceOnEachTarget() { choose(GetParam()); }
  ~WidestFaceOnEachTarget() override { choose(0); }

  static void choose(std::int64_t targets) {
    hwy::SetSupportedTargetsForTest(targets);
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
  }

  static void expect_same(const Convex& a, const Convex& b, const Pose& b_in_a) {
    const Face found = widest_face(a, b, b_in_a), expected = definition(a, b, b_in_a);
    EXPECT_EQ(found.separation, expected.separation);
    EXPECT_EQ(found.edge, expected.edge);
    EXPECT_EQ(found.vertex, expected.vertex);
  }
};

TEST_P(WidestFaceOnEachTarget, HasTheBitsOfTheDefinition) {
  Random random(1643);
  for (int i = 0; i < 2000; ++i) {
    SCOPED_TRACE(i);
    std::vector<Vec> points_a, points_b;
    for (std::uint64_t n = 3 + random() % 20; n > 0; --n) points_a.push_back(random_vec(random, 1.0, 1.0));
    for (std::uint64_t n = 3 + random() % 20; n > 0; --n) points_b.push_back(random_vec(random, 1.0, 1.0));
    const Convex a = convex(hull(points_a)), b = convex(hull(points_b));
    const Pose b_in_a = pose(random_vec(random, 2.0, 2.0), uniform(random, -3.0, 3.0));
    expect_same(a, b, b_in_a), expect_same(b, a, b_in_a);
    expect_same(segment(points_a[0], points_a[1]), b, b_in_a);
    expect_same(a, segment(points_b[0], points_b[1]), b_in_a);
    expect_same(a, disc(1.0), b_in_a);
  }
}

/// Of so many corners the answer comes from a walk round both.
TEST_P(WidestFaceOnEachTarget, HasTheBitsOfTheDefinitionForManyCorners) {
  Random random(1644);
  for (int i = 0; i < 300; ++i) {
    SCOPED_TRACE(i);
    std::vector<Vec> corners;
    for (std::uint64_t n = 40 + random() % 80; n > 0; --n)
      corners.push_back(pose({0.0, 0.0}, uniform(random, -3.1, 3.1)).rotate({1.0, 0.0}));
    const Convex many = convex(hull(corners)), few = convex(hull({corners.begin(), corners.begin() + 5}));
    ASSERT_GT(many.vertices.size(), 32u);
    const Pose b_in_a = pose(random_vec(random, 2.0, 2.0), uniform(random, -3.0, 3.0));
    expect_same(many, many, b_in_a), expect_same(many, few, b_in_a), expect_same(few, many, b_in_a);
  }
}

/// Opposite edges of one square in another are equally wide, as are the corners behind each.
TEST_P(WidestFaceOnEachTarget, IsTheFirstOfThoseEquallyWide) {
  for (const int n : {4, 6, 8, 12}) {
    std::vector<Vec> corners;
    for (int i = 0; i < n; ++i)
      corners.push_back(pose({0.0, 0.0}, i * 2.0 * std::numbers::pi / n).rotate({1.0, 0.0}));
    const Convex a = convex(corners);
    expect_same(a, a, {});
    const std::vector<Vec> square{{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
    expect_same(a, convex(square), {}), expect_same(convex(square), a, {});
    expect_same(convex(square), convex(square), {});
    EXPECT_EQ(widest_face(convex(square), convex(square), {}).edge, 0u);
  }
}

const auto name_of = [](const auto& target) { return std::string(hwy::TargetName(target.param)); };
INSTANTIATE_TEST_SUITE_P(, WidestFaceOnEachTarget, ::testing::ValuesIn(hwy::SupportedAndGeneratedTargets()),
                         name_of);

}  // namespace
}  // namespace throng::narrowphase
