// SPDX-License-Identifier: MIT
#include "narrowphase/linkage/sampled_linkage.h"

#include <algorithm>
#include <cmath>

namespace throng::narrowphase {

namespace {

/// How far the point of all links goes that goes farthest: of each, the origin and an end. m.
double longest_way(std::span<const Link> linkage, std::span<const double> from, std::span<const double> to) {
  constexpr int kInstants = 64;
  LinkageMotion motion;
  motion.reset(linkage, from, to);
  std::vector<Pose> before(linkage.size()), after(linkage.size());
  std::vector<Vec> ways(linkage.size(), Vec(0.0, 0.0));  // of origin and end
  motion.place(0.0, before);
  for (int k = 1; k <= kInstants; ++k) {
    motion.place(static_cast<double>(k) / kInstants, after);
    for (std::size_t i = 0; i < linkage.size(); ++i) {
      const double far = linkage[i].shape == nullptr ? 0.0 : linkage[i].shape->tree.nodes[0].far;
      const Vec end{far, 0.0};
      ways[i] +=
          Vec((after[i].position - before[i].position).norm(), (after[i] * end - before[i] * end).norm());
    }
    std::swap(before, after);
  }
  double longest = 0.0;
  for (const Vec& way : ways) longest = std::max(longest, way.maxCoeff());
  return longest;
}

}  // namespace

LinkageAnswer sample_motion(LinkageChecker& checker, std::span<const double> from, std::span<const double> to,
                            double step) {
  const double count = std::max(1.0, std::ceil(longest_way(checker.scene().linkage, from, to) / step));
  LinkageAnswer answer;
  std::vector<double> values(from.size());
  for (double k = 0.0; k <= count; ++k) {
    const double time = k / count;
    for (std::size_t i = 0; i < values.size(); ++i) values[i] = from[i] + time * (to[i] - from[i]);
    ++answer.evaluations;
    if (const auto contact = checker.contact(values)) {
      answer.verdict = Verdict::hit;
      answer.from = answer.to = time;
      answer.pair = contact->pair, answer.part_a = contact->part_a, answer.part_b = contact->part_b;
      return answer;
    }
  }
  return answer;
}

}  // namespace throng::narrowphase
