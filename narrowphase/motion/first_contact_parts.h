// SPDX-License-Identifier: MIT
#pragma once

#include "narrowphase/bvh_outline.h"
#include "narrowphase/bvh_parts.h"
#include "narrowphase/motion/first_contact.h"

namespace throng::narrowphase {

struct PartsQuestion {
  double width = 1e-12;    ///< of the size of the two parts that touch, as ContactQuestion says
  int evaluations = 1000;  ///< most distances for two parts, as ContactQuestion says
  int looks = 100000;      ///< most distances and comparisons of nodes in all; then `undecided`
  BvhCounters* counters = nullptr;
};

/// A hit's bracket is no wider than asked where no other pair is in doubt before it: a doubt that lasts until
/// the hit begins is part of its bracket, and so is what spent looks have left unseen.
struct FirstPartsContact {
  FirstContact contact;          ///< evaluations: of all pairs of parts
  std::uint32_t part_a, part_b;  ///< which touch; where the two are free 0
};

/// The same of two solids of many parts, either of which may be a scene of any number of parts that stands
/// still or moves as one: the first contact of all pairs of their parts, t_lo below those of all. Best first:
/// the queue holds pairs of nodes by when they may touch at the earliest, from when on each is looked at
/// again; what is behind the first bracket that closes is never opened. O(k log k), k = pairs of nodes that
/// come near before the contact; allocates the queue. Of several parts that touch within one bracket any is
/// named, always the same.
FirstPartsContact first_contact(const PartsBvh& a, const Motion& motion_a, const PartsBvh& b,
                                const Motion& motion_b, double duration, const PartsQuestion& question = {});

/// The same of two outlines: edges are the parts, by their index. One solid in the other, or a meeting as
/// `collide` says, at time 0 is a hit there. Edges that only ever meet in line, as those of boxes do, are in
/// doubt to each other; then the bracket ends where `collide` finds the solids, at most 2^16 times farther on
/// than it is wide. O(k log k), and `collide` at the start.
template <class Volume>
FirstPartsContact first_contact(const Outline<Volume>& a, const Motion& motion_a, const Outline<Volume>& b,
                                const Motion& motion_b, double duration, const PartsQuestion& question = {});

}  // namespace throng::narrowphase
