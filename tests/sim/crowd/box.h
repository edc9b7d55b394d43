// SPDX-License-Identifier: MIT
#pragma once

#include "sim/crowd/region.h"

namespace throng {

/// The rectangle between these corners.
inline Region box(double x0, double y0, double x1, double y1) {
  return {{{{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}}}};
}

}  // namespace throng
