// SPDX-License-Identifier: MIT
// Files that lie: each must be refused with a reason, or hold exactly what was written.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <map>
#include <random>

#include "sim/input_error.h"
#include "sim/recording/recording.h"
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

/// Everything that the reader tells of a file, as text; a refusal as its message.
std::string everything(const std::string& path) {
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
  for (std::size_t i = 0; i < recording.frames(); ++i) {
    const Frame frame = recording.frame(i);
    all << frame.step << ' ' << frame.time << ' ' << frame.state_hash << ' ';
    for (const Vec& p : frame.position) all << p;
    for (const Vec& p : frame.velocity) all << p;
    for (double x : frame.angle) all << x << ' ';
    for (double x : frame.spin) all << x << ' ';
  }
  return all.str();
}

std::string refusal(const std::string& path) {
  try {
    everything(path);
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

struct Hostile : testing::Test {
  Hostile() {
    record_drift(folder / "good.h5", mixed_scene(kBodies), kFrames);
    good = bytes_of(folder / "good.h5");
    expected = everything(folder / "good.h5");
  }

  /// True where the file is refused; a file that is accepted must tell what the good one does.
  bool refused(const std::string& bytes) {
    write(folder / "bad.h5", bytes);
    try {
      EXPECT_EQ(everything(folder / "bad.h5"), expected);
      return false;
    } catch (const InputError&) {
      return true;
    }
  }

  Folder folder;
  std::string good, expected;
};

TEST_F(Hostile, MutatedFilesAreRefusedOrUnharmed) {
  constexpr unsigned seed = 20240611;
  constexpr int files = 600;
  SCOPED_TRACE("seed " + std::to_string(seed));
  std::mt19937_64 random(seed);
  int refusals = 0;
  for (int i = 0; i < files && !HasFailure(); ++i) {
    std::string bytes = good;
    const std::size_t reach = i % 2 == 0 ? std::min<std::size_t>(4096, bytes.size()) : bytes.size();
    for (std::uint64_t changes = 1 + random() % 4; changes > 0; --changes)
      bytes[random() % reach] ^= static_cast<char>(1 + random() % 255);
    refusals += refused(bytes);
  }
  EXPECT_GT(refusals, files * 3 / 10);  // the sample hits what matters,
  EXPECT_LT(refusals, files);           // and what does not
}

TEST_F(Hostile, TruncatedFilesAreRefused) {
  for (std::size_t size = 0; size < good.size() && !HasFailure(); size += 512)
    EXPECT_TRUE(refused(good.substr(0, size))) << "truncated to " << size;
}

TEST_F(Hostile, RowsOfFramesAreCoveredThoughTheyCarryNoChecksum) {
  const Recording recording(folder / "good.h5");
  for (const std::uint64_t hash : recording.state_hashes()) {
    const std::size_t at = good.find(std::string_view(reinterpret_cast<const char*>(&hash), 8));
    ASSERT_NE(at, std::string::npos);
    std::string bytes = good;
    bytes[at + 3] ^= 16;
    EXPECT_TRUE(refused(bytes));
  }
}

TEST_F(Hostile, CraftedFilesAreRefusedWithTheirReason) {
  const std::map<std::string, std::string> reasons{{"external_storage", "another file"},
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
                                                   {"newer", "written by a newer throng"},
                                                   {"foreign", "not throng's"}};
  const std::string script = THRONG_SOURCE_DIR "/tests/sim/recording/crafted.py ";
  ASSERT_EQ(
      std::system(("/usr/bin/python3 " + script + (folder / "good.h5 ") + folder.path.string()).c_str()), 0);
  for (const auto& [fault, reason] : reasons)
    EXPECT_THAT(refusal(folder / (fault + ".h5")), HasSubstr(reason)) << fault;
}

TEST_F(Hostile, OtherPeoplesHdf5IsNotThrongs) {
  const std::string write_other =
      "/usr/bin/python3 -c \"import h5py; h5py.File('" + (folder / "o.h5") + "', 'w')['x'] = 1\"";
  ASSERT_EQ(std::system(write_other.c_str()), 0);
  EXPECT_THAT(refusal(folder / "o.h5"), HasSubstr("is HDF5 but not throng's"));
}

}  // namespace
}  // namespace throng
