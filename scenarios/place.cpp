// SPDX-License-Identifier: MIT
#include "scenarios/place.h"

#include <algorithm>
#include <cmath>

#include "scenarios/body_distance.h"
#include "sim/periodic.h"
#include "sim/random.h"

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

std::string path(const Entry& entry, const std::string& key) {
  return "bodies[" + std::to_string(entry.index) + "]." + key;
}

/// True where the body is not in the domain's box: a dynamic one with all of itself, any other with its
/// centre.
bool is_outside(const Scene& scene, std::uint32_t row) {
  const Bodies& bodies = scene.bodies;
  const Vec& p = bodies.position[row];
  Eigen::AlignedBox2d body(Vec(0.0, 0.0));
  if (bodies.kind[row] == BodyKind::dynamic) body = extent(scene, row);
  const Vec out = (scene.domain.min - p - body.min()).cwiseMax(p + body.max() - scene.domain.max);
  return !(out.maxCoeff() <= touching(bodies.radius[row], p));
}

void check_inside(const Entry& entry, const Scene& scene, Report& report) {
  if (scene.domain.kind != DomainKind::box || entry.place == Entry::Place::random) return;
  std::size_t outside = 0;
  std::uint32_t first = 0;
  for (std::uint32_t row = entry.first; row < entry.first + entry.count; ++row)
    if (is_outside(scene, row) && outside++ == 0) first = row;
  if (outside == 0) return;
  const Vec& p = scene.bodies.position[first];
  report.error(*entry.node, path(entry, entry.place == Entry::Place::at ? "at" : "place.lattice"),
               std::to_string(outside) + (outside == 1 ? " body is" : " bodies are") +
                   " not inside domain.box; the first is body " + std::to_string(first + 1) + " at " +
                   to_text(p));
}

/// Random places are looked for only where the domain is.
void check_within(const Entry& entry, const Scene& scene, Report& report) {
  if (scene.domain.kind != DomainKind::box || entry.place != Entry::Place::random) return;
  if (Eigen::AlignedBox2d(scene.domain.min, scene.domain.max).contains(entry.within)) return;
  report.error(*entry.node, path(entry, "place.random.within"), "must lie inside domain.box");
}

/// Nobody may meet his own image, and who is looked for by distance must not be found twice: the broadphase
/// looks as far as two reaches, each a radius and its skin of at most a quarter, and that must be at most
/// half the period.
double least_period(const Entry& entry, double radius) {
  return std::max((entry.kind != BodyKind::fixed ? 4.0 * 1.25 : 2.0) * radius, 2.0 * radius + entry.gap);
}

void check_period(const Entry& entry, const Scene& scene, Report& report) {
  if (scene.domain.kind != DomainKind::periodic || entry.count == 0) return;
  const auto first = scene.bodies.radius.begin() + entry.first;
  const double radius = *std::max_element(first, first + entry.count);
  const double period = (scene.domain.max - scene.domain.min).minCoeff();
  const double least = least_period(entry, radius);
  if (least <= period) return;
  report.error(*entry.node, path(entry, "shape"),
               "a body " + to_text(2.0 * radius) + " m across" +
                   (entry.gap > 0.0 ? " with its gap of " + to_text(entry.gap) + " m" : "") +
                   " needs domain.periodic to be at least " + to_text(least) +
                   " m wide and high, and it is " + to_text(period) + " m");
}

}  // namespace

Vec wrapped(const Domain& domain, const Vec& p) {
  return domain.kind == DomainKind::periodic ? throng::wrapped(p, domain) : p;
}

void place_bodies(std::span<const Entry> entries, std::span<const ShapeDraw> draws, Scene& scene,
                  Report& report) {
  resize(scene.bodies, entries.empty() ? 0 : entries.back().first + entries.back().count);
  for (const Entry& entry : entries) {
    fill(entry, draws[entry.shape], scene);
    set_velocities(entry, scene);
    if (entry.place != Entry::Place::random) place_on_lattice(entry, scene);
    check_period(entry, scene, report);
    check_inside(entry, scene, report);
    check_within(entry, scene, report);
  }
  if (report.errors() > 0) return;
  for (Vec& position : scene.bodies.position) position = wrapped(scene.domain, position);
  warn_of_overlaps(entries, scene, report);
  place_at_random(entries, scene, report);
}

}  // namespace throng::scenarios
