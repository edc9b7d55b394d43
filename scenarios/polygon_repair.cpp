// SPDX-License-Identifier: MIT
#include "scenarios/polygon_repair.h"

#include <string_view>
#include <vector>

#include "scenarios/geos.h"
#include "scenarios/polygon_check.h"
#include "scenarios/region_sets.h"

namespace throng::scenarios {

namespace {

/// What the ring encloses; nothing where that isn't plain.
Region inside_of(const Geos& geos, const GEOSGeometry* ring) {
  const std::vector<Vec> points = points_of(geos, ring);
  if (points.size() < 3) return {};
  const std::string fault = polygon_fault(polygon_wkt(points));
  const bool only_touches_itself = fault.find("Ring Self-intersection") != std::string::npos;
  return fault.empty() || only_touches_itself ? Region{{points}} : Region();
}

Region inside_of_polygon(const Geos& geos, const GEOSGeometry* polygon) {
  Region left = inside_of(geos, GEOSGetExteriorRing_r(geos.handle, polygon));
  for (int i = 0; i < GEOSGetNumInteriorRings_r(geos.handle, polygon) && !left.empty(); ++i) {
    const Region hole = inside_of(geos, GEOSGetInteriorRingN_r(geos.handle, polygon, i));
    const Region whole = inside_of(geos, GEOSGetExteriorRing_r(geos.handle, polygon));
    if (hole.empty() || !(common_area(whole, hole) > 0.0)) return {};
    left = without(left, hole);
  }
  return left;
}

}  // namespace

Region repaired_polygon(const std::string& wkt) {
  const Geos geos;
  const Geometry all = read(geos, wkt);
  if (!all) return {};
  std::vector<Region> insides;
  for (int i = 0; i < GEOSGetNumGeometries_r(geos.handle, all.get()); ++i) {
    insides.push_back(inside_of_polygon(geos, GEOSGetGeometryN_r(geos.handle, all.get(), i)));
    if (insides.back().empty()) return {};
  }
  return insides.empty() ? Region() : united(insides);
}

}  // namespace throng::scenarios
