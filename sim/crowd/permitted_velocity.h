// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <vector>

#include "sim/crowd/region.h"

namespace throng {

/// The velocities v with normal . v >= offset.
struct HalfPlane {
  Vec normal{1.0, 0.0};  ///< of length 1
  double offset = 0.0;   ///< m/s
};

/// Half planes one after another, an array for each number; behind the last one there is room for kPadding.
struct HalfPlanes {
  std::vector<double> normal_x, normal_y, offset;
  std::size_t size = 0;
  static constexpr std::size_t kPadding = 8;

  HalfPlane operator[](std::size_t i) const { return {Vec(normal_x[i], normal_y[i]), offset[i]}; }

  void make_room(std::size_t count) {
    if (normal_x.size() >= count + kPadding) return;
    for (std::vector<double>* all : {&normal_x, &normal_y, &offset}) all->resize(2 * count + kPadding);
  }
  void push_back(const HalfPlane& plane) {
    make_room(size + 1);
    normal_x[size] = plane.normal.x(), normal_y[size] = plane.normal.y(), offset[size++] = plane.offset;
  }
};

/// The velocity nearest to `preferred` (m/s) that is no faster than `most` and lies in all half planes. Where
/// there is none, one no faster than `most` that lies in the first `hard` of them and is least deep outside
/// that of the others in which it is deepest outside. Expects that there is one in the hard ones; without,
/// one near them. Within a few ulp of `most` of the true solution where the half planes that bound it meet at
/// a good angle.
///
/// Linear programs of two and three variables, plane by plane: de Berg et al., "Computational Geometry"
/// (chapter 4), as van den Berg, Guy, Lin and Manocha use them in "Reciprocal n-body collision avoidance"
/// (ISRR 2009; 2011). O(n) mostly, O(n^2) without, O(n^3) in the worst order. `room` is scratch.
Vec permitted_velocity(const HalfPlanes& planes, std::size_t hard, double most, const Vec& preferred,
                       HalfPlanes& room);

}  // namespace throng
