// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Geometry>

#include "scenarios/wall_grid.h"
#include "sim/scene.h"

/// How bodies of a scene lie to each other and to walls, at places that they need not have taken yet.
namespace throng::scenarios {

/// A body at a place; its angle is the scene's.
struct Placed {
  std::uint32_t row;
  Vec position;  ///< m
};

/// The signed distance of two bodies, m; below 0 it is minus how deep their deepest parts are in each other.
/// O(parts of a * parts of b).
double distance(const Scene& scene, const Placed& a, const Placed& b);

/// The signed distance of a body and a straight piece of wall, m.
double distance(const Scene& scene, const Placed& body, const WallGrid::Piece& piece);

/// Whether the two come closer than `gap` (m): the answer of `distance`, sooner. Adds to `work` about what it
/// cost, in units of a few nanoseconds.
bool is_closer(const Scene& scene, const Placed& a, const Placed& b, double gap, std::int64_t& work);
bool is_closer(const Scene& scene, const Placed& body, const WallGrid::Piece& piece, double gap,
               std::int64_t& work);

/// The least upright box round the body about its centre of mass, m.
Eigen::AlignedBox2d extent(const Scene& scene, std::uint32_t row);

/// How deep two things may be in each other by rounding alone, m: they count as touching.
double touching(double smaller_radius, const Vec& position);

}  // namespace throng::scenarios
