// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "scenarios/motion_task.h"

namespace throng::tools {

/// The outline of a shape at a pose, as an SVG path in metres with y up, about `origin`: near it the numbers
/// are short, and good to what browsers compute with. Parts that are rounded have arcs.
std::string svg_path(const MotionShape& shape, const narrowphase::Pose& pose, const Vec& origin);

}  // namespace throng::tools
