// SPDX-License-Identifier: MIT
#include "scenarios/place.h"

#include <cmath>

#include "scenarios/random.h"

namespace throng::scenarios {

namespace {

std::uint32_t id(std::size_t row) {
  return static_cast<std::uint32_t>(row + 1);
}

void resize(Bodies& bodies, std::size_t count) {
  bodies.shape.resize(count);
  bodies.material.resize(count);
  bodies.kind.resize(count);
  bodies.radius.resize(count);
  bodies.position.resize(count, Vec(0.0, 0.0));
  bodies.angle.resize(count);
  bodies.velocity.resize(count, Vec(0.0, 0.0));
  bodies.spin.resize(count);
}

/// All but positions and velocities.
void fill(const Entry& entry, const ShapeDraw& draw, Scene& scene) {
  Bodies& bodies = scene.bodies;
  const Shape& shape = scene.shapes[entry.shape];
  for (std::size_t row = entry.first; row < entry.first + entry.count; ++row) {
    bodies.shape[row] = entry.shape;
    bodies.material[row] = entry.material;
    bodies.kind[row] = entry.kind;
    bodies.spin[row] = entry.spin;
    bodies.angle[row] =
        Random(scene.seed, 0, id(row), Purpose::angle).uniform(entry.angle.low, entry.angle.high);
    bodies.radius[row] =
        shape.kind == ShapeKind::disc
            ? Random(scene.seed, 0, id(row), Purpose::radius).uniform(draw.radius.low, draw.radius.high)
            : shape.radius;
  }
}

/// Normal velocities of the entry's bodies, less that of their common centre of mass.
void draw_velocities(const Entry& entry, Scene& scene) {
  Bodies& bodies = scene.bodies;
  Vec momentum(0.0, 0.0);
  double total = 0.0;
  for (std::size_t row = entry.first; row < entry.first + entry.count; ++row) {
    Random random(scene.seed, 0, id(row), Purpose::velocity);
    const double x = random.normal();
    const double y = random.normal();
    bodies.velocity[row] = *entry.maxwell * Vec(x, y);
    const double m = mass(scene, row);
    momentum += m * bodies.velocity[row];
    total += m;
  }
  const Vec common = entry.count > 0 ? Vec(momentum / total) : Vec(0.0, 0.0);
  for (std::size_t row = entry.first; row < entry.first + entry.count; ++row) bodies.velocity[row] -= common;
}

void set_velocities(const Entry& entry, Scene& scene) {
  if (entry.maxwell) return draw_velocities(entry, scene);
  for (std::size_t row = entry.first; row < entry.first + entry.count; ++row)
    scene.bodies.velocity[row] = entry.velocity;
}

void place_on_lattice(const Entry& entry, Scene& scene) {
  for (std::uint32_t i = 0; i < entry.count; ++i) {
    const Vec site(i % entry.columns, i / entry.columns);
    scene.bodies.position[entry.first + i] = entry.origin + entry.spacing.cwiseProduct(site);
  }
}

/// x moved by whole periods into [low, high).
double wrap(double x, double low, double high) {
  const double length = high - low;
  const double wrapped = x - length * std::floor((x - low) / length);
  return wrapped >= low && wrapped < high ? wrapped : low;
}

void wrap_positions(Scene& scene) {
  const Domain& domain = scene.domain;
  if (domain.kind != DomainKind::periodic) return;
  for (Vec& p : scene.bodies.position)
    p = {wrap(p.x(), domain.min.x(), domain.max.x()), wrap(p.y(), domain.min.y(), domain.max.y())};
}

}  // namespace

void place_bodies(std::span<const Entry> entries, std::span<const ShapeDraw> draws, Scene& scene,
                  Report& report) {
  (void)report;
  resize(scene.bodies, entries.empty() ? 0 : entries.back().first + entries.back().count);
  for (const Entry& entry : entries) {
    fill(entry, draws[entry.shape], scene);
    set_velocities(entry, scene);
    if (entry.place != Entry::Place::random) place_on_lattice(entry, scene);
  }
  wrap_positions(scene);
}

}  // namespace throng::scenarios
