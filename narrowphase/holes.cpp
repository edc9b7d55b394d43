// SPDX-License-Identifier: MIT
#include "narrowphase/holes.h"

#include <utility>

#include "narrowphase/bvh_edges.h"
#include "narrowphase/crossing.h"
#include "narrowphase/polygon.h"
#include "narrowphase/relative.h"

namespace throng::narrowphase {

namespace {

CleanedRings refused(std::size_t ring, std::string why) {
  return {{}, {}, {ring, std::move(why)}};
}

std::string ring_name(std::size_t ring) {
  return ring == 0 ? "the outline" : "hole " + std::to_string(ring - 1);
}

/// Of a point that doesn't lie on the ring.
bool holds(const std::vector<Vec>& ring, const Vec& point) {
  bool inside = false;
  for (std::size_t i = 0; i < ring.size(); ++i)
    if (ray_passes(point, ring[i], ring[next(i, ring.size())])) inside = !inside;
  return inside;
}

/// What is wrong with where hole `ring` lies; rings don't meet, so that one vertex speaks for all.
std::string misplaced(const std::vector<std::vector<Vec>>& rings, std::size_t ring) {
  const Vec& vertex = rings[ring][0];
  if (!holds(rings[0], vertex)) return "lies outside the outline";
  for (std::size_t other = 1; other < rings.size(); ++other)
    if (other != ring && holds(rings[other], vertex))
      return "lies in " + ring_name(other) + ": what stands in a hole is a shape of its own";
  return {};
}

/// Of rings that are simple each: what is wrong with them together.
RingNote find_fault(const std::vector<std::vector<Vec>>& rings, const std::vector<Cleaned>& cleaned) {
  if (const auto meeting = find_crossing(rings)) {
    const auto& [early, late] = *meeting;
    return {late.ring, edge_name(cleaned[late.ring], late.edge) + " meets " +
                           edge_name(cleaned[early.ring], early.edge) + " of " + ring_name(early.ring) +
                           " (vertices and holes counted from 0): they must not cross or touch"};
  }
  for (std::size_t ring = 1; ring < rings.size(); ++ring)
    if (std::string why = misplaced(rings, ring); !why.empty()) return {ring, std::move(why)};
  return {};
}

}  // namespace

CleanedRings clean(std::span<const std::vector<Vec>> rings) {
  CleanedRings result;
  std::vector<Cleaned> cleaned;
  for (std::size_t ring = 0; ring < rings.size(); ++ring) {
    cleaned.push_back(ring == 0 ? clean(rings[0]) : clean_hole(rings[ring]));
    if (!cleaned[ring].refusal.empty()) return refused(ring, std::move(cleaned[ring].refusal));
    for (std::string& repair : cleaned[ring].repairs) result.repairs.push_back({ring, std::move(repair)});
    result.rings.push_back(cleaned[ring].vertices);
  }
  if (RingNote fault = find_fault(result.rings, cleaned); !fault.text.empty())
    return refused(fault.ring, std::move(fault.text));
  return result;
}

}  // namespace throng::narrowphase
