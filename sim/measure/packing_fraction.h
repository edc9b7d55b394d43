// SPDX-License-Identifier: MIT
#pragma once

#include "sim/state.h"

namespace throng {

/// How much of `box` (m) the dynamic bodies take; those that overlap count twice. Discs by the closed form of
/// a disc cut by four lines, polygons cut likewise; of a composite whose discs overlap, as if each took its
/// part of the whole. In a domain that repeats with all images that reach into the box, which is then at most
/// as large as the domain. Expects a box with an area. O(bodies).
double packing_fraction(const Scene& scene, const State& state, const Eigen::AlignedBox2d& box);

/// m², of a disc with that centre and radius what is in the box.
double area_within(const Vec& centre, double radius, const Eigen::AlignedBox2d& box);

/// m², of a convex polygon in counter-clockwise order what is in the box.
double area_within(std::vector<Vec> polygon, const Eigen::AlignedBox2d& box);

}  // namespace throng
