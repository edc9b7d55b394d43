// SPDX-License-Identifier: MIT
#include "sim/recording/scene_reader.h"

#include <algorithm>
#include <cmath>

#include "sim/recording/layout.h"
#include "sim/recording/observables.h"

namespace throng::recording {

namespace {

using h5::kAny;
using h5::read_array;

[[noreturn]] void reject(const std::string& why) {
  throw h5::Error(why);
}

void expect_finite(const std::vector<double>& values, const char* what) {
  for (double x : values)
    if (!std::isfinite(x)) reject(std::string(what) + " is not finite");
}

void expect_below(const std::vector<std::uint32_t>& rows, std::size_t limit, const char* what) {
  for (std::uint32_t row : rows)
    if (row >= limit) reject(std::string(what) + " points beyond its table");
}

std::vector<double> read_numbers(const h5::File& file, hid_t at, const char* name, hsize_t count) {
  std::vector<double> values = read_array<double>(file, at, name, {count});
  expect_finite(values, name);
  return values;
}

std::vector<Vec> read_points(const h5::File& file, hid_t at, const char* name) {
  const std::vector<double> flat = read_array<double>(file, at, name, {kAny, 2});
  expect_finite(flat, name);
  std::vector<Vec> points(flat.size() / 2);
  for (std::size_t i = 0; i < points.size(); ++i) points[i] = {flat[2 * i], flat[2 * i + 1]};
  return points;
}

/// Of lists in an array of `total` items: from 0, never down, to the end.
void expect_offsets(const std::vector<std::uint64_t>& offset, std::size_t total, const char* name) {
  if (offset.empty() || offset.front() != 0 || offset.back() != total ||
      !std::is_sorted(offset.begin(), offset.end()))
    reject(std::string(name) + " does not fit its list");
}

/// Offsets of `lists` lists into an array of `total` items.
std::vector<std::uint64_t> read_offsets(const h5::File& file, hid_t at, const char* name, std::size_t lists,
                                        std::size_t total) {
  std::vector<std::uint64_t> offset = read_array<std::uint64_t>(file, at, name, {lists + 1});
  expect_offsets(offset, total, name);
  return offset;
}

Domain read_domain(hid_t throng) {
  constexpr const char* kinds[] = {"unbounded", "box", "periodic"};
  const h5::Handle group = h5::open_group(throng, "domain");
  const std::string name = h5::read_attribute_text(group, "kind");
  const auto* kind = std::find(std::begin(kinds), std::end(kinds), name);
  if (kind == std::end(kinds)) reject("domain is of an unknown kind");
  const auto low = h5::read_attribute<double>(group, "min", 2),
             high = h5::read_attribute<double>(group, "max", 2);
  expect_finite(low, "domain");
  expect_finite(high, "domain");
  if (!(low[0] <= high[0] && low[1] <= high[1])) reject("domain is turned round");
  return {static_cast<DomainKind>(kind - kinds), {low[0], low[1]}, {high[0], high[1]}};
}

std::vector<Material> read_materials(const h5::File& file, hid_t throng) {
  const h5::Handle group = h5::open_group(throng, "materials");
  const std::vector<std::string> names = h5::read_texts(file, group, "name");
  const auto density = read_numbers(file, group, "density", names.size());
  const auto restitution = read_numbers(file, group, "restitution", names.size());
  const auto friction = read_numbers(file, group, "friction", names.size());
  std::vector<Material> materials;
  for (std::size_t i = 0; i < names.size(); ++i)
    materials.push_back({names[i], density[i], restitution[i], friction[i]});
  return materials;
}

void read_outlines(const h5::File& file, hid_t group, std::vector<Shape>& shapes) {
  const std::vector<Vec> outline = read_points(file, group, "outline"),
                         vertices = read_points(file, group, "vertices");
  const std::vector<double> radius = read_array<double>(file, group, "part_radius");
  expect_finite(radius, "part_radius");
  const auto outline_offset = read_offsets(file, group, "outline_offset", shapes.size(), outline.size());
  const auto part_offset = read_offsets(file, group, "part_offset", shapes.size(), radius.size());
  const auto vertex_offset = read_offsets(file, group, "vertex_offset", radius.size(), vertices.size());
  for (std::size_t s = 0; s < shapes.size(); ++s) {
    shapes[s].outline.assign(outline.begin() + outline_offset[s], outline.begin() + outline_offset[s + 1]);
    for (std::size_t p = part_offset[s]; p < part_offset[s + 1]; ++p) {
      if (vertex_offset[p] == vertex_offset[p + 1]) reject("part of a shape has no vertices");
      shapes[s].parts.push_back(narrowphase::convex(
          {vertices.begin() + vertex_offset[p], vertices.begin() + vertex_offset[p + 1]}, radius[p]));
    }
    if ((shapes[s].kind == ShapeKind::disc) != shapes[s].parts.empty())
      reject("a disc has parts, or another shape has none");
  }
}

/// Absent from files of version 1.0, which had none.
void read_holes(const h5::File& file, hid_t group, std::vector<Shape>& shapes) {
  if (!h5::exists(group, "hole_offset")) return;
  const std::vector<Vec> points = read_points(file, group, "rings");
  const auto ring_offset = read_array<std::uint64_t>(file, group, "ring_offset");
  expect_offsets(ring_offset, points.size(), "ring_offset");
  const auto hole_offset = read_offsets(file, group, "hole_offset", shapes.size(), ring_offset.size() - 1);
  for (std::size_t s = 0; s < shapes.size(); ++s)
    for (std::size_t h = hole_offset[s]; h < hole_offset[s + 1]; ++h)
      shapes[s].holes.emplace_back(points.begin() + ring_offset[h], points.begin() + ring_offset[h + 1]);
}

std::vector<Shape> read_shapes(const h5::File& file, hid_t throng) {
  const h5::Handle group = h5::open_group(throng, "shapes");
  const std::vector<std::string> names = h5::read_texts(file, group, "name");
  const auto kind = read_array<std::uint8_t>(file, group, "kind", {names.size()});
  const auto centre = read_points(file, group, "centre");
  const auto area = read_numbers(file, group, "area", names.size());
  const auto gyration2 = read_numbers(file, group, "gyration2", names.size());
  const auto radius = read_numbers(file, group, "radius", names.size());
  if (centre.size() != names.size()) reject("centre has the wrong size");
  std::vector<Shape> shapes(names.size());
  for (std::size_t s = 0; s < shapes.size(); ++s) {
    if (kind[s] > static_cast<int>(ShapeKind::composite)) reject("shape is of an unknown kind");
    shapes[s] = {names[s], static_cast<ShapeKind>(kind[s]), {}, {}, {}, centre[s], area[s], gyration2[s],
                 radius[s]};
  }
  read_outlines(file, group, shapes);
  read_holes(file, group, shapes);
  return shapes;
}

Bodies read_bodies(const h5::File& file, hid_t throng, const Scene& scene) {
  const h5::Handle group = h5::open_group(throng, "bodies");
  Bodies bodies;
  bodies.shape = read_array<std::uint32_t>(file, group, "shape");
  const std::size_t n = bodies.shape.size();
  bodies.material = read_array<std::uint32_t>(file, group, "material", {n});
  bodies.radius = read_numbers(file, group, "radius", n);
  expect_below(bodies.shape, scene.shapes.size(), "shape");
  expect_below(bodies.material, scene.materials.size(), "material");
  for (std::uint8_t kind : read_array<std::uint8_t>(file, group, "kind", {n})) {
    if (kind > static_cast<int>(BodyKind::agent)) reject("body is of an unknown kind");
    bodies.kind.push_back(static_cast<BodyKind>(kind));
  }
  bodies.position = bodies.velocity = std::vector<Vec>(n, Vec(0, 0));
  bodies.angle = bodies.spin = std::vector<double>(n, 0.0);
  return bodies;
}

std::vector<Wall> read_walls(const h5::File& file, hid_t throng, const Scene& scene) {
  const h5::Handle group = h5::open_group(throng, "walls");
  const std::vector<Vec> points = read_points(file, group, "points");
  const auto closed = read_array<std::uint8_t>(file, group, "closed");
  const auto material = read_array<std::uint32_t>(file, group, "material", {closed.size()});
  const auto offset = read_offsets(file, group, "offset", closed.size(), points.size());
  expect_below(material, scene.materials.size(), "material");
  std::vector<Wall> walls;
  for (std::size_t w = 0; w < closed.size(); ++w) {
    if (offset[w + 1] - offset[w] < 2) reject("wall has fewer than two points");
    walls.push_back(
        {{points.begin() + offset[w], points.begin() + offset[w + 1]}, closed[w] != 0, material[w]});
  }
  return walls;
}

/// The rings `offset` tells apart.
std::vector<std::vector<Vec>> read_rings(const h5::File& file, hid_t group) {
  const std::vector<Vec> points = read_points(file, group, "points");
  const auto offset = read_array<std::uint64_t>(file, group, "offset", {kAny});
  expect_offsets(offset, points.size(), "offset");
  std::vector<std::vector<Vec>> rings;
  for (std::size_t r = 1; r < offset.size(); ++r) {
    if (offset[r] - offset[r - 1] < 3) reject("a ring has fewer than three points");
    rings.emplace_back(points.begin() + offset[r - 1], points.begin() + offset[r]);
  }
  return rings;
}

Region read_walkable(const h5::File& file, hid_t throng) {
  if (!h5::exists(throng, "walkable")) return {};
  return {read_rings(file, h5::open_group(throng, "walkable"))};
}

std::vector<Region> read_regions(const h5::File& file, hid_t group, std::size_t count) {
  const std::vector<std::vector<Vec>> rings = read_rings(file, group);
  const auto offset = read_offsets(file, group, "area_offset", count, rings.size());
  std::vector<Region> regions(count);
  for (std::size_t i = 0; i < count; ++i)
    regions[i].rings.assign(rings.begin() + offset[i], rings.begin() + offset[i + 1]);
  return regions;
}

std::vector<Area> read_areas(const h5::File& file, hid_t throng) {
  if (!h5::exists(throng, "areas")) return {};
  const h5::Handle group = h5::open_group(throng, "areas");
  const std::vector<std::string> names = h5::read_texts(file, group, "name");
  const auto use = read_array<std::uint8_t>(file, group, "use", {names.size()});
  const std::vector<Region> regions = read_regions(file, group, names.size());
  std::vector<Area> areas;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (use[i] > static_cast<int>(AreaUse::wait)) reject("an area is of an unknown use");
    areas.push_back({names[i], regions[i], static_cast<AreaUse>(use[i])});
  }
  return areas;
}

std::vector<Queue> read_queues(const h5::File& file, hid_t throng) {
  if (!h5::exists(throng, "queues")) return {};
  const h5::Handle group = h5::open_group(throng, "queues");
  const std::vector<std::string> names = h5::read_texts(file, group, "name");
  const auto spacing = read_numbers(file, group, "spacing", names.size());
  const auto service = read_numbers(file, group, "service", names.size());
  const std::vector<Vec> points = read_points(file, group, "points");
  const auto offset = read_offsets(file, group, "offset", names.size(), points.size());
  std::vector<Queue> queues;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (offset[i + 1] - offset[i] < 2) reject("a queue has fewer than two points");
    if (!(spacing[i] > 0.0)) reject("a queue's spacing is out of range");
    queues.push_back({.name = names[i],
                      .line = {points.begin() + offset[i], points.begin() + offset[i + 1]},
                      .spacing = spacing[i],
                      .service = service[i]});
  }
  return queues;
}

