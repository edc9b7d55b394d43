// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <vector>

#include "narrowphase/half_plane.h"
#include "narrowphase/rim.h"
#include "sim/plan.h"
#include "sim/scene.h"

/// What may touch: the moving bodies' convex parts, and the obstacles, which never move.
namespace throng {

/// A row per convex part of a moving body. In a scene of discs a row is a body, and all but `body`, `radius`,
/// `movable` stay empty.
struct Colliders {
  std::vector<std::uint32_t> body;    ///< row of the body
  std::vector<double> radius;         ///< m, of the part's bounding disc
  std::vector<std::uint8_t> movable;  ///< 1 where the body is dynamic
  std::vector<Vec> centre;            ///< m, of the bounding disc, in the body's frame
  std::vector<double> swing;          ///< m, how much nearer to others its turning brings the surface at most
  std::vector<const narrowphase::Convex*> shape;  ///< the part; null for a disc about the body's centre
  std::vector<std::uint32_t> rim;                 ///< row of `rims`; empty where no shape has several parts
  std::vector<narrowphase::Rim> rims;             ///< of all parts of all shapes

  std::size_t size() const { return body.size(); }
};

Colliders colliders(const Scene& scene, const Plan& plan);

/// Whether the row is a disc about its body's centre.
inline bool is_disc(const Colliders& colliders, std::uint32_t row) {
  return colliders.shape.empty() || !colliders.shape[row];
}

/// What touches in that row; a disc about its body's centre has no shape of its own: `disc` becomes it.
inline const narrowphase::Convex& shape(const Colliders& colliders, std::uint32_t row,
                                        narrowphase::Convex& disc) {
  if (!is_disc(colliders, row)) return *colliders.shape[row];
  disc.radius = colliders.radius[row];
  return disc;
}

/// What never moves. Rows: first the sides of the domain's box, then walls and static bodies as convex parts
/// in the world's frame. In a periodic domain each part stands in all its images that the domain can touch.
struct Obstacles {
  std::vector<narrowphase::HalfPlane> side;  ///< four of a box, else none: the first rows
  std::vector<narrowphase::Convex> part;     ///< the rows behind them
  std::vector<narrowphase::Rim> rim;         ///< of every part
  std::vector<std::uint8_t> bends;      ///< whether every part bends gently (rim.h); empty where none does
  std::vector<std::uint32_t> material;  ///< of every row

  std::size_t size() const { return side.size() + part.size(); }
  bool is_side(std::uint32_t row) const { return row < side.size(); }
  const narrowphase::Convex& part_at(std::uint32_t row) const { return part[row - side.size()]; }
  const narrowphase::Rim& rim_at(std::uint32_t row) const { return rim[row - side.size()]; }
  bool bends_at(std::uint32_t row) const {
    return !bends.empty() && !is_side(row) && bends[row - side.size()];
  }
};

/// The box round a part, in its own frame (m).
Eigen::AlignedBox2d bounds(const narrowphase::Convex& part);

/// `reach` (m): how far beyond the domain's border an image still matters.
Obstacles obstacles(const Scene& scene, double reach);

}  // namespace throng
