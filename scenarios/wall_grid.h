// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

#include "narrowphase/convex.h"
#include "sim/scene.h"

namespace throng::scenarios {

/// The straight pieces of all walls, and who of them comes near a place: a hashed grid in which a piece lies
/// in every cell that it crosses. In a periodic domain the pieces' images lie there too.
class WallGrid {
 public:
  struct Piece {
    Vec a, b;            ///< m
    std::uint32_t wall;  ///< row of Scene::walls
  };

  /// `reach` (m): the farthest that `visit_near` will be asked to look. O(cells that the pieces cross), at
  /// most about a million.
  WallGrid(const Scene& scene, double reach);

  /// Calls visit(piece) for each piece that comes closer than `reach` to `position` until one call returns
  /// true; some pieces more than once.
  template <class Visit>
  bool visit_near(const Vec& position, double reach, Visit&& visit) const;

 private:
  struct Entry {
    std::uint32_t piece, next;
    std::int64_t x, y;
  };
  static constexpr std::uint32_t kNone = 0xFFFFFFFF;

  void add_piece(const Domain& domain, double reach, const Piece& piece);
  void enter(std::uint32_t piece);
  void enter_cell(std::uint32_t piece, std::int64_t x, std::int64_t y);
  std::size_t bucket(std::int64_t x, std::int64_t y) const;

  double cell_ = 1.0;
  std::vector<Piece> pieces_;
  std::vector<Entry> entries_;
  std::vector<std::uint32_t> heads_;
};

/// How far `point` is from the piece, m.
double distance(const WallGrid::Piece& piece, const Vec& point);

template <class Visit>
bool WallGrid::visit_near(const Vec& position, double reach, Visit&& visit) const {
  if (pieces_.empty()) return false;
  const auto cell_of = [this](double x) { return static_cast<std::int64_t>(std::floor(x / cell_)); };
  const std::int64_t x1 = cell_of(position.x() + reach), y1 = cell_of(position.y() + reach);
  for (std::int64_t y = cell_of(position.y() - reach); y <= y1; ++y)
    for (std::int64_t x = cell_of(position.x() - reach); x <= x1; ++x)
      for (std::uint32_t i = heads_[bucket(x, y)]; i != kNone; i = entries_[i].next) {
        const Entry& entry = entries_[i];
        if (entry.x != x || entry.y != y || !(distance(pieces_[entry.piece], position) < reach)) continue;
        if (visit(pieces_[entry.piece])) return true;
      }
  return false;
}

}  // namespace throng::scenarios
