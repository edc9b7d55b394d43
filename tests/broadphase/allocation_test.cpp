// SPDX-License-Identifier: MIT
// After warm-up nothing on this floor asks for memory: this file counts who does, in the whole test program.
#include <gtest/gtest.h>

#include <atomic>
#include <cstdlib>
#include <new>

#include "broadphase/all_lists.h"
#include "broadphase/box_index.h"
#include "broadphase/disc_pairs.h"
#include "broadphase/neighbours.h"
#include "tests/broadphase/clouds.h"

namespace {

std::atomic<long> allocations{0};

void* counted(std::size_t size) {
  ++allocations;
  if (void* memory = std::malloc(size > 0 ? size : 1)) return memory;
  throw std::bad_alloc();
}

}  // namespace

void* operator new(std::size_t size) {
  return counted(size);
}
void* operator new[](std::size_t size) {
  return counted(size);
}
void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
  return counted(size);
}
void* operator new(std::size_t size, std::align_val_t alignment) {
  ++allocations;
  const auto align = static_cast<std::size_t>(alignment);
  if (void* memory = std::aligned_alloc(align, (size + align - 1) / align * align)) return memory;
  throw std::bad_alloc();
}
void operator delete(void* memory, std::align_val_t) noexcept {
  std::free(memory);
}
void operator delete(void* memory, std::size_t, std::align_val_t) noexcept {
  std::free(memory);
}
void operator delete(void* memory) noexcept {
  std::free(memory);
}
void operator delete[](void* memory) noexcept {
  std::free(memory);
}
void operator delete(void* memory, std::size_t) noexcept {
  std::free(memory);
}
void operator delete[](void* memory, std::size_t) noexcept {
  std::free(memory);
}

namespace throng::broadphase {
namespace {

/// How often `work` allocates once it has run before.
template <class F>
long allocations_of(F&& work) {
  const long before_first = allocations;
  work();
  EXPECT_GT(allocations, before_first);  // the counter counts
  const long before = allocations;
  for (int again = 0; again < 3; ++again) work();
  return allocations - before;
}

TEST(Allocation, HappensOnceInAllPairs) {
  Random random(1);
  const Points points = cloud(random, 2000, 30.0);
  const Points sparse = cloud(random, 2000, 1e6);
  AllPairs search;
  PairList pairs;
  EXPECT_EQ(allocations_of([&] {
              for (const Points* some : {&points, &sparse}) search.find(*some, 1.0, nullptr, pairs);
            }),
            0);
  search.find(points, 1.0, nullptr, pairs);
  EXPECT_GT(pairs.size(), 100u);
}

TEST(Allocation, HappensOnceInDiscPairs) {
  Random random(2);
  const Points centres = cloud(random, 2000, 30.0);
  const std::vector<double> equal(2000, 0.4);
  std::vector<double> mixed;
  for (std::size_t i = 0; i < 2000; ++i) mixed.push_back(std::ldexp(0.5, -static_cast<int>(i % 9)));
  const std::vector<std::uint8_t> movable(2000, 1);
  DiscPairs discs;
  std::vector<Pair> pairs;
  EXPECT_EQ(allocations_of([&] {
              discs.find(centres, equal, nullptr, pairs, movable);
              discs.find(centres, mixed, nullptr, pairs);
            }),
            0);
}

TEST(Allocation, HappensOnceForNeighbours) {
  Random random(3);
  const Points points = cloud(random, 3000, 50.0);
  ProximityTree tree;
  std::vector<Neighbour> neighbours;
  NeighbourSearch search;
  NeighbourLists lists;
  EXPECT_EQ(allocations_of([&] {
              tree.build(points);
              for (const Point& p : points) find_near(tree, {p}, {.radius = 3.0, .most = 5}, neighbours);
              for (const std::size_t most : {std::size_t{5}, std::size_t{200}, points.size()}) {
                search.find(tree, {.at = points, .own = 0}, {.radius = 3.0, .most = most}, lists);
                search.find(tree, {.at = points}, {.radius = 3.0, .most = most}, lists);
              }
            }),
            0);
  EXPECT_GT(lists.row.size(), points.size());
}

TEST(Allocation, HappensOnceInAllLists) {
  Random random(6);
  const Points points = cloud(random, 3000, 50.0), sparse = cloud(random, 3000, 1e6);
  const std::vector<double> radius(3000, 2.0);
  AllLists search;
  NeighbourLists lists;
  EXPECT_EQ(allocations_of([&] {
              for (const Points* some : {&points, &sparse}) {
                search.find(*some, 2.0, nullptr, lists);
                search.find(*some, radius, nullptr, lists);
              }
            }),
            0);
  search.find(points, 2.0, nullptr, lists);
  EXPECT_GT(lists.row.size(), points.size());
}

TEST(Allocation, NeverHappensWhereNeighboursAreCalledFor) {
  Random random(5);
  const Points points = cloud(random, 1000, 30.0);
  ProximityTree tree;
  tree.build(points);
  std::size_t found = 0;
  const long before = allocations;
  for (const Point& p : points)
    for_each_near(tree, {p}, {.radius = 2.0}, [&](std::uint32_t, double) { ++found; });
  EXPECT_EQ(allocations, before);
  EXPECT_GT(found, 1000u);
}

TEST(Allocation, NeverHappensWhenABoxIndexAnswers) {
  Random random(4);
  std::vector<Extent> extents;
  for (int i = 0; i < 500; ++i)
    extents.push_back(Extent::of_segment(random.in_square(30.0), random.in_square(30.0)));
  BoxIndex index;
  index.build(extents, 1.0);
  std::size_t found = 0;
  const long before = allocations;
  for (int i = 0; i < 1000; ++i) {
    const Point corner = random.in_square(30.0);
    index.for_each_near(Box(corner, corner + random.in_square(10.0)), [&](std::uint32_t) { ++found; });
  }
  EXPECT_EQ(allocations, before);
  EXPECT_GT(found, 1000u);
}

}  // namespace
}  // namespace throng::broadphase
