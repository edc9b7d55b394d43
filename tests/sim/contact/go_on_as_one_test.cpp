// SPDX-License-Identifier: MIT
#include "sim/contact/go_on_as_one.h"

#include <gtest/gtest.h>

namespace throng {
namespace {

double energy_of(const SolverBody& body) {
  const double turning = body.inverse_inertia > 0.0 ? body.spin * body.spin / body.inverse_inertia : 0.0;
  return 0.5 * (body.velocity.squaredNorm() / body.inverse_mass + turning);
}

Vec momentum_of(const SolverBody& body) {
  return body.velocity / body.inverse_mass;
}

/// About the origin.
double angular_momentum_of(const SolverBody& body) {
  return cross(body.position, momentum_of(body)) + body.spin / body.inverse_inertia;
}

TEST(GoOnAsOne, KeepsMomentumAndAngularMomentumAndLosesEnergy) {
  SolverBody a{{3.0, -1.0}, 2.0, 0.5, {1.0, 2.0}, 0.0, 0.7}, b{{-4.0, 5.0}, -7.0, 0.1, {1.5, 2.5}, 0.0, 0.2};
  const Vec p = momentum_of(a) + momentum_of(b), between = b.position - a.position;
  const double l = angular_momentum_of(a) + angular_momentum_of(b), e = energy_of(a) + energy_of(b);
  go_on_as_one(a, b, between);
  EXPECT_LT((momentum_of(a) + momentum_of(b) - p).norm(), 1e-12);
  EXPECT_NEAR(angular_momentum_of(a) + angular_momentum_of(b), l, 1e-12);
  EXPECT_LT(energy_of(a) + energy_of(b), e);
  EXPECT_EQ(a.spin, b.spin);
  EXPECT_NEAR((b.velocity - a.velocity).dot(between), 0.0, 1e-12) << "they stay as far apart";
}

TEST(GoOnAsOne, TurnsNobodyWhoCant) {
  SolverBody a{{3.0, -1.0}, 0.0, 0.5, {1.0, 2.0}, 0.0, 0.0}, b{{-4.0, 5.0}, 0.0, 0.1, {1.5, 2.5}, 0.0, 0.0};
  const Vec p = momentum_of(a) + momentum_of(b);
  go_on_as_one(a, b, b.position - a.position);
  EXPECT_LT((momentum_of(a) + momentum_of(b) - p).norm(), 1e-12);
  EXPECT_EQ(a.velocity, b.velocity);
  EXPECT_EQ(a.spin, 0.0);
}

}  // namespace
}  // namespace throng
