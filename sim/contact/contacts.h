// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "sim/contact/body_rows.h"
#include "sim/contact/disc_blocks.h"
#include "sim/contact/face_blocks.h"
#include "sim/contact/roll.h"
#include "sim/contact/turning_faces.h"
#include "sim/state.h"
#include "sim/workers.h"

namespace throng {

/// The contacts of one step, with the names under which `State` keeps their impulses. Ascending by key: the
/// smaller collider, then the other; contacts with obstacles come after all pairs.
struct Contacts {
  DiscBlocks discs;
  std::vector<std::uint64_t> disc_key;
  FaceBlocks faces;
  std::vector<std::uint64_t> point_key;
  std::vector<std::uint32_t> point_feature;
  TurningFaces turning;                 ///< of those that turn far
  std::vector<RollContact> disc_rolls;  ///< of the same contacts; empty where nothing resists rolling
  std::vector<RollContact> point_rolls;
  std::vector<DiscContact> disc_bounces;    ///< those of who hits; all where a surface bounces
  std::vector<PointContact> point_bounces;  ///< likewise
  std::size_t hits = 0;                     ///< how many of them are to be stopped

  /// Forgets all; of so many rows of bodies the last ones, one a group, never move.
  void start(BodyRows<const SolverBody> bodies, std::size_t groups);

  /// The impulses of contacts that press, for the next step.
  void save(State& state, Workers& workers);

  std::vector<std::size_t> counts;  ///< a buffer of save()
};

}  // namespace throng
