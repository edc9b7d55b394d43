// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
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

inline std::string content(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

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

/// None to three of them, of the first four bodies.
inline std::vector<ContactRow> contacts_at(std::int64_t step) {
  std::vector<ContactRow> rows;
  for (std::int64_t k = 0; k < step % 4; ++k)
    rows.push_back({static_cast<std::uint32_t>(1 + k),
                    k == 0 ? 0 : static_cast<std::uint32_t>(2 + k),
                    0.5 * static_cast<double>(step + k),
                    {0.25 * static_cast<double>(k), 1.0}});
  return rows;
}

/// Who has the sensor of `add_sensor`, of the first four bodies, and whom each finds: none to three.
inline Sensed sensed_at(std::int64_t step) {
  Sensed sensed;
  for (std::uint32_t id = 1; id <= 4; ++id) {
    sensed.who.push_back(id);
    sensed.count.push_back(0);
    for (std::uint32_t other = 1; other <= 4; ++other)
      if (other != id && (step + id * other) % 3 == 0) sensed.whom.push_back(other), ++sensed.count.back();
  }
  return sensed;
}

/// A recorded sensor.
inline void add_sensor(Scene& scene, int every) {
  Sensor sensor;
  sensor.name = "ears & <eyes>";
  sensor.radius = 2.5, sensor.fov = 120.0, sensor.screens = Screens::walls;
  sensor.every = every, sensor.record = true;
  scene.sensors.push_back(sensor);
  scene.record.sensors.push_back(every);
}

/// Adds each step from `first` to `last` at which a frame is due.
inline void record_steps(Recorder& recorder, const Scene& scene, std::int64_t first, std::int64_t last) {
  for (std::int64_t step = first; step <= last; ++step) {
    const std::vector<Sensed> all(scene.sensors.size(), sensed_at(step));
    if (is_frame(scene.record, step)) recorder.record(state_at(scene, step), contacts_at(step), all);
  }
}

/// A recording of the steps up to `last`.
inline void record_run(const std::string& path, const Scene& scene, std::int64_t last) {
  Recorder recorder(path, scene, provenance());
  record_steps(recorder, scene, 0, last);
  recorder.finish({});
}

inline int& own_every(Scene& scene, RecordField field) {
  return scene.record.own_every[index(field)];
}

/// All that may be asked of a recording: of some bodies, at several rates, contacts, observables, and
/// positions quantized, or of who is in a region of the mixed scene, as float32.
inline Record full_record(bool region) {
  Record record;
  record.every = 2;
  record.contacts = record.spin = true;
  record.own_every[index(RecordField::velocity)] = 3;
  record.observables = 5;
  record.ids = {1, 2, 3, 4, 6};
  record.quantum = region ? 0.0 : 1e-3;
  record.single = region;
  if (region) record.within = Eigen::AlignedBox2d(Vec(1.0, -3.0), Vec(3.502, 9.0));
  return record;
}

/// Records `frames` states of the drift above, a frame each `record.every` steps, and finishes.
inline void record_drift(const std::string& path, const Scene& scene, int frames) {
  Recorder recorder(path, scene, provenance());
  for (int i = 0; i < frames; ++i) recorder.record(state_at(scene, std::int64_t{i} * scene.record.every));
  recorder.finish({});
}

}  // namespace throng::testing_recordings
