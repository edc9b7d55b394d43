// SPDX-License-Identifier: MIT
#include "sim/recording/scene_writer.h"

#include "sim/recording/h5_write.h"
#include "sim/recording/numbers.h"

namespace throng::recording {

namespace {

using h5::write_array;

/// One column of a list of structs.
template <class Item, class F>
auto column(const std::vector<Item>& items, F value) {
  std::vector<decltype(value(items[0]))> result;
  for (const Item& item : items) result.push_back(value(item));
  return result;
}

/// Lists of points end to end; list i is points[offset[i]] to points[offset[i + 1]].
struct Ragged {
  std::vector<std::uint64_t> offset{0};
  std::vector<Vec> points;

  void add(const std::vector<Vec>& list) {
    points.insert(points.end(), list.begin(), list.end());
    offset.push_back(points.size());
  }
};

void write_domain(hid_t throng, const Domain& domain) {
  constexpr const char* kinds[] = {"unbounded", "box", "periodic"};
  const h5::Handle group = h5::create_group(throng, "domain");
  h5::write_attribute(group, "kind", std::string_view(kinds[static_cast<int>(domain.kind)]));
  h5::write_attribute(group, "min", std::span<const double>(domain.min.data(), 2));
  h5::write_attribute(group, "max", std::span<const double>(domain.max.data(), 2));
}

void write_materials(hid_t throng, const std::vector<Material>& materials) {
  const h5::Handle group = h5::create_group(throng, "materials");
  h5::write_texts(group, "name", column(materials, [](const Material& m) { return m.name; }));
  write_array(group, "density", flat(column(materials, [](const Material& m) { return m.density; })));
  write_array(group, "restitution", flat(column(materials, [](const Material& m) { return m.restitution; })));
  write_array(group, "friction", flat(column(materials, [](const Material& m) { return m.friction; })));
}

void write_outlines(hid_t group, const std::vector<Shape>& shapes) {
  Ragged outlines, holes, parts;
  std::vector<std::uint64_t> hole_offset{0}, part_offset{0};
  std::vector<double> part_radius;
  for (const Shape& shape : shapes) {
    outlines.add(shape.outline);
    for (const std::vector<Vec>& hole : shape.holes) holes.add(hole);
    hole_offset.push_back(holes.offset.size() - 1);
    for (const narrowphase::Convex& part : shape.parts) {
      parts.add(part.vertices);
      part_radius.push_back(part.radius);
    }
    part_offset.push_back(part_radius.size());
  }
  write_array(group, "outline_offset", flat(outlines.offset));
  write_array(group, "outline", flat(outlines.points), 2);
  write_array(group, "hole_offset", flat(hole_offset));
  write_array(group, "ring_offset", flat(holes.offset));
  write_array(group, "rings", flat(holes.points), 2);
  write_array(group, "part_offset", flat(part_offset));
  write_array(group, "part_radius", flat(part_radius));
  write_array(group, "vertex_offset", flat(parts.offset));
  write_array(group, "vertices", flat(parts.points), 2);
}

void write_shapes(hid_t throng, const std::vector<Shape>& shapes) {
  const h5::Handle group = h5::create_group(throng, "shapes");
  h5::write_texts(group, "name", column(shapes, [](const Shape& s) { return s.name; }));
  write_array(group, "kind",
              flat(column(shapes, [](const Shape& s) { return static_cast<std::uint8_t>(s.kind); })));
  write_array(group, "centre", flat(column(shapes, [](const Shape& s) { return s.centre; })), 2);
  write_array(group, "area", flat(column(shapes, [](const Shape& s) { return s.area; })));
  write_array(group, "gyration2", flat(column(shapes, [](const Shape& s) { return s.gyration2; })));
  write_array(group, "radius", flat(column(shapes, [](const Shape& s) { return s.radius; })));
  write_outlines(group, shapes);
}

/// A row for each id, which is one more than the row of the scene.
void write_bodies(hid_t throng, const Scene& scene, std::span<const std::uint32_t> ids) {
  const h5::Handle group = h5::create_group(throng, "bodies");
  const Bodies& bodies = scene.bodies;
  const auto chosen = [&](auto value) {
    std::vector<decltype(value(0))> result;
    for (std::uint32_t id : ids) result.push_back(value(id - 1));
    return result;
  };
  write_array(group, "shape", flat(chosen([&](std::size_t row) { return bodies.shape[row]; })));
  write_array(group, "material", flat(chosen([&](std::size_t row) { return bodies.material[row]; })));
  write_array(group, "kind",
              flat(chosen([&](std::size_t row) { return static_cast<std::uint8_t>(bodies.kind[row]); })));
  write_array(group, "radius", flat(chosen([&](std::size_t row) { return bodies.radius[row]; })));
  write_array(group, "mass", flat(chosen([&](std::size_t row) { return mass(scene, row); })));
}

void write_walls(hid_t throng, const std::vector<Wall>& walls) {
  const h5::Handle group = h5::create_group(throng, "walls");
  Ragged lines;
  for (const Wall& wall : walls) lines.add(wall.points);
  write_array(group, "offset", flat(lines.offset));
  write_array(group, "points", flat(lines.points), 2);
  write_array(group, "closed", flat(column(walls, [](const Wall& w) { return std::uint8_t{w.closed}; })));
  write_array(group, "material", flat(column(walls, [](const Wall& w) { return w.material; })));
}

void write_walkable(hid_t throng, const Region& walkable) {
  const h5::Handle group = h5::create_group(throng, "walkable");
  Ragged rings;
  for (const std::vector<Vec>& ring : walkable.rings) rings.add(ring);
  write_array(group, "offset", flat(rings.offset));
  write_array(group, "points", flat(rings.points), 2);
}

/// As area_offset, offset, points.
void write_regions(hid_t group, const std::vector<Region>& regions) {
  Ragged rings;
  std::vector<std::uint64_t> area_offset{0};
  for (const Region& region : regions) {
    for (const std::vector<Vec>& ring : region.rings) rings.add(ring);
    area_offset.push_back(rings.offset.size() - 1);
  }
  write_array(group, "area_offset", flat(area_offset));
  write_array(group, "offset", flat(rings.offset));
  write_array(group, "points", flat(rings.points), 2);
}

void write_areas(hid_t throng, const std::vector<Area>& areas) {
  const h5::Handle group = h5::create_group(throng, "areas");
  h5::write_texts(group, "name", column(areas, [](const Area& a) { return a.name; }));
  write_array(group, "use",
              flat(column(areas, [](const Area& a) { return static_cast<std::uint8_t>(a.use); })));
  write_regions(group, column(areas, [](const Area& a) { return a.region; }));
}

void write_queues(hid_t throng, const std::vector<Queue>& queues) {
  const h5::Handle group = h5::create_group(throng, "queues");
  Ragged lines;
  for (const Queue& queue : queues) lines.add(queue.line);
  h5::write_texts(group, "name", column(queues, [](const Queue& q) { return q.name; }));
  write_array(group, "spacing", flat(column(queues, [](const Queue& q) { return q.spacing; })));
  write_array(group, "service", flat(column(queues, [](const Queue& q) { return q.service; })));
  write_array(group, "offset", flat(lines.offset));
  write_array(group, "points", flat(lines.points), 2);
}

void write_measures(hid_t throng, const std::vector<Measure>& measures) {
  const h5::Handle group = h5::create_group(throng, "measures");
  std::vector<double> lines;
  for (const Measure& measure : measures)
    for (const Vec& end : measure.line) lines.insert(lines.end(), {end.x(), end.y()});
  h5::write_texts(group, "name", column(measures, [](const Measure& m) { return m.name; }));
  write_array(group, "line", flat(lines), 4);
  write_array(group, "size", flat(column(measures, [](const Measure& m) { return m.size; })));
  write_array(group, "cutoff", flat(column(measures, [](const Measure& m) { return m.cutoff; })));
  write_regions(group, column(measures, [](const Measure& m) { return m.area; }));
}

}  // namespace

void write_scene(hid_t throng, const Scene& scene, std::span<const std::uint32_t> ids) {
  h5::write_attribute(throng, "name", std::string_view(scene.name));
  h5::write_attribute(throng, "description", std::string_view(scene.description));
  write_domain(throng, scene.domain);
  write_materials(throng, scene.materials);
  write_shapes(throng, scene.shapes);
  write_bodies(throng, scene, ids);
  write_walls(throng, scene.walls);
  if (scene.crowd.size() > 0) write_walkable(throng, scene.crowd.walkable);
  if (!scene.crowd.areas.empty()) write_areas(throng, scene.crowd.areas);
  if (!scene.crowd.queues.empty()) write_queues(throng, scene.crowd.queues);
  if (!scene.crowd.measures.empty()) write_measures(throng, scene.crowd.measures);
}

}  // namespace throng::recording
