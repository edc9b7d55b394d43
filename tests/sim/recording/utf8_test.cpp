// SPDX-License-Identifier: MIT
#include "sim/recording/utf8.h"

#include <gtest/gtest.h>

#include <cstdlib>

#include "sim/recording/recording.h"
#include "tests/sim/recording/scenes.h"

namespace throng::recording {
namespace {

using namespace testing_recordings;
using namespace std::string_literals;

const std::string kUnknown = "\xEF\xBF\xBD";

TEST(Utf8, LeavesTextsAlone) {
  for (const char* text : {"", "a b", "caf\u00e9", "\u20ac", "\U0001F600"}) EXPECT_EQ(as_utf8(text), text);
}

TEST(Utf8, ReplacesEachByteThatBelongsToNoCharacter) {
  EXPECT_EQ(as_utf8("caf\xe9.toml"), "caf" + kUnknown + ".toml");
  EXPECT_EQ(as_utf8("a\xe2\x82"), "a" + kUnknown + kUnknown);  // cut short
  EXPECT_EQ(as_utf8("\xc0\xaf"), kUnknown + kUnknown);         // longer than need be
  EXPECT_EQ(as_utf8("\xed\xa0\x80"), kUnknown + kUnknown + kUnknown);
  EXPECT_EQ(as_utf8("a\0b"s), "a" + kUnknown + "b");
}

/// It happened: a run of a file whose name was Latin-1 made a recording that called itself damaged.
TEST(Utf8, ARecordingTakesCommandLinesAndUsersThatAreNone) {
  const Folder folder;
  const char* const user = std::getenv("USER");
  const std::string before = user ? user : "";
  setenv("USER", "Ren\xe9", 1);
  Provenance from = provenance();
  from.command_line = "throng run caf\xe9.toml";
  const Scene scene = mixed_scene(3);
  Recorder recorder(folder / "a.h5", scene, from);
  recorder.record(state_at(scene, 0));
  recorder.finish({});
  user ? setenv("USER", before.c_str(), 1) : unsetenv("USER");
  const Recording recording(folder / "a.h5");
  EXPECT_EQ(recording.origin().author, "Ren" + kUnknown);
  EXPECT_EQ(recording.origin().provenance.command_line, "throng run caf" + kUnknown + ".toml");
}

}  // namespace
}  // namespace throng::recording
