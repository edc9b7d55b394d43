// SPDX-License-Identifier: MIT
// The models' kernels, compiled for each width of vectors: the same bits, and those of what they stand for.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "tests/sim/crowd/targets_test.cpp"
#include <gtest/gtest.h>
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <random>

#include "sim/crowd/near-inl.h"

HWY_BEFORE_NAMESPACE();
namespace throng::HWY_NAMESPACE {

void Exponentials(const double* x, double* result) {
  const Wide d;
  for (std::size_t k = 0; k < 16; k += 2 * kWide) {
    WideReals some[] = {hn::LoadU(d, x + k), hn::LoadU(d, x + k + kWide)};
    exponentiate(d, some);
    hn::StoreU(some[0], d, result + k), hn::StoreU(some[1], d, result + k + kWide);
  }
}

}  // namespace throng::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE

#include "sim/simulation.h"
#include "tests/sim/scene_from.h"

namespace throng {

HWY_EXPORT(Exponentials);

namespace {

std::vector<std::int64_t> targets() {
  return hwy::SupportedAndGeneratedTargets();
}

class OnEachTarget : public testing::Test {
 protected:
  ~OnEachTarget() override { hwy::SetSupportedTargetsForTest(0); }

  template <class F>
  void for_each(F f) {
    hwy::SetSupportedTargetsForTest(0);
    const auto all = targets();
    ASSERT_GE(all.size(), 2u) << "widths to compare";
    for (const std::int64_t target : all) {
      SCOPED_TRACE(hwy::TargetName(target));
      hwy::SetSupportedTargetsForTest(target);
      f();
    }
  }
};

TEST_F(OnEachTarget, TheExponentialIsTheScalarOne) {
  for_each([] {
    std::mt19937_64 random(1);
    for (int i = 0; i < 10'000; ++i) {
      double x[16], result[16];
      for (double& one : x) one = -750.0 + 1450.0 * (static_cast<double>(random() >> 11) * 0x1p-53);
      HWY_DYNAMIC_DISPATCH(Exponentials)(x, result);
      for (int k = 0; k < 16; ++k) ASSERT_EQ(result[k], exponential(x[k])) << x[k];
    }
  });
}

TEST_F(OnEachTarget, CrowdsWalkToTheSameBits) {
  for (const char* name : {"corridor", "bottleneck", "crossing", "circle_swap"}) {
    const Scene scene = gallery_scene(name);
    std::vector<std::uint64_t> hashes;
    for_each([&] {
      const auto run = simulation(scene);
      for (int i = 0; i < 300; ++i) run->step();
      hashes.push_back(hash(run->state()));
    });
    for (const std::uint64_t one : hashes) EXPECT_EQ(one, hashes.front()) << name;
  }
}

}  // namespace
}  // namespace throng

#endif
