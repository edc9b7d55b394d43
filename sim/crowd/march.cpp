// SPDX-License-Identifier: MIT
// Fast marching of second order: nodes become known in the order of their distance; a node's distance follows
// from the known ones before it, two deep where there are two.
#include "sim/crowd/march.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <queue>

namespace throng {

namespace {

constexpr double kDetour = 1.5;     // from the ground next to barriers, for each step back to free ground
constexpr double kDeepest = 250.0;  // steps

/// One axis of the equation |grad u| = 1: weight * (u - value)^2, in cells.
struct Upwind {
  double value = kUnreached, weight = 1.0;
};

class March {
 public:
  March(const FloorPlan& plan, const Barriers& barriers)
      : plan_(plan),
        barriers_(barriers),
        steps_{1, -1, plan.columns, -plan.columns},
        distance_(plan.size(), kUnreached),
        known_(plan.size(), false) {}

  void run(std::span<const Seed> seeds) {
    for (const Seed& seed : seeds) {
      distance_[seed.node] = seed.distance / plan_.cell;
      known_[seed.node] = true;
    }
    for (const Seed& seed : seeds) offer_neighbours(seed.node);
    empty_queue();
    spread_to_barriers();
  }

  std::vector<float> distances() const {
    std::vector<float> result(plan_.size());
    for (std::size_t i = 0; i < result.size(); ++i)
      result[i] = static_cast<float>(known_[i] ? distance_[i] * plan_.cell : kUnreached);
    return result;
  }

 private:
  struct Entry {
    double distance;
    std::size_t node;
    bool operator>(const Entry& other) const {
      return distance != other.distance ? distance > other.distance : node > other.node;
    }
  };

  void offer(std::size_t node, double distance) {
    if (!(distance < distance_[node])) return;
    distance_[node] = distance;
    queue_.push({distance, node});
  }

  void empty_queue() {
    while (!queue_.empty()) {
      const Entry entry = queue_.top();
      queue_.pop();
      if (known_[entry.node]) continue;
      known_[entry.node] = true;
      offer_neighbours(entry.node);
    }
  }

  /// Who is next to a barrier goes back to free ground first, to what of it is nearest. Were he to go on
  /// along the barrier, the end of a wall would be a short cut, which those who come from free ground would
  /// try.
  void spread_to_barriers() {
    std::vector<std::size_t> ring(plan_.size()), next;
    std::iota(ring.begin(), ring.end(), std::size_t{0});
    std::erase_if(ring, [&](std::size_t node) { return !known_[node]; });
    for (int depth = 1; !ring.empty() && depth <= deepest(); ++depth, ring.swap(next)) {
      next.clear();
      for (const std::size_t from : ring)
        for (const std::ptrdiff_t step : steps_) {
          const std::size_t to = from + static_cast<std::size_t>(step);
          if (known_[to] || plan_.footing[to] == Footing::none || !joined(from, to)) continue;
          if (distance_[to] == kUnreached) next.push_back(to);
          distance_[to] = std::min(distance_[to], distance_[from] + kDetour);
        }
      for (const std::size_t node : next) known_[node] = true;
    }
  }

  int deepest() const {
    return static_cast<int>(std::min(2.0 * plan_.clearance / plan_.cell + 1.0, kDeepest));
  }

  /// The plan's border is never walkable, so every walkable node has four neighbours.
  void offer_neighbours(std::size_t from) {
    for (const std::ptrdiff_t step : steps_) {
      const std::size_t to = from + static_cast<std::size_t>(step);
      if (!known_[to] && plan_.footing[to] == Footing::free) offer(to, solve(to));
    }
  }

  /// Free nodes are farther from every barrier than half a step: none stands between two of them.
  bool joined(std::size_t a, std::size_t b) const {
    if (plan_.footing[a] == Footing::free && plan_.footing[b] == Footing::free) return true;
    return !barriers_.block(plan_.node(a), plan_.node(b));
  }

  /// The distance that follows from one axis alone.
  double from(const Upwind& upwind) const { return upwind.value + 1.0 / std::sqrt(upwind.weight); }

  void look(std::size_t node, std::ptrdiff_t step, Upwind& upwind) const {
    const std::size_t first = node + static_cast<std::size_t>(step);
    if (!known_[first]) return;
    const double a = distance_[first];
    const std::size_t second = first + static_cast<std::size_t>(step);
    const bool two = second < plan_.size() && known_[second] && distance_[second] <= a;
    const Upwind found = two ? Upwind{(4.0 * a - distance_[second]) / 3.0, 2.25} : Upwind{a, 1.0};
    if (from(found) < from(upwind)) upwind = found;
  }

  double solve(std::size_t node) const {
    Upwind x, y;
    look(node, steps_[0], x), look(node, steps_[1], x);
    look(node, steps_[2], y), look(node, steps_[3], y);
    const double alone = std::min(from(x), from(y));
    if (!(x.value < kUnreached && y.value < kUnreached)) return alone;
    const double a = x.weight + y.weight, b = x.weight * x.value + y.weight * y.value;
    const double c = x.weight * x.value * x.value + y.weight * y.value * y.value - 1.0;
    const double discriminant = b * b - a * c;
    if (!(discriminant >= 0.0)) return alone;
    const double both = (b + std::sqrt(discriminant)) / a;
    return both >= std::max(x.value, y.value) ? both : alone;
  }

  const FloorPlan& plan_;
  const Barriers& barriers_;
  std::array<std::ptrdiff_t, 4> steps_;
  std::vector<double> distance_;  // in cells
  std::vector<std::uint8_t> known_;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue_;
};

}  // namespace

std::vector<float> march(const FloorPlan& plan, const Barriers& barriers, std::span<const Seed> seeds) {
  March run(plan, barriers);
  run.run(seeds);
  return run.distances();
}

}  // namespace throng
