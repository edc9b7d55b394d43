// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "broadphase/point.h"

/// The clouds of `throng bench broadphase`, drawn from a fixed seed.
namespace throng::bench {

enum class Kind {
  uniform,    ///< in a square
  clustered,  ///< Gaussian blobs of 1,000 points
  line,       ///< along the x axis
  mixed,      ///< discs in a square, as many of each power of two between the smallest and 1,000 times it
};

struct Cloud {
  std::string name;  ///< the case
  std::vector<broadphase::Point> points;
  double reach = 1.0;         ///< m: two points that are at most so far apart are a pair
  std::vector<double> radii;  ///< m; of discs, which are pairs where they touch: else empty
};

/// The name of a case, as in "uniform n=1000000 k=10 random".
std::string case_name(Kind kind, std::size_t n, double k, bool spatial);

/// `n` points, or discs, each with `k` others near it in the mean; in random order, or by rows of cells.
Cloud cloud(Kind kind, std::size_t n, double k, bool spatial, double size_ratio = 1000.0);

/// 64 random bits of (seed, index): SplitMix64 (Steele, Lea, Flood 2014).
std::uint64_t random_bits(std::uint64_t seed, std::uint64_t index);

/// A number of [0, 1).
double random_unit(std::uint64_t seed, std::uint64_t index);

}  // namespace throng::bench
