// SPDX-License-Identifier: MIT
#include "scenarios/wall_grid.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace throng::scenarios {

namespace {

constexpr double kMostCells = 1e6;

double total_length(const std::vector<WallGrid::Piece>& pieces) {
  double length = 0.0;
  for (const WallGrid::Piece& piece : pieces) length += (piece.b - piece.a).norm();
  return length;
}

}  // namespace

double distance(const WallGrid::Piece& piece, const Vec& point) {
  const Vec along = piece.b - piece.a;
  const double square = along.squaredNorm();
  const double t = square > 0.0 ? std::clamp((point - piece.a).dot(along) / square, 0.0, 1.0) : 0.0;
  return (piece.a + t * along - point).norm();
}

WallGrid::WallGrid(const Scene& scene, double reach) {
  for (std::size_t wall = 0; wall < scene.walls.size(); ++wall) {
    const std::vector<Vec>& points = scene.walls[wall].points;
    const std::size_t count = scene.walls[wall].closed ? points.size() : points.size() - 1;
    for (std::size_t i = 0; i < count; ++i)
      add_piece(scene.domain, reach,
                {points[i], points[(i + 1) % points.size()], static_cast<std::uint32_t>(wall)});
  }
  const double length = total_length(pieces_);
  cell_ = std::max({2.0 * reach, 2.0 * length / kMostCells, 1e-9});
  heads_.assign(std::bit_ceil(8 * pieces_.size() + static_cast<std::size_t>(4.0 * length / cell_) + 16),
                kNone);
  for (std::size_t i = 0; i < pieces_.size(); ++i) enter(static_cast<std::uint32_t>(i));
}

void WallGrid::add_piece(const Domain& domain, double reach, const Piece& piece) {
  if (domain.kind != DomainKind::periodic) {
    pieces_.push_back(piece);
    return;
  }
  const Vec size = domain.max - domain.min;
  for (int i = -1; i <= 1; ++i)
    for (int j = -1; j <= 1; ++j) {
      const Vec shift(i * size.x(), j * size.y());
      const Vec low = piece.a.cwiseMin(piece.b) + shift, high = piece.a.cwiseMax(piece.b) + shift;
      const bool near = (low.array() <= domain.max.array() + reach).all() &&
                        (high.array() >= domain.min.array() - reach).all();
      if (near) pieces_.push_back({piece.a + shift, piece.b + shift, piece.wall});
    }
}

/// Enters the piece in each row of cells where it passes, one cell wider to both sides than rounding could
/// matter.
void WallGrid::enter(std::uint32_t index) {
  const Piece& piece = pieces_[index];
  const Vec& low = piece.a.y() <= piece.b.y() ? piece.a : piece.b;
  const Vec& high = piece.a.y() <= piece.b.y() ? piece.b : piece.a;
  const double rise = high.y() - low.y();
  const auto cell_of = [this](double x) { return static_cast<std::int64_t>(std::floor(x / cell_)); };
  for (std::int64_t y = cell_of(low.y()); y <= cell_of(high.y()); ++y) {
    const auto x_at = [&](double height) {
      const double t = rise > 0.0 ? std::clamp((height - low.y()) / rise, 0.0, 1.0) : 0.0;
      return low.x() + t * (high.x() - low.x());
    };
    const double from = rise > 0.0 ? x_at(static_cast<double>(y) * cell_) : low.x();
    const double to = rise > 0.0 ? x_at(static_cast<double>(y + 1) * cell_) : high.x();
    const std::int64_t x1 = cell_of(std::max(from, to)) + 1;
    for (std::int64_t x = cell_of(std::min(from, to)) - 1; x <= x1; ++x) enter_cell(index, x, y);
  }
}

void WallGrid::enter_cell(std::uint32_t piece, std::int64_t x, std::int64_t y) {
  std::uint32_t& head = heads_[bucket(x, y)];
  entries_.push_back({piece, head, x, y});
  head = static_cast<std::uint32_t>(entries_.size() - 1);
}

std::size_t WallGrid::bucket(std::int64_t x, std::int64_t y) const {
  std::uint64_t h = static_cast<std::uint64_t>(x) * 0x9E3779B97F4A7C15ULL;
  h = (h ^ (h >> 32) ^ static_cast<std::uint64_t>(y)) * 0xD6E8FEB86659FD93ULL;
  return (h ^ (h >> 32)) & (heads_.size() - 1);
}

}  // namespace throng::scenarios
