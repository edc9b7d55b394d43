// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>

#include "narrowphase/convex.h"

namespace throng::narrowphase {

/// One point at which two shapes touch or nearly do.
struct ManifoldPoint {
  Vec point{0.0, 0.0};        ///< m, world, midway between the two surfaces
  double separation = 0.0;    ///< m, along the manifold's normal; below 0 in penetration
  std::uint32_t feature = 0;  ///< names the pair of features; the same while they stay in touch
};

/// Up to two points that share a normal: what a contact solver needs of a pair of convex shapes.
struct Manifold {
  Vec normal{0.0, 0.0};  ///< unit, from a to b
  int count = 0;
  std::array<ManifoldPoint, 2> points;
};

/// The contact manifold of two convex shapes; empty where they are more than `reach` apart. Allocates
/// nothing.
Manifold manifold(const Convex& a, const Pose& pose_a, const Convex& b, const Pose& pose_b, double reach);

}  // namespace throng::narrowphase
