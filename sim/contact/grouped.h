// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "sim/contact/strips.h"
#include "sim/workers.h"

namespace throng {

/// The contacts of one kind: numbered as in their list, in the blocks of their groups (strips.h).
template <class Blocks>
class Grouped {
 public:
  void clear() { seat_.clear(); }

  /// Forgets all, and makes room for so many contacts between so many rows of bodies.
  void start(std::size_t contacts, std::size_t bodies, std::size_t groups) {
    seat_.resize(contacts);
    free_from_.assign(bodies, 0);
    if (blocks_.size() < groups) blocks_.resize(groups);
  }

  /// Forgets the group's. `nobody`: its row that never moves. Groups of one phase may be filled at once.
  void start_group(std::size_t group, std::size_t phase, std::uint32_t nobody) {
    blocks_[group].start(free_from_, static_cast<std::uint32_t>(phase << 28), nobody);
  }

  /// The contact with that number has this seat in the blocks of its group.
  void seat(std::size_t i, std::size_t group, std::uint32_t seat) {
    seat_[i] = {static_cast<std::uint32_t>(group), seat};
  }

  Blocks& group(std::size_t group) { return blocks_[group]; }

  /// None where there are no contacts.
  auto blocks(std::size_t group) {
    return size() > 0 ? blocks_[group].blocks() : decltype(blocks_[group].blocks())();
  }

  std::size_t size() const { return seat_.size(); }
  double normal_impulse(std::size_t i) const { return of(i).normal_impulse(seat_[i].seat); }    ///< N s
  double tangent_impulse(std::size_t i) const { return of(i).tangent_impulse(seat_[i].seat); }  ///< N s

  /// As the solver left it.
  auto operator[](std::size_t i) const { return of(i)[seat_[i].seat]; }

 private:
  struct Seat {
    std::uint32_t group, seat;
  };

  const Blocks& of(std::size_t i) const { return blocks_[seat_[i].group]; }

  std::vector<Seat> seat_;                // of each contact
  std::vector<Blocks> blocks_;            // of each group; never shrinks
  std::vector<std::uint32_t> free_from_;  // as BlockOrder::start
};

}  // namespace throng
