// SPDX-License-Identifier: MIT
#include "sim/recording/scene_tables.h"

namespace throng::recording {

namespace {

void expect(bool fits, const char* what) {
  if (!fits) throw h5::Error(std::string(what) + " is not that of the scenario");
}

void expect_bodies(const std::vector<double>& masses, const Bodies& found, std::span<const std::uint32_t> ids,
                   const Scene& scene) {
  const Bodies& bodies = scene.bodies;
  for (std::size_t row = 0; row < ids.size(); ++row) {
    const std::size_t body = ids[row] - 1;
    expect(masses[row] == mass(scene, body), "mass");
    expect(found.radius[row] == bodies.radius[body], "radius");
    expect(found.shape[row] == bodies.shape[body], "shape");
    expect(found.material[row] == bodies.material[body], "material");
    expect(found.kind[row] == bodies.kind[body], "kind");
  }
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

}  // namespace

void expect_tables(const h5::File& file, const Scene& found, std::span<const std::uint32_t> ids,
                   const Scene& scene) {
  const h5::Handle bodies = h5::open_group(h5::open_group(file.handle, "throng"), "bodies");
  expect_bodies(h5::read_array<double>(file, bodies, "mass", {ids.size()}), found.bodies, ids, scene);
  expect_box(file, found.domain, scene.domain);
}

}  // namespace throng::recording
