// SPDX-License-Identifier: MIT
#include "sim/soft_timing.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "sim/contact/soft_law.h"
#include "sim/meeting_materials.h"
#include "sim/overlap.h"
#include "sim/state.h"

namespace throng {

namespace {

/// How much higher frequencies squared, and damping rates, are in a packing than of two: translations four
/// times at most (a triangular lattice, three times), spins that all turn one way twelve times the tangential
/// part.
double packed(double tangential) {
  return std::max(4.0, 12.0 * tangential);
}

/// How far apart the top and the bottom of the scene are, as gravity sees it (m).
class Height {
 public:
  explicit Height(const Scene& scene) : down_(scene.gravity.normalized()) {
    const Bodies& bodies = scene.bodies;
    for (std::size_t row = 0; row < bodies.size(); ++row) add(bodies.position[row], bodies.radius[row]);
    for (const Wall& wall : scene.walls)
      for (const Vec& point : wall.points) add(point, 0.0);
    if (scene.domain.kind == DomainKind::unbounded) return;
    add(scene.domain.min, 0.0), add(scene.domain.max, 0.0);
  }
  double size() const { return std::max(high_ - low_, 0.0); }

 private:
  void add(const Vec& place, double radius) {
    const double height = down_.dot(place);
    low_ = std::min(low_, height - radius), high_ = std::max(high_, height + radius);
  }

  Vec down_;
  double low_ = std::numeric_limits<double>::infinity(), high_ = -low_;
};

/// m/s, of the fastest point of a body at the beginning.
double first_speed(const Scene& scene) {
  double fastest = 0.0;
  for (std::size_t row = 0; row < scene.bodies.size(); ++row)
    fastest = std::max(fastest, scene.bodies.velocity[row].norm() +
                                    std::abs(scene.bodies.spin[row]) * scene.bodies.radius[row]);
  return fastest;
}

/// The least restitution of what a dynamic body may meet.
double least_restitution(const Scene& scene) {
  double least = 1.0;
  for (const auto& [a, b] : meeting_materials(scene))
    least = std::min(least, std::max(scene.materials[a].restitution, scene.materials[b].restitution));
  return least;
}

}  // namespace

double fall_speed(const Scene& scene) {
  const double gravity = scene.gravity.norm();
  return gravity > 0.0 ? std::sqrt(2.0 * gravity * Height(scene).size()) : 0.0;
}

double top_speed(const Scene& scene) {
  return first_speed(scene) + fall_speed(scene);
}

double longest_way(const Scene& scene) {
  return smallest_dynamic_radius(scene);
}

double first_speed_of_ways(const Scene& scene) {
  const Bodies& bodies = scene.bodies;
  double fastest = 0.0;
  for (std::size_t row = 0; row < bodies.size(); ++row) {
    const bool disc = scene.shapes[bodies.shape[row]].kind == ShapeKind::disc;
    const double turning = disc ? 0.0 : std::abs(bodies.spin[row]) * bodies.radius[row];
    fastest = std::max(fastest, bodies.velocity[row].norm() + turning);
  }
  return fastest;
}

SoftTiming soft_timing(const Scene& scene) {
  const double restitution = least_restitution(scene), ratio = damping_ratio(restitution);
  const SoftRatios tangential = soft_ratios(scene);
  const bool alone = std::ranges::count(scene.bodies.kind, BodyKind::dynamic) == 1;
  const double part = alone ? 1.0 : 0.5;  // of mass and radius, that two alike have
  constexpr double infinite = std::numeric_limits<double>::infinity();
  SoftTiming timing{first_speed(scene) + top_speed(scene), infinite, restitution, infinite};
  const bool hertz = scene.contact == ContactModel::hertz;
  const std::vector<double> deep =
      hertz ? Overlaps(scene).deepest(placed_bodies(scene)) : std::vector<double>();
  for (std::size_t row = 0; row < scene.bodies.size(); ++row) {
    if (scene.bodies.kind[row] != BodyKind::dynamic) continue;
    const double reduced = part * mass(scene, row);
    const SoftPair pair = soft_pair(scene, reduced, part * scene.bodies.radius[row], ratio);
    const double parts = hertz ? speed_of_depth(pair, reduced, deep[row]) : 0.0;
    const double speed = std::sqrt(timing.speed * timing.speed + parts * parts);
    const double frequency = std::sqrt(largest_stiffness(scene, pair, reduced, speed) / reduced);
    timing.contact = std::min(timing.contact, contact_duration(scene, pair, reduced, speed));
    timing.longest = std::min({timing.longest, 2.0 / (frequency * std::sqrt(packed(tangential.stiffness))),
                               1.0 / (ratio * frequency * packed(tangential.damping))});
  }
  return timing;
}

double substeps_per_impact(double restitution, double error) {
  const double ratio = damping_ratio(restitution);
  return std::sqrt((0.05 + ratio * (1.7 + 18.0 * ratio)) / error);
}

std::string soft_refusal(const Scene& scene) {
  const std::string model = scene.contact == ContactModel::spring ? "\"spring\"" : "\"hertz\"";
  for (std::size_t row = 0; row < scene.bodies.size(); ++row) {
    const BodyKind kind = scene.bodies.kind[row];
    const Shape& shape = scene.shapes[scene.bodies.shape[row]];
    if (kind == BodyKind::agent)
      return model + " is of bodies: beside agents contacts must be \"impulse\" or \"none\"";
    if (kind == BodyKind::dynamic && shape.kind != ShapeKind::disc)
      return model + " is of discs, and body " + std::to_string(row + 1) + " is a dynamic \"" + shape.name +
             "\", which is none; static and kinematic bodies may have any shape";
  }
  return "";
}

}  // namespace throng
