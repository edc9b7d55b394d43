// SPDX-License-Identifier: MIT
#pragma once

#include <cassert>
#include <cstddef>
#include <cstdint>
#include <span>
#include <type_traits>
#include <vector>

#include "sim/contact/contact.h"

namespace throng {

/// Bodies by their rows, wherever they stand: `Body` is SolverBody, const or not. A view, to be passed by
/// value.
template <class Body>
class BodyRows {
 public:
  BodyRows() = default;

  /// Each stands where its row says.
  BodyRows(std::span<Body> bodies) : bodies_(bodies) {}
  BodyRows(std::vector<std::remove_const_t<Body>>& bodies) : bodies_(bodies) {}
  BodyRows(const std::vector<SolverBody>& bodies)
    requires std::is_const_v<Body>
      : bodies_(bodies) {}

  /// Row i stands at places[i]; nowhere else, where that is empty.
  BodyRows(std::span<Body> bodies, std::span<const std::uint32_t> places)
      : bodies_(bodies), places_(places) {
    assert(places.empty() || places.size() == bodies.size());
  }
  template <class Other>
    requires(std::is_const_v<Body> && !std::is_const_v<Other>)
  BodyRows(BodyRows<Other> other) : BodyRows(other.by_place(), other.places()) {}

  std::size_t size() const { return bodies_.size(); }
  Body& operator[](std::size_t row) const { return bodies_[place(row)]; }

  std::uint32_t place(std::size_t row) const {
    return places_.empty() ? static_cast<std::uint32_t>(row) : places_[row];
  }
  std::span<Body> by_place() const { return bodies_; }
  std::span<const std::uint32_t> places() const { return places_; }

 private:
  std::span<Body> bodies_;
  std::span<const std::uint32_t> places_;
};

/// Both ways: where each row stands, and whose place it is.
class BodyPlaces {
 public:
  /// `places`: as in BodyRows, for as long as they are asked for. O(places).
  void start(std::span<const std::uint32_t> places) {
    places_ = places, rows_.resize(places.size());
    for (std::uint32_t row = 0; row < places.size(); ++row) rows_[places[row]] = row;
  }

  std::uint32_t place(std::uint32_t row) const { return places_.empty() ? row : places_[row]; }
  std::uint32_t row(std::uint32_t place) const { return rows_.empty() ? place : rows_[place]; }

 private:
  std::span<const std::uint32_t> places_;
  std::vector<std::uint32_t> rows_;
};

}  // namespace throng
