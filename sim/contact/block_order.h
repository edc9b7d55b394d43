// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <vector>

/// Which contacts may be solved at once.
namespace throng {

/// Instead of a lane, where there is none.
inline constexpr std::uint32_t kNoLane = ~std::uint32_t{0};

/// What a contact in a block keeps for the next step (N s), as in ContactBase.
struct BlockImpulses {
  double normal, tangent, preload;
};

/// A contact in its lane, to be looked at and changed.
struct BlockContact {
  std::uint32_t a, b;  ///< rows of the bodies
  double* normal_mass;
  double *normal_impulse, *tangent_impulse, *preload;
};

/// Puts contacts, in their order, into blocks of `kWidth` lanes. No body that a contact can move stands twice
/// in a block, and each contact comes in a later block than every earlier one that shares such a body: to
/// solve block after block, all lanes at once, gives the bits of solving contact after contact. So the
/// solver's order, and with it how it converges, is that of the list.
class BlockOrder {
 public:
  static constexpr std::size_t kWidth = 8, kKinds = 2;

  /// Forgets all. Allocates only to grow. O(1) where nothing is to be forgotten.
  void start(std::size_t bodies);

  /// The lane of the next contact: block * kWidth + lane, lanes of a block ascending. Whoever doesn't move
  /// stands in no one's way. Contacts of one kind, below kKinds, share no block with others. O(1) amortized,
  /// nearly.
  std::uint32_t place(std::uint32_t a, bool a_moves, std::uint32_t b, bool b_moves, std::size_t kind = 0);

  std::size_t blocks() const { return filled_.size(); }
  std::size_t filled(std::size_t block) const { return filled_[block]; }  ///< lanes in use

 private:
  using Ways = std::vector<std::uint32_t>;  // of each block: itself, or one on the way to the next with room

  std::uint32_t open_from(std::uint32_t block, std::size_t kind);
  void add_block(std::size_t kind);

  std::uint32_t first_open_ = 0;          // all blocks before it are full
  std::vector<std::uint32_t> free_from_;  // of each body: the first block that it may stand in
  std::array<Ways, kKinds> next_open_;    // for each kind
  std::vector<std::uint8_t> filled_;
};

}  // namespace throng
