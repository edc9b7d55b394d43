// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "sim/crowd/cell_piece.h"
#include "sim/crowd/crowd_cells.h"
#include "sim/crowd/region.h"

namespace throng {

/// The density of a crowd in an area by what room each agent has: the parts of the agents' Voronoi cells that
/// are in the area, each in proportion to its cell, over the area: Steffen and Seyfried, "Methods for
/// measuring pedestrian density, flow, speed and direction with minimal scatter" (Physica A 2010). Cells end
/// at a distance from their agent and at the floor's edges: what lies behind a wall of two sides, a hole of
/// the floor, isn't the agent's; thin walls on the floor end none.
class VoronoiDensity {
 public:
  /// `area`: the part of it that is floor, of `size` (m²). Cells reach as far as `cutoff` (m): they begin as
  /// regular polygons of 64 sides that circles of that radius are in.
  VoronoiDensity(const Region& floor, const Region& area, double size, double cutoff);

  /// 1/m², of agents at these places; two at one place share their cell. O(agents near (k + e)), k = agents
  /// within twice the cut-off, e = edges of floor and area near a cell, as CellPiece.
  double density(std::span<const Vec> position);

 private:
  /// The part of the plane that is nearer to that agent than to any other, about the agent.
  void make_cell(std::size_t agent);
  void find_others(const Vec& p, double reach);
  void leave_to_others();
  double farthest() const;

  /// Who may take a part of it.
  struct Other {
    double square;      ///< m², of `to`
    std::size_t place;  ///< in the cells, as two may be equally far
    Vec to;             ///< m
  };

  CellPiece piece_;
  Eigen::AlignedBox2d near_;  // m: agents outside have no cell in the area
  double size_;               // m²
  double cutoff_;             // m
  std::vector<Vec> disc_;     // m, the polygon round the cut-off's circle
  CrowdCells cells_;
  std::vector<Vec> agents_, cell_;
  std::vector<Other> others_;
};

}  // namespace throng
