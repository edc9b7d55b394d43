// SPDX-License-Identifier: MIT
// The search of a proximity tree, compiled once for each SIMD target: no include guard but Highway's.
#if defined(THRONG_PROXIMITY_SEARCH_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef THRONG_PROXIMITY_SEARCH_INL
#undef THRONG_PROXIMITY_SEARCH_INL
#else
#define THRONG_PROXIMITY_SEARCH_INL
#endif

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "broadphase/proximity_search.h"
#include "broadphase/proximity_space-inl.h"
#include "broadphase/proximity_upper-inl.h"

HWY_BEFORE_NAMESPACE();
namespace throng::broadphase::HWY_NAMESPACE {

/// Where the search meets items, how far they are, as a key that orders them: the distance of a disc, of all
/// else its square.
template <class Space, ProximityTree::Kind kKind>
class Search {
 public:
  using UpperPart = Upper<Space, kKind>;
  static constexpr bool kSquares = kKind != ProximityTree::Kind::discs;

  Search(const ProximityTree& tree, const Question& question, const Near& near)
      : tree_(tree),
        space_(tree.period),
        x_(hn::Set(D(), question.at.x())),
        y_(hn::Set(D(), question.at.y())),
        heading_x_(hn::Set(D(), question.heading.x())),
        heading_y_(hn::Set(D(), question.heading.y())),
        cos_(hn::Set(D(), near.view.cos_half)),
        sin_(hn::Set(D(), near.view.sin_half)),
        except_(hn::Set(U(), question.except)),
        groups_(hn::Set(U(), near.groups)),
        limited_view_(!near.view.all_around()),
        ahead_only_(limited_view_ && near.view.cos_half >= 0.0 && !Space::kWraps),
        grouped_(!tree.leaf_groups.empty()) {}

  /// The largest key of a distance of at most `radius`; finite, since what is unused is infinitely far away.
  static double radius_key(double radius) {
    return std::min(kSquares ? radius * radius : radius, std::numeric_limits<double>::max());
  }
  /// A key that no item has whose distance is larger, and that all have whose distance is as large: two
  /// squares may have one root.
  static double distance_key(double distance) {
    constexpr double kEpsilon = std::numeric_limits<double>::epsilon();
    return kSquares ? distance * distance * (1.0 + 4.0 * kEpsilon) + std::numeric_limits<double>::min()
                    : distance;
  }
  static double distance(double key) { return kSquares ? std::sqrt(key) : key; }

  /// Meets all that may be within `sink.limit()`.
  template <class Sink>
  void run(Sink& sink) const {
    if (!tree_.leaves.empty()) descend(tree_.level.size() - 2, 0, sink);
  }

  /// The same, below some parents of leaves alone.
  template <class Sink>
  void run(std::span<const std::uint32_t> parents, Sink& sink) const {
    for (const std::uint32_t node : parents) descend(0, node, sink);
  }

  /// The same for a limit that shrinks with what is met: what may be nearest is met first, and of equally
  /// near ones that with the lowest row; where `sink.has_better` says so, nothing.
  template <class Sink>
  void run_nearest_first(Sink& sink) const {
    if (!tree_.leaves.empty()) descend_nearest_first(tree_.level.size() - 2, 0, sink);
  }

  /// Meets the leaves beside the place along the curve, twice as many as hold `wanted` items.
  template <class Sink>
  void meet_around(std::size_t leaf, std::size_t wanted, Sink& sink) const {
    if (tree_.leaves.empty()) return;
    if (leaf == kNoLeaf) leaf = nearest_leaf();
    const std::size_t reach = std::max<std::size_t>(wanted / ProximityTree::kWidth, 1);
    const std::size_t end = std::min(leaf + reach + 1, tree_.leaves.size());
    for (std::size_t i = leaf - std::min(leaf, reach); i < end; ++i) meet_leaf(i, sink);
  }

 private:
  template <class Sink>
  void descend(std::size_t level, std::size_t node, Sink& sink) const {
    alignas(64) double key[ProximityTree::kWidth];
    std::uint32_t left = children(tree_.level[level] + node, sink.limit(), key);
    for (; left != 0; left &= left - 1) {
      const auto i = static_cast<std::size_t>(std::countr_zero(left));
      const std::size_t child = node * ProximityTree::kWidth + i;
      if (level > 0)
        descend(level - 1, child, sink);
      else
        meet_leaf(child, sink);
    }
  }

  template <class Sink>
  void descend_nearest_first(std::size_t level, std::size_t node, Sink& sink) const {
    alignas(64) double key[ProximityTree::kWidth];
    const std::uint32_t* first_row = tree_.first_row[tree_.level[level] + node].of;
    std::uint32_t left = children(tree_.level[level] + node, sink.limit(), key);
    while (left != 0) {
      auto next = static_cast<std::size_t>(std::countr_zero(left));
      for (std::uint32_t rest = left & (left - 1); rest != 0; rest &= rest - 1) {
        const auto other = static_cast<std::size_t>(std::countr_zero(rest));
        if (key[other] < key[next] || (key[other] == key[next] && first_row[other] < first_row[next]))
          next = other;
      }
      if (key[next] > sink.limit()) return;
      left &= ~(1U << next);
      if (sink.has_better(key[next], first_row[next])) continue;
      const std::size_t child = node * ProximityTree::kWidth + next;
      if (level > 0)
        descend_nearest_first(level - 1, child, sink);
      else
        meet_leaf(child, sink);
    }
  }

