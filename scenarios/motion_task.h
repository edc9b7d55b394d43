// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "narrowphase/linkage/linkage.h"

/// What `throng motion` is asked: what moves from waypoint to waypoint, and what stands in its way.
namespace throng {

using Vec = Eigen::Vector2d;

/// A solid in its own coordinates: a pose says where its origin stands, not its centre of mass.
struct MotionShape {
  std::string name;
  std::vector<narrowphase::Convex> parts;
  std::vector<std::vector<Vec>>
      rings;  ///< m, outline and holes of a sharp polygon; else it looks as its parts
};

/// As narrowphase's Link, with names.
struct MotionLink {
  static constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

  std::string name;              ///< "arm.hand"; that of a body is the body's
  std::uint32_t shape = kNone;   ///< row of MotionTask::shapes; kNone: nothing there
  std::uint32_t parent = kNone;  ///< of the mover's links, one before; kNone: its base
  narrowphase::Joint joint = narrowphase::Joint::revolute;
  Vec at{0.0, 0.0};    ///< m, in the parent's frame
  double angle = 0.0;  ///< rad
  Vec axis{1.0, 0.0};  ///< unit, in the parent's frame; prismatic joints only
  double lower = -std::numeric_limits<double>::infinity();  ///< rad or m
  double upper = std::numeric_limits<double>::infinity();
};

/// A robot; or a body, which is one of three links: along x, along y, and what turns, which alone has a
/// shape.
struct Mover {
  std::string name;
  Vec base{0.0, 0.0};       ///< m
  double base_angle = 0.0;  ///< rad
  std::vector<MotionLink> links;
  std::vector<std::vector<double>> waypoints;  ///< a value a link: rad or m
};

struct Obstacle {
  std::string name;
  std::uint32_t shape = 0;  ///< row of MotionTask::shapes
  Vec at{0.0, 0.0};         ///< m
  double angle = 0.0;       ///< rad
};

/// Those that bear one name: all movers' links are counted through, then the obstacles.
struct Solids {
  std::uint32_t first = 0, count = 0;
};

struct MotionTask {
  std::string name, description;
  std::vector<MotionShape> shapes;
  std::vector<Mover> movers;  ///< the bodies, then the robots; one or more
  std::vector<Obstacle> obstacles;
  std::vector<std::pair<Solids, Solids>> may_touch;
  double margin = 0.0;            ///< m: what comes as near as that counts as contact
  std::vector<double> durations;  ///< s, of the segments; empty where the file has none

  /// Of all movers. O(movers).
  std::uint32_t links() const {
    std::uint32_t count = 0;
    for (const Mover& mover : movers) count += static_cast<std::uint32_t>(mover.links.size());
    return count;
  }

  /// All movers have as many, two or more.
  std::size_t waypoints() const { return movers.empty() ? 0 : movers[0].waypoints.size(); }
};

}  // namespace throng
