// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "broadphase/box_index.h"
#include "sim/scene.h"

namespace throng {

/// Who sees whom between the walls of a scene.
class Sight {
 public:
  /// Indexes the walls, for about `distance` (m) of looking; it decides speed alone.
  Sight(std::span<const Wall> walls, const std::optional<broadphase::Period>& period, double distance);

  /// Whether the segment from `p` to the nearest image of `q` shares no point with a wall, not even with its
  /// end: no one sees through the corner where two walls meet. Exact for the points as given. In a periodic
  /// domain, where both must lie, a wall stands there and in the eight images beside it, as for bodies, each
  /// where it is rounded to.
  bool sees(const Vec& p, const Vec& q) const;

 private:
  void add(const Vec& a, const Vec& b);
  bool blocked(const Vec& p, const Vec& q) const;

  std::optional<broadphase::Period> period_;
  std::vector<broadphase::Extent> walls_;  // with their images
  broadphase::Box bounds_;                 // m, of all walls
  broadphase::BoxIndex index_;
};

}  // namespace throng
