// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

namespace throng {

/// Agents of radii (m) so much alike that they have the same ways.
struct SizeClass {
  double least, largest;
};

inline constexpr std::size_t kMostSizes = 16;

/// The classes of these radii, ascending: in each the same passages are open to all, whose widths (m) are
/// given, ascending, and the largest is at most half as large again as the least. Where that makes more than
/// kMostSizes of them, radii that differ by little share a class too, and the widest of it says what is open.
std::vector<SizeClass> size_classes(std::vector<double> radii, const std::vector<double>& passages);

}  // namespace throng
