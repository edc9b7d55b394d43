// SPDX-License-Identifier: MIT
#pragma once

#include "tools/motion_lanes.h"
#include "tools/picture.h"

namespace throng::tools {

/// Pixels that a timeline takes below a page whose text is of size `unit`.
double timeline_height(std::size_t lanes, double unit);

/// Draws what was proven free below the page, a lane below the other, time to the right: each strip with the
/// tick at which its distance was computed, contacts and what is in doubt across all lanes.
void draw_timeline(cairo_t* cairo, const Page& page, const MotionAnswer& answer,
                   const std::vector<Lane>& lanes);

}  // namespace throng::tools
