// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <vector>

#include "sim/scene.h"

namespace throng {

/// Discs in a box from collision to collision, by looking at all pairs after each one, in long double: the
/// definition.
class AllPairs {
 public:
  using Real = long double;
  using RealVec = Eigen::Matrix<Real, 2, 1>;

  explicit AllPairs(const Scene& scene) : scene_(scene), restitution_(scene.materials[0].restitution) {
    for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
      at.push_back(scene.bodies.position[i].cast<Real>());
      velocity.push_back(scene.bodies.velocity[i].cast<Real>());
    }
  }
  void fly(Real left) {
    for (;;) {
      Hit first{left, 0, -1};
      for (std::size_t a = 0; a < at.size(); ++a) {
        for (int side = 0; side < 4; ++side) look_at_side(a, side, first);
        for (std::size_t b = a + 1; b < at.size(); ++b) look(a, b, first);
      }
      for (std::size_t i = 0; i < at.size(); ++i) at[i] += first.time * velocity[i];
      left -= first.time;
      if (first.with == -1) return;
      ++collisions;
      bounce(first);
    }
  }

  std::vector<RealVec> at, velocity;
  int collisions = 0;

 private:
  struct Hit {
    Real time;
    std::size_t a;
    int with;  // a body; below -1 a side
  };
  void look(std::size_t a, std::size_t b, Hit& first) const {
    const RealVec r = at[b] - at[a], v = velocity[b] - velocity[a];
    const Real reach = scene_.bodies.radius[a] + scene_.bodies.radius[b];
    const Real nearing = -r.dot(v), d = nearing * nearing - v.dot(v) * (r.dot(r) - reach * reach);
    if (nearing <= 0 || d < 0) return;
    const Real time = std::max<Real>(0, (nearing - std::sqrt(d)) / v.dot(v));
    if (time < first.time) first = {time, a, static_cast<int>(b)};
  }
  void look_at_side(std::size_t a, int side, Hit& first) const {
    const int axis = side / 2;
    const Real sign = side % 2 ? -1 : 1, radius = scene_.bodies.radius[a];
    const Real border = (side % 2 ? scene_.domain.max : scene_.domain.min)[axis];
    if (sign * velocity[a][axis] >= 0) return;
    const Real time =
        std::max<Real>(0, (sign * (at[a][axis] - border) - radius) / (-sign * velocity[a][axis]));
    if (time < first.time) first = {time, a, -2 - axis};
  }
  void bounce(const Hit& hit) {
    if (hit.with < 0) {
      velocity[hit.a][-2 - hit.with] *= -restitution_;
      return;
    }
    const std::size_t b = static_cast<std::size_t>(hit.with);
    const RealVec n = (at[b] - at[hit.a]).normalized();
    const Real masses[] = {mass(scene_, hit.a), mass(scene_, b)};
    const Real impulse =
        -(1 + restitution_) * (velocity[b] - velocity[hit.a]).dot(n) / (1 / masses[0] + 1 / masses[1]);
    velocity[hit.a] -= impulse / masses[0] * n;
    velocity[b] += impulse / masses[1] * n;
  }

  const Scene& scene_;
  const Real restitution_;
};

}  // namespace throng
