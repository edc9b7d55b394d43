// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <map>
#include <vector>

#include "sim/scene.h"

namespace throng {

/// Soft contacts written down plainly: all pairs, the four sides of a box and single wall segments, plain
/// doubles, a map of springs. Discs of one material.
class SoftTwin {
 public:
  SoftTwin(const Scene& scene, double h) : scene_(scene), h_(h) {
    for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
      const Vec &x = scene.bodies.position[i], &v = scene.bodies.velocity[i];
      discs_.push_back(
          {x.x(), x.y(), v.x(), v.y(), scene.bodies.spin[i], scene.bodies.radius[i], mass(scene, i)});
    }
  }

  struct Disc {
    double x, y, vx, vy, spin, radius, mass;
    double fx = 0, fy = 0, torque = 0;
  };
  const std::vector<Disc>& discs() const { return discs_; }

  void step() {
    for (Disc& d : discs_) d.x += h_ / 2 * d.vx, d.y += h_ / 2 * d.vy;
    std::vector<Disc> begin = discs_;
    add_forces(begin, Pass::begin);
    std::vector<Disc> middle = discs_;
    for (std::size_t i = 0; i < middle.size(); ++i) kick(middle[i], begin[i], h_ / 2);
    add_forces(middle, Pass::middle);
    for (std::size_t i = 0; i < discs_.size(); ++i) kick(discs_[i], middle[i], h_);
    first_ = false;
    std::vector<Disc> end = discs_;
    add_forces(end, Pass::end);
    for (Disc& d : discs_) d.x += h_ / 2 * d.vx, d.y += h_ / 2 * d.vy;
  }

 private:
  static constexpr double kFar = 1.5;  // sums of radii: who is farther apart doesn't meet within a step

  enum class Pass { begin, middle, end };  // at the places of the middle, with the velocities of these

  struct Springs {
    double slip = 0, roll = 0;
  };

  void kick(Disc& d, const Disc& pushed, double time) const {
    d.vx += time * (pushed.fx / d.mass + scene_.gravity.x());
    d.vy += time * (pushed.fy / d.mass + scene_.gravity.y());
    d.spin += time * pushed.torque / (0.5 * d.mass * d.radius * d.radius);
  }

