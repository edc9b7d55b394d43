// SPDX-License-Identifier: MIT
#pragma once

#include "narrowphase/bvh_traverse.h"
#include "narrowphase/motion/safe_time.h"

/// The walk behind `safe_time`, for any hierarchy. For its sources alone.
namespace throng::narrowphase {

/// How long a lower bound of a distance lasts; one that isn't above 0 is only worth looking into, the lower
/// the sooner.
inline double lasting(double distance, double rate) {
  return distance > 0.0 ? (1.0 - 0x1p-48) * (distance / rate) : distance;
}

/// The times so far, and from which bound on a pair can't shorten them by more than is accepted.
struct Shortest {
  const SafeTimeQuestion& question;
  SafeTime time{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity(), false, 0,
                0};

  double enough() const {
    const double share = 1.0 / (1.0 + question.relative_error);
    return std::max(std::min(question.before, share * time.before),
                    std::min(question.after, share * time.after));
  }
  /// Things that are apart along a gap, whose distance changes by `rate` at most.
  void consider(double distance, double rate, const OpenGap& gap, std::uint32_t i, std::uint32_t j) {
    const double least = std::max(0.0, lasting(distance, rate));
    ClearTime clear{least, least};
    if (question.motion != nullptr && least < enough()) {
      const ClearTime longer = clear_time(gap, *question.motion, {question.before, question.after});
      clear = {std::max(least, longer.before), std::max(least, longer.after)};
    }
    consider(clear.before, clear.after, i, j);
  }
  void consider(double before, double after, std::uint32_t i, std::uint32_t j) {
    if (before < time.before || after < time.after) time.part_a = i, time.part_b = j;
    time.before = std::min(time.before, before);
    time.after = std::min(time.after, after);
  }
};

/// Of a thing that is rounded by `radius`, in a node that reaches `far`: how far its core goes, which alone
/// changes distances by turning.
inline double core_far(double far, double radius) {
  return std::max(0.0, far - radius);
}

/// Shortens `best` by all pairs of leaves: depth first, the more urgent first. `leaf(node of a, node of b,
/// best)` looks at one, and says whether it is a hit, which ends the walk.
template <class Volume, int kDim, class Leaf, class Counters>
void shorten(const Bvh<Volume>& a, const Bvh<Volume>& b, const Frame<kDim>& b_in_a, const GapRate& rate,
             Shortest& best, Leaf leaf, Counters& counters) {
  struct Bounded {
    double time;
    NodePair pair;
  };
  double least_skipped = std::numeric_limits<double>::infinity();
  const double origins_apart = b_in_a.shift.norm() - b_in_a.slack;
  const auto bounded = [&](const NodePair& pair) {
    ++counters.nodes;
    const auto &node_a = a.nodes[pair.a], &node_b = b.nodes[pair.b];
    const double however_turned = lasting(origins_apart - (node_a.far + node_b.far), rate.shift);
    if (however_turned >= best.enough()) return Bounded{however_turned, pair};
    const double mu = rate.of(node_a.far, node_b.far), enough = best.enough() * mu;
    const double gap = bound(node_a.volume, node_b.volume, b_in_a, (1.0 + 0x1p-46) * enough);
    return Bounded{lasting(gap, mu), pair};
  };
  TraversalStack<Bounded> stack;
  stack.push(bounded({0, 0}));
  while (!stack.empty()) {
    const Bounded top = stack.pop();
    if (top.time >= best.enough()) {
      least_skipped = std::min(least_skipped, top.time);
      continue;
    }
    if (are_leaves(a, b, top.pair)) {
      ++counters.leaves;
      if (leaf(a.nodes[top.pair.a], b.nodes[top.pair.b], best)) return;
      continue;
    }
    const auto halves = opened(a, b, top.pair);
    const Bounded first = bounded(halves[0]), second = bounded(halves[1]);
    stack.push(first.time <= second.time ? second : first);
    stack.push(first.time <= second.time ? first : second);
  }
  best.time.before = std::min(best.time.before, least_skipped);
  best.time.after = std::min(best.time.after, least_skipped);
}

}  // namespace throng::narrowphase
