// SPDX-License-Identifier: MIT
#pragma once

#include "tools/screen.h"
#include "tools/view.h"

namespace throng::tools {

/// Cells of a screen that a picture fills.
struct Cells {
  int column, row, columns, rows;
};

/// Draws a frame in Unicode's Braille patterns, two dots wide and four high a cell: bodies coloured by speed,
/// static and driven ones grey, bodies of two dots and more a dot apart; every body has a dot at least.
/// Borders of areas, queues and measured lines are dotted, goals and where agents wait in colours of their
/// own, and named where there is room. Expects positions. O(bodies + dots * edges of the bodies there); a
/// composite has as many as discs.
void draw_dots(Screen& screen, const Cells& area, const Scene& scene, const View& view, const Frame& frame);

}  // namespace throng::tools
