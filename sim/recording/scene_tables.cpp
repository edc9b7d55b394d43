// SPDX-License-Identifier: MIT
#include "sim/recording/scene_tables.h"

#include <algorithm>

#include "sim/uses_substeps.h"

namespace throng::recording {

namespace {

void expect(bool fits, const char* what) {
  if (!fits) throw h5::Error(std::string(what) + " is not that of the scenario");
}

void expect_bodies(const std::vector<double>& masses, const Bodies& found, std::span<const std::uint32_t> ids,
                   const Scene& scene, int minor) {
  const Bodies& bodies = scene.bodies;
  for (std::size_t row = 0; row < ids.size(); ++row) {
    const std::size_t body = ids[row] - 1;
    const bool like_all_agents = minor < 8 && bodies.kind[body] == BodyKind::agent;
    expect(masses[row] == (like_all_agents ? kAgentMass : mass(scene, body)), "mass");
    expect(found.radius[row] == bodies.radius[body], "radius");
    expect(found.shape[row] == bodies.shape[body], "shape");
    expect(found.material[row] == bodies.material[body], "material");
    expect(found.kind[row] == bodies.kind[body], "kind");
  }
}

bool same_part(const narrowphase::Convex& a, const narrowphase::Convex& b) {
  return a.vertices == b.vertices && a.radius == b.radius;
}

void expect_materials(const std::vector<Material>& found, const std::vector<Material>& materials) {
  const auto same = [](const Material& a, const Material& b) {
    return a.name == b.name && a.density == b.density && a.restitution == b.restitution &&
           a.friction == b.friction;
  };
  expect(std::ranges::equal(found, materials, same), "material");
}

void expect_shapes(const std::vector<Shape>& found, const std::vector<Shape>& shapes) {
  expect(found.size() == shapes.size(), "shape");
  for (std::size_t s = 0; s < shapes.size(); ++s) {
    const Shape &a = found[s], &b = shapes[s];
    expect(a.name == b.name && a.kind == b.kind && a.centre == b.centre && a.area == b.area &&
               a.gyration2 == b.gyration2 && a.radius == b.radius,
           "shape");
    expect(a.outline == b.outline && a.holes == b.holes, "outline of a shape");
    expect(std::ranges::equal(a.parts, b.parts, same_part), "part of a shape");
  }
}

void expect_walls(const std::vector<Wall>& found, const std::vector<Wall>& walls) {
  const auto same = [](const Wall& a, const Wall& b) {
    return a.points == b.points && a.closed == b.closed && a.material == b.material;
  };
  expect(std::ranges::equal(found, walls, same), "wall");
}

/// Areas, queues and the size of what is measured, as far as the file's layout has them.
void expect_floor(const Crowd& found, const Crowd& crowd, int minor) {
  if (crowd.size() > 0) expect(found.walkable.rings == crowd.walkable.rings, "walkable floor");
  const auto same_size = [](const Measure& a, const Measure& b) { return a.size == b.size; };
  if (minor >= 5)
    expect(std::ranges::equal(found.measures, crowd.measures, same_size), "size of what is measured");
  const auto same_cutoff = [](const Measure& a, const Measure& b) { return a.cutoff == b.cutoff; };
  if (minor >= 9) expect(std::ranges::equal(found.measures, crowd.measures, same_cutoff), "cut-off of cells");
  if (minor < 6) return;
  const auto same_area = [](const Area& a, const Area& b) {
    return a.name == b.name && a.region.rings == b.region.rings && a.use == b.use;
  };
  const auto same_queue = [](const Queue& a, const Queue& b) {
    return a.name == b.name && a.line == b.line && a.spacing == b.spacing && a.service == b.service;
  };
  expect(std::ranges::equal(found.areas, crowd.areas, same_area), "area");
  expect(std::ranges::equal(found.queues, crowd.queues, same_queue), "queue");
}

void expect_box(const h5::File& file, const Domain& found, const Domain& domain) {
  expect(found.kind == domain.kind && found.min == domain.min && found.max == domain.max, "domain");
  const h5::Handle trajectory = h5::open_group(h5::open_group(file.handle, "particles"), "trajectory"),
                   box = h5::open_group(trajectory, "box");
  const bool is_open = domain.kind == DomainKind::unbounded;
  expect(h5::exists(box, "edges") != is_open, "box");
  if (is_open) return;
  const std::vector<double> edges = h5::read_array<double>(file, box, "edges", {2});
  const Vec size = domain.max - domain.min;
  expect(edges[0] == size.x() && edges[1] == size.y(), "box");
}

/// What the attributes of /parameters and /throng say of the run. A scene without a name was called after its
/// file.
void expect_run(const Scene& found, const Scene& scene) {
  expect(scene.name.empty() || found.name == scene.name, "name");
  expect(found.description == scene.description, "description");
  expect(found.seed == scene.seed, "seed");
  expect(found.engine == scene.engine, "engine");
  expect(found.time.until == scene.time.until, "end");
  if (uses_substeps(scene)) expect(found.time.substeps == scene.time.substeps, "number of substeps");
}

}  // namespace

void expect_tables(const h5::File& file, const Scene& found, std::span<const std::uint32_t> ids,
                   const Scene& scene, int minor) {
  expect_run(found, scene);
  expect_materials(found.materials, scene.materials);
  expect_shapes(found.shapes, scene.shapes);
  expect_walls(found.walls, scene.walls);
  expect_floor(found.crowd, scene.crowd, minor);
  const h5::Handle bodies = h5::open_group(h5::open_group(file.handle, "throng"), "bodies");
  expect_bodies(h5::read_array<double>(file, bodies, "mass", {ids.size()}), found.bodies, ids, scene, minor);
  expect_box(file, found.domain, scene.domain);
}

void expect_bins(std::span<const Observable> found, const Scene& scene) {
  for (const AskedColumn& asked : asked_columns(scene))
    for (const Observable& one : found)
      expect(one.name != asked.name || one.up_to == asked.bins.up_to, "end of a histogram");
}

}  // namespace throng::recording
