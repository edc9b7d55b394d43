// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "sim/recording/recording.h"

namespace throng::tools {

/// Draws one frame to a PNG file, at most `width` pixels wide and high: bodies coloured by speed, walls, the
/// domain, a scale bar, name, time and the scale of colours. Where no velocity was recorded, all moving
/// bodies have one colour, and the legend says so. O(bodies). Throws InputError where positions were not
/// recorded or `output` can't be written; no half file stays.
void draw_png(const Scene& scene, const Frame& frame, const std::string& output, int width = 1600);

}  // namespace throng::tools
