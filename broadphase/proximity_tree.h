// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <span>
#include <vector>

#include "broadphase/box_index.h"
#include "broadphase/point.h"
#include "broadphase/spatial_order.h"

/// Points, discs or boxes, kept so that questions about what is near a place are answered fast however they
/// are spread: the structure; `neighbours.h` asks it. For all pairs within one distance use `AllPairs`.
///
/// A packed tree (Kamel and Faloutsos, "On Packing R-trees", 1993): the items along a Hilbert curve, eight a
/// leaf, eight leaves or nodes a node. It has no cell size to choose, costs about 50 bytes a point, and a
/// question takes O(log n + answers) in uniform clouds, blobs and lines alike, from however far away it is
/// asked.
namespace throng::broadphase {

struct ProximityTree {
  static constexpr std::size_t kWidth = 8;  ///< items of a leaf, children of a node

  enum class Kind { points, discs, boxes };

  struct alignas(64) Leaf {
    double x[kWidth], y[kWidth];  ///< m: the point, the centre, the lower left corner; infinite where unused
    std::uint64_t row[kWidth];
  };
  struct alignas(64) Corner {
    double x[kWidth], y[kWidth];
  };
  struct alignas(64) Node {
    double low_x[kWidth], low_y[kWidth], high_x[kWidth], high_y[kWidth];  ///< m, of the children
  };
  struct alignas(64) Lengths {
    double of[kWidth];
  };
  struct alignas(64) Groups {
    std::uint64_t of[kWidth];
  };
  struct alignas(32) FirstRows {
    std::uint32_t of[kWidth];
  };

  /// What each row belongs to, a bit a group; empty: all rows to all groups.
  using GroupBits = std::span<const std::uint32_t>;

  /// Indexes a copy of the points. Expects finite coordinates of at most 1e150 m, in a periodic domain inside
  /// it, and fewer than 2^31 points. O(n), see `SpatialOrder`; allocates only to grow.
  void build(std::span<const Point> points, const Period* period = nullptr, GroupBits groups = {});

  /// The same for discs, in a periodic domain those whose nearest images of the centre count. Expects finite
  /// radius >= 0.
  void build(std::span<const Point> centres, std::span<const double> radius, const Period* period = nullptr,
             GroupBits groups = {});

  /// The same for boxes that are not empty, in the plane.
  void build(std::span<const Box> boxes, GroupBits groups = {});

  std::size_t size() const { return order.size(); }

  Kind kind = Kind::points;
  bool periodic = false;
  Period period{{0.0, 0.0}, {1.0, 1.0}};
  std::vector<std::uint32_t> order;  ///< rows along the curve: leaf i holds those from 8 i on
  std::vector<Leaf> leaves;
  std::vector<Node> nodes;           ///< a level after the other, that of the leaves' parents first
  std::vector<std::size_t> level;    ///< where each level begins in `nodes`, and one more; the root is last
  std::vector<FirstRows> first_row;  ///< of each node's child the lowest in it: of equally near ones it wins
  std::vector<Corner> leaf_high;     ///< of boxes: upper right corners
  std::vector<Lengths> leaf_radius, node_radius;  ///< of discs; of a node's child the largest
  std::vector<Groups> leaf_groups, node_groups;   ///< of a node's child all that are in it

 private:
  void place(std::span<const Point> places, const Period* in);
  void fill_leaves(std::span<const Point> places);
  void fill_nodes();
  void fill_first_rows();
  void fill_radii(std::span<const double> radius);
  void fill_groups(GroupBits groups);

  SpatialOrder spatial_order_;
  std::vector<Point> places_;  // of boxes: their centres
};

}  // namespace throng::broadphase
