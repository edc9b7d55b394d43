// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

#include "sim/scene.h"

/// What scenes are put under in `throng bench stability`, a factor or two at a time.
namespace throng::bench {

enum class Factor { scale, offset, mass_ratio, dt, restitution, friction, substeps };
inline constexpr std::size_t kFactors = 7;

/// The names of the factors, with their units.
const char* factor_name(Factor factor);

/// The values that a factor is seen at, ascending; of `quick` the first, a middle and the last one.
std::vector<double> values_of(Factor factor, bool quick);

enum class Stressed { stack, pile, gas };
inline constexpr std::array kStressed{Stressed::stack, Stressed::pile, Stressed::gas};
const char* stressed_name(Stressed scene);

/// A value of each factor, by Factor; those of the scene's ordinary life to begin with.
using Stress = std::array<double, kFactors>;
Stress ordinary(Stressed scene);

/// The scene under that stress. stack: ten boxes of one metre, the last of which weighs mass_ratio times as
/// much as another. pile: 150 discs that fall into a box, every tenth of them heavier. gas: 150 discs that
/// fly in a box, every tenth heavier. All lengths are times scale, and all of it is offset along both axes;
/// gravity is ours, and runs last longer where falls do.
Scene stressed_scene(Stressed scene, const Stress& stress);

}  // namespace throng::bench
