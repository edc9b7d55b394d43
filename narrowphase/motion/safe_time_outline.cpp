// SPDX-License-Identifier: MIT
#include "narrowphase/bvh_containment-inl.h"
#include "narrowphase/motion/safe_time-inl.h"

namespace throng::narrowphase {

namespace {

/// Two edges, in the frame of a.
template <class Volume>
class EdgePairs {
 public:
  EdgePairs(const Outline<Volume>& a, const Outline<Volume>& b, const Pose& b_in_a, const Frame<2>& frame,
            const GapRate& rate)
      : a_(a), b_(b), b_in_a_(b_in_a), slack_(frame.slack), rate_(rate) {}

  template <class Node>
  bool operator()(const Node& node_a, const Node& node_b, Shortest& best) const {
    const double mu = rate_.of(node_a.far, node_b.far);
    const Branch &of_a = node_a.branch, &of_b = node_b.branch;
    for (std::uint32_t j = of_b.first; j < of_b.first + of_b.count; ++j) {
      const OutlineEdge& f = b_.edges[j];
      const Vec r = b_in_a_ * f.p, s = b_in_a_ * f.q;
      for (std::uint32_t i = of_a.first; i < of_a.first + of_a.count; ++i) {
        const OutlineEdge& e = a_.edges[i];
        const EdgePairPoints nearest = nearest_of_edges(e.p, e.q, r, s);
        if (nearest.squared == 0.0) return best.time = {0.0, 0.0, true, e.index, f.index}, true;
        const std::array<Vec, 2> ends_a{e.p, e.q}, ends_b{f.p, f.q};
        const Vec normal = normal_of_edges(nearest, e.p, e.q, r, s);
        best.consider(std::sqrt(nearest.squared) - slack_, mu,
                      {{ends_a, Pose{}, node_a.far}, {ends_b, b_in_a_, node_b.far}, normal, slack_}, e.index,
                      f.index);
      }
    }
    return false;
  }

 private:
  const Outline<Volume>&a_, &b_;
  const Pose& b_in_a_;
  double slack_;
  const GapRate& rate_;
};

}  // namespace

template <class Volume>
SafeTime safe_time(const Outline<Volume>& a, const Pose& pose_a, const Outline<Volume>& b, const Pose& pose_b,
                   const GapRate& rate, const SafeTimeQuestion& question, BvhCounters* counters) {
  const Pose b_in_a = relative(pose_a, pose_b);
  Frame<2> placed = frame(b_in_a, a.tree.reach + b.tree.reach);
  placed.slack += question.pose_error;
  RelativeMotion motion;
  SafeTimeQuestion asked = question;
  asked.motion = seen_from(pose_a, question.motion, motion);
  Shortest best{asked};
  const OnTheirWay<Volume> way{a.tree, b.tree, placed, rate, asked.motion};
  counting(counters, [&](auto& c) { shorten(way, best, EdgePairs<Volume>(a, b, b_in_a, placed, rate), c); });
  if (!best.time.hit && one_holds_the_other(PlacedOutlines<Volume>{a, b, b_in_a, placed}))
    return {0.0, 0.0, true, best.time.part_a, best.time.part_b};
  return best.time;
}

#define THRONG_SAFE_TIME(VOLUME)                                                                        \
  template SafeTime safe_time(const Outline<VOLUME>&, const Pose&, const Outline<VOLUME>&, const Pose&, \
                              const GapRate&, const SafeTimeQuestion&, BvhCounters*);
THRONG_SAFE_TIME(Ball<2>)
THRONG_SAFE_TIME(Box<2>)
THRONG_SAFE_TIME(OrientedBox<2>)
THRONG_SAFE_TIME(BoxAndBall<2>)
#undef THRONG_SAFE_TIME

}  // namespace throng::narrowphase
