// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "sim/contact/body_rows.h"
#include "sim/contact/parts.h"

namespace throng {

/// The bodies that a solver works on, those of a part side by side: what a thread writes would else stand
/// among what others read, and be fetched from them again and again.
class SolverBodies {
 public:
  explicit SolverBodies(std::size_t n) : bodies_(n) {}

  std::size_t size() const { return bodies_.size(); }
  SolverBody& operator[](std::size_t row) { return rows()[row]; }
  const SolverBody& operator[](std::size_t row) const { return rows()[row]; }

  operator BodyRows<SolverBody>() { return rows(); }
  operator BodyRows<const SolverBody>() const { return rows(); }
  BodyRows<SolverBody> rows() { return {bodies_, places_}; }
  BodyRows<const SolverBody> rows() const { return {bodies_, places_}; }

  /// Brings those of each part together, in the order of their rows, with the row that stands for obstacles
  /// among the part's contacts, where they aren't nearly so. Returns whether somebody stands elsewhere now.
  /// O(bodies).
  bool arrange(const Parts& parts);

 private:
  std::vector<SolverBody> bodies_, old_;
  std::vector<std::uint32_t> places_, old_places_;  // of each row; empty where each stands at its own
  std::vector<std::uint8_t> part_;                  // of each row, when they were arranged
};

}  // namespace throng
