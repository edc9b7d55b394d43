// SPDX-License-Identifier: MIT
// After warm-up a step allocates nothing: every operator new of this program is counted.
#include <gtest/gtest.h>

#include <atomic>
#include <cstdlib>
#include <new>

#include "sim/simulation.h"
#include "tests/sim/scene_from.h"

// g++ looks through the operators below where it inlines one of a pair, and takes what it sees for a
// mismatch.
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic ignored "-Wmismatched-new-delete"
#endif

namespace {
std::atomic<long> allocations{0};

void* counted(std::size_t size, std::size_t alignment) {
  ++allocations;
  if (void* p = std::aligned_alloc(alignment, (size + alignment - 1) / alignment * alignment)) return p;
  throw std::bad_alloc();
}
}  // namespace

void* operator new(std::size_t size) {
  return counted(size, alignof(std::max_align_t));
}
void* operator new(std::size_t size, std::align_val_t alignment) {
  return counted(size, std::size_t(alignment));
}
void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
  return counted(size, alignof(std::max_align_t));
}
void operator delete(void* p, const std::nothrow_t&) noexcept {
  std::free(p);
}
void operator delete(void* p) noexcept {
  std::free(p);
}
void operator delete(void* p, std::size_t) noexcept {
  std::free(p);
}
void operator delete(void* p, std::align_val_t) noexcept {
  std::free(p);
}
void operator delete(void* p, std::size_t, std::align_val_t) noexcept {
  std::free(p);
}

namespace throng {
namespace {

void expect_no_allocation(const Scene& scene) {
  const auto run = simulation(scene);
  ASSERT_GT(allocations, 0) << "nothing is counted";
  // Buffers grow with the number of contacts, which rises as bodies gather: wait until a hundred steps pass
  // without.
  long before = -1;
  for (int i = 0; i < 20 && before != allocations; ++i) {
    before = allocations;
    for (int j = 0; j < 100; ++j) run->step();
  }
  EXPECT_EQ(allocations, before);
}

class SettledScene : public ::testing::TestWithParam<const char*> {};

TEST_P(SettledScene, StepsWithoutAllocating) {
  expect_no_allocation(gallery_scene(GetParam()));
}

TEST(SoftDiscs, StepWithoutAllocating) {
  expect_no_allocation(scene_from(
      "gravity = [0, -9.81]\ntime.dt = 2e-3\ndomain.box = [[0, 0], [9, 20]]\n"
      "contact = { model = 'spring', stiffness = 1e4 }\nmaterials.default.rolling_resistance = 0.1\n"
      "shapes.ball.disc.radius = 0.4\nshapes.bar.polygon = [[0, 0], [3, 0], [3, 0.2], [0, 0.2]]\n"
      "[[bodies]]\nshape = 'ball'\ncount = 60\nplace.random = { within = [[0, 2], [9, 20]], gap = 0.01 }\n"
      "[[bodies]]\nshape = 'bar'\nat = [4, 1]\nspin = 1\nkind = 'kinematic'\n"
      "[[walls]]\npolyline = [[0, 0.5], [4, 0], [9, 0.5]]\n"));
}

INSTANTIATE_TEST_SUITE_P(Gallery, SettledScene,
                         ::testing::Values("gas", "cradle", "billiard", "hopper", "gears", "mixed",
                                           "corridor", "bottleneck", "crossing"),
                         [](const auto& scene) { return std::string(scene.param); });

}  // namespace
}  // namespace throng
