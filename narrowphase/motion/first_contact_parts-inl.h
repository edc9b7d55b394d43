// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <tuple>

#include "narrowphase/motion/first_contact_parts.h"
#include "narrowphase/relative.h"

/// The walk behind the first contact of solids, for any hierarchy in the plane. For its sources alone.
namespace throng::narrowphase {

/// Two nodes that surely don't touch before `time`.
struct Waiting {
  double time;
  NodePair pair;
};

inline bool comes_later(const Waiting& x, const Waiting& y) {
  return std::tie(x.time, x.pair.a, x.pair.b) > std::tie(y.time, y.pair.a, y.pair.b);
}

/// Of two contacts the earlier one, its bracket closed by the other where that is certain sooner; a doubt
/// that lasts until a certain hit begins is part of its bracket. Of equals the first.
inline FirstPartsContact merged(FirstPartsContact first, FirstPartsContact second) {
  if (first.contact.verdict == Verdict::free) return second;
  if (second.contact.t_lo < first.contact.t_lo) std::swap(first, second);
  const FirstContact& later = second.contact;
  const bool closes = later.verdict == Verdict::hit && later.t_lo <= first.contact.t_hi;
  if (!closes || (first.contact.verdict == Verdict::hit && later.t_hi >= first.contact.t_hi)) return first;
  second.contact.t_lo = first.contact.t_lo;
  return second;
}

/// Of two solids on their ways. `Leaves` has the solid's `tree()`, and of the thing at a place of its leaves
/// `shape(place)`, as it is until the next one is asked for, and `name(place)`.
template <class Leaves>
class Race {
 public:
  Race(Leaves a, const Motion& motion_a, Leaves b, const Motion& motion_b, double duration,
       const PartsQuestion& question)
      : a_(std::move(a)),
        b_(std::move(b)),
        motion_a_(motion_a),
        motion_b_(motion_b),
        duration_(duration),
        question_(question),
        rate_(gap_rate(motion_a, motion_b)),
        best_{{Verdict::free, duration, duration, 0}, 0, 0} {}

  FirstPartsContact run() {
    push({0.0, {0, 0}});
    while (!queue_.empty()) {
      std::pop_heap(queue_.begin(), queue_.end(), comes_later);
      const Waiting first = queue_.back();
      queue_.pop_back();
      if (comes_too_late(first.time)) break;
      if (nodes_ + evaluations_ >= question_.looks) {
        best_ = merged(best_, {{Verdict::undecided, first.time, best_.contact.t_hi, 0}, 0, 0});
        break;
      }
      look(first);
    }
    best_.contact.evaluations =
        static_cast<int>(std::min<std::int64_t>(evaluations_, std::numeric_limits<int>::max()));
    if (question_.counters) question_.counters->nodes += static_cast<std::size_t>(nodes_);
    return best_;
  }

 private:
  bool comes_too_late(double time) const {
    return best_.contact.verdict == Verdict::free ? time > duration_ : time >= best_.contact.t_hi;
  }

  void push(const Waiting& waiting) {
    queue_.push_back(waiting);
    std::push_heap(queue_.begin(), queue_.end(), comes_later);
  }

  /// The two nodes where they stand then: to wait on, to be opened, or two parts at last.
  void look(const Waiting& now) {
    ++nodes_;
    const auto &node_a = a_.tree().nodes[now.pair.a], &node_b = b_.tree().nodes[now.pair.b];
    const double gap = bound(node_a.volume, node_b.volume, frame_at(now.time));
    const double mu = rate_.of(node_a.far, node_b.far);
    const double time = gap > 0.0 ? now.time + (1.0 - 0x1p-48) * (gap / mu) : now.time;
    if (comes_too_late(time)) return;
    if (gap > 0.5 * (radius(node_a.volume) + radius(node_b.volume)) && time > now.time)
      push({time, now.pair});
    else if (are_leaves(a_.tree(), b_.tree(), now.pair))
      compare(node_a.branch, node_b.branch, time);
    else
      for (const NodePair& half : opened(a_.tree(), b_.tree(), now.pair)) push({time, half});
  }

  /// Its slack covers the poses too, which rounding moves by.
  Frame<2> frame_at(double time) const {
    Frame<2> b_in_a = frame(relative(pose_at(motion_a_, time), pose_at(motion_b_, time)),
                            a_.tree().reach + b_.tree().reach);
    b_in_a.slack += pose_rounding(motion_a_, time, a_.tree().nodes[0].far) +
                    pose_rounding(motion_b_, time, b_.tree().nodes[0].far);
    return b_in_a;
  }

  void compare(const Branch& of_a, const Branch& of_b, double from) {
    if (question_.counters) ++question_.counters->leaves;
    for (std::uint32_t k = of_a.first; k < of_a.first + of_a.count; ++k)
      for (std::uint32_t l = of_b.first; l < of_b.first + of_b.count; ++l) consider(k, l, from);
  }

  void consider(std::uint32_t k, std::uint32_t l, double from) {
    if (comes_too_late(from)) return;
    ContactQuestion question{question_.width, question_.evaluations, from};
    const FirstContact found =
        first_contact(a_.shape(k), motion_a_, b_.shape(l), motion_b_, best_.contact.t_hi, question);
    evaluations_ += found.evaluations;
    if (found.verdict != Verdict::free) best_ = merged(best_, {found, a_.name(k), b_.name(l)});
  }

  Leaves a_, b_;
  const Motion &motion_a_, &motion_b_;
  double duration_;
  const PartsQuestion& question_;
  GapRate rate_;
  FirstPartsContact best_;
  std::vector<Waiting> queue_;
  std::int64_t nodes_ = 0, evaluations_ = 0;
};

}  // namespace throng::narrowphase
