// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <limits>

#include "narrowphase/bvh_traverse.h"
#include "narrowphase/motion/safe_time.h"
#include "narrowphase/relative.h"

/// The walk behind `safe_time`, for any hierarchy in the plane. For its sources alone.
namespace throng::narrowphase {

/// How long a lower bound of a distance lasts; one that isn't above 0 is only worth looking into, the lower
/// the sooner.
inline double lasting(double distance, double rate) {
  return distance > 0.0 ? (1.0 - 0x1p-48) * (distance / rate) : distance;
}

/// Of a thing that is rounded by `radius`, in a node that reaches `far`: how far its core goes, which alone
/// changes distances by turning.
inline double core_far(double far, double radius) {
  return std::max(0.0, far - radius);
}

/// The times so far, and which can't shorten them by more than is accepted.
struct Shortest {
  const SafeTimeQuestion& question;
  SafeTime time{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity(), false, 0,
                0};
  ClearTime left_out = {time.before, time.after};  ///< of what is long enough, the least: apart from
                                                   ///< `time`, lest one accepted error go into the next

  ClearTime enough() const {
    const double share = 1.0 / (1.0 + question.relative_error);
    return {std::min(question.before, share * time.before), std::min(question.after, share * time.after)};
  }
  bool is_enough(const ClearTime& clear) const {
    const ClearTime least = enough();
    return clear.before >= least.before && clear.after >= least.after;
  }
  void leave_out(const ClearTime& clear) { left_out = shorter(left_out, clear); }
  void shorten(const ClearTime& clear) {
    time.before = std::min(time.before, clear.before);
    time.after = std::min(time.after, clear.after);
  }

  /// Things that are apart along a gap, whose distance changes by `rate` at most.
  void consider(double distance, double rate, const OpenGap& gap, std::uint32_t i, std::uint32_t j) {
    const double least = std::max(0.0, lasting(distance, rate));
    ClearTime clear{least, least};
    if (is_enough(clear)) return leave_out(clear);
    if (question.motion != nullptr)
      clear = longer(clear, clear_time(gap, *question.motion, {question.before, question.after}));
    if (clear.before < time.before || clear.after < time.after) time.part_a = i, time.part_b = j;
    shorten(clear);
  }
};

/// The motion as seen in a frame that stands at `pose`, kept in `turned`; none where there is none.
inline const RelativeMotion* seen_from(const Pose& pose, const RelativeMotion* motion,
                                       RelativeMotion& turned) {
  if (motion == nullptr) return nullptr;
  turned = *motion;
  turned.velocity = pose.unrotate(motion->velocity);
  return &turned;
}

/// Two hierarchies on their way: b in the frame of a, and its motion as seen there.
template <class Volume>
struct OnTheirWay {
  const Bvh<Volume>&a, &b;
  const Frame<2>& b_in_a;
  const GapRate& rate;
  const RelativeMotion* motion;
  double origins_apart = b_in_a.shift.norm() - b_in_a.slack;

  /// No more than how long the two nodes' things stay apart; where that isn't known below 0.
  ClearTime clear(const NodePair& pair, const Shortest& best) const {
    const auto &node_a = a.nodes[pair.a], &node_b = b.nodes[pair.b];
    const ClearTime enough = best.enough();
    const double wanted = std::max(enough.before, enough.after);
    const double however_turned = lasting(origins_apart - (node_a.far + node_b.far), rate.shift);
    if (however_turned >= wanted) return {however_turned, however_turned};
    const double mu = rate.of(node_a.far, node_b.far);
    const double gap = bound(node_a.volume, node_b.volume, b_in_a, (1.0 + 0x1p-46) * (wanted * mu));
    const double straight = lasting(gap, mu);
    if (straight >= wanted || !(gap > 0.0) || motion == nullptr) return {straight, straight};
    return longer({straight, straight}, of_balls(node_a.volume, node_b.volume));
  }

 private:
  ClearTime of_balls(const Volume& of_a, const Volume& of_b) const {
    const Vec arm_a = of_a.centre, arm_b = b_in_a.turn * of_b.centre;
    const BallGap gap{arm_a, arm_b, arm_b + b_in_a.shift - arm_a, radius(of_a) + radius(of_b) + b_in_a.slack};
    return clear_time(gap, *motion);
  }
};

/// Shortens `best` by all pairs of leaves: depth first, the more urgent first. `leaf(node of a, node of b,
/// best)` looks at one, and says whether it is a hit, which ends the walk.
template <class Volume, class Leaf, class Counters>
void shorten(const OnTheirWay<Volume>& way, Shortest& best, Leaf leaf, Counters& counters) {
  struct Bounded {
    ClearTime clear;
    NodePair pair;

    double urgency() const { return std::min(clear.before, clear.after); }
  };
  const auto bounded = [&](const NodePair& pair) {
    ++counters.nodes;
    return Bounded{way.clear(pair, best), pair};
  };
  TraversalStack<Bounded> stack;
  stack.push(bounded({0, 0}));
  while (!stack.empty()) {
    const Bounded top = stack.pop();
    if (best.is_enough(top.clear)) {
      best.leave_out(top.clear);
      continue;
    }
    if (are_leaves(way.a, way.b, top.pair)) {
      ++counters.leaves;
      if (leaf(way.a.nodes[top.pair.a], way.b.nodes[top.pair.b], best)) return;
      continue;
    }
    const auto halves = opened(way.a, way.b, top.pair);
    const Bounded first = bounded(halves[0]), second = bounded(halves[1]);
    stack.push(first.urgency() <= second.urgency() ? second : first);
    stack.push(first.urgency() <= second.urgency() ? first : second);
  }
  best.shorten(best.left_out);
}

}  // namespace throng::narrowphase
