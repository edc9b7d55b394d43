// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "sim/plan.h"
#include "sim/rows.h"
#include "sim/scene.h"
#include "sim/state.h"

namespace throng {

/// A large scene in parts, side by side, whose contacts are solved at the same time. Contacts are in groups:
/// one a part, of bodies that are both in it, and a last one of those that join parts. How many parts there
/// are and where they end follows from the scene alone, who is in which from the state, so that nothing
/// depends on the number of threads or on earlier steps.
class Parts {
 public:
  /// One part alone where there are few bodies, and where contacts aren't solved by sweeps. They are cut
  /// across the direction in which nothing falls, so that about as many bodies begin in each, and midway
  /// between two columns of them; parts that couldn't be told apart so are one. O(n log n).
  Parts(const Scene& scene, const Plan& plan);

  std::size_t count() const { return cuts_.size() + 1; }
  std::size_t groups() const { return cuts_.empty() ? 1 : count() + 1; }

  /// Who of those awake is where. Returns whether anybody is in another part than before. O(awake).
  bool place(const State& state, Rows awake);

  /// Of those whom place() was given last, who is in that part, ascending. Expects several parts.
  Rows rows(std::size_t part) const { return Rows::of(rows_[part]); }

  std::size_t group(std::uint32_t a) const { return cuts_.empty() ? 0 : part_[a]; }
  /// `a` is a body, `b` may stand behind all bodies, for the obstacles of a's part.
  std::size_t group(std::uint32_t a, std::uint32_t b) const {
    if (cuts_.empty()) return 0;
    return b >= part_.size() || part_[a] == part_[b] ? part_[a] : count();
  }

 private:
  Eigen::Index axis_ = 0;
  std::vector<double> cuts_;                      // m, along that axis, ascending
  std::vector<std::uint8_t> part_;                // of each body; empty where there is one
  std::vector<std::vector<std::uint32_t>> rows_;  // of each part; likewise
};

}  // namespace throng
