// SPDX-License-Identifier: MIT
// The linear programs against all corners that an answer may lie in.
#include "sim/crowd/permitted_velocity.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace throng {
namespace {

constexpr double kSlack = 1e-11;  // m/s, of a corner that was computed

double outside(const HalfPlane& plane, const Vec& v) {
  return plane.offset - plane.normal.dot(v);
}

struct Problem {
  std::vector<HalfPlane> planes;
  std::size_t hard = 0;
  double most = 2.0;
  Vec preferred{1.0, 0.0};

  double deepest(const Vec& v) const {  ///< outside of a plane that isn't hard
    double depth = 0.0;
    for (std::size_t i = hard; i < planes.size(); ++i) depth = std::max(depth, outside(planes[i], v));
    return depth;
  }
  bool keeps(const Vec& v) const {
    if (v.norm() > most + kSlack) return false;
    for (std::size_t i = 0; i < hard; ++i)
      if (outside(planes[i], v) > kSlack) return false;
    return true;
  }
  Vec answer() const {
    HalfPlanes all, room;
    for (const HalfPlane& plane : planes) all.push_back(plane);
    return permitted_velocity(all, hard, most, preferred, room);
  }
};

/// Calls f with the points where the border a . v = b meets the circle, and with that nearest to the target.
template <class F>
void on_line(const Vec& a, double b, const Problem& problem, F f) {
  const Vec n = a / a.norm(), along(-n.y(), n.x()), middle = b / a.norm() * n;
  f(middle + along.dot(problem.preferred) * along);
  const double room = problem.most * problem.most - middle.squaredNorm();
  if (room < 0.0) return;
  for (const double side : {-1.0, 1.0}) f(middle + side * std::sqrt(room) * along);
}

template <class F>
void on_both(const Vec& a, double b, const Vec& c, double d, F f) {
  const double det = a.x() * c.y() - a.y() * c.x();
  if (std::abs(det) > 1e-13) f(Vec((b * c.y() - d * a.y()) / det, (a.x() * d - c.x() * b) / det));
}

/// All lines on which an answer may lie: borders, and where two planes are equally deep outside.
std::vector<HalfPlane> lines(const Problem& problem, bool with_ties) {
  std::vector<HalfPlane> all = problem.planes;
  for (std::size_t i = problem.hard; with_ties && i < problem.planes.size(); ++i)
    for (std::size_t j = i + 1; j < problem.planes.size(); ++j) {
      const Vec normal = problem.planes[j].normal - problem.planes[i].normal;
      if (normal.norm() > 1e-9) all.push_back({normal, problem.planes[j].offset - problem.planes[i].offset});
    }
  return all;
}

template <class F>
void for_each_corner(const Problem& problem, bool with_ties, F f) {
  const double length = problem.preferred.norm();
  f(length > problem.most ? Vec(problem.most / length * problem.preferred) : problem.preferred);
  for (const HalfPlane& plane : problem.planes) f(problem.most * plane.normal);
  const std::vector<HalfPlane> all = lines(problem, with_ties);
  for (std::size_t i = 0; i < all.size(); ++i) {
    on_line(all[i].normal, all[i].offset, problem, f);
    for (std::size_t j = 0; j < i; ++j)
      on_both(all[i].normal, all[i].offset, all[j].normal, all[j].offset, f);
  }
}

struct Solution {
  Vec nearest{0.0, 0.0};  ///< where all is kept
  double distance = std::numeric_limits<double>::infinity();
  double depth = std::numeric_limits<double>::infinity();  ///< else
};

Solution solve(const Problem& problem) {
  Solution result;
  for_each_corner(problem, false, [&](const Vec& v) {
    const double distance = (v - problem.preferred).norm();
    if (problem.keeps(v) && problem.deepest(v) <= kSlack && distance < result.distance)
      result.nearest = v, result.distance = distance;
  });
  for_each_corner(problem, true, [&](const Vec& v) {
    if (problem.keeps(v)) result.depth = std::min(result.depth, problem.deepest(v));
  });
  return result;
}

class RandomProblems {
 public:
  double uniform(double low, double high) {
    return low + (high - low) * (static_cast<double>(engine_() >> 11) * 0x1p-53);
  }
  Vec direction() {
    for (;;) {
      const double x = uniform(-1, 1);
      const double y = uniform(-1, 1);
      const double length = std::hypot(x, y);
      if (length > 0.1 && length < 1.0) return Vec(x, y) / length;
    }
  }
  Problem problem(std::size_t planes) {
    Problem result;
    result.hard = static_cast<std::size_t>(uniform(0, 3.999));
    result.most = uniform(0.5, 2.0);
    result.preferred = uniform(0, 2.5) * direction();
    for (std::size_t i = 0; i < planes; ++i) {
      const Vec normal = direction();
      result.planes.push_back({normal, i < result.hard ? uniform(-0.7, 0.0) : uniform(-1.2, 0.6)});
    }
    result.hard = std::min(result.hard, planes);
    return result;
  }

