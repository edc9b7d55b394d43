// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "tools/motion_view.h"

namespace throng::tools {

/// Draws a motion and its answer: obstacles, where everything starts and ends and passes, the ways of the
/// origins, the contact, and below for each pair what was proven free. `width`: pixels. Throws InputError
/// where `output` can't be written or the picture gets too large; no half file stays.
void write_motion_png(const MotionSystem& system, const MotionAnswer& answer, const std::string& output,
                      int width);

}  // namespace throng::tools
