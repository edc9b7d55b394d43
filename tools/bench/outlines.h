// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

#include "narrowphase/convex.h"

/// Large polygons: stars, gears, coastlines; about 1 m in radius, counter-clockwise and simple for any size.
namespace throng::bench {

using narrowphase::Vec;
using Ring = std::vector<Vec>;

/// In [-1, 1), of a place: the same everywhere (Steele, Lea and Flood 2014, their mixing).
inline double noise(std::uint64_t seed, std::uint64_t place) {
  std::uint64_t z = seed * 0xbf58476d1ce4e5b9u + place * 0x9e3779b97f4a7c15u;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
  return static_cast<double>((z ^ (z >> 31)) >> 11) * 0x1p-52 - 1.0;
}

/// The polygon around the origin that has these radii at equal angles.
inline Ring around(const std::vector<double>& radii) {
  Ring ring;
  ring.reserve(radii.size());
  for (std::size_t i = 0; i < radii.size(); ++i) {
    const double angle = 2.0 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(radii.size());
    const narrowphase::Pose p = narrowphase::pose({0.0, 0.0}, angle);
    ring.emplace_back(radii[i] * p.cos, radii[i] * p.sin);
  }
  return ring;
}

inline std::vector<double> star_radii(std::size_t edges) {
  std::vector<double> radii(edges);
  for (std::size_t i = 0; i < edges; ++i) radii[i] = i % 2 == 0 ? 1.0 : 0.5;
  return radii;
}

/// Teeth of four edges, 0.1 high.
inline std::vector<double> gear_radii(std::size_t edges) {
  std::vector<double> radii(edges);
  for (std::size_t i = 0; i < edges; ++i) radii[i] = i % 4 < 2 ? 1.0 : 0.9;
  return radii;
}

/// Midpoint displacement of the radius (Fournier, Fussell and Carpenter 1982): half as many edges need 2^0.8
/// times the displacement, so the coast has dimension 1.2. Expects a power of two.
inline std::vector<double> coast_radii(std::size_t edges, std::uint64_t seed) {
  std::vector<double> radii(edges, 1.0);
  double size = 0.15;
  for (std::size_t step = edges; step > 1; step /= 2) {
    for (std::size_t i = step / 2; i < edges; i += step)
      radii[i] = 0.5 * (radii[i - step / 2] + radii[(i + step / 2) % edges]) + size * noise(seed, i);
    size *= 0.5743491774985174;  // 2^-0.8
  }
  return radii;
}

/// The same a little farther out.
inline std::vector<double> widened(std::vector<double> radii, double by) {
  for (double& radius : radii) radius += by;
  return radii;
}

inline Ring turned(Ring ring, double angle) {
  const narrowphase::Pose p = narrowphase::pose({0.0, 0.0}, angle);
  for (Vec& v : ring) v = p * v;
  return ring;
}

}  // namespace throng::bench
