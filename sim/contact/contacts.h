// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "sim/contact/contact.h"
#include "sim/contact/disc_blocks.h"
#include "sim/contact/face_blocks.h"
#include "sim/contact/grouped.h"
#include "sim/contact/roll.h"
#include "sim/contact/strips.h"
#include "sim/state.h"
#include "sim/workers.h"

namespace throng {

/// The contacts of one step, with the names under which `State` keeps their impulses. Ascending by key: the
/// smaller collider, then the other; contacts with obstacles come after all pairs.
struct Contacts {
  Strips strips;  ///< the groups of the two below
  Grouped<DiscBlocks> discs;
  std::vector<std::uint64_t> disc_key;
  Grouped<FaceBlocks> faces;
  std::vector<std::uint64_t> point_key;
  std::vector<std::uint32_t> point_feature;
  std::vector<RollContact> disc_rolls;  ///< of the same contacts; empty where nothing resists rolling
  std::vector<RollContact> point_rolls;
  std::vector<DiscContact> disc_bounces;  ///< the same contacts once more; empty where no surface bounces
  std::vector<PointContact> point_bounces;

  void clear();

  /// Writes the impulses of contacts that press, for the next step.
  void save(State& state, Workers& workers) const;
};

}  // namespace throng
