// SPDX-License-Identifier: MIT
#include "broadphase/box_index.h"

#include <gmock/gmock.h>

#include "broadphase/brute_force.h"
#include "tests/broadphase/clouds.h"

namespace throng::broadphase {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using Extents = std::vector<Extent>;
using Rows = std::vector<std::uint32_t>;

Box box(double x, double y, double right, double top) {
  return {Point(x, y), Point(right, top)};
}
Extent box_extent(double x, double y, double right, double top) {
  return Extent::of(box(x, y, right, top));
}
Extent segment(double ax, double ay, double bx, double by) {
  return Extent::of_segment({ax, ay}, {bx, by});
}

BoxIndex index_of(const Extents& extents, double query_size = 0.0) {
  BoxIndex index;
  index.build(extents, query_size);
  return index;
}

Rows near(const BoxIndex& index, const Box& box) {
  Rows rows;
  index.for_each_near(box, [&](std::uint32_t row) { rows.push_back(row); });
  return rows;
}

TEST(BoxIndex, FindsWhatPaperFinds) {
  const BoxIndex index = index_of({box_extent(0, 0, 1, 1), segment(0, 3, 3, 0), box_extent(5, 5, 6, 6)}, 1.0);
  EXPECT_THAT(near(index, box(0.5, 0.5, 0.9, 0.9)), ElementsAre(0));
  EXPECT_THAT(near(index, box(0.5, 0.5, 1.5, 1.5)), ElementsAre(0, 1));
  EXPECT_THAT(near(index, box(2, 2, 4.9, 4.9)), IsEmpty());   // in the diagonal's box, beside the diagonal
  EXPECT_THAT(near(index, box(6, 6, 7, 7)), ElementsAre(2));  // the border counts
  EXPECT_THAT(near(index, box(-9, -9, 9, 9)), ElementsAre(0, 1, 2));
}

TEST(BoxIndex, FindsNothingWhereNothingIs) {
  EXPECT_THAT(near(index_of({}), box(0, 0, 1, 1)), IsEmpty());
  EXPECT_THAT(near(BoxIndex(), box(0, 0, 1, 1)), IsEmpty());
  const BoxIndex index = index_of({segment(0, 0, 1, 0)}, 0.1);
  for (const double far : {2.0, 1e9, -1e9, 1e300})
    EXPECT_THAT(near(index, box(far, far, far, far)), IsEmpty());
}

/// Whether the box and the segment, in whole numbers, share a point: exactly.
bool touches_exactly(const Extent& e, const Box& b) {
  if (!e.box().intersects(b)) return false;
  int left = 0, right = 0;
  for (const Box::CornerType corner : {Box::BottomLeft, Box::BottomRight, Box::TopLeft, Box::TopRight}) {
    const Point d = e.b - e.a, q = b.corner(corner) - e.a;
    const auto side = static_cast<__int128>(d.x()) * static_cast<__int128>(q.y()) -
                      static_cast<__int128>(d.y()) * static_cast<__int128>(q.x());
    left += side >= 0;
    right += side <= 0;
  }
  return left > 0 && right > 0;
}

TEST(Touches, AgreesWithExactNumbersOnASmallLattice) {
  int touching = 0;
  const auto each = [](auto&& f) {
    for (int x = -2; x <= 3; ++x)
      for (int y = -2; y <= 3; ++y) f(Point(x, y));
  };
  const Box square = box(0, 0, 2, 1);
  each([&](const Point& a) {
    each([&](const Point& b) {
      const Extent e = Extent::of_segment(a, b);
      EXPECT_EQ(touches(e, square), touches_exactly(e, square)) << a.transpose() << " to " << b.transpose();
      touching += touches(e, square);
    });
  });
  EXPECT_GT(touching, 36 * 36 / 3);
  EXPECT_LT(touching, 36 * 36 * 2 / 3);
}

TEST(Touches, MissesNoGrazedCornerOfLargeNumbers) {
  Random random(12);
  const auto whole = [&] { return std::floor(random.between(-0x1p52, 0x1p52)); };
  int wrong = 0;
  for (int round = 0; round < 20000; ++round) {
    const Point corner(whole(), whole()),
        d(std::floor(random.between(1, 0x1p20)), std::floor(random.between(1, 0x1p20)));
    const double before = std::floor(random.between(1, 0x1p30)),
                 behind = std::floor(random.between(1, 0x1p30));
    // The segment passes exactly through the box's upper left corner, or through a point beside it.
    const Extent e = Extent::of_segment(corner - before * d, corner + behind * d);
    const Box grazed(Point(corner.x(), corner.y() - 5.0), Point(corner.x() + 5.0, corner.y()));
    if (!touches_exactly(e, grazed)) continue;
    wrong += !touches(e, grazed);
  }
  EXPECT_EQ(wrong, 0);
}

/// Walls and boxes from a thousandth of `side` to longer than it.
Extents mixed(Random& random, std::size_t n, double side) {
  Extents extents;
  for (std::size_t i = 0; i < n; ++i) {
    const double size = side * std::ldexp(1.0, -static_cast<int>(random.below(10)));
    const Point a = random.in_square(side);
    Point d = random.in_square(2.0 * size) - Point(size, size);
    if (i % 5 == 1) d.x() = 0.0;
    if (i % 5 == 2) d.y() = 0.0;
    if (i % 5 == 3) d = a.array().round().matrix() - a;  // ends on a border of cells
    extents.push_back(i % 2 ? Extent::of_segment(a, a + d) : Extent::of(Extent::of_segment(a, a + d).box()));
  }
  return extents;
}

std::size_t expect_brute_force(Random& random, const Extents& extents, const BoxIndex& index, double side,
                               double query) {
  const Extent& some = extents[random.below(extents.size())];
  const Point corner = random.below(2) ? Point(random.in_square(1.2 * side) + extents[0].a) : some.a;
  const Box asked(corner, corner + random.in_square(query));
  const Rows rows = near(index, asked);
  EXPECT_EQ(rows, brute_force::near(extents, asked)) << asked.min().transpose() << " " << query;
  return rows.size();
}

TEST(BoxIndex, AgreesWithTheDefinition) {
  const std::uint64_t seed = 314;
  SCOPED_TRACE("seed " + std::to_string(seed));
  Random random(seed);
  double found = 0.0, asked = 0.0;
  for (int round = 0; round < 200; ++round) {
    const double side = 10.0;
    Extents extents = mixed(random, 1 + random.below(150), side);
    if (round % 4 == 0) extents.push_back(segment(-1e6, 3e5, 1e6, -2e5));
    if (round % 4 == 1) extents.push_back(box_extent(1e7, -1e7, 1e7, 1e7));
    const BoxIndex index = index_of(extents, round % 3 == 0 ? 0.0 : random.between(0.01, 3.0));
    for (int query = 0; query < 30; ++query) {
      found +=
          static_cast<double>(expect_brute_force(random, extents, index, side, std::ldexp(4.0, -query % 8)));
      asked += static_cast<double>(extents.size());
    }
  }
  EXPECT_GT(found / asked, 0.01);
  EXPECT_LT(found / asked, 0.5);
}

TEST(BoxIndex, AgreesWithTheDefinitionFarFromTheOriginAndInSmallUnits) {
  Random random(27);
  for (const double unit : {1e-6, 1.0, 1e6}) {
    for (const double offset : {0.0, -1e6, 1e9}) {
      Extents extents = mixed(random, 200, 10.0);
      for (Extent& e : extents)
        e = {e.a * unit + Point(offset, offset), e.b * unit + Point(offset, offset), e.is_segment};
      const BoxIndex index = index_of(extents, 0.2 * unit);
      for (int query = 0; query < 100; ++query) expect_brute_force(random, extents, index, 10.0 * unit, unit);
    }
  }
}

TEST(BoxIndex, NeedsNoMoreMemoryThanItPromises) {
  Random random(15);
  for (const std::size_t n : {1u, 20u, 500u}) {
    Extents extents;
    for (std::size_t i = 0; i < n; ++i)
      extents.push_back(segment(0, random.unit(), 1e6, 1e6 * random.unit()));
    for (std::size_t i = 0; i < n; ++i)
      extents.push_back(box_extent(0, 0, 1e5 * random.unit(), 1e5 * random.unit()));
    const BoxIndex index = index_of(extents, 1e-3);
    EXPECT_LE(index.entries(), 16 * extents.size() + 4096);
    for (int query = 0; query < 30; ++query) expect_brute_force(random, extents, index, 1e6, 1e3);
  }
}

TEST(BoxIndex, NeedsNoMoreMemoryThanItPromisesForThousandsOfMiddlingBoxes) {
  Random random(16);
  Extents extents;
  for (int i = 0; i < 2000; ++i) {  // of 900 cells each at the size that is asked for: none is kept aside
    const Point corner = random.in_square(10.0);
    extents.push_back(box_extent(corner.x(), corner.y(), corner.x() + 0.029, corner.y() + 0.029));
  }
  const BoxIndex index = index_of(extents, 1e-3);
  EXPECT_LE(index.entries(), 16 * extents.size() + 4096);
  for (int query = 0; query < 30; ++query) expect_brute_force(random, extents, index, 10.0, 0.1);
}

TEST(BoxIndex, PutsALongDiagonalIntoFewCells) {
  const BoxIndex index = index_of({segment(0, 0, 100, 70)}, 1.0);
  EXPECT_EQ(index.cell_size(), 1.0);
  EXPECT_GE(index.entries(), 170u);  // it crosses 99 + 69 borders; its box has 7,000 cells
  EXPECT_LE(index.entries(), 180u);
}

}  // namespace
}  // namespace throng::broadphase