 private:
  std::mt19937_64 engine_{7};
};

TEST(PermittedVelocity, IsTheOneWantedWhereNothingForbidsIt) {
  Problem problem;
  EXPECT_EQ(problem.answer(), Vec(1, 0));
  problem.preferred = {3, 4};
  EXPECT_NEAR((problem.answer() - Vec(1.2, 1.6)).norm(), 0.0, 1e-15) << "as fast as may be";
}

TEST(PermittedVelocity, IsTheNearestOfAHalfPlaneAndOfACorner) {
  Problem problem;
  problem.planes = {{{-1, 0}, 0.0}};
  EXPECT_EQ(problem.answer(), Vec(0, 0));
  problem.planes.push_back({{0, 1}, 0.5});
  EXPECT_NEAR((problem.answer() - Vec(0, 0.5)).norm(), 0.0, 1e-15);
}

TEST(PermittedVelocity, IsAsLittleOutsideAsCanBe) {
  Problem problem;
  problem.planes = {{{1, 0}, 0.5}, {{-1, 0}, 0.7}};
  EXPECT_NEAR(problem.answer().x(), -0.1, 1e-15) << "0.6 outside of both";
  problem.hard = 1;
  EXPECT_NEAR(problem.answer().x(), 0.5, 1e-15) << "the first one is kept";
}

TEST(PermittedVelocity, AgreesWithTheBestOfAllCorners) {
  RandomProblems draw;
  int kept = 0, trials = 4000;
  double worst = 0.0, worst_depth = 0.0;
  for (int trial = 0; trial < trials; ++trial) {
    const Problem problem = draw.problem(1 + static_cast<std::size_t>(trial) % 12);
    const Solution truth = solve(problem);
    const Vec v = problem.answer();
    ASSERT_TRUE(problem.keeps(v)) << "seed 7, trial " << trial;
    if (truth.distance < 1e9) {
      ++kept;
      worst = std::max(worst, (v - truth.nearest).norm());
      ASSERT_LE(problem.deepest(v), kSlack) << "seed 7, trial " << trial;
    } else {
      worst_depth = std::max(worst_depth, std::abs(problem.deepest(v) - truth.depth));
    }
    ASSERT_LE(std::max(worst, worst_depth), 1e-9) << "seed 7, trial " << trial;
  }
  EXPECT_GT(kept, trials / 4) << "the sample has problems with a solution,";
  EXPECT_LT(kept, 3 * trials / 4) << "and without one";
}

TEST(PermittedVelocity, BearsPlanesThatAreTheSameOrOpposite) {
  Problem problem;
  const Vec n = Vec(0.6, 0.8);
  problem.planes = {{n, 0.3}, {n, 0.3}, {-n, -0.3}, {-n, 0.1}, {n, 0.5}};
  const Vec v = problem.answer();
  EXPECT_NEAR(problem.deepest(v), 0.3, 1e-12);
}

}  // namespace
}  // namespace throng