/// Names become paths below /observables, each another.
void expect_own_name(const std::string& name, std::span<const std::string> before) {
  if (name.empty() || std::ranges::find(before, name) != before.end())
    reject("a measure has no name of its own");
}

std::vector<Measure> read_measures(const h5::File& file, hid_t throng) {
  if (!h5::exists(throng, "measures")) return {};
  const h5::Handle group = h5::open_group(throng, "measures");
  const std::vector<std::string> names = h5::read_texts(file, group, "name");
  if (names.size() > kMostMeasures) reject("there are too many measures");
  const auto line = read_array<double>(file, group, "line", {names.size(), 4});
  const auto size = read_numbers(file, group, "size", names.size());
  expect_finite(line, "line");
  const std::vector<double> cutoff = h5::exists(group, "cutoff")
                                         ? read_numbers(file, group, "cutoff", names.size())
                                         : std::vector<double>(names.size());
  const std::vector<Region> areas = read_regions(file, group, names.size());
  std::vector<Measure> measures(names.size());
  for (std::size_t m = 0; m < names.size(); ++m) {
    expect_own_name(names[m], std::span(names).first(m));
    measures[m].name = names[m];
    measures[m].line = {Vec(line[4 * m], line[4 * m + 1]), Vec(line[4 * m + 2], line[4 * m + 3])};
    measures[m].size = size[m];
    measures[m].cutoff = cutoff[m];
    measures[m].area = areas[m];
  }
  return measures;
}

