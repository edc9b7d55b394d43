// SPDX-License-Identifier: MIT
#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include "sim/input_error.h"
#include "sim/recording/recording.h"
#include "tests/durability/durable_run.h"
#include "tests/sim/recording/crowd.h"
#include "tests/sim/recording/scenes.h"

/// Files that lie: samples of every kind, and all that is read of them.
namespace throng {

using namespace testing_recordings;

inline constexpr int kFrames = 8;
inline constexpr std::size_t kBodies = 10;

inline std::string bytes_of(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

inline void write(const std::string& path, const std::string& bytes) {
  std::ofstream(path, std::ios::binary) << bytes;
}

/// Everything that the reader tells of a file, as text.
struct Told {
  std::string scene;
  std::vector<std::string> frames;
};

inline std::string text(const Frame& frame) {
  std::ostringstream all;
  all.precision(17);
  all << frame.step << ' ' << frame.time << ' ' << frame.state_hash << ' ';
  for (const Vec& p : frame.position) all << p;
  for (const Vec& p : frame.velocity) all << p;
  for (double x : frame.angle) all << x << ' ';
  for (double x : frame.spin) all << x << ' ';
  for (int there : frame.is_present) all << there;
  if (frame.contacts)
    for (const ContactRow& row : *frame.contacts)
      all << ' ' << row.a << ' ' << row.b << ' ' << row.impulse << ' ' << row.point;
  if (const auto& seen = frame.observables)
    all << ' ' << seen->kinetic_energy << ' ' << seen->potential_energy << ' ' << seen->momentum << ' '
        << seen->contacts << ' ' << seen->max_overlap << ' ' << seen->mean_overlap;
  if (frame.observables && frame.observables->crowd) {
    all << ' ' << frame.observables->crowd->agents << ' ' << frame.observables->crowd->arrived;
    for (double x : frame.observables->crowd->measures) all << ' ' << x;
  }
  for (const std::optional<Sensed>& sensed : frame.sensed) {
    all << (sensed ? " sensed" : " not due");
    for (const auto& column :
         {sensed.value_or(Sensed{}).who, sensed.value_or(Sensed{}).count, sensed.value_or(Sensed{}).whom}) {
      all << ':';
      for (const std::uint32_t id : column) all << ' ' << id;
    }
  }
  return all.str();
}

inline Told everything(const std::string& path) {
  std::ostringstream all;
  all.precision(17);
  const Recording recording(path);
  const Scene& scene = recording.geometry();
  const RecordingOrigin& origin = recording.origin();
  all << recording.complete() << scene.name << scene.description << scene.seed << scene.time.dt
      << scene.time.until << scene.time.substeps << scene.record.every << static_cast<int>(scene.engine)
      << scene.domain.min << scene.domain.max << static_cast<int>(scene.domain.kind) << origin.version
      << origin.compiler << origin.flags << origin.author << origin.provenance.scenario
      << origin.provenance.resolved << origin.provenance.command_line << origin.provenance.threads;
  for (const Material& m : scene.materials)
    all << m.name << m.density << ' ' << m.restitution << ' ' << m.friction;
  for (const Shape& s : scene.shapes) {
    all << s.name << static_cast<int>(s.kind) << s.centre << s.area << ' ' << s.gyration2 << ' ' << s.radius;
    for (const Vec& p : s.outline) all << p;
    for (const auto& hole : s.holes)
      for (const Vec& p : hole) all << p;
    for (const auto& part : s.parts) {
      all << part.radius;
      for (const Vec& p : part.vertices) all << p;
    }
  }
  for (std::size_t row = 0; row < scene.bodies.size(); ++row)
    all << scene.bodies.shape[row] << ' ' << scene.bodies.material[row] << ' '
        << static_cast<int>(scene.bodies.kind[row]) << ' ' << scene.bodies.radius[row];
  for (const Wall& wall : scene.walls) {
    all << wall.closed << wall.material;
    for (const Vec& p : wall.points) all << p;
  }
  for (const Sensor& sensor : scene.sensors)
    all << sensor.name << sensor.radius << ' ' << sensor.fov << name(sensor.screens) << sensor.every;
  for (const Measure& measure : scene.crowd.measures) {
    all << measure.name << measure.line[0] << measure.line[1] << measure.size;
    for (const auto& ring : measure.area.rings)
      for (const Vec& p : ring) all << p;
  }
  for (const Area& area : scene.crowd.areas) {
    all << area.name << static_cast<int>(area.use);
    for (const auto& ring : area.region.rings)
      for (const Vec& p : ring) all << p;
  }
  for (const Queue& queue : scene.crowd.queues) {
    all << queue.name << queue.spacing << queue.service;
    for (const Vec& p : queue.line) all << p;
  }
  for (const auto& ring : scene.crowd.walkable.rings)
    for (const Vec& p : ring) all << p;
  Told told{all.str(), {}};
  for (std::size_t i = 0; i < recording.frames(); ++i) told.frames.push_back(text(recording.frame(i)));
  return told;
}

inline std::string refusal(const std::string& path) {
  try {
    everything(path);
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

/// A file and what it tells; `unfinished`: as a run that was killed leaves it.
struct Sample {
  std::string bytes;
  Told told;
  bool unfinished = false;
};

struct Hostile : testing::Test {
  Hostile() {
    const Scene scene = mixed_scene(kBodies);
    record_drift(folder / "good.h5", scene, kFrames);
    good = {bytes_of(folder / "good.h5"), everything(folder / "good.h5")};
  }

  Sample single() const {
    Scene scene = mixed_scene(kBodies);
    scene.record.single = true;
    scene.record.angle = false;
    record_drift(folder / "single.h5", scene, kFrames);
    return {bytes_of(folder / "single.h5"), everything(folder / "single.h5")};
  }

  /// Of all that there may be in a file, the hash of each frame must hold what carries no checksum.
  Sample full(bool region) const { return full(full_record(region)); }
  Sample full(const Record& record) const {
    Scene scene = mixed_scene(kBodies);
    scene.record = record;
    add_sensor(scene, 4);
    const std::string file = folder / "full.h5";
    std::filesystem::remove(file);
    record_run(file, scene, 12);
    return {bytes_of(file), everything(file)};
  }

  /// Of agents, with measures and a sensor.
  Sample crowd() const {
    record_simulation(folder / "crowd.h5", measured_crowd());
    return {bytes_of(folder / "crowd.h5"), everything(folder / "crowd.h5")};
  }

  /// A copy of the part once all frames are committed, while the writer has it open.
  Sample unfinished() const {
    const Scene scene = mixed_scene(kBodies);
    Recorder recorder(folder / "going.h5", scene, provenance());
    for (int i = 0; i < kFrames; ++i) recorder.record(state_at(scene, i));
    recorder.checkpoint(state_at(scene, kFrames - 1));
    while (!std::filesystem::exists(folder / "going.h5.ckpt")) std::this_thread::yield();
    write(folder / "killed.h5.part", bytes_of(recorder.part()));
    EXPECT_EQ(Recording(folder / "killed.h5.part").frames(), static_cast<std::size_t>(kFrames));
    return {bytes_of(folder / "killed.h5.part"), everything(folder / "killed.h5.part"), true};
  }

  /// True where the file is refused; a file that is accepted must tell what the sample does, of a run that
  /// did not end perhaps fewer frames.
  bool refused(const std::string& bytes, const Sample& sample) {
    write(folder / "bad.h5", bytes);
    try {
      Told told = everything(folder / "bad.h5");
      EXPECT_EQ(told.scene, sample.told.scene);
      EXPECT_LE(told.frames.size(), sample.told.frames.size());
      std::vector<std::string> expected = sample.told.frames;
      if (sample.unfinished) expected.resize(told.frames.size());
      EXPECT_EQ(told.frames, expected);
      return false;
    } catch (const InputError&) {
      return true;
    }
  }

  Folder folder;
  Sample good;
};

}  // namespace throng
