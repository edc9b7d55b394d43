// SPDX-License-Identifier: MIT
// A checkpoint as its reader gets it, with hashes that fit, as those of an attacker would: refused by
// InputError, or a state that a run can go on from. An input's first byte says of which run it is a
// checkpoint, or that what follows is all of a file; of a run's follow three bytes each: where in its first
// 64 KiB, and what is there instead. So inputs stay good when the layout changes.
#include <array>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>

#include "scenarios/load.h"
#include "sim/input_error.h"
#include "sim/recording/checkpoint.h"
#include "sim/recording/frame_hash.h"
#include "sim/simulation.h"
#include "tests/fuzz/fuzz.h"
#include "tests/fuzz/memory_file.h"
#include "tests/sim/recording/scenes.h"

namespace throng::fuzz {

namespace {

using Bytes = std::vector<std::uint8_t>;

// Where things stand in the header: see sim/recording/checkpoint.cpp.
constexpr std::size_t kHeader = 248, kCounts = 56, kContentHash = 232, kHash = 240;  // bytes

std::uint64_t number_at(const Bytes& bytes, std::size_t at) {
  std::uint64_t number;
  std::memcpy(&number, bytes.data() + at, sizeof number);
  return number;
}

void put(Bytes& bytes, std::size_t at, std::uint64_t number) {
  std::memcpy(bytes.data() + at, &number, sizeof number);
}

/// The hash of all behind the header, cut as its counts say; 0 where the file is too short for them.
std::uint64_t content_hash(const Bytes& bytes) {
  constexpr std::array<std::uint64_t, 5> body{4, 16, 8, 16, 8};
  constexpr std::array<std::uint64_t, 6> contact{8, 4, 8, 8, 8, 8};
  std::vector<std::uint64_t> sizes{number_at(bytes, kCounts)};
  for (const std::uint64_t one : body) sizes.push_back(one * number_at(bytes, kCounts + 8));
  for (const std::uint64_t one : {16, 8, 4, 4, 4, 8, 16, 16, 8})  // agents
    sizes.push_back(one * number_at(bytes, kCounts + 32));
  sizes.push_back(4 * number_at(bytes, kCounts + 40));  // groups
  sizes.push_back(sizeof(Measured) * number_at(bytes, kCounts + 48));
  sizes.push_back(sizeof(OnLine) * number_at(bytes, kCounts + 56));
  for (const std::uint64_t one : {8, 4}) sizes.push_back(one * number_at(bytes, kCounts + 96));  // arrivals
  sizes.push_back(sizeof(SensedSum) * number_at(bytes, kCounts + 64));
  for (const std::uint64_t one : {8, 4, 4})
    sizes.push_back(one * number_at(bytes, kCounts + 72));  // sleepers
  for (const std::size_t kind : {16, 24, 80, 88}) {
    for (const std::uint64_t one : contact) sizes.push_back(one * number_at(bytes, kCounts + kind));
    if (kind < 80) continue;
    for (const std::uint64_t one : {4, 4, 4, 16}) sizes.push_back(one * number_at(bytes, kCounts + kind));
  }
  std::uint64_t chain = recording::kEmptyChain;
  std::size_t at = kHeader;
  for (const std::uint64_t size : sizes) {
    if (size > bytes.size() - at) return 0;
    const auto part = std::as_bytes(std::span(bytes).subspan(at, size));
    chain = recording::chain_hash(std::array{recording::hash_bytes(part)}, chain);
    at += size;
  }
  return chain;
}

void mend(Bytes& bytes) {
  if (bytes.size() < kHeader) return;
  put(bytes, kContentHash, content_hash(bytes));
  put(bytes, kHash, recording::hash_bytes(std::as_bytes(std::span(bytes)).first(kHash)));
}

void expect_sound(const State& state) {
  const std::size_t n = state.id.size(), agents = state.crowd.stand.size();
  const std::uint64_t names = n + static_cast<std::uint64_t>(state.crowd.arrived) + waiting(state.crowd);
  expect(state.step >= 0, "the step is not before the start");
  expect(state.crowd.arrivals.size() == state.crowd.arrived_id.size(), "who arrived did at some step");
  for (const std::uint32_t id : state.crowd.arrived_id)
    expect(1 <= id && id <= names, "who arrived has a number");
  expect(state.crowd.arrived >= 0 && state.crowd.wall_corrections >= 0, "crowds count upwards");
  for_each_agent_array(
      state.crowd, [&](const auto& all) { expect(agents <= n && all.size() == agents, "a row an agent"); });
  expect(state.position.size() == n && state.angle.size() == n && state.velocity.size() == n &&
             state.spin.size() == n,
         "a row a body");
  for (std::size_t row = 0; row < n; ++row)
    expect(state.id[row] >= 1 && state.id[row] <= names && state.position[row].allFinite() &&
               state.velocity[row].allFinite() && std::isfinite(state.angle[row] + state.spin[row]),
           "bodies are numbered, their motion is finite");
}

/// Bodies, agents with all that is remembered of them, bodies that sleep, and soft ones.
const std::array<Scene, 4>& scenes() {
  static const std::array<Scene, 4> all{
      testing_recordings::mixed_scene(5),
      load_scenario_text(
          "throng = 1\ndomain.box = [[-50, -50], [50, 50]]\n"
          "areas.a = [[-50, -50], [-45, -50], [-45, 50], [-50, 50]]\n"
          "areas.b = [[45, -50], [50, -50], [50, 50], [45, 50]]\n"
          "queues.q = { line = [[0, 0], [9, 0]], service = 1 }\n"
          "[[agents]]\ncount = 3\nmodel = 'orca'\ngoal = ['b', { wait = 'b', for = 1 }, { queue = 'q' }, "
          "{ least_crowded = ['a', 'b'] }]\nplace.random.within = 'a'\n"
          "[[agents]]\ncount = 2\nmodel = 'social_force'\ngoal = 'a'\n"
          "place.random.within = 'b'\nappear.rate = 1\n"
          "[[agents]]\nmodel = 'constant_velocity'\ngoal = 'b'\nat = [44.5, 0]\n"
          "[[measure]]\nname = 'x'\nline = [[0, -50], [0, 50]]\n"
          "[[sensors]]\nname = 'y'\nradius = 30\nfov_degrees = 120\nsight = 'bodies'\n",
          "crowd.toml")
          .scene,
      load_scenario_text(
          "throng = 1\ntime.until = 6000\ngravity = [0, -9.81]\ndomain.box = [[0, 0], [9, 9]]\n"
          "materials.default.rolling_resistance = 0.1\nshapes.ball.disc.radius = 0.5\nshapes.box.polygon = "
          "[[0, 0], [1, 0], [1, 1], [0, 1]]\n"
          "[[bodies]]\nshape = 'box'\nat = [2, 0.5]\n[[bodies]]\nshape = 'ball'\nat = [2.99, 0.5]\n"
          "[[bodies]]\nshape = 'ball'\nat = [2.49, 1.37]\n[[bodies]]\nshape = 'ball'\nat = [6, 8]\n",
          "sleep.toml")
          .scene,
      load_scenario_text(
          "throng = 1\ntime.until = 6000\ngravity = [0, -9.81]\ndomain.box = [[0, 0], [9, 9]]\n"
          "contact = { model = 'spring', stiffness = 1e4 }\nmaterials.default.rolling_resistance = 0.1\n"
          "shapes.ball.disc.radius = 0.5\nshapes.bar.polygon = [[0, 0], [3, 0], [3, 0.2], [0, 0.2]]\n"
          "[[bodies]]\nshape = 'ball'\nat = [2, 0.5]\n[[bodies]]\nshape = 'ball'\nat = [2.99, 0.5]\n"
          "[[bodies]]\nshape = 'ball'\nat = [2.49, 1.37]\n"
          "[[bodies]]\nshape = 'bar'\nat = [6, 0.5]\nspin = 1\nkind = 'kinematic'\n"
          "[[walls]]\npolyline = [[0, 0.1], [4, 0], [9, 0.1]]\n",
          "soft.toml")
          .scene};
  return all;
}

/// A run of each, made once: the way to the agents' goals takes seconds to find where all is watched.
Simulation& run_of(const Scene& scene) {
  static const std::array<std::unique_ptr<Simulation>, 4> runs{
      simulation(scenes()[0]), simulation(scenes()[1]), simulation(scenes()[2]), simulation(scenes()[3])};
  return *runs[static_cast<std::size_t>(&scene - scenes().data())];
}

constexpr int kSteps = 400;  // by then an agent has arrived, and bodies sleep

/// What a run of the scene leaves at its start, or after so many steps, as far as it goes: the bodies of the
/// first lie in one another.
Bytes checkpoint_of(const Scene& scene, int steps) {
  const auto run = simulation(scene);
  try {
    while (steps-- > 0) run->step();
  } catch (const SimulationError&) {
  }
  const std::string path =
      (std::filesystem::temp_directory_path() / ("fuzz_" + std::to_string(getpid()) + ".ckpt")).string();
  recording::write_checkpoint(path, {}, run->state());
  std::ifstream in(path, std::ios::binary);
  Bytes bytes{std::istreambuf_iterator<char>(in), {}};
  std::filesystem::remove(path);
  return bytes;
}

/// Of each scene at its start, then of each after some steps: all of them are read.
const std::vector<Bytes>& checkpoints() {
  static const std::vector<Bytes> all = [] {
    std::vector<Bytes> made;
    for (const int steps : {0, kSteps})
      for (const Scene& scene : scenes()) made.push_back(checkpoint_of(scene, steps));
    bool arrived = false, asleep = false;
    for (Bytes& bytes : made) {
      const Bytes written = bytes;
      mend(bytes);
      expect(bytes == written, "the hashes of a checkpoint are where this looks for them");
      const State state = recording::read_checkpoint(memory_file(bytes)).state;
      expect_sound(state);
      arrived |= !state.crowd.arrivals.empty(), asleep |= throng::asleep(state.sleep) > 0;
    }
    expect(arrived && asleep, "there is something of everything");
    return made;
  }();
  return all;
}

/// What the input means.
Bytes file_of(const std::uint8_t* data, std::size_t size) {
  const std::size_t which = data[0] % (checkpoints().size() + 1);
  if (which == checkpoints().size()) return {data + 1, data + size};
  Bytes bytes = checkpoints()[which];
  for (std::size_t i = 1; i + 2 < size; i += 3)
    if (const std::size_t at = data[i] + 256u * data[i + 1]; at < bytes.size()) bytes[at] = data[i + 2];
  mend(bytes);
  return bytes;
}

/// Contacts of the file may be of bodies that do not touch, or do not exist.
void go_on(const State& state) {
  for (const Scene& scene : scenes()) {
    if (!fits(state, scene) || state.step > scene.time.steps()) continue;  // as `throng resume`
    Simulation& run = run_of(scene);
    try {
      if (!run.restore(state)) continue;
      run.step();
      run.step();
    } catch (const SimulationError&) {  // a body that runs away
    }
  }
}

}  // namespace

}  // namespace throng::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace throng;
  if (size == 0) return 0;
  const fuzz::Bytes bytes = fuzz::file_of(data, size);
  try {
    const State state = recording::read_checkpoint(fuzz::memory_file(bytes)).state;
    fuzz::expect_sound(state);
    fuzz::go_on(state);
  } catch (const InputError&) {
  }
  return 0;
}
