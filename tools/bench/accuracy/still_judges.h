// SPDX-License-Identifier: MIT
#pragma once

#include <functional>

#include "tools/bench/accuracy/judge.h"

/// Judges of what should stand still. They look at the last second of a run.
namespace throng::bench {

/// Of bodies that begin at rest in their places: the farthest that one gets from its place, m.
std::unique_ptr<Judge> place_judge(const Scene& scene);

/// How far bodies that press on each other are from touching, inside of each other or apart: the mean over
/// these pairs and over ten looks, in mean radii of the dynamic bodies, of which each is one convex part.
/// Also `overlap` and `max_overlap`, the mean over pairs that overlap and the deepest, and `kinetic_energy`
/// (J).
std::unique_ptr<Judge> touch_judge(const Scene& scene);

/// What is pressed upon, and how hard it should be.
struct Loads {
  std::function<int(const ContactRow&)> which;  ///< row of `force` that a contact is part of; -1: of none
  std::vector<double> force;                    ///< N, along the contacts' normals, in the static solution
};

/// The worst of the loads' relative errors, each load a mean over the last second, and `jitter`: the root
/// mean square of what single steps are off, relative too. Infinite where an engine tells no forces.
std::unique_ptr<Judge> load_judge(const Scene& scene, Loads loads);

}  // namespace throng::bench
