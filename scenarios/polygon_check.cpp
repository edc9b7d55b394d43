// SPDX-License-Identifier: MIT
// All of GEOS stays in this file.
#include "scenarios/polygon_check.h"

#include <geos_c.h>

#include <memory>

#include "scenarios/report.h"

namespace throng::scenarios {

namespace {

/// GEOS in one thread, for as long as this lives; frees what was made by it.
struct Geos {
  GEOSContextHandle_t handle = GEOS_init_r();
  Geos() = default;
  Geos(const Geos&) = delete;
  Geos& operator=(const Geos&) = delete;
  ~Geos() { GEOS_finish_r(handle); }

  auto keep(GEOSGeometry* geometry) const {
    const auto destroy = [context = handle](GEOSGeometry* g) { GEOSGeom_destroy_r(context, g); };
    return std::unique_ptr<GEOSGeometry, decltype(destroy)>(geometry, destroy);
  }
};

std::string at(const Geos& geos, const GEOSGeometry* point) {
  double x = 0.0, y = 0.0;
  GEOSGeomGetX_r(geos.handle, point, &x);
  GEOSGeomGetY_r(geos.handle, point, &y);
  return " at [" + to_text(x) + ", " + to_text(y) + "]";
}

}  // namespace

std::string polygon_fault(const std::string& wkt) {
  const Geos geos;
  GEOSWKTReader* reader = GEOSWKTReader_create_r(geos.handle);
  const auto polygon = geos.keep(GEOSWKTReader_read_r(geos.handle, reader, wkt.c_str()));
  GEOSWKTReader_destroy_r(geos.handle, reader);
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
