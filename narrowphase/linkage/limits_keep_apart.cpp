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
  double lever;         ///< m a rad, or 1
};

double reach(const PartsBvh& shape) {
  return shape.tree.nodes[0].far;
}

/// Of a revolute joint no more than once round.
Between between(const Link& link, std::uint32_t index, double lever) {
  constexpr double kOnceRound = 3.15;
  if (link.joint == Joint::prismatic)
    return {index, 0.5 * (link.lower + link.upper), 0.5 * (link.upper - link.lower), 1.0};
  if (!(link.upper - link.lower < 2.0 * kOnceRound)) return {index, 0.0, kOnceRound, lever};
  return {index, 0.5 * (link.lower + link.upper), 0.5 * (link.upper - link.lower), lever};
}

/// The longest that the arm to a link gets, m.
double longest_arm(const Link& link) {
  if (link.joint == Joint::revolute) return link.at.norm();
  return link.at.norm() + std::max(std::abs(link.lower), std::abs(link.upper));
}

/// The joints' values, around their middles.
struct ValueBox {
  std::vector<double> middle, half;
};

class Proof {
 public:
  Proof(std::span<const Link> linkage, const LinkPair& links)
      : linkage_(linkage), links_(links), values_(linkage.size(), 0.0), poses_(linkage.size()) {
    const std::uint32_t ancestor = nearest_common_ancestor(linkage, links);
    for (std::uint32_t end : {links.a, links.b}) {
      double lever = reach(*linkage[end].shape);
      for (; end != ancestor; end = linkage[end].parent) {
        joints_.push_back(between(linkage[end], end, lever));
        lever += longest_arm(linkage[end]);
      }
      size_ += lever;
    }
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
  double gap_at(const ValueBox& box) {
    for (std::size_t i = 0; i < joints_.size(); ++i) values_[joints_[i].link] = box.middle[i];
    place_links(linkage_, values_, poses_);
    return rough_separation(*linkage_[links_.a].shape, poses_[links_.a], *linkage_[links_.b].shape,
                            poses_[links_.b], 0.25)
        .lower;
  }

  /// At most, rounding included.
  double moved_within(const ValueBox& box) const {
    double moved = 0x1p-40 * size_;
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
  std::vector<Between> joints_;
  std::vector<double> values_;
  std::vector<Pose> poses_;
  double size_ = 0.0;  ///< m, of all lengths between the two
};

}  // namespace

bool limits_keep_apart(std::span<const Link> linkage, const LinkPair& links, std::size_t effort) {
  return Proof(linkage, links).succeeds(effort);
}

}  // namespace throng::narrowphase
