// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

#include "sim/contact/contact.h"

namespace throng {

/// Where in memory the body of each row stands, and whose slot it is: at its own, where nothing is said.
class BodySlots {
 public:
  BodySlots() = default;
  /// Expects each slot once.
  explicit BodySlots(std::vector<std::uint32_t> slots) : slots_(std::move(slots)), rows_(slots_.size()) {
    for (std::uint32_t row = 0; row < slots_.size(); ++row) rows_[slots_[row]] = row;
  }

  std::uint32_t slot(std::uint32_t row) const { return slots_.empty() ? row : slots_[row]; }
  std::uint32_t row(std::uint32_t slot) const { return rows_.empty() ? slot : rows_[slot]; }

  /// The slot of each row; null where each stands at its own.
  const std::uint32_t* of_rows() const { return slots_.empty() ? nullptr : slots_.data(); }

 private:
  std::vector<std::uint32_t> slots_, rows_;
};

/// Each row in its own slot.
inline const BodySlots kOwnSlots;

/// Bodies by their rows, in whatever slots: `Body` is SolverBody, const or not. A view, to be passed by
/// value.
template <class Body>
class BodyRows {
 public:
  BodyRows() = default;
  BodyRows(std::span<Body> bodies, const BodySlots& slots = kOwnSlots)
      : bodies_(bodies), slots_(&slots), slot_(slots.of_rows()) {}
  BodyRows(std::vector<std::remove_const_t<Body>>& bodies) : bodies_(bodies) {}
  BodyRows(const std::vector<SolverBody>& bodies) requires std::is_const_v<Body> : bodies_(bodies) {}
  template <class Other>
  requires(std::is_const_v<Body> && !std::is_const_v<Other>) BodyRows(BodyRows<Other> other)
      : BodyRows(other.by_slot(), other.slots()) {}

  std::size_t size() const { return bodies_.size(); }
  std::size_t slot(std::size_t row) const { return slot_ ? slot_[row] : row; }
  Body& operator[](std::size_t row) const { return bodies_[slot(row)]; }

  std::span<Body> by_slot() const { return bodies_; }
  const BodySlots& slots() const { return *slots_; }

 private:
  std::span<Body> bodies_;
  const BodySlots* slots_ = &kOwnSlots;
  const std::uint32_t* slot_ = nullptr;  // of each row, as in slots_
};

}  // namespace throng
