// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "sim/scene.h"

/// What a scene needs, decided once: a stage that it doesn't need is not run and allocates nothing.
namespace throng {

/// How two materials act on each other.
struct Surface {
  double friction;     ///< Coulomb's coefficient: the geometric mean of the two
  double restitution;  ///< the larger of the two
  double rolling;      ///< coefficient of rolling resistance: the larger of the two
};

/// One stage of the step, for people: does it run, and why.
struct Stage {
  std::string name;
  bool runs;
  std::string reason;
};

struct Plan {
  double substep = 0.0;           ///< s, dt over the number of substeps
  bool gravity = false;           ///< something falls
  bool pairs = false;             ///< two bodies may touch, one of them dynamic
  bool obstacles = false;         ///< there are walls or static bodies
  bool box = false;               ///< the domain is a box
  bool periodic = false;          ///< the domain repeats
  bool composites = false;        ///< some moving body has several parts
  bool polygons = false;          ///< some moving body is not a disc: manifolds, and angles turn shapes
  bool rotation = false;          ///< something turns, or may come to
  bool friction = false;          ///< surfaces that meet rub
  bool rolling = false;           ///< some that meet resist the rolling of discs
  bool restitution = false;       ///< some that meet bounce
  bool elastic = false;           ///< some that meet keep all energy
  bool soft = false;              ///< discs that give way where they touch: springs and dashpots
  bool flights = false;           ///< discs alone, all that meet keep all energy, and nothing pulls
  bool sleep = false;             ///< bodies at rest leave the loop
  bool crowd = false;             ///< there are agents
  bool entrances = false;         ///< some agents appear in the course of time
  bool measures = false;          ///< something is counted while they walk
  bool sensors = false;           ///< somebody senses others
  bool sums_impulses = false;     ///< contacts are recorded, with all that they press in a step
  std::size_t materials = 0;      ///< how many the scene has
  std::vector<Surface> surfaces;  ///< of each two of them: see surface()
  std::vector<Surface> meeting;   ///< of those of them at which bodies may meet
  std::vector<Stage> stages;  ///< of the native engine, in the order of the step, those that are skipped too

  /// Of two materials: the row of their surface, and the surface.
  std::size_t surface_row(std::size_t a, std::size_t b) const { return a * materials + b; }
  const Surface& surface(std::size_t a, std::size_t b) const { return surfaces[surface_row(a, b)]; }

  bool contacts() const { return pairs || obstacles || box; }
};

Plan plan_for(const Scene& scene);

/// The same as if the scene had that contact model.
Plan plan_for(const Scene& scene, ContactModel contact);

}  // namespace throng
