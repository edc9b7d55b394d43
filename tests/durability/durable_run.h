// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <ostream>
#include <span>
#include <string>
#include <vector>

#include "sim/recording/checkpoint.h"
#include "sim/recording/recording.h"
#include "tests/full_length.h"
#include "tests/tools/heap.h"
#include "tests/tools/program.h"

/// A run of the program whose recording is to survive what these tests do to it.
namespace throng {

/// Sanitizers take memory of their own.
#ifdef THRONG_SANITIZED
inline constexpr bool kSanitized = true;
#else
inline constexpr bool kSanitized = false;
#endif

/// How many cases to try: all at full length, else the usual number; a quarter of it under sanitizers, which
/// make a process five times as slow.
inline int cases(int full, int usual) {
  return full_length() ? full : kSanitized ? usual / 4 : usual;
}

/// What runs are asked to record: all fields in each frame, or all that there is, packed or of a region.
struct Recorded {
  const char* name;
  const char* record;         ///< of the scenario
  const char* scene = kHeap;  ///< the rest of it
  double dt = 0.01;           ///< s, of the scene

  std::string until(int steps) const { return " --until " + std::to_string(steps * dt) + " "; }
};
inline constexpr Recorded kRecorded[] = {{"whole", ""},
                                         {"packed", R"([record]
every = 2
fields = ["position", "angle", "contacts"]
also = [{ every = 3, fields = ["velocity"] }]
observables = 5
of = { shape = "ball" }
quantize = 1e-3
[[sensors]]
name = "near"
radius = 1.2
every = 4
record = true
)"},
                                         {"region", R"([record]
every = 2
fields = ["position", "angle", "contacts"]
also = [{ every = 3, fields = ["velocity"] }]
observables = 5
within = [[-5, 0], [0.5, 4]]
precision = "single"
[[sensors]]
name = "near"
radius = 1.2
every = 4
record = true
)"}};

/// Agents who appear, line up, wait and leave, with all that may be recorded of them.
inline constexpr Recorded kRecordedCrowd{"crowd", "", R"TOML(throng = 1
name = "crowd"
time = { dt = 0.02, until = 8.0 }
walkable = "POLYGON ((0 0, 10 0, 10 5, 0 5, 0 0), (4 2, 5 2, 5 3, 4 3, 4 2))"
record = { every = 2, fields = ["position", "contacts"], also = [{ every = 3, fields = ["velocity"] }], observables = 5 }
queues = { till = { line = [[7, 1], [4, 1]], service = 0.5 } }
[areas]
start = [[0, 0], [3, 0], [3, 5], [0, 5]]
bench = [[6, 3.5], [9, 3.5], [9, 5], [6, 5]]
exit = [[9.5, 2], [10, 2], [10, 3], [9.5, 3]]
[[agents]]
count = 25
place = { random = { within = "start" } }
model = "social_force"
goal = "exit"
[[agents]]
count = 20
appear = { rate = 5 }
place = { random = { within = "start" } }
model = "collision_free_speed"
goal = [{ queue = "till" }, { wait = "bench", for = 1 }, "exit"]
[[measure]]
name = "door"
line = [[9, 0], [9, 5]]
[[measure]]
name = "start"
area = "start"
voronoi = { cutoff = 1 }
[[sensors]]
name = "eyes"
radius = 2
fov_degrees = 170
sight = true
every = 4
record = true
)TOML",
                                         0.02};

inline void PrintTo(const Recorded& recorded, std::ostream* out) {
  *out << recorded.name;
}
inline std::string heap(const Recorded& recorded) {
  return std::string(recorded.scene) + recorded.record;
}

class DurableRun : public Program {
 protected:
  /// The hashes of the frames of the uninterrupted run, which is made as `name`.
  std::vector<std::uint64_t> reference(const std::string& scene, const std::string& options,
                                       const std::string& name = "whole.h5") {
    const Result result = throng("run " + scene + " --progress none -o " + path(name) + " " + options);
    EXPECT_EQ(result.exit_code, 0) << result.err;
    return hashes(Recording(path(name)));
  }

  static std::vector<std::uint64_t> hashes(const Recording& recording) {
    const std::span<const std::uint64_t> all = recording.frame_hashes();
    return {all.begin(), all.end()};
  }

  /// Every frame of the file can be read, matches its hash, and is that of the uninterrupted run.
  static void expect_beginning_of(const std::vector<std::uint64_t>& whole, const std::string& file) {
    const Recording recording(file);
    const std::vector<std::uint64_t> found = hashes(recording);
    ASSERT_LE(found.size(), whole.size());
    ASSERT_TRUE(std::equal(found.begin(), found.end(), whole.begin()));
    Frame frame;
    for (std::size_t i = 0; i < found.size(); ++i) ASSERT_NO_THROW(recording.read(i, frame)) << "frame " << i;
  }

  static void expect_whole(const std::vector<std::uint64_t>& whole, const std::string& file) {
    expect_beginning_of(whole, file);
    EXPECT_EQ(Recording(file).frames(), whole.size());
    EXPECT_TRUE(Recording(file).complete());
  }

  /// Frames that a reader is promised: those that the last whole checkpoint follows.
  static std::size_t promised(const std::string& file) {
    for (const std::string& name :
         {recording::checkpoint_path(file), recording::previous_checkpoint_path(file)})
      if (std::filesystem::exists(name)) return recording::read_checkpoint(name).origin.frames;
    return 0;
  }

  /// Looks at what a death left of a recording that had `before` frames. Returns how many can be read.
  static std::size_t expect_sound(const std::vector<std::uint64_t>& whole, const std::string& file,
                                  std::size_t before) {
    const std::size_t known = std::max(before, promised(file));
    const std::string& left = std::filesystem::exists(file) ? file : file + ".part";
    if (known == 0) return 0;  // it died before its first commit
    expect_beginning_of(whole, left);
    const std::size_t frames = Recording(left).frames();
    EXPECT_GE(frames, known) << "frames are lost";
    return frames;
  }
};

}  // namespace throng
