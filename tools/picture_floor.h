// SPDX-License-Identifier: MIT
#pragma once

#include <cairo.h>

#include "sim/crowd/crowd.h"

namespace throng::tools {

/// Tints the areas of a crowd's floor, dashes their borders, and draws queues with a dot at their heads:
/// goals in one colour, where agents wait or line up in another, other areas in a third. The lines that are
/// measured are dashed, with an arrow to the side to which they count forward. `cairo` is in metres with y
/// up; `pixel` is the length of one (m).
void draw_floor(cairo_t* cairo, const Crowd& crowd, double pixel);

/// Writes the names of areas into their upper left corners, those of queues at their heads, of
/// lines at the end that is farther to the upper left, in letters of
/// `size` pixels, all within a picture `width` pixels wide; none of what is too small to be seen.
void name_floor(cairo_t* cairo, const Crowd& crowd, double size, int width);

}  // namespace throng::tools
