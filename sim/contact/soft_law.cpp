// SPDX-License-Identifier: MIT
#include "sim/contact/soft_law.h"

#include <limits>
#include <numbers>

#include "sim/crowd/exponential.h"
#include "sim/random.h"

namespace throng {

namespace {

/// x^p of x > 0, with the same bits on every machine.
double power(double x, double p) {
  return exponential(p * logarithm(std::max(x, 1e-300)));
}

/// m, of Hertz: how deep an impact gets.
double largest_depth(const SoftPair& pair, double mass, double speed) {
  return power(1.25 * mass * speed * speed / pair.stiffness, 0.4);
}

}  // namespace

double damping_ratio(double restitution) {
  if (restitution >= 1.0) return 0.0;
  if (restitution < 1e-300) return 1.0;
  const double decrement = -logarithm(restitution);
  return decrement / std::sqrt(std::numbers::pi * std::numbers::pi + decrement * decrement);
}

std::vector<double> damping_ratios(const Plan& plan) {
  std::vector<double> ratios;
  for (const Surface& surface : plan.surfaces) ratios.push_back(damping_ratio(surface.restitution));
  return ratios;
}

SoftPair soft_pair(const Scene& scene, double mass, double radius, double ratio) {
  const SoftContact& soft = scene.soft;
  if (scene.contact == ContactModel::spring)
    return {soft.stiffness, 2.0 * ratio * std::sqrt(soft.stiffness * mass), 0.0};
  // Two of one material: 1 / E* = 2 (1 - nu^2) / E.
  const double modulus = 0.5 * soft.youngs_modulus / (1.0 - soft.poisson_ratio * soft.poisson_ratio);
  const double stiffness = 4.0 / 3.0 * modulus * std::sqrt(radius);
  return {stiffness, std::sqrt(5.0) * ratio * std::sqrt(mass * stiffness), 0.0};
}

/// Of Hertz that of Mindlin (1949) without slip: 4 G* / E*.
SoftRatios soft_ratios(const Scene& scene) {
  const SoftContact& soft = scene.soft;
  const double mindlin = 2.0 * (1.0 - soft.poisson_ratio) / (2.0 - soft.poisson_ratio);
  return {scene.contact == ContactModel::spring ? soft.tangential_stiffness : mindlin,
          soft.tangential_damping};
}

double contact_duration(const Scene& scene, const SoftPair& pair, double mass, double speed) {
  if (scene.contact == ContactModel::spring) return std::numbers::pi * std::sqrt(mass / pair.stiffness);
  constexpr double kHertz = 2.9432751843247;  // 4/5 sqrt(pi) Gamma(2/5) / Gamma(9/10)
  return speed > 0.0 ? kHertz * largest_depth(pair, mass, speed) / speed
                     : std::numeric_limits<double>::infinity();
}

double speed_of_depth(const SoftPair& pair, double mass, double depth) {
  return std::sqrt(0.8 * pair.stiffness / mass * depth * depth * std::sqrt(depth));
}

double largest_stiffness(const Scene& scene, const SoftPair& pair, double mass, double speed) {
  if (scene.contact == ContactModel::spring) return pair.stiffness;
  return speed > 0.0 ? 1.5 * pair.stiffness * std::sqrt(largest_depth(pair, mass, speed)) : 0.0;
}

}  // namespace throng
