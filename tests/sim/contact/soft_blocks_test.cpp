// SPDX-License-Identifier: MIT
// Soft contacts in lanes against the same one after the other, to the last bit, on all sets of instructions.
#include "sim/contact/soft_blocks.h"

#include <gtest/gtest.h>

#include <hwy/targets.h>
#include <random>

namespace throng {
namespace {

constexpr std::size_t kBodies = 23;

struct Plain {
  std::vector<SolverBody> bodies;
  std::vector<SoftSpeed> speeds;
  std::vector<SoftPush> pushes;
  std::vector<SoftBlock> blocks;
  std::vector<SoftShifts> shifts;
};

/// What is asked: 43 pairs of discs about as far apart as their radii, some lanes without a pair.
Plain some_blocks(std::uint32_t seed, bool periodic) {
  std::mt19937 random(seed);
  const auto number = [&](double from, double to) {
    return from + (to - from) * static_cast<double>(random()) / 4294967296.0;
  };
  Plain p{std::vector<SolverBody>(kBodies),
          std::vector<SoftSpeed>(kBodies),
          std::vector<SoftPush>(kBodies),
          std::vector<SoftBlock>(6),
          {}};
  for (std::size_t i = 0; i < kBodies; ++i) {
    p.bodies[i] = {Vec(number(-1, 1), number(-1, 1)), number(-5, 5), 1.0,
                   Vec(number(0, 1), number(0, 1)),   0.0,           1.0};
    p.speeds[i] = {Vec(number(-1, 1), number(-1, 1)), number(-5, 5)};
  }
  p.bodies[1].position = p.bodies[0].position;  // one in the other
  p.speeds[3] = p.speeds[2];
  if (periodic) p.shifts.resize(p.blocks.size());
  for (std::size_t i = 0; i < 43; ++i) {
    SoftBlock& c = p.blocks[i / BlockOrder::kWidth];
    const std::size_t k = i % BlockOrder::kWidth;
    const auto a = static_cast<std::uint32_t>(i % (kBodies - 1));
    const auto b =
        i == 0 || i == 2 ? a + 1 : a + 1 + static_cast<std::uint32_t>(random() % (kBodies - 1 - a));
    c.a[k] = a, c.b[k] = b;
    const Vec shift = periodic ? Vec(number(-0.1, 0.1), number(-0.1, 0.1)) : Vec(0.0, 0.0);
    if (periodic)
      p.shifts[i / BlockOrder::kWidth].x[k] = shift.x(), p.shifts[i / BlockOrder::kWidth].y[k] = shift.y();
    const double distance = (p.bodies[b].position + shift - p.bodies[a].position).norm();
    const double reach = distance + (i % 3 == 0 ? number(-3e-3, 3e-3) : number(-0.1, 0.3) * distance);
    c.radius_a[k] = 0.4 * reach, c.radius_b[k] = 0.6 * reach;
    if (i == 2) c.radius_a[k] = c.radius_b[k] = 0.5 * distance;  // it just touches, and then nothing moves
    c.stiffness[k] = 1e3, c.damping[k] = i % 5 == 0 ? 0.0 : 7.0, c.friction[k] = i % 4 == 0 ? 0.0 : 0.3;
    c.rolling[k] = 0.1, c.roll_radius[k] = 0.24 * reach;
    c.touching[k] = i % 2 == 0 ? 1.0 : 0.0;
    c.normal_x[k] = 0.6, c.normal_y[k] = 0.8, c.depth[k] = number(-1e-3, 5e-3);
    c.slip[k] = number(-1e-2, 1e-2), c.roll[k] = number(-1e-2, 1e-2);
  }
  return p;
}

SoftMotion motion(const SoftBlock& c, std::size_t k, const auto& a, const auto& b) {
  const double in = 0.5 * std::max(c.depth[k], 0.0), arm_a = c.radius_a[k] - in, arm_b = c.radius_b[k] - in;
  const Vec apart = b.velocity - a.velocity;
  const double closing = -(apart.x() * c.normal_x[k] + apart.y() * c.normal_y[k]);
  const double across = apart.x() * -c.normal_y[k] + apart.y() * c.normal_x[k];
  return {c.depth[k], closing, across - (arm_a * a.spin + arm_b * b.spin), b.spin - a.spin};
}

void push(const SoftBlock& c, std::size_t k, const SoftForce& force, Plain& p) {
  const double in = 0.5 * std::max(c.depth[k], 0.0);
  const Vec n(c.normal_x[k], c.normal_y[k]), all = force.normal * n + force.tangent * Vec(-n.y(), n.x());
  SoftPush &a = p.pushes[c.a[k]], &b = p.pushes[c.b[k]];
  a.force -= all, b.force += all;
  a.torque -= (c.radius_a[k] - in) * force.tangent + force.torque;
  b.torque -= (c.radius_b[k] - in) * force.tangent - force.torque;
}

SoftPair pair_of(const SoftBlock& c, std::size_t k) {
  return {c.stiffness[k], c.damping[k], c.friction[k], c.rolling[k], c.roll_radius[k]};
}

void stretch_plainly(SoftBlock& c, std::size_t k, const SoftLaw& law, const Plain& p, double h) {
  const SoftMotion moves = motion(c, k, p.bodies[c.a[k]], p.bodies[c.b[k]]);
  SoftSprings springs{c.slip[k], c.roll[k]};
  stretch(springs, moves, contact_time_after(moves, 0.5 * h), law.rolls);
  c.slip[k] = springs.slip, c.roll[k] = springs.roll;
}

/// One pair in its turn.
template <class Law>
void press_plainly(const Law& wide, std::size_t i, const SoftLaw& law, const SoftSubstep& now, Plain& p,
                   SoftSqueeze& squeeze) {
  SoftBlock& c = p.blocks[i / BlockOrder::kWidth];
  const std::size_t k = i % BlockOrder::kWidth;
  const SolverBody &a = p.bodies[c.a[k]], &b = p.bodies[c.b[k]];
  Vec way = b.position - a.position;
  if (!p.shifts.empty())
    way += Vec(p.shifts[i / BlockOrder::kWidth].x[k], p.shifts[i / BlockOrder::kWidth].y[k]);
  const double distance = way.norm(), reach = c.radius_a[k] + c.radius_b[k];
  const bool known = c.touching[k] != 0.0;
  if (!known) c.slip[k] = c.roll[k] = 0.0;
  if (known && !now.first) stretch_plainly(c, k, law, p, now.h);
  const Vec n = distance > 0.0 ? Vec(way / distance) : Vec(1.0, 0.0);
  c.normal_x[k] = n.x(), c.normal_y[k] = n.y(), c.depth[k] = reach - distance;
  const SoftMotion moves = motion(c, k, a, b);
  const bool near = way.squaredNorm() < (reach + now.fringe) * (reach + now.fringe);
  c.touching[k] = near && c.depth[k] + std::abs(0.5 * now.h * moves.closing) > 0.0 ? 1.0 : 0.0;
  if (c.touching[k] == 0.0) return;
  if (c.depth[k] > SoftSqueeze::kMost * std::min(c.radius_a[k], c.radius_b[k]))
    squeeze.note(c.a[k], c.b[k], c.depth[k]);
  SoftSprings springs{c.slip[k], c.roll[k]};
  stretch(springs, moves, contact_time_before(moves, known ? 0.5 * now.h : now.past), law.rolls);
  c.slip[k] = springs.slip, c.roll[k] = springs.roll;
  push(c, k, soft_force(wide, pair_of(c, k), moves, now.h, law.rolls, springs), p);
}

template <class Law>
void press_plainly_again(const Law& wide, std::size_t i, const SoftLaw& law, double h, Plain& p) {
  SoftBlock& c = p.blocks[i / BlockOrder::kWidth];
  const std::size_t k = i % BlockOrder::kWidth;
  if (c.touching[k] == 0.0) return;
  SoftSprings springs{c.slip[k], c.roll[k]};
  const SoftMotion moves = motion(c, k, p.speeds[c.a[k]], p.speeds[c.b[k]]);
  const SoftForce force = soft_force(wide, pair_of(c, k), moves, h, law.rolls, springs);
  c.slip[k] = springs.slip, c.roll[k] = springs.roll, c.force[k] = force.normal;
  push(c, k, force, p);
}

SoftSubstep substep_of(Plain& p, bool first) {
  return {first, true, 1e-3, 0.7e-3, 2e-3, p.bodies, p.speeds, p.pushes};
}

template <class Law>
SoftSqueeze run_plainly(const Law& wide, const SoftLaw& law, bool first, Plain& p) {
  const SoftSubstep now = substep_of(p, first);
  SoftSqueeze squeeze;
  for (std::size_t i = 0; i < BlockOrder::kWidth * p.blocks.size(); ++i)
    press_plainly(wide, i, law, now, p, squeeze);
  for (std::size_t i = 0; i < BlockOrder::kWidth * p.blocks.size(); ++i)
    press_plainly_again(wide, i, law, now.h, p);
  for (SoftBlock& c : p.blocks)
    for (std::size_t k = 0; k < BlockOrder::kWidth; ++k) stretch_plainly(c, k, law, p, now.h);
  return squeeze;
}

void expect_same(const Plain& one, const Plain& other, bool rolls) {
  for (std::size_t i = 0; i < kBodies; ++i) {
    ASSERT_EQ(one.pushes[i].force, other.pushes[i].force) << i;
    ASSERT_EQ(one.pushes[i].torque, other.pushes[i].torque) << i;
  }
  for (std::size_t i = 0; i < BlockOrder::kWidth * one.blocks.size(); ++i) {
    const SoftBlock &a = one.blocks[i / BlockOrder::kWidth], &b = other.blocks[i / BlockOrder::kWidth];
    const std::size_t k = i % BlockOrder::kWidth;
    ASSERT_EQ(a.touching[k], b.touching[k]) << i;
    if (a.touching[k] == 0.0) continue;
    ASSERT_EQ(a.normal_x[k], b.normal_x[k]) << i;
    ASSERT_EQ(a.normal_y[k], b.normal_y[k]) << i;
    ASSERT_EQ(a.depth[k], b.depth[k]) << i;
    ASSERT_EQ(a.slip[k], b.slip[k]) << i;
    if (rolls) {
      ASSERT_EQ(a.roll[k], b.roll[k]) << i;
    }
    ASSERT_EQ(a.force[k], b.force[k]) << i;
  }
}

class SoftBlocks : public ::testing::TestWithParam<std::int64_t> {
 protected:
  SoftBlocks() { hwy::SetSupportedTargetsForTest(GetParam()); }
  ~SoftBlocks() override { hwy::SetSupportedTargetsForTest(0); }
};
INSTANTIATE_TEST_SUITE_P(EveryTarget, SoftBlocks, ::testing::ValuesIn(hwy::SupportedAndGeneratedTargets()),
                         [](const auto& param) { return hwy::TargetName(param.param); });

TEST_P(SoftBlocks, DoAsTheLawToTheLastBit) {
  int touching = 0, deep = 0;
  for (std::uint32_t seed = 0; seed < 400; ++seed) {
    const bool hertz = seed % 2 == 0, rolls = seed % 4 < 2, periodic = seed % 8 < 4, first = seed % 16 < 8;
    const SoftLaw law{hertz, rolls, {2.0 / 7.0, seed % 3 == 0 ? 0.0 : 0.5}};
    Plain wide = some_blocks(seed, periodic), plain = wide;
    SoftSqueeze squeeze;
    const SoftSubstep now = substep_of(wide, first);
    press_soft(wide.blocks, wide.shifts, law, now, squeeze);
    press_soft_again(wide.blocks, law, now);
    stretch_soft(wide.blocks, law, now);
    const SoftSqueeze worst = hertz ? run_plainly(HertzLaw{law.tangential}, law, first, plain)
                                    : run_plainly(LinearLaw{law.tangential}, law, first, plain);
    expect_same(wide, plain, rolls);
    ASSERT_EQ(squeeze.depth, worst.depth);
    ASSERT_EQ(squeeze.a, worst.a);
    ASSERT_EQ(squeeze.b, worst.b);
    for (const SoftBlock& c : wide.blocks)
      for (const double one : c.touching) touching += one != 0.0;
    deep += squeeze.depth > 0.0;
  }
  EXPECT_GT(touching, 400 * 15);
  EXPECT_GT(deep, 20);
}

}  // namespace
}  // namespace throng
