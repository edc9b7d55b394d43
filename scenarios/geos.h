// SPDX-License-Identifier: MIT
#pragma once

#include <geos_c.h>

#include <memory>
#include <string>

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

}  // namespace throng::scenarios
