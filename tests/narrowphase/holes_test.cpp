// SPDX-License-Identifier: MIT
#include "narrowphase/holes.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "narrowphase/crossing.h"
#include "narrowphase/polygon.h"
#include "polygons.h"

namespace throng::narrowphase {
namespace {

using testing::HasSubstr;
using testing::StartsWith;
using Ring = std::vector<Vec>;

const Ring kOutline = {{0, 0}, {9, 0}, {9, 9}, {0, 9}};

Ring square_at(double x, double y, double side) {
  return {{x, y}, {x + side, y}, {x + side, y + side}, {x, y + side}};
}

CleanedRings cleaned(const Ring& outline, const std::vector<Ring>& holes) {
  std::vector<Ring> rings{outline};
  rings.insert(rings.end(), holes.begin(), holes.end());
  return clean(rings);
}

RingNote refusal(const std::vector<Ring>& holes) {
  const CleanedRings c = cleaned(kOutline, holes);
  EXPECT_EQ(c.rings.empty(), !c.refusal.text.empty());
  return c.refusal;
}

TEST(CleanRings, LeavesGoodRingsAloneAndHolesClockwise) {
  const CleanedRings c = cleaned(kOutline, {square_at(1, 1, 2)});
  EXPECT_EQ(c.refusal.text, "");
  EXPECT_EQ(c.rings, (std::vector<Ring>{kOutline, {{1, 1}, {1, 3}, {3, 3}, {3, 1}}}));
  EXPECT_TRUE(c.repairs.empty());
}

TEST(CleanRings, SaysWhichRingWasMended) {
  const CleanedRings c = cleaned(square_at(0, 0, 9), {square_at(1, 1, 2), {{5, 5}, {6, 5}, {7, 5}, {7, 7}}});
  EXPECT_EQ(c.rings.at(2).size(), 3u);
  ASSERT_EQ(c.repairs.size(), 1u);
  EXPECT_EQ(c.repairs[0].ring, 2u);
  EXPECT_EQ(c.repairs[0].text, "vertex 1 lies on a straight edge: dropped");
}

TEST(CleanRings, RefusesARingThatIsNoPolygon) {
  const RingNote bowtie = refusal({square_at(1, 1, 2), {{4, 4}, {6, 6}, {6, 4}, {4, 6}}});
  EXPECT_EQ(bowtie.ring, 2u);
  EXPECT_THAT(bowtie.text, StartsWith("edge 0-1 meets edge 2-3 "));
  EXPECT_EQ(refusal({{}}).ring, 1u);
  EXPECT_EQ(clean(std::vector<Ring>{{{0, 0}, {1, 1}}}).refusal.ring, 0u);
}

TEST(CleanRings, RefusesRingsThatCrossOrTouchAndNamesTheEdges) {
  const RingNote across = refusal({{{8, 3}, {8, 5}, {10, 4}}});
  EXPECT_EQ(across.ring, 1u);
  EXPECT_THAT(across.text, StartsWith("edge "));
  EXPECT_THAT(across.text, HasSubstr("meets edge 1-2 of the outline"));
  const RingNote touching = refusal({square_at(1, 1, 2), {{3, 2}, {5, 1}, {5, 3}}});
  EXPECT_EQ(touching.ring, 2u);
  EXPECT_THAT(touching.text, HasSubstr("meets edge 1-2 of hole 0 "));
  EXPECT_NE(refusal({{{9, 9}, {6, 8}, {8, 6}}}).text, "");                // vertex on vertex
  EXPECT_NE(refusal({{{1, 0}, {3, 0}, {2, 1}}}).text, "");                // edge along edge
  EXPECT_NE(refusal({square_at(1, 1, 2), square_at(1, 1, 2)}).text, "");  // the same twice
  EXPECT_EQ(refusal({{{8, 3}, {8, 5}, {9 - 0x1p-49, 4}}}).text, "");      // an ulp away
  EXPECT_NE(refusal({square_at(1, 1, 2), {{3, 3}, {4, 5}, {5, 4}}}).text, "");
}

TEST(CleanRings, RefusesAHoleOutside) {
  const RingNote beside = refusal({square_at(1, 1, 2), square_at(20, 1, 2)});
  EXPECT_EQ(beside.ring, 2u);
  EXPECT_EQ(beside.text, "lies outside the outline");
  EXPECT_EQ(refusal({square_at(-1, -1, 11)}).text, "lies outside the outline");
}

TEST(CleanRings, RefusesAHoleInAHoleWhicheverComesFirst) {
  const RingNote inner = refusal({square_at(1, 1, 6), square_at(2, 2, 1)});
  EXPECT_EQ(inner.ring, 2u);
  EXPECT_THAT(inner.text, StartsWith("lies in hole 0"));
  const RingNote first = refusal({square_at(2, 2, 1), square_at(1, 1, 6)});
  EXPECT_EQ(first.ring, 1u);
  EXPECT_THAT(first.text, StartsWith("lies in hole 1"));
}

bool crosses(const Ring& one, const Ring& other) {
  for (std::size_t i = 0; i < one.size(); ++i)
    for (std::size_t j = 0; j < other.size(); ++j)
      if (segments_meet(one[i], one[(i + 1) % one.size()], other[j], other[(j + 1) % other.size()]))
        return true;
  return false;
}

/// Whether `one` lies within `other`, by the angle that it sees: rings that don't meet.
bool lies_within(const Ring& one, const Ring& other) {
  double turn = 0.0;
  for (std::size_t i = 0; i < other.size(); ++i) {
    const Vec p = other[i] - one[0], q = other[(i + 1) % other.size()] - one[0];
    turn += std::atan2(p.x() * q.y() - p.y() * q.x(), p.dot(q));
  }
  return std::abs(turn) > 3.0;
}

TEST(CleanRings, DecidesAsTheDefinitionDoes) {
  Random random(15);
  int good = 0, bad = 0;
  for (int i = 0; i < 30000; ++i) {
    const std::vector<Ring> holes{random_on_grid(random, 3 + random() % 3, {-4, -4}, 4),
                                  random_on_grid(random, 3 + random() % 3, {-4, -4}, 8)};
    const Ring outline = random_simple_on_grid(random);
    bool sound = true;
    for (const Ring& hole : holes) sound = sound && clean(hole).refusal.empty();
    if (!sound) continue;
    const bool expected = !crosses(outline, holes[0]) && !crosses(outline, holes[1]) &&
                          !crosses(holes[0], holes[1]) && lies_within(holes[0], outline) &&
                          lies_within(holes[1], outline) && !lies_within(holes[0], holes[1]) &&
                          !lies_within(holes[1], holes[0]);
    ASSERT_EQ(cleaned(outline, holes).refusal.text.empty(), expected) << "seed 15, " << i;
    ++(expected ? good : bad);
  }
  EXPECT_GT(good, 300);
  EXPECT_GT(bad, 3000);
}

TEST(CleanRings, OfThousandsOfHolesTakeNoMinutes) {
  EXPECT_EQ(clean(grating(70)).refusal.text, "");
}

}  // namespace
}  // namespace throng::narrowphase
