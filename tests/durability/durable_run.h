// SPDX-License-Identifier: MIT
#pragma once

#include <cstdlib>
#include <span>
#include <string>
#include <vector>

#include "sim/recording/recording.h"
#include "tests/tools/program.h"

/// A run of the program whose recording is to survive what these tests do to it.
namespace throng {

/// Tests at full length: THRONG_FULL=1.
inline bool full_length() {
  const char* full = std::getenv("THRONG_FULL");
  return full && std::string(full) == "1";
}

/// Sanitizers take memory of their own.
#if defined(__SANITIZE_ADDRESS__)
inline constexpr bool kSanitized = true;
#else
inline constexpr bool kSanitized = false;
#endif

/// Discs and bricks that fall on one another, with friction and bounces: contacts of both kinds.
inline const char* const kHeap = R"(throng = 1
name = "heap"
gravity = [0, -10]
time = { dt = 0.01, until = 2.0 }
domain = { box = [[-5, 0], [5, 9]] }
[materials]
default = { density = 1.0, friction = 0.5, restitution = 0.2 }
[shapes]
ball = { disc = { radius = 0.4 } }
brick = { polygon = [[0, 0], [1, 0], [1, 1], [0, 1]] }
[[bodies]]
shape = "ball"
place = { lattice = { origin = [-4, 1], spacing = [1.1, 1.1], size = [8, 3] } }
[[bodies]]
shape = "brick"
place = { lattice = { origin = [-4, 5], spacing = [1.2, 1.2], size = [7, 2] } }
)";

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
};

}  // namespace throng
