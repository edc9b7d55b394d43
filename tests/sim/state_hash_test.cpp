// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>
#include <hwy/targets.h>

#include <bit>
#include <cmath>
#include <random>

#include "sim/state.h"

namespace throng {
namespace {

constexpr std::size_t kMost = 40;  // more than four of the widest vectors hold

/// Bodies in no order, whose numbers are of any size, one in six of them zero below zero.
State any_state(std::size_t bodies) {
  std::mt19937_64 random(bodies);
  const auto number = [&random] {
    const int scale = static_cast<int>(random() % 200) - 160;
    return scale % 6 == 0 ? -0.0 : std::ldexp(static_cast<double>(random()) - 9e18, scale);
  };
  State state;
  state.step = static_cast<std::int64_t>(random() >> 1);
  for (std::size_t row = 0; row < bodies; ++row) {
    state.id.push_back(static_cast<std::uint32_t>(random()));
    state.position.push_back({number(), number()});
    state.angle.push_back(number());
    state.velocity.push_back({number(), number()});
    state.spin.push_back(number());
  }
  return state;
}

std::uint64_t mixed(std::uint64_t hash, std::uint64_t word) {
  return std::rotl(hash + word * 14029467366897019727u, 31) * 11400714785074694791u;
}

std::uint64_t finished(std::uint64_t hash) {
  for (const std::uint64_t factor : {18397679294719823053u, 14181476777654086739u})
    hash = (hash ^ (hash >> 33)) * factor;
  return hash ^ (hash >> 33);
}

/// What files rely on, written down once more.
std::uint64_t definition(const State& state) {
  std::uint64_t sum = 0;
  for (std::size_t row = 0; row < state.id.size(); ++row) {
    std::uint64_t one = mixed(0x7468726f6e673032u, state.id[row]);
    for (const double x : {state.position[row].x(), state.position[row].y(), state.angle[row],
                           state.velocity[row].x(), state.velocity[row].y(), state.spin[row]})
      one = mixed(one, x == 0.0 ? 0 : std::bit_cast<std::uint64_t>(x));
    sum += finished(one);
  }
  return finished(mixed(mixed(sum, state.id.size()), static_cast<std::uint64_t>(state.step)));
}

class HashOnEachTarget : public testing::TestWithParam<std::int64_t> {
 protected:
  HashOnEachTarget() { hwy::SetSupportedTargetsForTest(GetParam()); }
  ~HashOnEachTarget() override { hwy::SetSupportedTargetsForTest(0); }
};

TEST_P(HashOnEachTarget, IsWhatIsDefinedForAnyNumberOfBodies) {
  for (std::size_t bodies = 0; bodies <= kMost; ++bodies) {
    const State state = any_state(bodies);
    EXPECT_EQ(hash(state), definition(state)) << bodies << " bodies";
  }
}

INSTANTIATE_TEST_SUITE_P(Widths, HashOnEachTarget,
                         testing::ValuesIn([] { return hwy::SupportedAndGeneratedTargets(); }()),
                         [](const auto& target) { return std::string(hwy::TargetName(target.param)); });

}  // namespace
}  // namespace throng
