// SPDX-License-Identifier: MIT
// X1, X2, X4: files that lie. Each must be refused with a reason, or hold exactly what was written.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <map>
#include <random>
#include <thread>

#include "sim/input_error.h"
#include "sim/recording/recording.h"
#include "tests/durability/durable_run.h"
#include "tests/sim/recording/crowd.h"
#include "tests/sim/recording/scenes.h"

namespace throng {
namespace {

using namespace testing_recordings;
using testing::HasSubstr;

constexpr int kFrames = 8;
constexpr std::size_t kBodies = 10;

std::string bytes_of(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

void write(const std::string& path, const std::string& bytes) {
  std::ofstream(path, std::ios::binary) << bytes;
}

/// Everything that the reader tells of a file, as text.
struct Told {
  std::string scene;
  std::vector<std::string> frames;
};

std::string text(const Frame& frame) {
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

Told everything(const std::string& path) {
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

std::string refusal(const std::string& path) {
  try {
    everything(path);
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

/// What `work` takes in a process of its own.
struct Cost {
  double memory, seconds;  // bytes that were resident at most, s of the processor's time
};

Cost cost_of(const std::function<void()>& work) {
  const pid_t child = fork();
  if (child == 0) {
    work();
    _exit(0);
  }
  int status = 0;
  rusage usage = {};
  EXPECT_EQ(wait4(child, &status, 0, &usage), child);
  EXPECT_TRUE(WIFEXITED(status)) << "a signal";
  return {1024.0 * static_cast<double>(usage.ru_maxrss),
          static_cast<double>(usage.ru_utime.tv_sec + usage.ru_stime.tv_sec) +
              1e-6 * static_cast<double>(usage.ru_utime.tv_usec + usage.ru_stime.tv_usec)};
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

  /// `crafted`: what crafted.py is asked to make; each fault has its reason.
  void expect_refused(const std::string& crafted, const std::map<std::string, std::string>& reasons) const {
    const std::string script = "/usr/bin/python3 " THRONG_SOURCE_DIR "/tests/durability/crafted.py ";
    ASSERT_EQ(std::system((script + crafted).c_str()), 0);
    for (const auto& [fault, reason] : reasons) {
      const std::string file = folder / (fault + ".h5");
      EXPECT_THAT(refusal(file), HasSubstr(reason)) << fault;
      const Cost cost = cost_of([&] { refusal(file); });
      EXPECT_LT(cost.memory, kSanitized ? 1e9 : 200e6) << fault;
      EXPECT_LT(cost.seconds, 1.0) << fault;
    }
  }

  void expect_mutations_seen(const Sample& sample, int files) {
    constexpr unsigned seed = 20240611;
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937_64 random(seed);
    int refusals = 0;
    for (int i = 0; i < files && !HasFailure(); ++i) {
      std::string bytes = sample.bytes;
      const std::size_t reach = i % 2 == 0 ? std::min<std::size_t>(4096, bytes.size()) : bytes.size();
      for (std::uint64_t changes = 1 + random() % 4; changes > 0; --changes)
        bytes[random() % reach] ^= static_cast<char>(1 + random() % 255);
      const auto begin = std::chrono::steady_clock::now();
      refusals += refused(bytes, sample);
      EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(10))
          << "file " << i << " hangs";
    }
    EXPECT_GT(refusals, files * 3 / 10);  // the sample hits what matters,
    EXPECT_LT(refusals, files);           // and what does not
  }

  Folder folder;
  Sample good;
};

const int kMutations = cases(10'000 / 7 + 1, 300);

TEST_F(Hostile, X1MutatedFilesAreRefusedOrUnharmed) {
  expect_mutations_seen(good, kMutations);
}

TEST_F(Hostile, X1MutatedFilesOfSinglePrecisionAreRefusedOrUnharmed) {
  expect_mutations_seen(single(), kMutations);
}

TEST_F(Hostile, X1MutatedFilesOfPackedPositionsAreRefusedOrUnharmed) {
  expect_mutations_seen(full(false), kMutations);
}

TEST_F(Hostile, X1MutatedFilesOfRegionsAreRefusedOrUnharmed) {
  expect_mutations_seen(full(true), kMutations);
}

TEST_F(Hostile, X1MutatedFilesOfPackedRegionsAreRefusedOrUnharmed) {
  Record record = full_record(true);
  record.quantum = 1e-3;
  expect_mutations_seen(full(record), kMutations);
}

TEST_F(Hostile, X1MutatedFilesOfCrowdsAreRefusedOrUnharmed) {
  expect_mutations_seen(crowd(), kMutations);
}

TEST_F(Hostile, X2TruncatedFilesOfEveryKindAreRefused) {
  for (const int kind : {0, 1, 2}) {
    const Sample sample = kind == 2 ? crowd() : full(kind == 1);
    for (std::size_t size = 0; size < sample.bytes.size() && !HasFailure(); size += 512)
      EXPECT_TRUE(refused(sample.bytes.substr(0, size), sample)) << "truncated to " << size;
  }
}

/// HDF5 looks a hundred times at a checksum that is wrong in a file that is open for writing, and doubles its
/// pause each time: a killed run's damaged file once took for ever to be refused.
TEST_F(Hostile, X1MutatedFilesOfKilledRunsAreRefusedOrTellFewerFrames) {
  expect_mutations_seen(unfinished(), kMutations);
}

TEST_F(Hostile, X2TruncatedFilesAreRefused) {
  for (std::size_t size = 0; size < good.bytes.size() && !HasFailure(); size += 512)
    EXPECT_TRUE(refused(good.bytes.substr(0, size), good)) << "truncated to " << size;
}

TEST_F(Hostile, X2TruncatedFilesOfKilledRunsAreRefusedOrTellFewerFrames) {
  const Sample sample = unfinished();
  int refusals = 0;
  for (std::size_t size = 0; size < sample.bytes.size() && !HasFailure(); size += 512)
    refusals += refused(sample.bytes.substr(0, size), sample);
  EXPECT_GT(refusals, 3);
}

/// The mark of completeness is written before the file is closed: where the disk failed in between, it may
/// stand there in part. The frames are still those of a run that did not end.
TEST_F(Hostile, AMarkInAFileThatWasNeverClosedIsNoEnd) {
  const std::string mark =
      "/usr/bin/python3 -c \"import h5py, os; f = h5py.File('" + (folder / "good.h5") +
      "', 'r+', libver='latest'); f.swmr_mode = True; d = f['throng/finished']; d[()] = 5; "
      "d.flush(); os._exit(0)\"";
  ASSERT_EQ(std::system(mark.c_str()), 0);
  const Recording recording(folder / "good.h5");
  EXPECT_FALSE(recording.complete());
  ASSERT_EQ(recording.frames(), static_cast<std::size_t>(kFrames));
  EXPECT_EQ(text(recording.frame(kFrames - 1)), good.told.frames.back());
}

TEST_F(Hostile, RowsOfFramesAreCoveredThoughTheyCarryNoChecksum) {
  const Recording recording(folder / "good.h5");
  const std::string& before = good.bytes;
  for (const std::uint64_t hash : recording.state_hashes()) {
    const std::size_t at = before.find(std::string_view(reinterpret_cast<const char*>(&hash), 8));
    ASSERT_NE(at, std::string::npos);
    std::string bytes = before;
    bytes[at + 3] ^= 16;
    EXPECT_TRUE(refused(bytes, good));
  }
}

TEST_F(Hostile, SensedAndMeasuredAreCoveredThoughTheyCarryNoChecksum) {
  const Sample sample = crowd();
  const Recording recording(folder / "crowd.h5");
  std::vector<std::uint32_t> whom;
  std::vector<double> densities;
  for (std::size_t i = 0; i < recording.frames(); ++i) {
    const Frame frame = recording.frame(i);
    const Sensed sensed = frame.sensed.at(0).value_or(Sensed{});
    whom.insert(whom.end(), sensed.whom.begin(), sensed.whom.end());
    if (frame.observables) densities.push_back(frame.observables->crowd->measures.at(6));
  }
  ASSERT_GT(whom.size(), 8u);
  const auto expect_covered = [&](const auto& rows) {
    const std::string_view column(reinterpret_cast<const char*>(rows.data()), rows.size() * sizeof rows[0]);
    const std::size_t at = sample.bytes.find(column);
    ASSERT_NE(at, std::string::npos);
    for (std::size_t k = 0; k < column.size(); k += 7) {
      std::string bytes = sample.bytes;
      bytes[at + k] ^= 1;
      EXPECT_TRUE(refused(bytes, sample)) << k;
    }
  };
  expect_covered(whom);
  densities.erase(densities.begin());  // nobody knows the first one's bits: it is no number
  expect_covered(densities);
}

TEST_F(Hostile, X4CraftedFilesAreRefusedWithTheirReason) {
  const std::map<std::string, std::string> reasons{
      {"external_storage", "another file"},
      {"external_link", "link to elsewhere"},
      {"soft_link", "link to elsewhere"},
      {"virtual_dataset", "unknown way"},
      {"huge_dimensions", "more than the file can hold"},
      {"bomb", "more than the file can hold"},
      {"wrong_type", "wrong type"},
      {"wrong_rank", "wrong rank"},
      {"wrong_size", "wrong size"},
      {"not_finite", "not finite"},
      {"not_finite_position", "frame 3"},
      {"altered_position", "does not match its hash"},
      {"altered_state_hash", "does not match its hash"},
      {"altered_scenario", "scenario does not match"},
      {"time_going_back", "wrong at frame 3"},
      {"time_off_the_steps", "wrong at frame 3"},
      {"frame_missing", "does not match its hash"},
      {"value_missing", "too few frames"},
      {"index_beyond", "beyond its table"},
      {"kind_unknown", "unknown kind"},
      {"offset_beyond", "does not fit"},
      {"wall_without_points", "fewer than two points"},
      {"wall_of_one_point", "fewer than two points"},
      {"part_without_vertices", "no vertices"},
      {"disc_with_parts", "a disc has parts"},
      {"polygon_without_parts", "another shape has none"},
      {"cycle", "is missing"},
      {"deflated", "filter"},
      {"foreign_filter", "filter"},
      {"scale_offset", "filter"},
      {"variable_text", "wrong type"},
      {"no_utf8", "UTF-8"},
      {"dataset_for_a_group", "walls"},
      {"group_missing", "frames is missing"},
      {"equal_measures", "no name of its own"},
      {"many_measures", "too many measures"},
      {"observables_again_and_again", "observables claim more than the file can hold"},
      {"newer", "written by a newer throng"},
      {"foreign", "not throng's"}};
  expect_refused((folder / "good.h5 ") + folder.path.string(), reasons);
}

TEST_F(Hostile, X4CraftedCrowdsAreRefusedWithTheirReason) {
  record_simulation(folder / "crowd.h5", measured_crowd());
  EXPECT_EQ(refusal(folder / "crowd.h5"), "accepted");
  expect_refused((folder / "crowd.h5 ") + folder.path.string() + " crowd",
                 {{"area_of_unknown_use", "unknown use"},
                  {"area_of_two_points", "fewer than three points"},
                  {"area_beyond_its_rings", "area_offset does not fit"},
                  {"area_nowhere", "not finite"},
                  {"fewer_uses_than_areas", "use has the wrong size"},
                  {"areas_elsewhere", "link to elsewhere"},
                  {"areas_of_a_bomb", "more than the file can hold"},
                  {"queue_of_one_point", "fewer than two points"},
                  {"queue_without_spacing", "spacing is out of range"},
                  {"floor_of_two_points", "fewer than three points"},
                  {"measure_of_nothing", "line has the wrong size"},
                  {"measure_without_columns", "is missing"},
                  {"column_of_few_rows", "too few"},
                  {"column_too_large", "more than the file can hold"},
                  {"column_elsewhere", "link to elsewhere"},
                  {"altered_density", "does not match its hash"},
                  {"sensor_without_a_rate", "out of range"},
                  {"sensor_of_no_width", "out of range"},
                  {"sensor_without_end", "are missing"},
                  {"sensor_running_backwards", "runs backwards"},
                  {"altered_sensed", "does not match its hash"},
                  {"altered_count", "frame 0"},
                  {"contacts_too_many", "contacts are missing"},
                  {"presence_of_another", "id is not in order"}});
}

TEST_F(Hostile, OtherPeoplesHdf5IsNotThrongs) {
  const std::string write_other =
      "/usr/bin/python3 -c \"import h5py; h5py.File('" + (folder / "o.h5") + "', 'w')['x'] = 1\"";
  ASSERT_EQ(std::system(write_other.c_str()), 0);
  EXPECT_THAT(refusal(folder / "o.h5"), HasSubstr("is HDF5 but not throng's"));
}

}  // namespace
}  // namespace throng
