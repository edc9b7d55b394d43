// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <limits>
#include <numeric>

#include "narrowphase/bvh.h"

namespace throng::narrowphase {

namespace {

constexpr int kBins = 16;

/// A box that grows.
template <int kDim>
struct GrowingBox {
  Point<kDim> low = Point<kDim>::Constant(std::numeric_limits<double>::infinity());
  Point<kDim> high = Point<kDim>::Constant(-std::numeric_limits<double>::infinity());

  void add(const Point<kDim>& p, const Point<kDim>& q) { low = low.cwiseMin(p), high = high.cwiseMax(q); }
  Point<kDim> sides() const { return high - low; }
  /// What the chance of a hit grows with: half the perimeter, or half the surface.
  double measure() const {
    const Point<kDim> s = sides();
    if constexpr (kDim == 2) return s[0] + s[1];
    return s[0] * s[1] + s[1] * s[2] + s[2] * s[0];
  }
};

/// The things that go left have a centre (twice it) below `at` on `axis`; or the first half does, where no
/// plane parts them.
struct Plane {
  int axis = -1;
  double at = 0.0;
  double cost = std::numeric_limits<double>::infinity();
};

template <int kDim>
class Splitter {
 public:
  Splitter(const std::vector<Thing<kDim>>& things, const BvhConfig& config)
      : things_(things), config_(config) {
    result_.order.resize(things.size());
    std::iota(result_.order.begin(), result_.order.end(), 0u);
  }

  Topology run() {
    result_.branches.push_back({});
    std::vector<Task> tasks{{0, 0, static_cast<std::uint32_t>(things_.size()), 0}};
    while (!tasks.empty()) {
      const Task task = tasks.back();
      tasks.pop_back();
      if (task.end - task.begin <= config_.leaf) {
        result_.branches[task.node] = {task.begin, task.end - task.begin};
        continue;
      }
      const std::uint32_t middle = part(task);
      const auto child = static_cast<std::uint32_t>(result_.branches.size());
      result_.branches[task.node] = {child, 0};
      result_.branches.resize(child + 2);
      tasks.push_back({child + 1, middle, task.end, task.depth + 1});
      tasks.push_back({child, task.begin, middle, task.depth + 1});
    }
    return std::move(result_);
  }

 private:
  struct Task {
    std::uint32_t node, begin, end, depth;
  };

  double centre(std::uint32_t thing, int axis) const {
    return things_[thing].low[axis] + things_[thing].high[axis];
  }

  GrowingBox<kDim> centres(const Task& task) const {
    GrowingBox<kDim> result;
    for (std::uint32_t k = task.begin; k < task.end; ++k) {
      const Thing<kDim>& thing = things_[result_.order[k]];
      result.add(thing.low + thing.high, thing.low + thing.high);
    }
    return result;
  }

  std::uint32_t part(const Task& task) {
    const auto begin = result_.order.begin() + task.begin, end = result_.order.begin() + task.end;
    const GrowingBox<kDim> box = centres(task);
    const Plane plane = task.depth < kDeepestBvh / 2 ? best_plane(task, box) : Plane{};
    if (plane.axis >= 0) {
      const auto middle = std::partition(
          begin, end, [&](std::uint32_t thing) { return centre(thing, plane.axis) < plane.at; });
      if (middle != begin && middle != end) return static_cast<std::uint32_t>(middle - result_.order.begin());
    }
    return halve(task, longest(box));
  }

  std::uint32_t halve(const Task& task, int axis) {
    const std::uint32_t middle = task.begin + (task.end - task.begin) / 2;
    const auto order = result_.order.begin();
    std::nth_element(order + task.begin, order + middle, order + task.end,
                     [&](std::uint32_t i, std::uint32_t j) {
                       return centre(i, axis) != centre(j, axis) ? centre(i, axis) < centre(j, axis) : i < j;
                     });
    return middle;
  }

  static int longest(const GrowingBox<kDim>& box) {
    int axis = 0;
    box.sides().maxCoeff(&axis);
    return axis;
  }

  Plane best_plane(const Task& task, const GrowingBox<kDim>& box) const {
    const int axis = longest(box);
    if (config_.split == Split::middle) return {axis, box.low[axis] + 0.5 * box.sides()[axis], 0.0};
    Plane best;
    for (int i = 0; i < kDim; ++i)
      if (const Plane plane = cheapest(task, box, i); plane.cost < best.cost) best = plane;
    return best;
  }

  /// The border of bins with the least sum of measure times number on both sides.
  Plane cheapest(const Task& task, const GrowingBox<kDim>& box, int axis) const {
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    struct Bin {
      GrowingBox<kDim> extent;
      std::uint32_t count = 0;
    };
    const double low = box.low[axis], width = box.sides()[axis] / kBins;
    if (!(width > 0.0)) return {};
    std::array<Bin, kBins> bins;
    for (std::uint32_t k = task.begin; k < task.end; ++k) {
      const std::uint32_t thing = result_.order[k];
      const int bin = std::clamp(static_cast<int>((centre(thing, axis) - low) / width), 0, kBins - 1);
      bins[static_cast<std::size_t>(bin)].extent.add(things_[thing].low, things_[thing].high);
      ++bins[static_cast<std::size_t>(bin)].count;
    }
    std::array<double, kBins> left{};
    Bin sum;
    for (std::size_t i = 0; i + 1 < kBins; ++i) {
      if (bins[i].count > 0) sum.extent.add(bins[i].extent.low, bins[i].extent.high);
      sum.count += bins[i].count;
      left[i] = sum.count > 0 ? sum.count * sum.extent.measure() : kInfinity;
    }
    Plane best{axis, 0.0, kInfinity};
    sum = {};
    for (std::size_t i = kBins - 1; i > 0; --i) {
      if (bins[i].count > 0) sum.extent.add(bins[i].extent.low, bins[i].extent.high);
      sum.count += bins[i].count;
      if (sum.count == 0) continue;
      const double cost = left[i - 1] + sum.count * sum.extent.measure();
      if (cost < best.cost) best = {axis, low + static_cast<double>(i) * width, cost};
    }
    return best;
  }

  const std::vector<Thing<kDim>>& things_;
  const BvhConfig config_;
  Topology result_;
};

}  // namespace

template <int kDim>
Topology split(const std::vector<Thing<kDim>>& things, const BvhConfig& config) {
  return Splitter<kDim>(things, config).run();
}

template Topology split<2>(const std::vector<Thing<2>>&, const BvhConfig&);
template Topology split<3>(const std::vector<Thing<3>>&, const BvhConfig&);

}  // namespace throng::narrowphase
