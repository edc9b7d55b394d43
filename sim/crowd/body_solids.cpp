// SPDX-License-Identifier: MIT
#include "sim/crowd/body_solids.h"

#include <numbers>

namespace throng {

std::vector<Vec> round_outline(const Vec& centre, double radius) {
  constexpr int kSides = 64;
  constexpr double kSide = 2.0 * std::numbers::pi / kSides;
  const double reach = radius / narrowphase::pose({0.0, 0.0}, 0.5 * kSide).cos;
  std::vector<Vec> ring;
  for (int i = 0; i < kSides; ++i) ring.push_back(narrowphase::pose(centre, i * kSide) * Vec(reach, 0.0));
  return ring;
}

std::vector<Region> solids(const Scene& scene, std::size_t row) {
  const Shape& shape = scene.shapes[scene.bodies.shape[row]];
  if (shape.kind == ShapeKind::disc) return {{{round_outline({0.0, 0.0}, scene.bodies.radius[row])}}};
  std::vector<Region> pieces;
  if (shape.kind == ShapeKind::composite) {
    for (const narrowphase::Convex& disc : shape.parts)
      pieces.push_back({{round_outline(disc.vertices[0], disc.radius)}});
  } else {
    pieces.push_back({{shape.outline}});
    for (const std::vector<Vec>& hole : shape.holes) pieces.back().rings.push_back(hole);
  }
  return pieces;
}

std::vector<Region> placed(std::vector<Region> solids, const narrowphase::Pose& pose) {
  for (Region& piece : solids)
    for (std::vector<Vec>& ring : piece.rings)
      for (Vec& point : ring) point = pose * point;
  return solids;
}

std::vector<Region> standing_solids(const Scene& scene) {
  std::vector<Region> standing;
  const Bodies& bodies = scene.bodies;
  for (std::size_t row = 0; row < bodies.size(); ++row)
    if (bodies.kind[row] == BodyKind::fixed)
      for (Region& piece :
           placed(solids(scene, row), narrowphase::pose(bodies.position[row], bodies.angle[row])))
        standing.push_back(std::move(piece));
  return standing;
}

std::vector<BarrierLine> rings(const std::vector<Region>& solids) {
  std::vector<BarrierLine> lines;
  for (const Region& piece : solids)
    for (const std::vector<Vec>& ring : piece.rings) lines.push_back({ring, true});
  return lines;
}

}  // namespace throng
