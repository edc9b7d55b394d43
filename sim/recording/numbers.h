// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "sim/crowd/region.h"

/// Lists of numbers as files have them.
namespace throng::recording {

/// The numbers of a list end to end.
template <class T>
std::span<const T> flat(const std::vector<T>& values) {
  return values;
}

inline std::span<const double> flat(const std::vector<Vec>& values) {
  return {values.empty() ? nullptr : values[0].data(), 2 * values.size()};
}

/// No branch for each number: 0 x is 0 unless x is not finite.
template <class T>
bool all_finite(std::span<const T> values) {
  T sums[4] = {0, 0, 0, 0};
  const std::size_t whole = values.size() / 4 * 4;
  for (std::size_t i = 0; i < whole; i += 4)
    for (std::size_t k = 0; k < 4; ++k) sums[k] += T{0} * values[i + k];
  for (std::size_t i = whole; i < values.size(); ++i) sums[0] += T{0} * values[i];
  return sums[0] + sums[1] + sums[2] + sums[3] == T{0};
}

}  // namespace throng::recording
