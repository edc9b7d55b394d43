// SPDX-License-Identifier: MIT
#pragma once

#include <cairo.h>

#include "sim/recording/recording.h"
#include "tools/palette.h"

namespace throng::tools {

/// Draws every body, filled, outlined, discs with the radius that shows their turn, and where agents walk.
/// `cairo` is in metres with y up; `pixel` is the length of one (m). With `top` > 0 moving bodies are
/// coloured by speed from 0 to `top` (m/s).
void draw_bodies(cairo_t* cairo, const Scene& scene, const Frame& frame, double pixel, double top);

/// Draws the walls as solid lines of `thickness` (m).
void draw_walls(cairo_t* cairo, const Scene& scene, double thickness);

}  // namespace throng::tools
