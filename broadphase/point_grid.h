// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

/// Who is near whom, among points: a uniform grid of square cells, hashed, so that it costs memory in
/// proportion to the points and never to the area. For long or large static things use `BoxIndex`.
namespace throng::broadphase {

using Point = Eigen::Vector2d;

/// Two rows of the array that was indexed, a < b.
struct Pair {
  std::uint32_t a, b;
  friend bool operator==(const Pair&, const Pair&) = default;
  friend auto operator<=>(const Pair&, const Pair&) = default;
};

/// The period of a periodic domain: x and y repeat each `size`. Points lie in [origin, origin + size).
struct Period {
  Point origin, size;
};

class PointGrid {
 public:
  /// Indexes `points` (kept by reference: they must outlive the grid's use and not move). O(n); allocates only to
  /// grow. Expects finite points and cell_size > 0. With a period, cells wrap round and distances take the nearest image.
  void rebuild(std::span<const Point> points, double cell_size, const Period* period = nullptr);

  /// Replaces `pairs` by all rows a < b whose centres are at most `reach` apart, ascending.
  /// Expects 0 <= reach <= cell_size(). O(n k), k = mean number of points in nine cells; allocates only to grow.
  void find_pairs(double reach, std::vector<Pair>& pairs);

  /// Replaces `pairs` by all rows a < b with |p_a - p_b| <= reach[a] + reach[b], ascending.
  /// Expects 2 max(reach) <= cell_size().
  void find_pairs(std::span<const double> reach, std::vector<Pair>& pairs);

  double cell_size() const;
};

}  // namespace throng::broadphase
