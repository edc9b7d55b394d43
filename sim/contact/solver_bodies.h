// SPDX-License-Identifier: MIT
#pragma once

#include <cassert>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "sim/contact/body_rows.h"
#include "sim/contact/parts.h"

namespace throng {

/// The bodies that a solver works on, those of a part side by side: what a thread writes would else stand
/// among what others read, and be fetched from them again and again.
class SolverBodies {
 public:
  explicit SolverBodies(std::size_t n) : bodies_(n) {}
  SolverBodies(const SolverBodies&) = delete;  // views know where the slots are
  SolverBodies& operator=(const SolverBodies&) = delete;

  std::size_t size() const { return bodies_.size(); }
  SolverBody& operator[](std::size_t row) { return rows()[row]; }
  const SolverBody& operator[](std::size_t row) const { return rows()[row]; }

  operator BodyRows<SolverBody>() { return rows(); }
  operator BodyRows<const SolverBody>() const { return rows(); }
  BodyRows<SolverBody> rows() { return {bodies_, slots_}; }
  BodyRows<const SolverBody> rows() const { return {bodies_, slots_}; }

  /// By rows, where there are no parts and so nobody is arranged.
  std::span<SolverBody> in_order() { return assert(part_.empty()), bodies_; }
  std::span<const SolverBody> in_order() const { return assert(part_.empty()), bodies_; }

  /// Brings those of each part together, in the order of their rows, and behind them the one that stands for
  /// obstacles among the part's contacts, where many stand elsewhere. Who keeps slots or views must ask for
  /// them anew. O(bodies).
  void arrange(const Parts& parts);

 private:
  std::vector<SolverBody> bodies_, old_;
  BodySlots slots_;
  std::vector<std::uint8_t> part_;  // of each row, when they were arranged
};

}  // namespace throng
