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

  /// Where they stand: row i is the body in row id[i] - 1 of the scene. `tree` is of these places, and all
  /// outlive the questions. Where all are discs, angles may be left out.
  void place(std::span<const std::uint32_t> id, std::span<const Vec> position, std::span<const double> angle,
             const broadphase::ProximityTree& tree);

  /// Whether another body stands between `from`, the centre of row `own` if any, and the centre of row `to`,
  /// be it by touching the line. Each body counts at its image that is nearest to the middle of the line;
  /// nothing stands between two in one place. Exact for discs up to rounding, as `separation` for others.
  /// O(log n + bodies in the disc round the line, wider by the largest body).
  bool hide(const Vec& from, std::optional<std::uint32_t> own, std::uint32_t to) const;

 private:
  Vec apart(const Vec& from, const Vec& to) const;  // to the nearest image
  bool is_on(std::uint32_t row, const Vec& half, const Vec& centre) const;

  const Scene& scene_;
  double largest_ = 0.0;  // m, radius
  std::span<const std::uint32_t> id_;
  std::span<const Vec> position_;
  std::span<const double> angle_;
  const broadphase::ProximityTree* tree_ = nullptr;
};

}  // namespace throng