  void add_forces(std::vector<Disc>& discs, Pass pass) {
    const std::size_t n = discs.size();
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = i + 1; j < n; ++j) {
        Disc &a = discs[i], &b = discs[j];
        const double dx = b.x - a.x, dy = b.y - a.y, distance = std::sqrt(dx * dx + dy * dy);
        if (distance > kFar * (a.radius + b.radius)) continue;
        const double depth = a.radius + b.radius - distance, in = std::max(depth, 0.0);
        touch({i, j}, a, &b, dx / distance, dy / distance, depth, a.radius - in / 2, b.radius - in / 2, pass);
      }
    for (std::size_t i = 0; i < n; ++i) {
      Disc& a = discs[i];
      const auto wall = [&](std::size_t which, double nx, double ny, double distance) {
        const double depth = a.radius - distance;
        touch({i, n + which}, a, nullptr, nx, ny, depth, a.radius - std::max(depth, 0.0), 0.0, pass);
      };
      if (scene_.domain.kind == DomainKind::box) {
        wall(0, -1, 0, a.x - scene_.domain.min.x()), wall(1, 1, 0, scene_.domain.max.x() - a.x);
        wall(2, 0, -1, a.y - scene_.domain.min.y()), wall(3, 0, 1, scene_.domain.max.y() - a.y);
      }
      for (std::size_t w = 0; w < scene_.walls.size(); ++w) {
        const Vec p = scene_.walls[w].points[0], way = scene_.walls[w].points[1] - p, place(a.x, a.y);
        const double along = std::min(1.0, std::max(0.0, way.dot(place - p) / way.dot(way)));
        const Vec to = p + along * way - place;
        wall(4 + w, to.x() / to.norm(), to.y() / to.norm(), to.norm());
      }
    }
  }

  void touch(std::pair<std::size_t, std::size_t> key, Disc& a, Disc* b, double nx, double ny, double depth,
             double arm_a, double arm_b, Pass pass) {
    const double tx = -ny, ty = nx;
    const double ux = (b ? b->vx : 0.0) - a.vx, uy = (b ? b->vy : 0.0) - a.vy;
    const double spin_b = b ? b->spin : 0.0;
    const double closing = -(ux * nx + uy * ny);
    const double sliding = ux * tx + uy * ty - arm_a * a.spin - arm_b * spin_b, rolling = spin_b - a.spin;
    const double from = depth - h_ / 2 * closing, to = depth + h_ / 2 * closing;
    if (pass == Pass::end && springs_.contains(key)) {
      const double ahead = depth > 0 ? h_ / 2 : closing * h_ / 2 > -depth ? h_ / 2 + depth / closing : 0.0;
      springs_[key].slip += ahead * sliding, springs_[key].roll += ahead * rolling;
      return;
    }
    if (pass == Pass::begin && from <= 0 && to <= 0) springs_.erase(key);
    if (pass != Pass::begin && !springs_.contains(key)) return;  // it comes into contact in the next step
    if (pass == Pass::end || (from <= 0 && to <= 0)) return;
    const double reduced = b ? a.mass * b->mass / (a.mass + b->mass) : a.mass;
    const double radius = b ? a.radius * b->radius / (a.radius + b->radius) : a.radius;
    const Material& material = scene_.materials[0];
    const double e = material.restitution;
    const double ratio = e <= 0 ? 1.0 : -std::log(e) / std::hypot(std::acos(-1.0), std::log(e));
    const SoftContact& soft = scene_.soft;
    const double nu = soft.poisson_ratio;
    const bool hertz = scene_.contact == ContactModel::hertz;
    const double k =
        hertz ? 4.0 / 3.0 * soft.youngs_modulus / (2 * (1 - nu * nu)) * std::sqrt(radius) : soft.stiffness;
    const double c =
        hertz ? std::sqrt(5.0) * ratio * std::sqrt(reduced * k) : 2 * ratio * std::sqrt(k * reduced);
    // Powers of the depth in elastic and viscous force, and what they add up to over the depth.
    const double p = hertz ? 1.5 : 1.0, q = hertz ? 0.25 : 0.0;
    const auto sum = [](double d, double power) {
      return d > 0 ? std::pow(d, power + 1) / (power + 1) : 0.0;
    };
    const double share = (std::max(to, 0.0) - std::max(from, 0.0)) / (to - from);
    const bool all = std::min(from, to) > 0 && std::abs(to - from) < 2e-3 * depth;
    const double normal =
        all ? k * std::pow(depth, p) + c * std::pow(depth, q) * closing
            : (k * (sum(to, p) - sum(from, p)) + c * closing * (sum(to, q) - sum(from, q))) / (to - from);
    const double part = all ? 1.0 : share;
    const double back = springs_.contains(key) || first_ ? h_ / 2 : h_;
    Springs& springs = springs_[key];
    if (pass == Pass::begin) {
      const double lasting = depth <= 0 ? 0.0 : closing * back > depth ? depth / closing : back;
      springs.slip += lasting * sliding, springs.roll += lasting * rolling;
    }
    const double in = std::max(depth, 0.0);
    const double k_t =
        (hertz ? 2 * (1 - nu) / (2 - nu) : soft.tangential_stiffness) * (hertz ? 1.5 * k * std::sqrt(in) : k);
    const double c_t = soft.tangential_damping * c * std::pow(in, q);
    Springs held = springs;
    const double most = std::max(normal, 0.0);
    const double tangent = hold(k_t, c_t, part, material.friction * most, sliding, held.slip);
    const double torque = hold(k_t * radius * radius, c_t * radius * radius, part,
                               material.rolling_resistance * radius * most, rolling, held.roll);
    if (pass == Pass::middle) springs = held;
    const double fx = normal * nx + tangent * tx, fy = normal * ny + tangent * ty;
    a.fx -= fx, a.fy -= fy, a.torque -= arm_a * tangent + torque;
    if (b) b->fx += fx, b->fy += fy, b->torque += torque - arm_b * tangent;
  }

  static double hold(double k, double c, double share, double most, double rate, double& spring) {
    const double force = -share * (k * spring + c * rate);
    if (std::abs(force) <= most) return force;
    const double held = force > 0 ? most : -most;
    if (k > 0) spring = -(held / share + c * rate) / k;
    return held;
  }

  const Scene& scene_;
  const double h_;
  bool first_ = true;
  std::vector<Disc> discs_;
  std::map<std::pair<std::size_t, std::size_t>, Springs> springs_;
};

}  // namespace throng
