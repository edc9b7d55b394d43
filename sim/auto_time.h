// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "sim/scene.h"

/// How long steps may be for a wanted error, where that can be told before a run.
namespace throng {

/// `time.dt = "auto"`.
struct AutoTime {
  double dt = 0.01;  ///< s, a whole part of the run
  int substeps = 4;
  std::string promise;  ///< what the error is of, a clause
  std::string why;      ///< how the steps follow from it, a clause
  std::string refusal;  ///< why nothing can be promised; "" where it can, and all above is filled in
};

/// Chooses for scene.time.error and .until, whatever the scene's dt and substeps are. An error is of the
/// radius of the smallest dynamic body, unless `promise` says otherwise:
///
/// * of those who meet no other (lone_ways.h): who only falls, the disc that rolls and bounces, and what lies
///   on a wall and slides there, how far off its exact way it is at the end;
/// * of several that stand on one another at the beginning, and stay there, how far from there they get; of
///   several that may meet and don't bounce, how deep those that press on one another overlap by the mean
///   once all lie: a contact sags by F h² / (1.28 m), with F the weight of all above, spread over the floor;
///   both this and the way of those that hit no other where they touch at rest and then slide or roll;
/// * of soft contacts, how far the restitution of an impact is off the formula: it falls with the square of
///   the substeps in an impact (soft_law.h), as measured for all restitutions;
/// * of discs that keep all their energy and that nothing pulls, and of engine event_driven, nothing but
///   rounding is left at any step.
///
/// Where several of these are in one scene, the strictest holds for all. Nothing is promised of crowds, of
/// Box2D, of ways that are sensitive to where bodies are, and where errors grow at each collision: among
/// bodies that bounce and may meet. O(bodies (walls + static bodies)), and the pairs of bodies that may meet;
/// where they touch at rest, first loads and 64 steps.
AutoTime auto_time(const Scene& scene);

}  // namespace throng
