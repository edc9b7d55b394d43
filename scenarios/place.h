// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "scenarios/read.h"

namespace throng::scenarios {

/// Fills scene.bodies from the entries, whose settings, materials, shapes and walls the scene already has:
/// radii, angles, velocities and positions. Reports bodies outside the domain, entries for which there is no
/// room, and warns of bodies that the file itself put into one another.
void place_bodies(std::span<const Entry> entries, std::span<const ShapeDraw> draws, Scene& scene,
                  Report& report);

/// Random places for the bodies of all entries that ask for them: wholly within their box, no nearer than
/// their gap to any other body and to any wall. The others must stand already. A body's tries depend on the
/// seed and its id alone, the place that it gets also on who came before: larger bodies do, then smaller ids.
/// O(n) while there is room (10,000 discs that cover half of the box: about 40 tries each); gives up within
/// seconds and says so.
void place_at_random(std::span<const Entry> entries, Scene& scene, Report& report);

/// Warns of bodies placed by hand that lie in one another or in a wall, the first ten pairs by id and depth.
/// Touching is fine, and so is whatever cannot move. O(n).
void warn_of_overlaps(std::span<const Entry> entries, const Scene& scene, Report& report);

/// The position moved by whole periods into a periodic domain; any other as it is.
Vec wrapped(const Domain& domain, const Vec& position);

}  // namespace throng::scenarios
