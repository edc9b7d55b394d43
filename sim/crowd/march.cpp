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

constexpr int kFollowed = 2;        // steps from free ground: as far the ways beside barriers are its own
constexpr double kDetour = 1.5;     // from farther, for each step back to free ground
constexpr double kDeepest = 250.0;  // steps

constexpr double kStairs = 0.1;  // cells, that a straight way may get nearer to barriers than free nodes

/// All directions of straight ways of up to three cells each way.
constexpr std::pair<std::ptrdiff_t, std::ptrdiff_t> kChords[] = {
    {1, 1},  {1, -1},  {-1, 1}, {-1, -1}, {1, 2},  {1, -2},  {-1, 2}, {-1, -2}, {2, 1},  {2, -1},
    {-2, 1}, {-2, -1}, {1, 3},  {1, -3},  {-1, 3}, {-1, -3}, {3, 1},  {3, -1},  {-3, 1}, {-3, -1},
    {2, 3},  {2, -3},  {-2, 3}, {-2, -3}, {3, 2},  {3, -2},  {-3, 2}, {-3, -2}};

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
    const auto is_beside = [&](const Seed& seed) {
      return seed.distance > 0.0 && plan_.footing[seed.node] != Footing::free;
    };
    const auto know = [&](const Seed& seed) {
      distance_[seed.node] = seed.distance / plan_.cell;
      known_[seed.node] = true;
    };
    for (const Seed& seed : seeds)
      if (!is_beside(seed)) know(seed);
    for (const Seed& seed : seeds)
      if (!is_beside(seed)) offer_neighbours(seed.node);
    empty_queue();
    for (const Seed& seed : seeds)
      if (is_beside(seed)) know(seed);
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

  /// Beside barriers the ways of free ground go on as they are; deeper than who keeps off them gets, they
  /// lead back to free ground, to what of it is nearest. Were they sought there, too, the end of a wall would
  /// be a short cut, which those who come from free ground would try.
  void spread_to_barriers() {
    std::vector<std::size_t> ring(plan_.size()), next;
    std::iota(ring.begin(), ring.end(), std::size_t{0});
    std::erase_if(ring, [&](std::size_t node) { return !known_[node]; });
    for (int depth = 1; !ring.empty() && depth <= deepest(); ++depth, ring.swap(next)) {
      next.clear();
      for (const std::size_t from : ring)
        for (const std::ptrdiff_t step : steps_) {
          const std::size_t to = from + static_cast<std::size_t>(step);
          if (known_[to] || distance_[to] < kUnreached || !leads(to, from)) continue;
          distance_[to] = depth <= kFollowed ? beyond(to) : back(to);
          next.push_back(to);
        }
      for (const std::size_t node : next) known_[node] = true;
    }
  }

  bool leads(std::size_t node, std::size_t to) const {
    return known_[to] && plan_.footing[node] != Footing::none && joined(to, node);
  }

  /// What the known nodes next to it let expect there: the mean of the straight lines through them and those
  /// behind them.
  double beyond(std::size_t node) const {
    double sum = 0.0;
    int lines = 0;
    for (const std::ptrdiff_t step : steps_) {
      const std::size_t first = node + static_cast<std::size_t>(step);
      if (!leads(node, first)) continue;
      const std::size_t second = first + static_cast<std::size_t>(step);
      const bool two = leads(first, second);
      sum += two ? 2.0 * distance_[first] - distance_[second] : distance_[first], ++lines;
    }
    return std::max(sum / lines, 0.0);
  }

  double back(std::size_t node) const {
    double least = kUnreached;
    for (const std::ptrdiff_t step : steps_)
      if (const std::size_t to = node + static_cast<std::size_t>(step); leads(node, to))
        least = std::min(least, distance_[to] + kDetour);
    return least;
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
    const double both = both_axes(x, y);
    return is_on_rim(node) ? along_rim(node, both) : both;
  }

  double both_axes(const Upwind& x, const Upwind& y) const {
    const double alone = std::min(from(x), from(y));
    if (!(x.value < kUnreached && y.value < kUnreached)) return alone;
    const double a = x.weight + y.weight, b = x.weight * x.value + y.weight * y.value;
    const double c = x.weight * x.value * x.value + y.weight * y.value * y.value - 1.0;
    const double discriminant = b * b - a * c;
    if (!(discriminant >= 0.0)) return alone;
    const double both = (b + std::sqrt(discriminant)) / a;
    return both >= std::max(x.value, y.value) ? both : alone;
  }

  bool is_on_rim(std::size_t node) const {
    return std::ranges::any_of(steps_, [&](std::ptrdiff_t step) {
      return plan_.footing[node + static_cast<std::size_t>(step)] != Footing::free;
    });
  }

  /// The rim of free ground is stairs: along these its ways would be longer than they are.
  double along_rim(std::size_t node, double distance) const {
    for (const auto& [x, y] : kChords) {
      const std::size_t to = node + static_cast<std::size_t>(x + y * steps_[2]);
      if (!(to < plan_.size() && known_[to] && plan_.footing[to] == Footing::free)) continue;
      const double way = distance_[to] + std::sqrt(static_cast<double>(x * x + y * y));
      if (way < distance && !is_closed(node, x, y) && is_clear(plan_.node(node), plan_.node(to)))
        distance = way;
    }
    return distance;
  }

  /// Whether a straight way may lead through a passage that is too narrow: that is closed by a line of nodes.
  bool is_closed(std::size_t node, std::ptrdiff_t x, std::ptrdiff_t y) const {
    const std::ptrdiff_t right = x > 0 ? 1 : -1, up = y > 0 ? 1 : -1;
    for (std::ptrdiff_t j = 0; j != y + up; j += up)
      for (std::ptrdiff_t i = 0; i != x + right; i += right)
        if (plan_.footing[node + static_cast<std::size_t>(i + j * steps_[2])] == Footing::closed) return true;
    return false;
  }

  /// Whether a straight way between free nodes keeps off barriers.
  bool is_clear(const Vec& p, const Vec& q) const {
    const double reach = plan_.clearance - kStairs * plan_.cell;
    bool clear = true;
    barriers_.for_each_near({Vec(p.cwiseMin(q) - Vec(reach, reach)), Vec(p.cwiseMax(q) + Vec(reach, reach))},
                            [&](const Barriers::Segment& segment) {
                              const auto is_near = [&](const Vec& end) {
                                return (nearest_on_segment(p, q, end) - end).squaredNorm() < reach * reach;
                              };
                              clear = clear && !is_near(segment.a) && !is_near(segment.b);
                            });
    return clear && !barriers_.block(p, q);
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
