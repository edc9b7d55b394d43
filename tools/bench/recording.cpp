// SPDX-License-Identifier: MIT
// throng bench recording: a run with every step recorded against the same run without; and how fast frames
// get to the disk and back, against the same bytes without HDF5, hashes and checksums.
#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <stdexcept>

#include "sim/recording/recorder.h"
#include "sim/recording/recording.h"
#include "sim/simulation.h"
#include "tools/bench/benchmarks.h"
#include "tools/bench/crowd_motion.h"
#include "tools/bench/interleave.h"
#include "tools/bench/scenes.h"
#include "tools/bench/scratch_folder.h"

namespace throng::bench {

namespace {

constexpr std::size_t kBlock = std::size_t{1} << 20;  // bytes at a time, as dd bs=1M

void run(const Scene& scene, int steps, Recorder* recorder) {
  const auto simulation = throng::simulation(scene);
  for (int i = 0; i < steps; ++i) {
    simulation->step();
    if (recorder) recorder->record(simulation->state());
  }
  if (recorder) recorder->finish({});
}

void expect(bool done, const char* what) {
  if (!done) throw std::runtime_error(std::string("cannot ") + what + " the benchmark's file");
}

/// What `dd bs=1M conv=fsync` does.
void write_plainly(const std::string& file, std::size_t bytes) {
  static const std::vector<char> block(kBlock, 'x');
  const int fd = open(file.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  expect(fd >= 0, "open");
  for (std::size_t done = 0; done < bytes;) {
    const ssize_t now = write(fd, block.data(), std::min(kBlock, bytes - done));
    expect(now > 0, "write");
    done += static_cast<std::size_t>(now);
  }
  expect(fsync(fd) == 0, "sync");
  close(fd);
}

void read_plainly(const std::string& file) {
  static std::vector<char> block(kBlock);
  const int fd = open(file.c_str(), O_RDONLY | O_CLOEXEC);
  expect(fd >= 0, "open");
  while (const ssize_t now = read(fd, block.data(), block.size())) expect(now > 0, "read");
  close(fd);
}

void write_frames(const std::string& file, const Scene& scene, State& state, int frames) {
  Recorder recorder(file, scene, {}, true);
  for (int i = 0; i < frames; ++i) {
    state.step = i;
    recorder.record(state);
  }
  recorder.finish({});
}

void read_frames(const std::string& file) {
  const Recording recording(file);
  throng::Frame frame;
  for (std::size_t i = 0; i < recording.frames(); ++i) recording.read(i, frame);
}

/// Discs on a lattice, each with numbers of its own.
Scene lattice(std::size_t n) {
  Scene scene;
  scene.materials = {{}};
  scene.shapes = {{}};
  scene.time = {0.01, 1.0, 1};
  for (std::size_t i = 0; i < n; ++i) {
    const auto x = static_cast<double>(i % 1000), y = static_cast<double>(i / 1000);
    scene.bodies.shape.push_back(0);
    scene.bodies.material.push_back(0);
    scene.bodies.kind.push_back(BodyKind::dynamic);
    scene.bodies.radius.push_back(0.4);
    scene.bodies.position.push_back({x, y});
    scene.bodies.angle.push_back(1.0 / (x + 1.0));
    scene.bodies.velocity.push_back({y / 7.0, x / 3.0});
    scene.bodies.spin.push_back(0.0);
  }
  return scene;
}

std::vector<Row> rows_of(const std::string& name, const std::vector<Contestant>& contestants, double work,
                         double bytes) {
  std::vector<Row> rows;
  for (const Contestant& c : contestants) {
    nlohmann::ordered_json error = nlohmann::ordered_json::object();
    if (bytes > 0.0) error["GB_per_s"] = 1e-6 * bytes / median(c.ms);
    rows.push_back({"recording", name, c.engine, 1, c.ms, work, "", error});
  }
  return rows;
}

std::vector<Row> bench_run(const std::string& name, const Options& options, const std::string& file) {
  const int steps = options.quick ? 20 : 1200;  // as many as the scenario has
  Scene scene = settled(gallery_scene(options.scenarios, "pile"), options.quick ? 0.5 : 5.0);
  scene.record.velocity = false;
  scene.sleep = false;  // a step of sleepers costs less than to copy them
  int files = 0;        // a file of its own for each: to replace one takes as long as to remove it
  std::vector<Contestant> contestants = {{"unrecorded", [&] { run(scene, steps, nullptr); }},
                                         {"recorded", [&] {
                                            Recorder recorder(file + std::to_string(files++), scene, {});
                                            run(scene, steps, &recorder);
                                          }}};
  interleave(contestants, options.blocks, steps);
  return rows_of(name, contestants, steps, 0.0);
}

/// Frames of position, angle and velocity; the plain engines move as many bytes as the file has.
std::vector<Row> bench_frames(const std::string& name, const Options& options, const std::string& file,
                              bool reading) {
  const int frames = options.quick ? 2 : 10;
  const Scene scene = lattice(options.quick ? 10'000 : 1'000'000);
  State state = initial_state(scene);
  write_frames(file, scene, state, frames);
  const std::size_t bytes = std::filesystem::file_size(file);
  std::vector<Contestant> contestants;
  if (reading)
    contestants = {{"plain", [&] { read_plainly(file); }}, {"throng", [&] { read_frames(file); }}};
  else
    contestants = {{"plain", [&] { write_plainly(file + ".plain", bytes); }},
                   {"throng", [&] { write_frames(file, scene, state, frames); }}};
  interleave(contestants, options.blocks, frames);
  return rows_of(name, contestants, frames, static_cast<double>(bytes) / frames);
}

void write_states(const std::string& file, const Scene& scene, const std::vector<State>& states) {
  Recorder recorder(file, scene, {}, true);
  for (const State& state : states) recorder.record(state);
  recorder.finish({});
}

/// m, of any coordinate in any frame.
double farthest_off(const std::string& file, const std::vector<State>& states) {
  const Recording recording(file);
  throng::Frame frame;
  double most = 0.0;
  for (std::size_t i = 0; i < states.size(); ++i) {
    recording.read(i, frame);
    for (std::size_t row = 0; row < frame.position.size(); ++row)
      most = std::max(most, (frame.position[row] - states[i].position[row]).cwiseAbs().maxCoeff());
  }
  return most;
}

/// Positions of a crowd as float32 and quantized: bytes a body and frame, MB/s of float32, error (m).
std::vector<Row> bench_quantized(const std::string& name, const Options& options, const std::string& file) {
  const std::size_t people = options.quick ? 1000 : 20'000, frames = options.quick ? 200 : 250;
  Scene scene = crowd_scene(people);
  const std::vector<State> states = crowd_motion(scene, frames);
  Record& record = scene.record;
  record.angle = record.velocity = false, record.single = true;
  Scene quantized = scene;
  quantized.record.quantum = 1e-3;
  const std::string files[] = {file + ".single", file + ".quantized"};
  std::vector<Contestant> contestants = {{"float32", [&] { write_states(files[0], scene, states); }},
                                         {"quantized", [&] { write_states(files[1], quantized, states); }},
                                         {"read quantized", [&] { read_frames(files[1]); }}};
  interleave(contestants, options.blocks, static_cast<int>(frames));
  std::vector<Row> rows =
      rows_of(name, contestants, static_cast<double>(frames), 8.0 * static_cast<double>(people));
  for (std::size_t i = 0; i < 2; ++i) {
    rows[i].error["bytes_a_body"] =
        static_cast<double>(std::filesystem::file_size(files[i])) / static_cast<double>(people * frames);
    rows[i].error["farthest_off"] = farthest_off(files[i], states);
  }
  return rows;
}

constexpr std::size_t kSeeks = 50;

void write_again(const std::string& file, const Scene& scene, const std::vector<State>& states,
                 std::size_t frames) {
  Recorder recorder(file, scene, {}, true);
  for (std::size_t i = 0; i < frames; ++i) {
    State state = states[i % states.size()];
    state.step = static_cast<std::int64_t>(i);
    recorder.record(state);
  }
  recorder.finish({});
}

/// Frames in an order in which none follows its neighbour, each read on its own and held against its hash.
void seek(const Recording& recording) {
  throng::Frame frame;
  for (std::size_t k = 0; k < kSeeks; ++k) recording.read((k + 1) * 7919 % recording.frames(), frame);
}

std::vector<Row> bench_seek(const std::string& name, const Options& options, const std::string& file) {
  const std::size_t bodies = options.quick ? 1000 : 50'000, frames = options.quick ? 20 : 400;
  Scene scene = crowd_scene(bodies);
  scene.record.velocity = false;
  Scene quantized = scene;
  quantized.record.quantum = 1e-3;
  const std::vector<State> states = crowd_motion(scene, options.quick ? 20 : 40);
  write_again(file, scene, states, frames);
  write_again(file + ".quantized", quantized, states, frames);
  const Recording plain(file), packed(file + ".quantized");
  std::vector<Contestant> contestants = {{"throng", [&] { seek(plain); }},
                                         {"quantized", [&] { seek(packed); }}};
  interleave(contestants, options.blocks, static_cast<double>(kSeeks));
  return rows_of(name, contestants, static_cast<double>(kSeeks), 0.0);
}

/// The same in a file of ten gigabytes.
std::vector<Row> bench_large_seek(const std::string& name, const Options& options, const std::string& file) {
  constexpr std::size_t kBodies = 50'000, kFrames = 8'300;
  Scene scene = crowd_scene(kBodies);
  scene.record.velocity = false;
  write_again(file, scene, crowd_motion(scene, 40), kFrames);
  const Recording recording(file);
  std::vector<Contestant> contestants = {{"throng", [&] { seek(recording); }}};
  interleave(contestants, options.blocks, static_cast<double>(kSeeks));
  std::vector<Row> rows = rows_of(name, contestants, static_cast<double>(kSeeks), 0.0);
  rows[0].error["GB"] = 1e-9 * recording.bytes();
  return rows;
}

}  // namespace

std::vector<Row> bench_recording(const Options& options) {
  const ScratchFolder folder;
  const std::string size = options.quick ? "n=10000" : "n=1000000", file = folder.path + "/a.h5";
  std::vector<Row> rows;
  const auto add = [&](const std::string& name, auto bench) {
    if (!chosen(name, options)) return;
    for (Row& row : bench(name)) rows.push_back(std::move(row));
    options.show(rows);
  };
  add("pile n=10000 every step, position and angle",
      [&](const std::string& name) { return bench_run(name, options, file); });
  add("write " + size, [&](const std::string& name) { return bench_frames(name, options, file, false); });
  add(options.quick ? "crowd n=1000 quantize=0.001" : "crowd n=20000 quantize=0.001",
      [&](const std::string& name) { return bench_quantized(name, options, file); });
  add(options.quick ? "seek n=1000" : "seek n=50000",
      [&](const std::string& name) { return bench_seek(name, options, file); });
  if (options.large)
    add("seek n=50000 frames=8300",
        [&](const std::string& name) { return bench_large_seek(name, options, file); });
  add("read " + size, [&](const std::string& name) { return bench_frames(name, options, file, true); });
  return rows;
}

}  // namespace throng::bench
