// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "sim/crowd/barriers.h"
#include "sim/scene.h"

/// Bodies as agents meet them.
namespace throng {

/// What a body fills, piece by piece, about its centre of mass; pieces of composites may overlap. A disc is
/// the regular polygon of kDiscSides round it, which sticks out of it by 0.12 % of its radius at most.
std::vector<Region> solids(const Scene& scene, std::size_t row);
inline constexpr int kDiscSides = 64;

/// The same at a pose.
std::vector<Region> placed(std::vector<Region> solids, const narrowphase::Pose& pose);

/// The rings of the bodies of this kind where the scene has them.
std::vector<BarrierLine> outlines(const Scene& scene, BodyKind kind);

}  // namespace throng
