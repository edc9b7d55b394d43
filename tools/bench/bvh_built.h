// SPDX-License-Identifier: MIT
#pragma once

#include <nlohmann/json.hpp>

#include "tools/bench/bvh_pairs.h"

namespace throng::bench {

using namespace narrowphase;

/// A pair of polygons in hierarchies of one kind, and the sums of what these answer in all its places.
template <class Volume>
struct Built {
  std::string name;
  Outline<Volume> a, b;

  Built(std::string engine, const PolygonPair& pair)
      : name(std::move(engine)), a(outline<Volume>(pair.a)), b(outline<Volume>(pair.b)) {}

  double collisions(const PolygonPair& pair, Order order, BvhCounters* counters = nullptr) const {
    double count = 0.0;
    for (const auto& [at_a, at_b] : pair.places)
      count += collide(a, at_a, b, at_b, {order, nullptr, counters});
    return count;
  }
  double meetings(const PolygonPair& pair, BvhCounters* counters = nullptr) const {
    std::vector<std::pair<std::uint32_t, std::uint32_t>> found;
    double count = 0.0;
    for (const auto& [at_a, at_b] : pair.places) {
      find_meetings(a, at_a, b, at_b, found, counters);
      count += static_cast<double>(found.size());
    }
    return count;
  }
  double distances(const PolygonPair& pair, double relative_error, BvhCounters* counters = nullptr) const {
    double sum = 0.0;
    for (const auto& [at_a, at_b] : pair.places)
      sum += proximity(a, at_a, b, at_b, {relative_error, nullptr, counters}).upper;
    return sum;
  }
  /// One step after the other, each from the last one's closest edges.
  double coherent_distances(const PolygonPair& pair, double relative_error, OutlineCache& cache,
                            BvhCounters* counters = nullptr) const {
    double sum = 0.0;
    for (const auto& [at_a, at_b] : pair.places)
      sum += proximity(a, at_a, b, at_b, {relative_error, &cache, counters}).upper;
    return sum;
  }
};

/// A question's tests of nodes and of leaves.
inline nlohmann::ordered_json counted(const BvhCounters& counters) {
  return {{"nodes", static_cast<double>(counters.nodes) / kPlaces},
          {"leaves", static_cast<double>(counters.leaves) / kPlaces}};
}

}  // namespace throng::bench
