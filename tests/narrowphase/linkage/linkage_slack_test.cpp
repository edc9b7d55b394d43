// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "random_linkage.h"
#include "tests/narrowphase/motion/exact_gap.h"

namespace throng::narrowphase {
namespace {

struct ExactPose {
  ExactVec position{0, 0};
  Digits angle = 0;

  ExactVec operator*(const ExactVec& v) const {
    const Digits c = cos(angle), s = sin(angle);
    return {position[0] + c * v[0] - s * v[1], position[1] + s * v[0] + c * v[1]};
  }
};

/// A straight line between two configurations.
struct Way {
  Linkage linkage;
  std::vector<double> from, to;

  /// The definition, in 50 digits.
  ExactPose pose(std::uint32_t link, double time, std::uint32_t seen_from) const {
    if (link == seen_from) return {};
    const Link& l = linkage[link];
    const ExactPose parent = pose(l.parent, time, seen_from);
    const Digits value = Digits(from[link]) + Digits(time) * (Digits(to[link]) - Digits(from[link]));
    const Digits slid = l.joint == Joint::prismatic ? value : Digits(0);
    return {parent * ExactVec{l.at.x() + slid * l.axis.x(), l.at.y() + slid * l.axis.y()},
            parent.angle + l.angle + value - slid};
  }
};

/// How far a link's tip is from where it ought to be, of the slack, at most. Of all links and instants.
double greatest_error(const Way& way) {
  LinkageMotion motion;
  motion.reset(way.linkage, way.from, way.to);
  double greatest = 0.0;
  for (std::uint32_t i = 0; i < way.linkage.size(); ++i)
    for (double time : {0.0, 0.37, 1.0})
      for (std::uint32_t top = i; top != kWorld;) {
        top = way.linkage[top].parent;
        const Vec tip{reach(way.linkage[i]), 0.0}, placed = motion.pose(i, time, top) * tip;
        const ExactVec exact = way.pose(i, time, top) * ExactVec{tip.x(), tip.y()};
        const Vec off(static_cast<double>(placed.x() - exact[0]), static_cast<double>(placed.y() - exact[1]));
        greatest = std::max(greatest, off.norm() / motion.slack());
      }
  return greatest;
}

TEST(LinkageSlack, KnowsAnglesThatCancel) {
  ShapeStore shapes;
  Way way{arm(shapes, 2, 1.0, 0.0), {0.1, -1e6}, {0.2, -1e6}};
  way.linkage[1].at = {0, 0}, way.linkage[1].angle = 1e6;
  EXPECT_LT(greatest_error(way), 0.5) << "there are two links in a pair";
}

TEST(LinkageSlack, KnowsASlideThatCancels) {
  ShapeStore shapes;
  Way way{arm(shapes, 2, 1.0, 0.0), {1.0, 1e6}, {1.0, 1e6}};
  way.linkage[1].joint = Joint::prismatic;
  way.linkage[1].axis = {0.6, 0.8}, way.linkage[1].at = -1e6 * way.linkage[1].axis;
  EXPECT_LT(greatest_error(way), 0.5);
}

TEST(LinkageSlack, KnowsAChangeThatCancels) {
  ShapeStore shapes;
  const Way way{arm(shapes, 2, 1.0, 0.0), {1e6 + 0.1, -1e6}, {-2e6 + 0.7, 2e6}};
  EXPECT_LT(greatest_error(way), 0.5);
}

/// Joints that take back what their links' places have, and what joints before them did.
Way cancelling(Random& random, ShapeStore& shapes, double size) {
  Way way{random_forest(random, shapes, 5), random_values(random, 5, 2.0), random_values(random, 5, 2.0)};
  for (std::size_t i = 0; i < 5; ++i) {
    Link& link = way.linkage[i];
    const double back = uniform(random, -size, size);
    const std::size_t kind = random() % 3;
    if (kind == 0) continue;
    way.from[i] += back, way.to[i] += back;
    if (link.joint == Joint::prismatic)
      link.at -= back * link.axis;
    else if (kind == 1)
      link.angle -= back;
    else if (i > 0)
      way.from[i - 1] -= back, way.to[i] += back, way.to[i - 1] -= 2.0 * back;
  }
  return way;
}

TEST(LinkageSlack, HoldsInFiftyDigits) {
  Random random(19);
  for (double size : {1.0, 1e3, 1e6}) {
    double greatest = 0.0;
    for (int i = 0; i < 100; ++i) {
      ShapeStore shapes;
      const double error = greatest_error(cancelling(random, shapes, size));
      EXPECT_LT(error, 0.5) << "seed 19, size " << size << ", forest " << i;
      greatest = std::max(greatest, error);
    }
    RecordProperty("greatest_error_of_slack_" + std::to_string(size), std::to_string(greatest));
    EXPECT_GT(greatest, 0.005) << "the slack is no idle bound, size " << size;
  }
}

}  // namespace
}  // namespace throng::narrowphase
