// SPDX-License-Identifier: MIT
#include "sim/scene.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "sim/crowd/model.h"

namespace throng {

namespace {

constexpr const char* kEngines[] = {"native", "box2d", "event_driven"};  // as Engine

/// kg, what the agent's model reckons with.
double agent_mass(const Crowd& crowd, std::size_t agent) {
  if (agent >= crowd.size()) return kAgentMass;  // a recording's, which has no groups
  const AgentGroup& group = crowd.groups[crowd.group[agent]];
  const std::span<const ModelParameter> known = walking_models()[group.model].parameters;
  for (std::size_t i = 0; i < known.size(); ++i)
    if (std::string_view(known[i].key) == "mass")
      return group.parameters_of(static_cast<std::uint32_t>(agent - group.first))[i];
  return kAgentMass;
}

}  // namespace

const char* engine_name(Engine engine) {
  return kEngines[static_cast<std::size_t>(engine)];
}

Engine engine_named(std::string_view name) {
  const auto* found = std::ranges::find(kEngines, name);
  return found == std::end(kEngines) ? Engine::native : static_cast<Engine>(found - std::begin(kEngines));
}

std::int64_t Time::steps() const {
  const double steps = until / dt;
  const double rounding = std::max(1e-9, 4.0 * std::numeric_limits<double>::epsilon() * steps);
  return static_cast<std::int64_t>(std::min(std::ceil(steps - rounding), kMostSteps));
}

bool bodies_come_and_go(const Scene& scene) {
  const auto& kind = scene.bodies.kind;
  return scene.record.within || std::find(kind.begin(), kind.end(), BodyKind::agent) != kind.end();
}

double smallest_dynamic_radius(const Scene& scene) {
  double smallest = std::numeric_limits<double>::infinity();
  for_dynamic(scene, [&](std::size_t row) { smallest = std::min(smallest, scene.bodies.radius[row]); });
  return smallest;
}

double mass(const Scene& scene, std::size_t row) {
  const Bodies& bodies = scene.bodies;
  if (bodies.kind[row] == BodyKind::agent) return agent_mass(scene.crowd, row - scene.crowd.first);
  const Shape& shape = scene.shapes[bodies.shape[row]];
  const double radius = bodies.radius[row];
  const double area = shape.kind == ShapeKind::disc ? std::numbers::pi * radius * radius : shape.area;
  return area * scene.materials[bodies.material[row]].density;
}

double inertia(const Scene& scene, std::size_t row) {
  const Bodies& bodies = scene.bodies;
  const Shape& shape = scene.shapes[bodies.shape[row]];
  const double radius = bodies.radius[row];
  return mass(scene, row) * (shape.kind == ShapeKind::disc ? 0.5 * radius * radius : shape.gyration2);
}

}  // namespace throng
