// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <vector>

#include "broadphase/neighbours.h"

namespace throng::broadphase {

inline std::vector<Neighbour> list(const NeighbourLists& lists, std::size_t i) {
  std::vector<Neighbour> result;
  for (std::size_t k = lists.begin[i]; k < lists.begin[i + 1]; ++k)
    result.push_back({lists.row[k], lists.distance[k]});
  return result;
}

}  // namespace throng::broadphase
