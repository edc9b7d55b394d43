// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "sim/contact_row.h"
#include "sim/scene.h"

namespace throng::recording {

/// Where bodies are, by and large: in the domain or, where it has no bounds, on the floor; without either
/// around where they begin.
Eigen::AlignedBox2d place_of_bodies(const Scene& scene);

/// Which bodies a recording holds, and in which of its rows: those of record.ids, in order of id, in each
/// frame those whose centre is within the region of record.within, agents until they leave.
class Selection {
 public:
  explicit Selection(const Scene& scene);

  std::size_t rows() const { return ids_.size(); }
  std::span<const std::uint32_t> ids() const { return ids_; }  ///< ascending, by row
  bool all() const { return row_of_.empty(); }                 ///< row = id - 1
  bool changes() const { return changes_; }                    ///< from frame to frame: bodies_come_and_go

  /// Whether a contact of the run is one of a frame: one of its sides is. `is_present`: as Frame has it.
  bool keeps(const ContactRow& contact, std::span<const std::uint8_t> is_present) const {
    return has(contact.a, is_present) || has(contact.b, is_present);
  }

  static constexpr std::uint32_t kNone = ~std::uint32_t{0};
  std::uint32_t row_of(std::uint32_t id) const { return all() ? id - 1 : row_of_[id]; }  ///< kNone: left out

  /// Whether a body at that place (m) is in a frame. A position of a domain that repeats counts as its image
  /// within the domain. Borders are in.
  bool is_within(const Vec& position) const;

  /// Whether bodies in rows of these ids stand as the recording has them.
  bool is_order(std::span<const std::uint32_t> id) const;

  /// Puts what stands in a body's row of `from`, so many numbers, into its row of `to`.
  template <int components>
  void bring(std::span<const std::uint32_t> id, const double* from, std::vector<double>& to) const {
    for (std::size_t body = 0; body < id.size(); ++body) {
      const std::uint32_t row = row_of(id[body]);
      if (row == kNone) continue;
      for (std::size_t c = 0; c < components; ++c)
        to[components * std::size_t{row} + c] = from[components * body + c];
    }
  }

 private:
  bool has(std::uint32_t id, std::span<const std::uint8_t> is_present) const {
    const std::uint32_t row = id > 0 ? row_of(id) : kNone;
    return row != kNone && (is_present.empty() || is_present[row] != 0);
  }

  std::vector<std::uint32_t> ids_, row_of_;  // row_of_: by id; empty where all bodies are recorded
  bool changes_;
  Domain domain_;
  std::optional<Eigen::AlignedBox2d> within_;
};

}  // namespace throng::recording
