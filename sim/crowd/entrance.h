// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <optional>

#include "sim/crowd/barriers.h"
#include "sim/crowd/sampler.h"
#include "sim/crowd/standing.h"
#include "sim/scene.h"

namespace throng {

/// A place (m) in an entrance that `suits`, where an agent who appears overlaps none of the `others` and no
/// barrier, at random by (seed, step, id); none where kEntranceTries don't find one. With a `companion` (m)
/// who has appeared, beside him: as many tries from nearer to farther, a width more each ten, come first.
std::optional<Vec> free_place(const Scene& scene, const Barriers& barriers, Standing& others,
                              const Sampler& entrance, std::uint32_t agent, std::int64_t step,
                              const std::optional<Vec>& companion,
                              const std::function<bool(const Vec&)>& suits);
inline constexpr int kEntranceTries = 100;

}  // namespace throng
