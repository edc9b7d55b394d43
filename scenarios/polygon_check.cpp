// SPDX-License-Identifier: MIT
#include "scenarios/polygon_check.h"

#include "scenarios/geos.h"
#include "scenarios/report.h"

namespace throng::scenarios {

namespace {

std::string at(const Geos& geos, const GEOSGeometry* point) {
  double x = 0.0, y = 0.0;
  GEOSGeomGetX_r(geos.handle, point, &x);
  GEOSGeomGetY_r(geos.handle, point, &y);
  return " at [" + to_text(x) + ", " + to_text(y) + "]";
}

}  // namespace

std::string polygon_fault(const std::string& wkt) {
  const Geos geos;
  const Geometry polygon = read(geos, wkt);
  if (!polygon) return "is no polygon that GEOS can read";
  char* reason = nullptr;
  GEOSGeometry* place = nullptr;
  const char valid = GEOSisValidDetail_r(geos.handle, polygon.get(), 0, &reason, &place);
  const auto kept = geos.keep(place);
  std::string fault;
  if (valid != 1)
    fault = std::string("is no polygon: ") + (reason ? reason : "not valid") + (place ? at(geos, place) : "");
  GEOSFree_r(geos.handle, reason);
  return fault;
}

std::string polygon_wkt(const std::vector<Vec>& ring) {
  std::string text = "POLYGON ((";
  for (const Vec& p : ring) text += to_text(p.x()) + " " + to_text(p.y()) + ", ";
  return text + to_text(ring.front().x()) + " " + to_text(ring.front().y()) + "))";
}

}  // namespace throng::scenarios
