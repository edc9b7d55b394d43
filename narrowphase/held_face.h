// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

#include "narrowphase/manifold.h"

/// How little two polygons must have moved for what was found out about their contact to hold still. Bodies
/// at rest need no search for the widest face in each step.
namespace throng::narrowphase {

/// What two polygons showed when b stood at `b_in_a` in a's frame.
struct HeldFace {
  enum class Kind { none, apart, face };

  Kind kind = Kind::none;
  Pose b_in_a;
  double lever = 0.0;  ///< m: a turn by which a unit vector's end gets x farther moves no vertex by more than
                       ///< x times that, in the other's frame
  /// m. Of a face: while they move less, no edge but the incident one is as wide as the reference, and the
  /// incident edge is the same, as is, but for a change of its ends, the deepest vertex. Else how far apart
  /// they were, at least.
  double most = 0.0;
  bool of_b = false;                        ///< the reference is b's
  std::size_t reference = 0, incident = 0;  ///< edges of the reference's shape and of the other
};

/// What may be held of a and b whose manifold is `m`: none where a corner, a disc or a wall is among them, or
/// where the least movement would change it. Expects 2 vertices or more in each. Allocates nothing. O(n m),
/// as a scan that looks at each edge by itself.
HeldFace hold(const Convex& a, const Convex& b, const Pose& b_in_a, const Manifold& m);

/// m: an upper bound of how far any vertex of the one has moved in the frame of the other, up to rounding.
double movement(const HeldFace& held, const Pose& b_in_a);

/// Of the lever, what rounding may change: separations closer to each other than that count as equal.
constexpr double kHeldRounding = 1e-12;

}  // namespace throng::narrowphase
