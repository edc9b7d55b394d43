// SPDX-License-Identifier: MIT
// The part of a search that places near one another share; see proximity_search-inl.h.
#if defined(THRONG_PROXIMITY_UPPER_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef THRONG_PROXIMITY_UPPER_INL
#undef THRONG_PROXIMITY_UPPER_INL
#else
#define THRONG_PROXIMITY_UPPER_INL
#endif

#include <bit>
#include <vector>

#include "broadphase/proximity_space-inl.h"

HWY_BEFORE_NAMESPACE();
namespace throng::broadphase::HWY_NAMESPACE {

/// Searches the upper part of a tree once for all places of a box: the parents of leaves in which something
/// may be within a limit of one of them.
template <class Space, ProximityTree::Kind kKind>
class Upper {
 public:
  Upper(const ProximityTree& tree, const Box& places, double limit, std::vector<std::uint32_t>& parents)
      : tree_(tree), space_(tree.period), limit_(limit), parents_(parents) {
    for (int axis = 0; axis < 2; ++axis) {
      low_[axis] = hn::Set(D(), places.min()[axis]);
      high_[axis] = hn::Set(D(), places.max()[axis]);
    }
  }

  /// False where there are too many to be worth it.
  bool run() {
    parents_.clear();
    return tree_.leaves.empty() || descend(tree_.level.size() - 2, 0);
  }

 private:
  static constexpr std::size_t kMost = 24;  // parents, of 64 items each

  bool descend(std::size_t level, std::size_t node) {
    if (level == 0) parents_.push_back(static_cast<std::uint32_t>(node));
    if (level == 0) return parents_.size() <= kMost;
    for (std::uint32_t left = children(tree_.level[level] + node); left != 0; left &= left - 1)
      if (!descend(level - 1,
                   node * ProximityTree::kWidth + static_cast<std::size_t>(std::countr_zero(left))))
        return false;
    return true;
  }

  HWY_INLINE std::uint32_t children(std::size_t index) const {
    const ProximityTree::Node& node = tree_.nodes[index];
    std::uint32_t found = 0;
    for (std::size_t i = 0; i < ProximityTree::kWidth; i += kLanes) {
      const Reals dx = space_.template to<0>(low_[0], high_[0], hn::Load(D(), node.low_x + i),
                                             hn::Load(D(), node.high_x + i));
      const Reals dy = space_.template to<1>(low_[1], high_[1], hn::Load(D(), node.low_y + i),
                                             hn::Load(D(), node.high_y + i));
      Reals nearest = squared(dx, dy);
      if constexpr (kKind == ProximityTree::Kind::discs)
        nearest = hn::Sub(hn::Sqrt(nearest), hn::Load(D(), tree_.node_radius[index].of + i));
      std::uint8_t byte[8] = {};
      hn::StoreMaskBits(D(), hn::Le(nearest, hn::Set(D(), limit_)), byte);
      found |= std::uint32_t{byte[0]} << i;
    }
    return found;
  }

  const ProximityTree& tree_;
  Space space_;
  double limit_;
  std::vector<std::uint32_t>& parents_;
  Reals low_[2], high_[2];
};

}  // namespace throng::broadphase::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
