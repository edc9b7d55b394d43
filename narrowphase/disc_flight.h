// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <limits>

#include "narrowphase/half_plane.h"
#include "narrowphase/relative.h"

/// When does a disc that flies straight touch what stands still, or another such disc? In closed form, where
/// `first_contact` serves shapes that turn.
namespace throng::narrowphase {

/// The time of what does not happen. s.
constexpr double kNever = std::numeric_limits<double>::infinity();

struct DiscFlight {
  double gap;  ///< m, at time 0; below 0 they overlap
  double
      time;  ///< s, of the first touch; 0 where they touch and near each other, infinite where they never do
};

/// Two discs, the second seen from the first: at `between` (m), moving with `velocity` (m/s). `reach`: the
/// sum of their radii (m). The time is infinite where it is after `until` (s); most such take no root. The
/// gap is right to first order, and its sign to a rounding.
inline DiscFlight disc_flight(const Vec& between, const Vec& velocity, double reach, double until) {
  const double excess = dot(between, between) - reach * reach;
  const double gap = excess / (2.0 * reach);
  const double nearing = -dot(between, velocity);
  if (!(nearing > 0.0) || excess > 2.0 * nearing * until) return {gap, kNever};
  if (excess <= 0.0) return {gap, 0.0};
  const double discriminant = nearing * nearing - dot(velocity, velocity) * excess;
  if (discriminant < 0.0) return {gap, kNever};
  const double time = excess / (nearing + std::sqrt(discriminant));
  return {gap, time <= until ? time : kNever};
}

/// A disc, and all of the plane behind a border.
DiscFlight disc_flight(const Vec& centre, double radius, const Vec& velocity, const HalfPlane& free);

/// A disc, and a shape in the world's frame: the disc's centre as a ray against the shape grown by its
/// radius. A centre inside of a polygon has the gap of its nearest edge. O(n).
DiscFlight disc_flight(const Vec& centre, double radius, const Vec& velocity, const Convex& shape);

/// The unit vector from a point to the nearest one of the shape's core, before its radius; of a point on the
/// core, against the normal of that edge. O(n).
Vec towards(const Vec& point, const Convex& shape);

}  // namespace throng::narrowphase
