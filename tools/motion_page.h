// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "tools/motion_view.h"

namespace throng::tools {

/// The page motion_page.html; @GIVEN@ stands where the data go.
extern const char* const kMotionHtml;

/// The data: JSON that may stand in a script of a page.
std::string motion_page_data(const MotionSystem& system, const MotionAnswer& answer);

/// Writes one HTML file that shows a motion and its answer in any browser, without network: a scrubber over
/// time, and below for each pair what was proven free. Throws InputError where `output` can't be written; no
/// half file stays.
void write_motion_page(const MotionSystem& system, const MotionAnswer& answer, const std::string& output);

}  // namespace throng::tools
