// SPDX-License-Identifier: MIT
#pragma once

#include "tools/framing.h"
#include "tools/motion_answer.h"
#include "tools/palette.h"

namespace throng::tools {

/// An instant of a path.
struct MotionInstant {
  std::size_t segment = 0;
  double fraction = 0.0;
};

/// How a motion is shown.
struct MotionView {
  Extent extent;
  std::vector<MotionInstant> ghosts;     ///< from the start to the end, evenly
  std::optional<MotionInstant> contact;  ///< the first that is known, or where what is in doubt begins
  bool doubt = false;                    ///< it is that
};

/// All that moves, wherever it comes, and what of the obstacles is near. O(segments * vertices).
MotionView view_of(const MotionSystem& system, const MotionAnswer& answer);

/// The answer in a line: the verdict, who and when.
std::string summary(const MotionSystem& system, const MotionAnswer& answer, const MotionView& view);

/// The colour of a mover: the eight of Okabe and Ito (2008) but black, yellow and the vermillion of contacts.
Colour mover_colour(std::size_t mover);
inline constexpr Colour kContact{0.835, 0.369, 0.0}, kObstacle{0.62, 0.63, 0.65};

}  // namespace throng::tools
