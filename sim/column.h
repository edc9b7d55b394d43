// SPDX-License-Identifier: MIT
#pragma once

#include "sim/scene.h"

namespace throng {

/// Bodies that stand over one piece of the floor, on one another or beside.
struct Column {
  double load;         ///< how many times the weight of the lightest body its lowest contact may bear: twice
                       ///< the mean of its floor, but not more than there is
  double layers;       ///< of bodies that may stand on one another
  double slenderness;  ///< its height over its width
  bool is_tower;       ///< the lowest contact bears all of it
};

/// The one that presses hardest on the floor. Expects some dynamic bodies, and gravity.
/// O(n log n), n = corners of bodies.
Column heaviest_column(const Scene& scene);

}  // namespace throng
