// SPDX-License-Identifier: MIT
#include "sim/recording/output_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "sim/input_error.h"
#include "tests/sim/recording/scenes.h"

namespace throng::recording {
namespace {

using namespace testing_recordings;
using testing::HasSubstr;

std::string output_refusal(const std::string& path, bool force = false) {
  try {
    OutputFile output(path, force);
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

std::size_t entries(const Folder& folder) {
  return static_cast<std::size_t>(std::distance(std::filesystem::directory_iterator(folder.path), {}));
}

/// The refusal of a question that makes nothing, which must be that of the attempt.
std::string foretold(const std::string& path, bool force = false) {
  try {
    expect_writable(path, force);
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(OutputFile, ForetellsItsRefusalsAndMakesNothing) {
  const Folder folder;
  EXPECT_EQ(foretold(folder / "new.h5"), "accepted");
  EXPECT_EQ(entries(folder), 0u);
  std::ofstream(folder / "a.h5") << "precious";
  std::ofstream(folder / "left.h5.part") << "frames";
  std::ofstream(folder / "empty.h5.part");
  std::filesystem::create_directory(folder / "folder.h5.part");
  std::filesystem::create_symlink(folder / "a.h5", folder / "link.h5");
  const OutputFile held(folder / "held.h5", false);
  const std::size_t refused[] = {7, 5};
  for (bool force : {false, true}) {
    std::size_t refusals = 0;
    for (const char* name :
         {"no/such/a.h5", "a.h5/a.h5", "a.h5", "left.h5", "folder.h5", "link.h5", "held.h5"}) {
      const std::size_t before = entries(folder);
      const std::string expected = foretold(folder / name, force);
      refusals += expected != "accepted";
      EXPECT_EQ(entries(folder), before) << name;
      EXPECT_EQ(output_refusal(folder / name, force) == "accepted", expected == "accepted") << name;
    }
    EXPECT_EQ(refusals, refused[force]);
  }
  EXPECT_EQ(foretold(folder / "empty.h5"), "accepted");
}

TEST(OutputFile, RefusesAFolderThatDoesNotExist) {
  const Folder folder;
  EXPECT_THAT(output_refusal(folder / "no/such/a.h5"), HasSubstr("no/such does not exist"));
}

TEST(OutputFile, RefusesAPlaceBelowAFile) {
  const Folder folder;
  std::ofstream(folder / "file") << "x";
  EXPECT_THAT(output_refusal(folder / "file/a.h5"), HasSubstr("is no folder"));
}

TEST(OutputFile, RefusesAFolderThatCannotBeWritten) {
  EXPECT_THAT(output_refusal("/proc/a.h5"), HasSubstr("cannot write /proc/a.h5"));
}

TEST(OutputFile, RefusesAFileThatExistsWithoutForce) {
  const Folder folder;
  std::ofstream(folder / "a.h5") << "precious";
  EXPECT_THAT(output_refusal(folder / "a.h5"), HasSubstr("--force"));
  EXPECT_EQ(content(folder / "a.h5"), "precious");
  EXPECT_EQ(entries(folder), 1u);
}

TEST(OutputFile, RefusesAFolderAsTarget) {
  const Folder folder;
  std::filesystem::create_directory(folder / "a.h5");
  EXPECT_THAT(output_refusal(folder / "a.h5", true), HasSubstr("no regular file"));
}

TEST(OutputFile, RefusesThePartOfARunThatDidNotEndWithoutForce) {
  const Folder folder;
  std::ofstream(folder / "a.h5.part") << "frames";
  EXPECT_THAT(output_refusal(folder / "a.h5"),
              testing::AllOf(HasSubstr("did not end"),
                             HasSubstr("'throng resume " + (folder / "a.h5") + "' goes on with it")));
  EXPECT_EQ(content(folder / "a.h5.part"), "frames");
  EXPECT_EQ(output_refusal(folder / "a.h5", true), "accepted");
}

TEST(OutputFile, NeverFollowsALinkOfThePartsName) {
  const Folder folder;
  std::ofstream(folder / "elsewhere") << "precious";
  std::filesystem::create_symlink("elsewhere", folder / "a.h5.part");
  EXPECT_THAT(output_refusal(folder / "a.h5", true), HasSubstr("cannot write"));
  EXPECT_EQ(content(folder / "elsewhere"), "precious");
}

TEST(OutputFile, RefusesTwoRunsOfTheSameNameAndLeavesTheFirstInPeace) {
  const Folder folder;
  OutputFile first(folder / "a.h5", false);
  EXPECT_TRUE(is_being_written(first.part()));
  EXPECT_THAT(output_refusal(folder / "a.h5", true), HasSubstr("another run"));
  EXPECT_TRUE(std::filesystem::exists(first.part()));
}

TEST(OutputFile, RefusesWhatTheDiskCannotHold) {
  const Folder folder;
  const OutputFile output(folder / "a.h5", false);
  EXPECT_NO_THROW(expect_room(output.path(), 1000));
  EXPECT_THROW(expect_room(output.path(), 1e18), InputError);
}

TEST(OutputFile, LeavesNothingWhereNothingWasKept) {
  const Folder folder;
  { OutputFile output(folder / "a.h5", false); }
  EXPECT_EQ(entries(folder), 0u);
}

TEST(OutputFile, PublishesUnderTheFinalNameAndWithForceInPlaceOfTheOld) {
  const Folder folder;
  for (bool force : {false, true}) {
    OutputFile output(folder / "a.h5", force);
    std::ofstream(output.part()) << (force ? "new" : "old");
    output.publish();
    EXPECT_EQ(content(folder / "a.h5"), force ? "new" : "old");
    EXPECT_EQ(entries(folder), 1u);
  }
}

TEST(OutputFile, NeverReplacesAFileThatCameMeanwhile) {
  const Folder folder;
  OutputFile output(folder / "a.h5", false);
  std::ofstream(folder / "a.h5") << "precious";
  EXPECT_THROW(output.publish(), std::runtime_error);
  EXPECT_EQ(content(folder / "a.h5"), "precious");
}

}  // namespace
}  // namespace throng::recording