Sensor read_sensor(hid_t group) {
  Sensor sensor;
  sensor.name = h5::read_attribute_text(group, "name");
  sensor.radius = h5::read_attribute<double>(group, "radius");
  sensor.fov = h5::read_attribute<double>(group, "fov_degrees");
  const std::string sight = h5::read_attribute_text(group, "sight");
  const auto* screens = std::find(kScreens.begin(), kScreens.end(), sight);
  const auto every = h5::read_attribute<std::int64_t>(group, "every");
  if (screens == kScreens.end() || !(sensor.radius >= 0.0 && std::isfinite(sensor.radius)) ||
      !(sensor.fov > 0.0 && sensor.fov <= 360.0) || every < 1 || every > kRarest)
    reject("a sensor is out of range");
  sensor.screens = static_cast<Screens>(screens - kScreens.begin());
  sensor.every = static_cast<int>(every);
  sensor.record = true;
  return sensor;
}

}  // namespace

std::vector<Sensor> read_sensors(hid_t throng) {
  std::vector<Sensor> sensors;
  if (!h5::exists(throng, "sensors")) return sensors;
  const h5::Handle group = h5::open_group(throng, "sensors");
  for (std::string k = "0"; sensors.size() < kMostSensors && h5::exists(group, k.c_str());
       k = std::to_string(sensors.size()))
    sensors.push_back(read_sensor(h5::open_group(group, k.c_str())));
  return sensors;
}

Scene read_scene(const h5::File& file, hid_t throng) {
  Scene scene;
  scene.name = h5::read_attribute_text(throng, "name");
  scene.description = h5::read_attribute_text(throng, "description");
  scene.domain = read_domain(throng);
  scene.materials = read_materials(file, throng);
  scene.shapes = read_shapes(file, throng);
  scene.bodies = read_bodies(file, throng, scene);
  scene.walls = read_walls(file, throng, scene);
  scene.crowd.walkable = read_walkable(file, throng);
  scene.crowd.areas = read_areas(file, throng);
  scene.crowd.queues = read_queues(file, throng);
  scene.crowd.measures = read_measures(file, throng);
  return scene;
}

}  // namespace throng::recording
