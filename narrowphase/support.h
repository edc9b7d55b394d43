// SPDX-License-Identifier: MIT
#pragma once

#include "narrowphase/relative.h"

namespace throng::narrowphase {

/// The vertex that lies farthest along `direction`, up to rounding; the first of several. O(n) up to 32
/// vertices, by bisection over the angles of the normals beyond: O(log n).
std::size_t support(const Convex& shape, const Vec& direction);

}  // namespace throng::narrowphase
