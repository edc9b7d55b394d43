// SPDX-License-Identifier: MIT
#pragma once

#include <geos_c.h>

#include <memory>
#include <string>
#include <vector>

#include "sim/crowd/region.h"

namespace throng::scenarios {

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

inline Geometry read(const Geos& geos, const std::string& wkt) {
  GEOSWKTReader* reader = GEOSWKTReader_create_r(geos.handle);
  Geometry geometry = geos.keep(GEOSWKTReader_read_r(geos.handle, reader, wkt.c_str()));
  GEOSWKTReader_destroy_r(geos.handle, reader);
  return geometry;
}

/// Each once.
inline std::vector<Vec> points_of(const Geos& geos, const GEOSGeometry* ring) {
  const GEOSCoordSequence* sequence = GEOSGeom_getCoordSeq_r(geos.handle, ring);
  unsigned size = 0;
  GEOSCoordSeq_getSize_r(geos.handle, sequence, &size);
  std::vector<Vec> points(size);
  for (unsigned i = 0; i < size; ++i)
    GEOSCoordSeq_getXY_r(geos.handle, sequence, i, &points[i].x(), &points[i].y());
  if (!points.empty()) points.pop_back();  // that repeats the first
  return points;
}

}  // namespace throng::scenarios
