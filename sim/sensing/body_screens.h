// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "broadphase/proximity_tree.h"
#include "sim/scene.h"

namespace throng {

/// Which bodies hide others from each other: those that the line between two centres touches.
class BodyScreens {
 public:
  explicit BodyScreens(const Scene& scene);

  /// Where they stand: row i is the body in row id[i] - 1 of the scene, in a periodic domain inside it. All
  /// outlive the questions. Where all are discs, angles may be left out. O(n).
  void place(std::span<const std::uint32_t> id, std::span<const Vec> position, std::span<const double> angle);

  /// Whether another body stands between `from`, the centre of row `own` if any, and the centre of row `to`,
  /// be it by touching the line. Each body counts at its image that is nearest to the middle of the line;
  /// nothing stands between two in one place. Exact for discs up to rounding, as `separation` for others; of
  /// two rows the same from either side. O(log n + bodies near the line); ends with the first that hides.
  bool hide(const Vec& from, std::optional<std::uint32_t> own, std::uint32_t to) const;

 private:
  struct Line {
    Vec middle, half;  // m, from the middle to an end
    std::optional<std::uint32_t> own;
    std::uint32_t to;
  };
  Vec apart(const Vec& from, const Vec& to) const;  // to the nearest image
  bool any_on(const Line& line, const Vec& middle, std::size_t level, std::size_t node) const;
  bool any_of_leaf(const Line& line, std::size_t leaf) const;
  bool is_on(const Line& line, std::uint32_t row) const;
  bool covers(std::uint32_t row, const Vec& half, const Vec& centre) const;

  const Scene& scene_;
  std::optional<broadphase::Period> period_;
  std::vector<Vec> shifts_;  // m, to the images of the domain that a line is looked for in
  double largest_ = 0.0;     // m, radius
  std::span<const std::uint32_t> id_;
  std::span<const Vec> position_;
  std::span<const double> angle_;
  broadphase::ProximityTree discs_;  // round the bodies
};

}  // namespace throng
