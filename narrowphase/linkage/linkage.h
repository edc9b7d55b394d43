// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "narrowphase/bvh_parts.h"

/// Articulated robots in the plane: bodies of any shape on revolute and prismatic joints, in chains and
/// trees.
namespace throng::narrowphase {

/// Stands for all that never moves: what a robot's first link is mounted on, and the obstacles.
constexpr std::uint32_t kWorld = std::numeric_limits<std::uint32_t>::max();

enum class Joint { revolute, prismatic };

/// A body of a robot, and the joint that carries it. With the joint's value q the link's frame stands in its
/// parent's at `at`, turned by angle + q (revolute), or at `at` + q axis, turned by `angle` (prismatic).
/// Equal limits make a joint rigid; two prismatic ones and a revolute one make a vehicle.
struct Link {
  const PartsBvh* shape = nullptr;  ///< in the link's frame; the caller's, who keeps it; null: nothing there
  std::uint32_t parent = kWorld;    ///< the link that it hangs on
  Joint joint = Joint::revolute;
  Vec at{0.0, 0.0};    ///< m, in the parent's frame
  double angle = 0.0;  ///< rad
  Vec axis{1.0, 0.0};  ///< of a prismatic joint: unit, in the parent's frame
  double lower = -std::numeric_limits<double>::infinity();  ///< rad or m, the joint's limits
  double upper = std::numeric_limits<double>::infinity();
};

/// One robot or several: what hangs on the world begins a robot, parents come before what hangs on them. A
/// configuration of it is one joint value a link (rad or m), in the same order.
using Linkage = std::vector<Link>;

/// Adds a robot, the frame that it is mounted on standing at `position`, turned by `angle` (rad). Returns
/// the number of its first link in `linkage`. O(links).
std::uint32_t mount(Linkage& linkage, std::span<const Link> robot, const Vec& position, double angle);

/// What is wrong with it, a sentence, or nothing: a parent that does not come before its child, a value that
/// is not finite, an axis that is not of length 1 within 1e-9, limits the wrong way round. For strangers'
/// linkages: all else here expects one without faults.
std::string fault(std::span<const Link> linkage);

/// The first joint whose value lies outside its limits.
std::optional<std::uint32_t> beyond_limits(std::span<const Link> linkage, std::span<const double> values);

/// Where a joint's value puts the link's origin in its parent's frame. m.
inline Vec offset(const Link& link, double value) {
  return link.joint == Joint::revolute ? link.at : Vec(link.at + value * link.axis);
}

/// Where the links stand. Angles are summed as angles, so that a link's is off by no more than the roundings
/// of these sums: one in 2^53 of each partial sum, of which large ones that cancel keep theirs. Expects as
/// many values and poses as links. About 15 ns a link; allocates nothing.
void place_links(std::span<const Link> linkage, std::span<const double> values, std::span<Pose> poses);

}  // namespace throng::narrowphase
