// SPDX-License-Identifier: MIT
#include "scenarios/region_sets.h"

#include <stdexcept>

#include "scenarios/geos.h"
#include "scenarios/report.h"

namespace throng::scenarios {

namespace {

/// What GEOS made; it makes nothing where memory or its arithmetic fails it.
Geometry made(const Geos& geos, GEOSGeometry* geometry) {
  if (!geometry) throw std::runtime_error("GEOS could not join or cut the areas of this scene");
  return geos.keep(geometry);
}

std::string line_wkt(std::span<const Vec> line, bool closed) {
  std::string text = "(";
  const auto add = [&](const Vec& p) {
    text += (text.size() > 1 ? ", " : "") + to_text(p.x()) + " " + to_text(p.y());
  };
  for (const Vec& p : line) add(p);
  if (closed) add(line.front());
  return text + ")";
}

/// What an odd number of rings encloses.
Geometry solid(const Geos& geos, const Region& region) {
  if (region.empty()) return read(geos, "POLYGON EMPTY");
  std::string rings = "MULTILINESTRING (";
  for (const std::vector<Vec>& ring : region.rings)
    rings += (&ring == &region.rings.front() ? "" : ", ") + line_wkt(ring, true);
  const Geometry lines = read(geos, rings + ")");
  const Geometry noded = made(geos, GEOSUnaryUnion_r(geos.handle, lines.get()));
  return made(geos, GEOSBuildArea_r(geos.handle, noded.get()));
}

void add_rings(const Geos& geos, const GEOSGeometry* polygon, Region& region) {
  if (GEOSisEmpty_r(geos.handle, polygon)) return;
  region.rings.push_back(points_of(geos, GEOSGetExteriorRing_r(geos.handle, polygon)));
  for (int hole = 0; hole < GEOSGetNumInteriorRings_r(geos.handle, polygon); ++hole)
    region.rings.push_back(points_of(geos, GEOSGetInteriorRingN_r(geos.handle, polygon, hole)));
}

/// Of all polygons; the points and lines in which regions only touch have no inside.
void add_polygons(const Geos& geos, const GEOSGeometry* geometry, Region& region) {
  const int kind = GEOSGeomTypeId_r(geos.handle, geometry);
  if (kind == GEOS_POLYGON) add_rings(geos, geometry, region);
  if (kind != GEOS_MULTIPOLYGON && kind != GEOS_GEOMETRYCOLLECTION) return;
  for (int i = 0; i < GEOSGetNumGeometries_r(geos.handle, geometry); ++i)
    add_polygons(geos, GEOSGetGeometryN_r(geos.handle, geometry, i), region);
}

Region region_of(const Geos& geos, const GEOSGeometry* geometry) {
  Region region;
  add_polygons(geos, geometry, region);
  return region;
}

}  // namespace

double common_area(const Region& a, const Region& b) {
  const Geos geos;
  const Geometry one = solid(geos, a), other = solid(geos, b);
  const Geometry common = made(geos, GEOSIntersection_r(geos.handle, one.get(), other.get()));
  double area = 0.0;
  GEOSArea_r(geos.handle, common.get(), &area);
  return area;
}

bool runs_through(const Vec& from, const Vec& to, const Region& region) {
  const Geos geos;
  const Vec ends[] = {from, to};
  const Geometry line = read(geos, "LINESTRING " + line_wkt(ends, false)), other = solid(geos, region);
  const char has = GEOSRelatePattern_r(geos.handle, line.get(), other.get(), "T********");
  if (has > 1) throw std::runtime_error("GEOS could not hold a line against the areas of this scene");
  return has == 1;
}

Region common(const Region& a, const Region& b) {
  const Geos geos;
  const Geometry one = solid(geos, a), other = solid(geos, b);
  return region_of(geos, made(geos, GEOSIntersection_r(geos.handle, one.get(), other.get())).get());
}

Region without(const Region& region, const Region& other) {
  const Geos geos;
  const Geometry one = solid(geos, region), less = solid(geos, other);
  return region_of(geos, made(geos, GEOSDifference_r(geos.handle, one.get(), less.get())).get());
}

Region band(std::span<const Vec> line, double half) {
  const Geos geos;
  const Geometry middle = read(geos, "LINESTRING " + line_wkt(line, false));
  return region_of(geos, made(geos, GEOSBufferWithStyle_r(geos.handle, middle.get(), half, 1,
                                                          GEOSBUF_CAP_FLAT, GEOSBUF_JOIN_MITRE, 2.0))
                             .get());
}

Region united(std::span<const Region> regions) {
  if (regions.size() == 1) return regions.front();
  const Geos geos;
  std::vector<Geometry> pieces;
  for (const Region& region : regions) pieces.push_back(solid(geos, region));
  std::vector<GEOSGeometry*> given;
  for (Geometry& piece : pieces) given.push_back(piece.release());
  const Geometry all =
      made(geos, GEOSGeom_createCollection_r(geos.handle, GEOS_GEOMETRYCOLLECTION, given.data(),
                                             static_cast<unsigned>(given.size())));
  return region_of(geos, made(geos, GEOSUnaryUnion_r(geos.handle, all.get())).get());
}

}  // namespace throng::scenarios
