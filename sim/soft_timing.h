// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "sim/scene.h"

/// Whether a scene's steps are short enough for contacts that give way.
namespace throng {

/// How long soft contacts of a scene last, and how long a substep may be.
struct SoftTiming {
  double speed = 0.0;        ///< m/s, at which bodies may meet that didn't begin in each other
  double contact = 0.0;      ///< s, the shortest impact; infinite where none is to be expected
  double restitution = 1.0;  ///< the least of what may meet
  double longest = 0.0;  ///< s, the longest substep that is stable, in the densest packing; may be infinite
};

/// m/s, beyond which no point of a body gets: that of the fastest at the beginning and what a fall from the
/// top of the scene to its bottom adds. O(bodies + walls).
double top_speed(const Scene& scene);

/// m, how far a body may get in a substep and still be seen by all that it meets: the radius of the smallest
/// dynamic disc, as a solid that is passed so fast is noticed in its heart at least. O(bodies).
double longest_way(const Scene& scene);

/// m/s, that a fall from the top of the scene to its bottom adds. O(bodies + walls).
double fall_speed(const Scene& scene);

/// m/s, with which discs, and points of what is none, move at the beginning, at most. O(bodies).
double first_speed_of_ways(const Scene& scene);

/// Of all discs that are dynamic, as if each met its like, or an obstacle where it is alone. `speed` is twice
/// that of the fastest body and what a fall from the top of the scene to its bottom adds. Impacts of `spring`
/// last as long at any speed; those of `hertz` are the shorter the faster, and as short where bodies begin as
/// deep in each other, which they are searched for as by overlap(); whom they hit as they part isn't counted.
/// O(bodies) else.
///
/// Stable are w h < 2 and z h < 2, w the highest frequency and z the highest damping rate of a packing in
/// which each disc has six contacts.
SoftTiming soft_timing(const Scene& scene);

/// In how many substeps the shortest impact must take place for its restitution to be off by no more than
/// `error`, of what it is (of 0.2 where it is less): as measured at 16 phases of a step for restitutions from
/// 0.05 to 1, and a fifth more.
double substeps_per_impact(double restitution, double error);

/// What soft contacts can't do of the scene: "PATH: why", "" where they can do all of it. O(bodies).
std::string soft_refusal(const Scene& scene);

}  // namespace throng
