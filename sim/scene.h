// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "narrowphase/convex.h"
#include "sim/crowd/crowd.h"
#include "sim/measure/asked.h"
#include "sim/record.h"
#include "sim/sensing/sensor.h"

/// What is simulated: read once from a scenario, const ever after. What changes stands in `State`.
namespace throng {

enum class Engine { native, box2d, event_driven };
enum class ContactModel { none, impulse, spring, hertz };
enum class DomainKind { unbounded, box, periodic };
enum class BodyKind : std::uint8_t { dynamic, fixed, kinematic, agent };  // `fixed` is the file's "static"
enum class ShapeKind { disc, polygon, composite };

struct Material {
  std::string name = "default";
  double density = 1.0;             ///< kg/m², > 0
  double restitution = 0.0;         ///< 0 to 1; a pair takes the larger of its two
  double friction = 0.5;            ///< Coulomb's coefficient, >= 0; a pair takes the geometric mean
  double rolling_resistance = 0.0;  ///< torque over radius times normal force, >= 0; a pair takes the larger
};

/// A rigid shape about its centre of mass.
struct Shape {
  std::string name;
  ShapeKind kind = ShapeKind::disc;
  std::vector<narrowphase::Convex> parts;  ///< convex; empty for a disc, whose radius is its body's
  std::vector<Vec> outline;                ///< m, the polygon as drawn, counter-clockwise; polygons only
  std::vector<std::vector<Vec>> holes;     ///< m, of the polygon, clockwise
  Vec centre{0.0, 0.0};                    ///< m, where the centre of mass stood in the file's coordinates
  double area = 0.0;                       ///< m²; 0 for a disc
  double gyration2 = 0.0;                  ///< m², moment of inertia over mass; 0 for a disc
  double radius = 0.0;  ///< m, of the smallest disc about the centre that holds all of it; 0 for a disc
};

/// A row per body in the order of the file; the id of a row is row + 1.
struct Bodies {
  std::vector<std::uint32_t> shape;     ///< row of Scene::shapes
  std::vector<std::uint32_t> material;  ///< row of Scene::materials
  std::vector<BodyKind> kind;
  std::vector<double> radius;  ///< m: a disc's own, else that of its shape
  std::vector<Vec> position;   ///< m, of the centre of mass
  std::vector<double> angle;   ///< rad
  std::vector<Vec> velocity;   ///< m/s
  std::vector<double> spin;    ///< rad/s

  std::size_t size() const { return shape.size(); }
};

/// A thin wall with two sides: a line through its points, back to the first where it is closed.
struct Wall {
  std::vector<Vec> points;  ///< m, two or more
  bool closed = false;
  std::uint32_t material = 0;
};

struct Domain {
  DomainKind kind = DomainKind::unbounded;
  Vec min{0.0, 0.0}, max{0.0, 0.0};  ///< m
};

struct Time {
  double dt = 0.01;     ///< s, > 0
  double until = 10.0;  ///< s, >= 0
  int substeps = 4;     ///< >= 1
  double error = 0.0;   ///< that dt and substeps were chosen for (auto_time.h); 0: they were given

  std::int64_t steps() const;  ///< the fewest steps that reach `until`, up to rounding; at most kMostSteps
  static constexpr double kMostSteps = 1e12;  ///< no run has more
};

/// Contact models spring and hertz: discs that give way. What materials say holds beside it.
struct SoftContact {
  double stiffness = 0.0;                   ///< N/m, > 0, of spring
  double tangential_stiffness = 2.0 / 7.0;  ///< of the normal one, of spring; of hertz by Poisson's ratio
  double youngs_modulus = 0.0;              ///< Pa, > 0, of hertz
  double poisson_ratio = 0.3;               ///< of hertz
  double tangential_damping = 0.5;          ///< of the normal one
};

struct Scene {
  std::string name;
  std::string description;
  std::uint64_t seed = 1;
  Engine engine = Engine::native;
  bool sleep = true;      ///< resting bodies may leave the loop
  Vec gravity{0.0, 0.0};  ///< m/s²
  Time time;
  Domain domain;
  ContactModel contact = ContactModel::impulse;
  SoftContact soft;
  Record record;
  Asked asked;  ///< to be observed of all bodies
  std::vector<Material> materials;
  std::vector<Shape> shapes;
  Bodies bodies;
  std::vector<Wall> walls;
  Crowd crowd;  ///< whose agents are the last of the bodies
  std::vector<Sensor> sensors;
};

/// Whether bodies that touch give way, as springs do.
inline bool is_soft(ContactModel model) {
  return model == ContactModel::spring || model == ContactModel::hertz;
}

/// Calls f(row) for dynamic bodies.
template <class F>
void for_dynamic(const Scene& scene, F f) {
  for (std::size_t row = 0; row < scene.bodies.size(); ++row)
    if (scene.bodies.kind[row] == BodyKind::dynamic) f(row);
}

/// Whether some body is a disc, or has one: else nothing rolls.
inline bool any_round(const Scene& scene) {
  return std::ranges::any_of(scene.bodies.shape, [&](std::uint32_t shape) {
    return scene.shapes[shape].kind != ShapeKind::polygon;
  });
}

/// As files and command lines have it.
const char* engine_name(Engine engine);

/// The engine of that name; native where there is none.
Engine engine_named(std::string_view name);

/// Whether frames of a recording hold other bodies now and then: those in record.within, agents until they
/// leave. Also of a scene that was read from a recording, whose bodies are the recorded ones. O(bodies).
bool bodies_come_and_go(const Scene& scene);

/// m, of dynamic bodies; infinite where there are none. O(bodies).
double smallest_dynamic_radius(const Scene& scene);

double mass(const Scene& scene, std::size_t row);  ///< kg; an agent's by its model; not of what was recorded
double inertia(const Scene& scene, std::size_t row);  ///< kg m², about the centre of mass

}  // namespace throng
