// SPDX-License-Identifier: MIT
#pragma once

#include "sim/crowd/model.h"

namespace throng {

/// Agents turn away from those who are near, and walk as fast as the gap ahead allows at a fixed time gap:
/// they never run into one another. Tordeux, Chraibi and Seyfried, "Collision-free speed model for pedestrian
/// dynamics" (Traffic and Granular Flow '15, 2016; arXiv 1512.05597). Barriers turn agents too, with a
/// strength and a range of their own.
ModelKind collision_free_speed();

}  // namespace throng
