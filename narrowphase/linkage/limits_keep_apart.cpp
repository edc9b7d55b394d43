// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>

#include "narrowphase/linkage/link_pairs.h"

namespace throng::narrowphase {

namespace {

/// A joint between the two links, and how far a unit of its value can move what hangs on it.
struct Between {
  std::uint32_t link;
  double middle, half;  ///< rad or m, its values
  double lever;         ///< m a rad, or the axis' length
};

double reach(const PartsBvh& shape) {
  return shape.tree.nodes[0].far;
}

/// Of a revolute joint no more than once round.
Between between(const Link& link, std::uint32_t index, double lever) {
  constexpr double kOnceRound = 3.15;
  if (link.joint == Joint::prismatic)
    return {index, 0.5 * (link.lower + link.upper), 0.5 * (link.upper - link.lower), link.axis.norm()};
  if (!(link.upper - link.lower < 2.0 * kOnceRound)) return {index, 0.0, kOnceRound, lever};
  return {index, 0.5 * (link.lower + link.upper), 0.5 * (link.upper - link.lower), lever};
}

/// The longest that the arm to a link gets, m.
double longest_arm(const Link& link) {
  if (link.joint == Joint::revolute) return link.at.norm();
  return link.at.norm() + link.axis.norm() * std::max(std::abs(link.lower), std::abs(link.upper));
}

/// The joints' values, around their middles.
struct ValueBox {
  std::vector<double> middle, half;
};

class Proof {
 public:
  Proof(std::span<const Link> linkage, const LinkPair& links) : linkage_(linkage), links_(links) {
    const std::uint32_t ancestor = nearest_common_ancestor(linkage, links);
    climb(links.a, ancestor);
    end_of_a_ = joints_.size();
    climb(links.b, ancestor);
  }

  bool succeeds(std::size_t effort) {
    ValueBox all;
    for (const Between& joint : joints_) {
      if (!std::isfinite(joint.middle) || !std::isfinite(joint.half)) return false;
      all.middle.push_back(joint.middle), all.half.push_back(joint.half);
    }
    std::vector<ValueBox> open{std::move(all)};
    for (; !open.empty() && effort > 0; --effort) {
      const ValueBox box = std::move(open.back());
      open.pop_back();
      const double gap = gap_at(box);
      if (!(gap > 0.0)) return false;
      if (gap <= moved_within(box)) halve(box, open);
    }
    return open.empty();
  }

 private:
  void climb(std::uint32_t link, std::uint32_t ancestor) {
    double lever = reach(*linkage_[link].shape), turned = 1.0;
    for (; link != ancestor; link = linkage_[link].parent) {
      joints_.push_back(between(linkage_[link], link, lever));
      lever += longest_arm(linkage_[link]);
      turned += std::abs(linkage_[link].angle);
      if (linkage_[link].joint == Joint::revolute) turned += std::abs(joints_.back().middle);
    }
    rounding_ += 0x1p-40 * lever * turned;
  }

  double gap_at(const ValueBox& box) {
    const Pose a = placed(box, 0, end_of_a_), b = placed(box, end_of_a_, joints_.size());
    return rough_separation(*linkage_[links_.a].shape, a, *linkage_[links_.b].shape, b, 0.25).lower;
  }

  /// Seen from the common ancestor, however far from the world's origin that is; of joints from `first` to
  /// `last`, which lead to it.
  Pose placed(const ValueBox& box, std::size_t first, std::size_t last) const {
    Pose stands;
    double angle = 0.0;
    while (last > first) {
      const Link& link = linkage_[joints_[--last].link];
      angle += link.angle + (link.joint == Joint::revolute ? box.middle[last] : 0.0);
      stands = pose(stands * offset(link, box.middle[last]), angle);
    }
    return stands;
  }

  /// At most, rounding included.
  double moved_within(const ValueBox& box) const {
    double moved = rounding_;
    for (std::size_t i = 0; i < joints_.size(); ++i) moved += box.half[i] * joints_[i].lever;
    return moved;
  }

  /// Across the joint that moves the most.
  void halve(const ValueBox& box, std::vector<ValueBox>& open) const {
    std::size_t widest = 0;
    for (std::size_t i = 1; i < joints_.size(); ++i)
      if (box.half[i] * joints_[i].lever > box.half[widest] * joints_[widest].lever) widest = i;
    for (double side : {-0.5, 0.5}) {
      open.push_back(box);
      open.back().middle[widest] += side * box.half[widest];
      open.back().half[widest] *= 0.5;
    }
  }

  std::span<const Link> linkage_;
  LinkPair links_;
  std::vector<Between> joints_;  ///< from a to the common ancestor, those from b to it from
  std::size_t end_of_a_;         ///< here on
  double rounding_ = 0.0;        ///< m, of all lengths between the two, however they turn
};

}  // namespace

bool limits_keep_apart(std::span<const Link> linkage, const LinkPair& links, std::size_t effort) {
  return Proof(linkage, links).succeeds(effort);
}

}  // namespace throng::narrowphase
