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

  struct Destroy {
    GEOSContextHandle_t handle;
    void operator()(GEOSGeometry* geometry) const { GEOSGeom_destroy_r(handle, geometry); }
  };
  std::unique_ptr<GEOSGeometry, Destroy> keep(GEOSGeometry* geometry) const {
    return {geometry, Destroy{handle}};
  }
};

using Geometry = std::unique_ptr<GEOSGeometry, Geos::Destroy>;

Geometry read(const Geos& geos, const std::string& wkt) {
  GEOSWKTReader* reader = GEOSWKTReader_create_r(geos.handle);
  Geometry geometry = geos.keep(GEOSWKTReader_read_r(geos.handle, reader, wkt.c_str()));
  GEOSWKTReader_destroy_r(geos.handle, reader);
  return geometry;
}

/// What an odd number of rings encloses.
Geometry solid(const Geos& geos, const Region& region) {
  Geometry all = read(geos, "POLYGON EMPTY");
  for (const std::vector<Vec>& ring : region.rings) {
    const Geometry one = read(geos, polygon_wkt(ring));
    all = geos.keep(GEOSSymDifference_r(geos.handle, all.get(), one.get()));
  }
  return all;
}

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

double common_area(const Region& a, const Region& b) {
  const Geos geos;
  const Geometry one = solid(geos, a), other = solid(geos, b);
  const Geometry common = geos.keep(GEOSIntersection_r(geos.handle, one.get(), other.get()));
  double area = 0.0;
  GEOSArea_r(geos.handle, common.get(), &area);
  return area;
}

std::string polygon_wkt(const std::vector<Vec>& ring) {
  std::string text = "POLYGON ((";
  for (const Vec& p : ring) text += to_text(p.x()) + " " + to_text(p.y()) + ", ";
  return text + to_text(ring.front().x()) + " " + to_text(ring.front().y()) + "))";
}

}  // namespace throng::scenarios
