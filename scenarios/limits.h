// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

/// What a scenario may ask for. The bounds are far beyond any use and keep every later sum and product
/// finite.
namespace throng::scenarios {

constexpr std::size_t kMostBytes = std::size_t{64} << 20;  ///< of a file
constexpr int kDeepest = 32;                               ///< levels of lists, tables and dotted keys
constexpr std::size_t kMostItems = 10'000'000;             ///< values in a file
constexpr std::size_t kMostBodies = 10'000'000;
constexpr std::size_t kMostVertices = 10'000;     ///< of one polygonal shape, its holes included
constexpr std::size_t kMostHoles = 1'000;         ///< of one polygonal shape
constexpr std::size_t kMostParts = 1'000;         ///< discs of one composite
constexpr std::size_t kMostInShapes = 1'000'000;  ///< vertices and discs of all shapes together

constexpr std::size_t kMostLinks = 1'000;  ///< of all robots and bodies of a motion
constexpr std::size_t kMostWaypoints = 10'000;
constexpr std::size_t kMostMayTouch = 10'000;    ///< pairs of names
constexpr std::size_t kMostAtOnce = 10'000'000;  ///< links and pairs of a motion, times its segments: 2 GB

constexpr double kFarthest = 1e9;        ///< m, any coordinate
constexpr double kShortest = 1e-9;       ///< m, any radius
constexpr double kShortestEdge = 1e-12;  ///< m, of walls, polygons and domains: its square must be far from 0
constexpr double kLeastArea = 1e-20;     ///< m², of any shape: its mass must be more than 0
constexpr double kLeastLeft = 1e-10;     ///< of a polygon's area, by its holes: its centre needs the digits
constexpr double kFastest = 1e9;         ///< m/s
constexpr double kShortestStep = 1e-12;  ///< s

}  // namespace throng::scenarios