  /// Always into the child that is nearest: good enough to begin with.
  std::size_t nearest_leaf() const {
    std::size_t node = 0;
    for (std::size_t level = tree_.level.size() - 1; level-- > 0;) {
      alignas(64) double key[ProximityTree::kWidth];
      children(tree_.level[level] + node, std::numeric_limits<double>::max(), key);
      const auto nearest = std::min_element(key, key + ProximityTree::kWidth) - key;
      node = node * ProximityTree::kWidth + static_cast<std::size_t>(nearest);
    }
    return node;
  }

  /// The children of a node that may hold what is looked for, a bit each, and the least key in them.
  HWY_INLINE std::uint32_t children(std::size_t index, double limit, double* key) const {
    const ProximityTree::Node& node = tree_.nodes[index];
    std::uint32_t found = 0;
    for (std::size_t i = 0; i < ProximityTree::kWidth; i += kLanes) {
      const Reals low_x = hn::Load(D(), node.low_x + i), low_y = hn::Load(D(), node.low_y + i);
      const Reals high_x = hn::Load(D(), node.high_x + i), high_y = hn::Load(D(), node.high_y + i);
      const Reals dx = space_.template to<0>(x_, x_, low_x, high_x),
                  dy = space_.template to<1>(y_, y_, low_y, high_y);
      Reals nearest = squared(dx, dy);
      if constexpr (kKind == ProximityTree::Kind::discs)
        nearest = hn::Sub(hn::Sqrt(nearest), hn::Load(D(), tree_.node_radius[index].of + i));
      Mask mask = hn::Le(nearest, hn::Set(D(), limit));
      if (ahead_only_) mask = hn::And(mask, reaches_ahead(low_x, low_y, high_x, high_y));
      if (grouped_) mask = hn::And(mask, wanted(tree_.node_groups[index].of + i));
      hn::Store(nearest, D(), key + i);
      found |= bits(mask) << i;
    }
    return found;
  }

  template <class Sink>
  HWY_INLINE void meet_leaf(std::size_t index, Sink& sink) const {
    const ProximityTree::Leaf& leaf = tree_.leaves[index];
    for (std::size_t i = 0; i < ProximityTree::kWidth; i += kLanes) {
      Reals dx, dy;
      const Reals x = hn::Load(D(), leaf.x + i), y = hn::Load(D(), leaf.y + i);
      if constexpr (kKind == ProximityTree::Kind::boxes) {
        dx = to_interval(x_, x, hn::Load(D(), tree_.leaf_high[index].x + i));
        dy = to_interval(y_, y, hn::Load(D(), tree_.leaf_high[index].y + i));
      } else {
        dx = space_.template to<0>(x_, x);
        dy = space_.template to<1>(y_, y);
      }
      Reals key = squared(dx, dy);
      if constexpr (kKind == ProximityTree::Kind::discs)
        key = hn::Sub(hn::Sqrt(key), hn::Load(D(), tree_.leaf_radius[index].of + i));
      const Rows rows = hn::Load(U(), leaf.row + i);
      Mask mask =
          hn::And(hn::Le(key, hn::Set(D(), sink.limit())), hn::RebindMask(D(), hn::Ne(rows, except_)));
      if (limited_view_) mask = hn::And(mask, seen(dx, dy));
      if (grouped_) mask = hn::And(mask, wanted(tree_.leaf_groups[index].of + i));
      sink.take(mask, key, rows);
    }
  }

  /// From p to the nearest point of an interval, with its sign.
  static HWY_INLINE Reals to_interval(Reals p, Reals low, Reals high) {
    const Reals zero = hn::Zero(D());
    return hn::Add(hn::Max(hn::Sub(low, p), zero), hn::Min(hn::Sub(high, p), zero));
  }

  /// `FieldOfView::sees`.
  HWY_INLINE Mask seen(Reals dx, Reals dy) const {
    const Reals across = hn::Sub(hn::Mul(heading_x_, dy), hn::Mul(heading_y_, dx));
    const Reals ahead = hn::Add(hn::Mul(heading_x_, dx), hn::Mul(heading_y_, dy));
    return hn::Le(hn::Mul(hn::Abs(across), cos_), hn::Mul(ahead, sin_));
  }

  /// Of a view of half a turn or less: whether a box reaches before the eye. Rounding keeps order, so what is
  /// seen is never lost.
  HWY_INLINE Mask reaches_ahead(Reals low_x, Reals low_y, Reals high_x, Reals high_y) const {
    const Reals x =
        hn::Max(hn::Mul(heading_x_, hn::Sub(low_x, x_)), hn::Mul(heading_x_, hn::Sub(high_x, x_)));
    const Reals y =
        hn::Max(hn::Mul(heading_y_, hn::Sub(low_y, y_)), hn::Mul(heading_y_, hn::Sub(high_y, y_)));
    return hn::Ge(hn::Mul(hn::Add(x, y), sin_), hn::Zero(D()));
  }

  HWY_INLINE Mask wanted(const std::uint64_t* groups) const {
    return hn::RebindMask(D(), hn::Ne(hn::And(hn::Load(U(), groups), groups_), hn::Zero(U())));
  }

 public:
  static HWY_INLINE std::uint32_t bits(Mask mask) {
    std::uint8_t byte[8] = {};
    hn::StoreMaskBits(D(), mask, byte);
    return byte[0];
  }

 private:
  const ProximityTree& tree_;
  Space space_;
  Reals x_, y_, heading_x_, heading_y_, cos_, sin_;
  Rows except_, groups_;
  bool limited_view_, ahead_only_, grouped_;
};

}  // namespace throng::broadphase::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
