// SPDX-License-Identifier: MIT
#include "narrowphase/motion/safe_time.h"

#include "narrowphase/motion/safe_time-inl.h"
#include "narrowphase/relative.h"

namespace throng::narrowphase {

SafeTime safe_time(const PartsBvh& a, const Pose& pose_a, const PartsBvh& b, const Pose& pose_b,
                   const GapRate& rate, const SafeTimeQuestion& question, BvhCounters* counters) {
  Frame<2> b_in_a = frame(relative(pose_a, pose_b), a.tree.reach + b.tree.reach);
  b_in_a.slack += question.pose_error;
  const auto leaf = [&](const auto& node_a, const auto& node_b, Shortest& best) {
    const Branch &of_a = node_a.branch, &of_b = node_b.branch;
    for (std::uint32_t k = of_a.first; k < of_a.first + of_a.count; ++k)
      for (std::uint32_t l = of_b.first; l < of_b.first + of_b.count; ++l) {
        const std::uint32_t i = a.tree.order[k], j = b.tree.order[l];
        const Separation apart = separation(a.parts[i], pose_a, b.parts[j], pose_b);
        if (apart.distance <= 0.0) {
          best.time = {0.0, 0.0, true, i, j};
          return true;
        }
        const double far_a = core_far(node_a.far, a.parts[i].radius);
        const double far_b = core_far(node_b.far, b.parts[j].radius);
        const OpenGap gap{{a.parts[i].vertices, pose_a, far_a},
                          {b.parts[j].vertices, pose_b, far_b},
                          apart.normal,
                          a.parts[i].radius + b.parts[j].radius + b_in_a.slack};
        best.consider(apart.distance - b_in_a.slack, rate.of(far_a, far_b), gap, i, j);
      }
    return false;
  };
  Shortest best{question};
  RelativeMotion motion;
  const OnTheirWay<BoxAndBall<2>> way{a.tree, b.tree, b_in_a, rate,
                                      seen_from(pose_a, question.motion, motion)};
  counting(counters, [&](auto& c) { shorten(way, best, leaf, c); });
  return best.time;
}

}  // namespace throng::narrowphase
