// SPDX-License-Identifier: MIT
// A recording that was changed: refused by InputError, or read as it was written. Where its checksums were
// made to fit the change, as those of an attacker would, no fault of the program.
#include "sim/recording/recording.h"

#include <cmath>
#include <cstring>
#include <fstream>
#include <iterator>
#include <optional>
#include <thread>

#include "sim/input_error.h"
#include "sim/observe.h"
#include "tests/fuzz/fuzz.h"
#include "tests/fuzz/h5_sums.h"
#include "tests/fuzz/memory_file.h"
#include "tests/sim/recording/crowd.h"
#include "tests/sim/recording/scenes.h"

namespace throng::fuzz {

namespace {

using Bytes = std::vector<std::uint8_t>;

constexpr int kFrames = 4;  // or more, of all that there may be

/// A file that throng wrote, what it holds, and where it is worth changing.
struct Sample {
  Bytes bytes;
  std::vector<ChecksummedBlock> blocks;
  std::vector<std::size_t> places;  ///< of all bytes in the blocks
  std::vector<Frame> frames;
};

Bytes bytes_of(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

Sample sample_of(const std::string& path) {
  Sample sample{bytes_of(path), {}, {}, {}};
  {
    const Recording recording(
        path);  // closed before the checksums are looked for: HDF5 has a file open in one way
    for (std::size_t i = 0; i < recording.frames(); ++i) sample.frames.push_back(recording.frame(i));
  }
  expect(sample.frames.size() >= kFrames, "the sample has frames");
  sample.blocks = checksummed_blocks(path, sample.bytes);
  expect(sample.blocks.size() > 120, "the sample shows its checksums");
  for (const ChecksummedBlock& block : sample.blocks)
    for (std::size_t i = 0; i < block.size; ++i) sample.places.push_back(block.begin + i);
  return sample;
}

Scene scene(bool single) {
  Scene scene = testing_recordings::mixed_scene(6);
  scene.record.single = single;
  return scene;
}

Sample finished(bool single) {
  const testing_recordings::Folder folder;
  testing_recordings::record_drift(folder / "a.h5", scene(single), kFrames);
  return sample_of(folder / "a.h5");
}

Sample full(const Record& record) {
  const testing_recordings::Folder folder;
  Scene all = testing_recordings::mixed_scene(6);
  all.record = record;
  testing_recordings::add_sensor(all, 3);
  testing_recordings::record_run(folder / "a.h5", all, 6);
  return sample_of(folder / "a.h5");
}

Record packed_region() {
  Record record = testing_recordings::full_record(true);
  record.quantum = 1e-3;
  return record;
}

/// Of agents, with measures.
Sample crowd(double quantum) {
  const testing_recordings::Folder folder;
  Scene scene = testing_recordings::measured_crowd();
  scene.record.quantum = quantum;
  testing_recordings::record_simulation(folder / "a.h5", scene);
  return sample_of(folder / "a.h5");
}

/// As a run leaves it that is killed.
Sample unfinished() {
  const testing_recordings::Folder folder;
  const Scene drift = scene(false);
  Recorder recorder(folder / "a.h5", drift, testing_recordings::provenance());
  for (int i = 0; i < kFrames; ++i) recorder.record(testing_recordings::state_at(drift, i));
  recorder.checkpoint(testing_recordings::state_at(drift, kFrames - 1));
  while (!std::filesystem::exists(folder / "a.h5.ckpt")) std::this_thread::yield();
  std::filesystem::copy(recorder.part(), folder / "killed.h5.part");
  return sample_of(folder / "killed.h5.part");
}

/// The last two have numbers of their own: what was kept before they came means the others.
const Sample& sample(int which) {
  using testing_recordings::full_record;
  static const Sample samples[] = {
      finished(false),         finished(true), unfinished(),          full(full_record(false)),
      full(full_record(true)), crowd(0.0),     full(packed_region()), crowd(1e-3)};
  return samples[which == 125 ? 6 : which == 126 ? 7 : which % 6];
}

/// Changes of four bytes each: where, as a place of the sample or as one of the file, and to what.
void change(const Sample& from, std::span<const std::uint8_t> changes, Bytes& bytes) {
  for (; changes.size() >= 4; changes = changes.subspan(4)) {
    const std::size_t where = changes[0] + 256 * changes[1] + 65536 * (changes[2] % 128);
    const bool anywhere = changes[2] >= 128;
    bytes[anywhere ? where % bytes.size() : from.places[where % from.places.size()]] = changes[3];
  }
}

/// Bit for bit: who is not in a region has NaN.
template <class T>
bool same(const std::vector<T>& a, const std::vector<T>& b) {
  return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0);
}

bool same(const Frame& a, const Frame& b) {
  return a.step == b.step && a.time == b.time && a.state_hash == b.state_hash &&
         same(a.position, b.position) && same(a.angle, b.angle) && same(a.velocity, b.velocity) &&
         same(a.spin, b.spin) && a.is_present == b.is_present && a.contacts == b.contacts &&
         a.sensed == b.sensed && a.observables == b.observables;
}

/// What commands do with the frames of any recording.
void look_at(const Scene& scene, const Frame& frame) {
  if (!frame.is_present.empty()) return;  // what is away has no place
  State state = initial_state(scene);
  if (!frame.position.empty()) state.position = frame.position;
  if (!frame.angle.empty()) state.angle = frame.angle;
  if (!frame.velocity.empty()) state.velocity = frame.velocity;
  expect(!std::isnan(overlap(scene, state).max) || !frame.position.empty(), "an overlap is a number");
  kinetic_energy(scene, state);
}

}  // namespace

}  // namespace throng::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace throng;
  if (size == 0) return 0;
  const fuzz::Sample& sample = fuzz::sample(data[0] / 2);
  const bool mended = data[0] % 2 != 0;
  fuzz::Bytes bytes = sample.bytes;
  fuzz::change(sample, {data + 1, size - 1}, bytes);
  if (mended) fuzz::mend(sample.blocks, bytes);
  try {
    const Recording recording(fuzz::memory_file(bytes));
    for (std::size_t i = 0; i < recording.frames(); ++i) {
      const Frame frame = recording.frame(i);
      fuzz::expect(mended || (i < sample.frames.size() && fuzz::same(frame, sample.frames[i])),
                   "what is read was written");
      fuzz::look_at(recording.geometry(), frame);
    }
  } catch (const InputError&) {
  }
  return 0;
}
