// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "sim/crowd/barriers.h"
#include "sim/scene.h"

/// Bodies as agents meet them.
namespace throng {

/// What agents meet of a disc: the regular polygon of 64 sides round it (m), which sticks out of it by 0.12 %
/// of its radius at most.
std::vector<Vec> round_outline(const Vec& centre, double radius);

/// What a body fills, piece by piece, about its centre of mass; pieces of composites may overlap.
std::vector<Region> solids(const Scene& scene, std::size_t row);

/// The same at a pose.
std::vector<Region> placed(std::vector<Region> solids, const narrowphase::Pose& pose);

/// What the static bodies fill, where they stand.
std::vector<Region> standing_solids(const Scene& scene);

/// The rings of these pieces.
std::vector<BarrierLine> rings(const std::vector<Region>& solids);

}  // namespace throng
