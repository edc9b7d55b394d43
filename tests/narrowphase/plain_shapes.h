// SPDX-License-Identifier: MIT
#pragma once

#include "narrowphase/convex.h"

/// A shape and a place to calculate with by hand.
namespace throng::narrowphase {

inline const Convex kSquare = convex({{-1, -1}, {1, -1}, {1, 1}, {-1, 1}});

inline Pose at(double x, double y) {
  return {{x, y}};
}

}  // namespace throng::narrowphase
