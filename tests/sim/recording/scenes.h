// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <filesystem>
#include <string>

#include "sim/recording/recorder.h"

/// Scenes, states and places for the tests of recordings.
namespace throng::testing_recordings {

/// A folder of the test's own, gone with it.
struct Folder {
  Folder() {
    std::string pattern = std::filesystem::temp_directory_path() / "throng-test-XXXXXX";
    path = mkdtemp(pattern.data());
  }
  ~Folder() { std::filesystem::remove_all(path); }
  std::string operator/(const std::string& name) const { return path / name; }
  std::filesystem::path path;
};

inline narrowphase::Convex square(double half) {
  narrowphase::Convex result;
  result.vertices = {{-half, -half}, {half, -half}, {half, half}, {-half, half}};
  result.normals = {{0, -1}, {1, 0}, {0, 1}, {-1, 0}};
  return result;
}

/// Discs, squares and a composite of two discs in a box with two walls: `n` bodies, the first one static.
inline Scene mixed_scene(std::size_t n) {
  Scene scene;
  scene.name = "mixed <b>&\"bodies\"";
  scene.seed = 18446744073709551615ULL;
  scene.domain = {DomainKind::box, {-1.0, -2.0}, {20.0, 10.0}};
  scene.record.spin = true;
  scene.materials = {{}, {"ice", 0.9, 0.1, 0.02}};
  Shape ball, box, robot;
  ball.name = "ball";
  box.name = "box";
  box.kind = ShapeKind::polygon;
  box.parts = {square(0.3)};
  box.outline = box.parts[0].vertices;
  box.area = 0.36;
  box.gyration2 = 0.06;
  box.radius = 0.3 * std::sqrt(2.0);
  robot.name = "robot";
  robot.kind = ShapeKind::composite;
  robot.parts = {{{{-0.2, 0.0}}, {}, 0.3}, {{{0.2, 0.0}}, {}, 0.2}};
  robot.area = 0.4;
  robot.radius = 0.5;
  scene.shapes = {ball, box, robot};
  for (std::size_t i = 0; i < n; ++i) {
    scene.bodies.shape.push_back(i % 3);
    scene.bodies.material.push_back(i % 2);
    scene.bodies.kind.push_back(i == 0 ? BodyKind::fixed : BodyKind::dynamic);
    scene.bodies.radius.push_back(i % 3 == 0 ? 0.2 + 0.01 * (i % 7) : scene.shapes[i % 3].radius);
    scene.bodies.position.push_back({0.5 + i % 20, 0.5 + i / 20});
    scene.bodies.angle.push_back(0.1 * i);
    scene.bodies.velocity.push_back({0.01 * i, -0.02 * i});
    scene.bodies.spin.push_back(0.3 - 0.01 * i);
  }
  scene.walls = {{{{0, 0}, {5, 1}, {10, 0}}, false, 0}, {{{12, 3}, {13, 3}, {12.5, 4}}, true, 1}};
  return scene;
}

inline Provenance provenance() {
  return {"throng = 1\nname = \"mixed\"  # as given\n", "throng = 1\nname = \"mixed\"\n",
          "throng run mixed.toml -o x.h5", 2};
}

/// A motion that is easy to check: all bodies drift and turn.
inline State state_at(const Scene& scene, std::int64_t step) {
  State state = initial_state(scene);
  state.step = step;
  const double t = static_cast<double>(step) * scene.time.dt;
  for (std::size_t row = 0; row < state.id.size(); ++row) {
    state.position[row] += t * state.velocity[row];
    state.angle[row] += t * state.spin[row];
  }
  return state;
}

/// Records `frames` states of the drift above, a frame each `record.every` steps, and finishes.
inline void record_drift(const std::string& path, const Scene& scene, int frames) {
  Recorder recorder(path, scene, provenance());
  for (int i = 0; i < frames; ++i) recorder.record(state_at(scene, std::int64_t{i} * scene.record.every));
  recorder.finish();
}

}  // namespace throng::testing_recordings
