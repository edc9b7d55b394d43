// SPDX-License-Identifier: MIT
// H4: disks that are too small. Real ones where the machine lets a test mount: file systems in memory, in a
// name space of the run's own. And ones that are made up, which any machine has.
#include <gmock/gmock.h>

#include <filesystem>
#include <iostream>

#include "tests/durability/durable_run.h"

namespace throng {
namespace {

using ::testing::HasSubstr;

enum class Disk { mounted, made_up };

class SmallDisk : public DurableRun, public ::testing::WithParamInterface<Disk> {
 protected:
  SmallDisk() {
    std::filesystem::create_directories(disk);
    if (GetParam() == Disk::made_up || may_mount()) return;
    std::cout << "No test may mount a file system here: this one runs on a disk that is made up.\n";
    is_mounted = false;
  }

  /// A run that records to a disk of so many MB, of which what is on it at the end comes to `kept`.
  Result run_on(int megabytes, const std::string& arguments) {
    std::filesystem::create_directories(kept);
    const std::string run = "run " + arguments + " -o " + disk + "/a.h5 --progress none";
    const std::string keep = "code=$?\nfor file in " + disk + "/*; do [ -e \"$file\" ] && cp \"$file\" " +
                             kept + "\ndone\nexit $code\n";
    return is_mounted ? throng(run, kMounting + write("on_disk", mount(megabytes) + keep) + " ")
                      : throng(run, "sh " + write("on_disk", make_up(megabytes) + keep) + " ");
  }

  const std::string disk = path("disk"), kept = path("kept");

 private:
  static constexpr const char* kMounting = "unshare --map-root-user --mount sh ";

  std::string mount(int megabytes) const {
    return "mount -t tmpfs -o size=" + std::to_string(megabytes) + "m none " + disk + " || exit 70\n\"$@\"\n";
  }
  std::string make_up(int megabytes) const {
    return "ASAN_OPTIONS=verify_asan_link_order=0 LD_PRELOAD=" THRONG_SMALL_DISK " THRONG_DISK=" + disk +
           " THRONG_DISK_BYTES=" + std::to_string(megabytes * 1024 * 1024) + " \"$@\"\n";
  }
  bool may_mount() const {
    return std::system((kMounting + write("try", mount(1) + "exit 0\n") + " true 2>/dev/null").c_str()) == 0;
  }

  bool is_mounted = GetParam() == Disk::mounted;
};

TEST_P(SmallDisk, H4OneWithoutRoomForTheReserveIsRefusedAtOnce) {
  const Result result = run_on(3, write("a.toml", kHeap));
  EXPECT_EQ(result.exit_code, 2) << result.err;
  EXPECT_THAT(result.err, HasSubstr("disk has 3.15 MB left"));
  EXPECT_TRUE(std::filesystem::is_empty(kept));
}

/// How many bodies are in a region nobody knows before: the disk fills while the run goes on.
TEST_P(SmallDisk, H4OneThatFillsEndsTheRunWithWhatIsCommittedReadable) {
  const std::string scene = write("a.toml", std::string(kHeap) + "[record]\nwithin = [[-5, 0], [5, 9]]\n");
  const std::vector<std::uint64_t> whole = reference(scene, "--until 200");
  const Result result = run_on(28, scene + " --until 200");
  EXPECT_EQ(result.exit_code, 1) << result.err;
  EXPECT_THAT(result.err, HasSubstr("frames in it are readable"));
  const std::string part = kept + "/a.h5.part";
  ASSERT_TRUE(std::filesystem::exists(part)) << result.err;
  expect_beginning_of(whole, part);
  EXPECT_THAT(result.err, HasSubstr("; " + std::to_string(Recording(part).frames()) + " frames"));
  EXPECT_GT(Recording(part).frames(), 100u);
}

INSTANTIATE_TEST_SUITE_P(Any, SmallDisk, ::testing::Values(Disk::mounted, Disk::made_up),
                         [](const auto& one) {
                           return std::string(one.param == Disk::mounted ? "mounted" : "made_up");
                         });

}  // namespace
}  // namespace throng
