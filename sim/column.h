// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "sim/scene.h"

namespace throng {

/// Dynamic bodies that stand over one piece of the floor, on one another or side by side.
struct Column {
  double load;         ///< how many times the weight of the lightest body its lowest contact may bear: twice
                       ///< the mean of its floor, but not more than there is
  double layers;       ///< of bodies that may stand on one another, at most
  double slenderness;  ///< its height over its mean width
  double thinnest;     ///< the height of a body over its width, at most, where one stands on another
  bool is_tower;       ///< none stands beside another
};

/// All of the scene, beside one another. Expects some dynamic bodies, and gravity. O(n log n), n = corners of
/// bodies.
std::vector<Column> columns(const Scene& scene);

}  // namespace throng
