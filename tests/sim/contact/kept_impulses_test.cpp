// SPDX-License-Identifier: MIT
#include "sim/contact/kept_impulses.h"

#include <gtest/gtest.h>

#include <array>
#include <vector>

#include "narrowphase/convex.h"
#include "narrowphase/manifold.h"

namespace throng {
namespace {

using Features = std::array<std::uint32_t, 2>;

/// Two squares, the upper one a little aside and turned by so much.
Features features(double aside, double angle, const narrowphase::Reference& kept = {}) {
  const narrowphase::Convex square =
      narrowphase::convex({Vec(-0.5, -0.5), Vec(0.5, -0.5), Vec(0.5, 0.5), Vec(-0.5, 0.5)});
  const auto m = narrowphase::manifold(square, narrowphase::pose(Vec(0, 0), 0.0), square,
                                       narrowphase::pose(Vec(aside, 1.0), angle), 0.1, kept);
  EXPECT_EQ(m.count, 2);
  return {m.points[0].feature, m.points[1].feature};
}

std::vector<ContactImpulse> kept(const Features& names) {
  return {{3, names[0], 1.0, 0.0}, {3, names[1], 2.0, 0.0}};
}

/// The impulses of both points.
std::array<double, 2> found(const std::vector<ContactImpulse>& contacts, const Features& names) {
  KeptImpulses memory(contacts);
  const ContactImpulse *first = memory.find(3, names, 0), *second = memory.find(3, names, 1);
  return {first ? first->normal : 0.0, second ? second->normal : 0.0};
}

using Both = std::array<double, 2>;

TEST(KeptImpulses, AreThoseOfTheSameFeatures) {
  const Features names = features(0.25, 0.0);
  EXPECT_EQ(found(kept(names), names), (Both{1.0, 2.0}));
  EXPECT_EQ(found(kept(names), Features{names[1], names[0]}), (Both{2.0, 1.0}));  // as walls list them
  EXPECT_EQ(found({}, names), (Both{0.0, 0.0}));
  const std::vector<ContactImpulse> all = kept(names);
  KeptImpulses memory(all);
  EXPECT_NE(memory.find(3, names, 0), nullptr);
  EXPECT_EQ(memory.find(4, names, 0), nullptr);
}

/// Of corners that meet, now one is within the other's face and now the other within the one's.
TEST(KeptImpulses, OutliveNewNamesOfCornersThatMeet) {
  const Features left = features(-1e-9, 0.0), right = features(1e-9, 0.0);
  const auto differ = [](std::uint32_t a, std::uint32_t b) {
    return narrowphase::without_reference(a) != narrowphase::without_reference(b);
  };
  ASSERT_TRUE(differ(left[0], right[0]) && differ(left[1], right[1])) << "nothing to outlive";
  EXPECT_EQ(found(kept(left), right), (Both{1.0, 2.0}));
}

/// On the other's face the points run the other way.
TEST(KeptImpulses, OutliveANewReferenceAndNewNames) {
  const Features one = features(-1e-9, 0.0, {2, false, true}), other = features(1e-9, 0.0, {0, true, true});
  ASSERT_NE(narrowphase::reference_is_b(one[0]), narrowphase::reference_is_b(other[0]));
  EXPECT_EQ(found(kept(one), other), (Both{2.0, 1.0}));
}

TEST(KeptImpulses, AreForgottenWhereOnePointIsLeftOfAnotherName) {
  const Features left = features(-1e-9, 0.0), right = features(1e-9, 0.0);
  const std::vector<ContactImpulse> one{{3, left[0], 1.0, 0.0}};
  EXPECT_EQ(found(one, right), (Both{0.0, 0.0}));
  EXPECT_EQ(found(one, left), (Both{1.0, 0.0}));
}

}  // namespace
}  // namespace throng
