// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <sstream>
#include <string>
#include <vector>

#include "tests/sim/trial.h"

/// Scenes that are built stone by stone, as the text of a scenario.
namespace throng {

class Masonry {
 public:
  /// `dt` in s. A floor at y = 0, wide enough for all that is built here. Nobody sleeps: what stands must
  /// stand by itself. `substeps`: 0 for as many as a scenario has that doesn't say.
  explicit Masonry(double dt, double friction = 0.6, Vec floor = {0.0, 0.0}, int substeps = 0)
      : floor_(floor) {
    head_ << "sleep = false\ngravity = [0, -9.81]\ntime = { dt = " << exactly(dt) << ", until = 1"
          << (substeps > 0 ? ", substeps = " + std::to_string(substeps) : "") << " }\n"
          << "domain = { box = [[" << exactly(floor.x() - 100) << ", " << exactly(floor.y()) << "], ["
          << exactly(floor.x() + 100) << ", " << exactly(floor.y() + 100) << "]] }\n"
          << "[materials.default]\nfriction = " << friction << "\n";
  }

  /// A convex stone where its corners say (m, from the floor's middle). `density` in kg/m².
  void stone(const std::vector<Vec>& corners, double density = 1.0, const std::string& more = "") {
    const std::string name = "s" + std::to_string(stones_++);
    double area = 0.0;
    Vec centre(0.0, 0.0);
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const Vec &p = corners[i], &q = corners[(i + 1) % corners.size()];
      const double part = 0.5 * (p.x() * q.y() - p.y() * q.x());
      area += part;
      centre += part / 3.0 * (p + q);
    }
    centre /= area;
    shapes_ << name << " = { polygon = [";
    for (const Vec& c : corners) shapes_ << "[" << exactly(c.x()) << ", " << exactly(c.y()) << "], ";
    shapes_ << "] }\n";
    materials_ << "[materials." << name << "]\ndensity = " << density << "\nfriction = 0.6\n";
    const bool plain = density == 1.0;
    bodies_ << "[[bodies]]\nshape = \"" << name << "\"\nat = [" << exactly(floor_.x() + centre.x()) << ", "
            << exactly(floor_.y() + centre.y()) << "]\n"
            << (plain ? "" : "material = \"" + name + "\"\n") << more;
  }

  /// A box by its middle, width, height (m) and angle (rad).
  void box(const Vec& middle, double width, double height, double angle = 0.0, double density = 1.0,
           const std::string& more = "") {
    const Vec along(0.5 * width * std::cos(angle), 0.5 * width * std::sin(angle));
    const Vec up(-0.5 * height * std::sin(angle), 0.5 * height * std::cos(angle));
    stone({middle - along - up, middle + along - up, middle + along + up, middle - along + up}, density,
          more);
  }

  void ball(const Vec& middle, double radius, const std::string& more = "") {
    const std::string name = "s" + std::to_string(stones_++);
    shapes_ << name << " = { disc = { radius = " << exactly(radius) << " } }\n";
    bodies_ << "[[bodies]]\nshape = \"" << name << "\"\nat = [" << exactly(floor_.x() + middle.x()) << ", "
            << exactly(floor_.y() + middle.y()) << "]\n"
            << more;
  }

  std::string text() const {
    return head_.str() + materials_.str() + "[shapes]\n" + shapes_.str() + bodies_.str();
  }

 private:
  static std::string exactly(double x) {
    std::ostringstream out;
    out.precision(17);
    out << std::scientific << x;
    return out.str();
  }

  Vec floor_;
  int stones_ = 0;
  std::ostringstream head_, materials_, shapes_, bodies_;
};

inline double fastest(const State& state) {
  double most = 0.0;
  for (const Vec& v : state.velocity) most = std::max(most, v.norm());
  return most;
}

/// How far the body that strayed most is from where the scene put it (m).
inline double farthest(const Scene& scene, const State& state) {
  double most = 0.0;
  for (std::size_t i = 0; i < state.position.size(); ++i)
    most = std::max(most, (state.position[i] - scene.bodies.position[i]).norm());
  return most;
}

}  // namespace throng
