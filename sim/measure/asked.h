// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Geometry>
#include <optional>

/// What a scenario asks to be observed of its bodies as a whole, beside energies, momentum and overlaps.
namespace throng {

/// Equal bins from 0 on; none where it isn't asked for.
struct Bins {
  double up_to = 0.0;
  int count = 0;

  double width() const { return up_to / count; }
  explicit operator bool() const { return count > 0; }
};

struct Asked {
  bool temperature = false, packing_fraction = false, coordination_number = false;
  bool collisions = false, compressibility_factor = false;
  std::optional<Eigen::AlignedBox2d> packing_within;  ///< m, where the fraction is taken; absent: the domain
  Bins speeds;                                        ///< m/s
  Bins pair_correlation;                              ///< m
  std::optional<Eigen::AlignedBox2d> correlation_within;  ///< m, whose pairs are told; absent: the domain

  bool any() const {
    return temperature || packing_fraction || coordination_number || collisions || compressibility_factor ||
           speeds || pair_correlation;
  }
};

inline constexpr int kMostBins = 10'000;

}  // namespace throng
