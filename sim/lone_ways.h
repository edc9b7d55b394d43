// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "sim/plan.h"
#include "sim/scene.h"
#include "sim/surroundings.h"

/// What can be told, before a run, of the ways of bodies that meet no other.
namespace throng {

/// Of one dynamic body, as if it were the only one.
struct LoneWay {
  Surroundings::Box reach;  ///< m, which all of it stays in until the end, along the walls and across them
  double impact = 0.0;      ///< m/s, at which it may hit a wall; 0 where it hits none
  std::string doubt;        ///< why its way may be sensitive to where it is; "" where it isn't
};

/// A row per body, empty but for dynamic ones. No doubt is about:
/// * who gets to nothing in its flight;
/// * a disc among straight walls square to each other that gets to no end of them, nor to a static body:
///   where it rubs, to no two of them, which it would hold on to at once; where it bounces, gravity being
///   along them;
/// * what lies on such a wall with two points at least, and slides there or stays: if it isn't to tip over,
///   bounces nowhere, and gets to no other wall, to no end of its own, and to no static body.
/// Ways are those of hard contacts. O(bodies (walls + static bodies)).
std::vector<LoneWay> lone_ways(const Scene& scene, const Plan& plan);

/// Why what stands on this scene's obstacles may be at an edge or a corner of one, "" where it isn't: static
/// bodies, walls that aren't along one direction and across it, and those that end under a body.
std::string doubt_of_obstacles(const Scene& scene, const Plan& plan);

}  // namespace throng
