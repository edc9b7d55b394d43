// SPDX-License-Identifier: MIT
// throng info and throng replay, as their users run them.
#include <cairo.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "tests/tools/picture.h"

namespace throng {
namespace {

using testing::AllOf;
using testing::HasSubstr;

constexpr const char* kThreeDiscs = R"(throng = 1
name = "three </script><b>&"
gravity = [0.0, -9.81]
time = { dt = 0.01, until = 0.2, substeps = 2 }
domain = { box = [[0, 0], [4, 3]] }
[materials.default]
density = 1.0
[shapes]
ball = { disc = { radius = 0.3 } }
[[bodies]]
shape = "ball"
place = { lattice = { origin = [0.7, 0.4], spacing = [1.0, 1.0], size = [3, 1] } }
velocity = [1.0, 0.5]
)";

#ifdef THRONG_HAS_PAGE
const std::vector<std::string> kPictures{"--png", "--html"};
#else
const std::vector<std::string> kPictures{"--png"};
#endif

struct Answer {
  std::string text;
  int code;
};

struct Replay : testing::Test {
  Replay() {
    std::string pattern = std::filesystem::temp_directory_path() / "throng-test-XXXXXX";
    folder = mkdtemp(pattern.data());
    std::ofstream(folder / "three.toml") << kThreeDiscs;
    const Answer made = throng("run three.toml -o a.h5 --progress none");
    EXPECT_EQ(made.code, 0) << made.text;
  }
  ~Replay() override { std::filesystem::remove_all(folder); }

  Answer shell(const std::string& command) const {
    FILE* pipe = popen(("cd " + folder.string() + " && " + command + " 2>&1").c_str(), "r");
    Answer answer;
    for (int c; (c = std::fgetc(pipe)) != EOF;) answer.text += static_cast<char>(c);
    answer.code = WEXITSTATUS(pclose(pipe));
    return answer;
  }
  Answer throng(const std::string& arguments) const { return shell(THRONG_PROGRAM " " + arguments); }

  /// Edits the recording with h5py and makes its own hashes fit: a forgery that only running it again can
  /// find.
  void alter(const std::string& python) const {
    const Answer answer =
        shell("/usr/bin/python3 -c \"import h5py; f = h5py.File('a.h5', 'r+'); " + python + "\"");
    ASSERT_EQ(answer.code, 0) << answer.text;
  }

  /// Puts the scenario of one recording into another one, with its hash.
  void give_scenario(const std::string& from, const std::string& to) const {
    const Answer answer = shell(
        "/usr/bin/python3 -c \"import h5py; a = h5py.File('" + from + "'); b = h5py.File('" + to +
        "', 'r+'); b['parameters'].attrs.modify('resolved_hash', a['parameters'].attrs['resolved_hash']);"
        "b.__delitem__('parameters/resolved'); a.copy('parameters/resolved', b['parameters'])\"");
    ASSERT_EQ(answer.code, 0) << answer.text;
  }

  std::string content(const std::string& name) const {
    std::ifstream file(folder / name);
    return {std::istreambuf_iterator<char>(file), {}};
  }

  std::filesystem::path folder;
};

TEST_F(Replay, InfoTellsWhatTheFileHolds) {
  const Answer answer = throng("info a.h5");
  EXPECT_EQ(answer.code, 0);
  EXPECT_THAT(answer.text, HasSubstr("status        complete"));
  EXPECT_THAT(answer.text, HasSubstr("frames        21, of each step\n"));
  EXPECT_THAT(answer.text, HasSubstr("every         1 step, of what has no rate of its own below\n"));
  EXPECT_THAT(answer.text, HasSubstr("bodies        3"));
  EXPECT_THAT(answer.text, HasSubstr("last_time     0.2"));
  EXPECT_THAT(answer.text,
              HasSubstr("fields        position each step, in 21 frames; angle each step, in 21 frames; "
                        "velocity each step, in 21 frames\n"));
  EXPECT_THAT(answer.text, HasSubstr("domain        box 0 0 4 3\n"));
  EXPECT_THAT(answer.text, HasSubstr("bodies_of_run 3, that the scenario makes\n"));
  EXPECT_THAT(answer.text, HasSubstr("substeps      2 a step\n"));
  EXPECT_THAT(answer.text, HasSubstr("quantum       none\n"));
  EXPECT_THAT(throng("info a.h5 --json").text, HasSubstr("\"command_line\": \"throng run three.toml"));
}

/// "every 4, frames 91" puzzled who had asked for 301 steps.
TEST_F(Replay, InfoTellsOfWhichStepsThereAreFrames) {
  const auto frames = [&](const std::string& record) {
    const Answer made =
        throng("run three.toml -o b.h5 --force --progress none --set 'record=" + record + "'");
    EXPECT_EQ(made.code, 0) << made.text;
    const std::string text = throng("info b.h5").text;
    const std::size_t at = text.find("frames        ") + 14;
    return text.substr(at, text.find('\n', at) - at);
  };
  EXPECT_EQ(frames("{ every = 4, observables = 10 }"), "7, of each step that is a multiple of 4 or 10");
  EXPECT_EQ(frames("{ every = 6, fields = [\"position\"], also = [{ every = 4, fields = [\"spin\"] }, "
                   "{ every = 12, fields = [\"velocity\"] }], observables = 9 }"),
            "9, of each step that is a multiple of 4, 6 or 9");
  EXPECT_EQ(frames("{ every = 5 }"), "5, of each step that is a multiple of 5");
}

TEST_F(Replay, VerifiesWhatTheSameProgramWrote) {
  const Answer answer = throng("replay a.h5 --verify");
  EXPECT_EQ(answer.code, 0);
  EXPECT_EQ(answer.text, "verified: 21 frames\n");
}

TEST_F(Replay, SaysInPlainWordsThatAFileIsCutShort) {
  const auto size = std::filesystem::file_size(folder / "a.h5");
  std::filesystem::resize_file(folder / "a.h5", 1000);
  EXPECT_EQ(throng("info a.h5").text,
            "throng: a.h5 is damaged: it cannot be opened: it is cut short: 1000 of " + std::to_string(size) +
                " bytes are there\n");
}

TEST_F(Replay, IsOfRecordingsThatAreCalledSo) {
  for (const std::string ending : {"csv", "png", "toml"}) {
    const Answer answer = throng("run three.toml -o b." + ending);
    EXPECT_EQ(answer.code, 2);
    EXPECT_THAT(answer.text, HasSubstr("cannot write b." + ending + ": a recording is HDF5, as OUT.h5"));
    EXPECT_FALSE(std::filesystem::exists(folder / ("b." + ending + ".part")));
  }
}

TEST_F(Replay, VerifiesOtherFieldsAndRates) {
  ASSERT_EQ(throng("run three.toml -o b.h5 --progress none --every 7 --set 'record.fields=[\"angle\"]'").code,
            0);
  EXPECT_EQ(throng("replay b.h5 --verify").text, "verified: 3 frames\n");
}

TEST_F(Replay, CallsADamagedFileUnusable) {
  alter("f['particles/trajectory/position/value'][4, 1, 0] += 1e-9");
  const Answer answer = throng("replay a.h5 --verify");
  EXPECT_EQ(answer.code, 2);
  EXPECT_THAT(answer.text, HasSubstr("frame 4: it does not match its hash"));
}

/// It happened: masses and edges that other programs could not read were called verified.
TEST_F(Replay, VerifiesTheTablesThatOtherProgramsRead) {
  const std::string kept = content("a.h5");
  for (const char* table : {"throng/bodies/mass", "particles/trajectory/box/edges", "throng/bodies/radius"}) {
    alter("f['" + std::string(table) + "'][0] *= 1.5");
    const Answer other = throng("replay a.h5 --verify");
    EXPECT_EQ(other.code, 2) << table;
    EXPECT_THAT(other.text, HasSubstr("is not that of the scenario"));
    std::ofstream(folder / "a.h5", std::ios::binary) << kept;
    alter("at = f['" + std::string(table) +
          "'].id.get_chunk_info(0).byte_offset; f.close(); f = open('a.h5', 'r+b'); f.seek(at + 6);"
          "byte = f.read(1)[0]; f.seek(at + 6); f.write(bytes([byte ^ 16]))");
    const Answer broken = throng("replay a.h5 --verify");
    EXPECT_EQ(broken.code, 2) << table;
    EXPECT_THAT(broken.text, HasSubstr("a.h5 is damaged: " + std::string(table) + ": cannot read"));
    std::ofstream(folder / "a.h5", std::ios::binary) << kept;
  }
  EXPECT_EQ(throng("replay a.h5 --verify").text, "verified: 21 frames\n");
}

constexpr const char* kHouse = R"(throng = 1
name = "house"
description = "with a court"
time = { dt = 0.01, until = 0.05 }
[shapes]
ball = { disc = { radius = 0.3 } }
court = { polygon = [[0, 0], [4, 0], [4, 4], [0, 4]], holes = [[[1, 1], [3, 1], [3, 3], [1, 3]]] }
robot = { discs = [[0, 0, 0.3], [0.4, 0, 0.2]] }
[[bodies]]
shape = "court"
at = [2, 2]
kind = "static"
[[bodies]]
shape = "robot"
at = [2, 2]
[[walls]]
polyline = [[0, -1], [4, -1], [4, 3]]
)";

/// Checksums are right: somebody wrote these numbers.
TEST_F(Replay, VerifiesOutlinesWallsAndWhatTheFileSaysOfItsRun) {
  std::ofstream(folder / "house.toml") << kHouse;
  ASSERT_EQ(throng("run house.toml -o a.h5 --force --progress none --substeps 4").code, 0);
  EXPECT_EQ(throng("replay a.h5 --verify").text, "verified: 6 frames\n");
  const std::string kept = content("a.h5");
  const auto expect_noticed = [&](const std::string& forgery, const std::string& what) {
    alter(forgery);
    const Answer answer = throng("replay a.h5 --verify");
    EXPECT_EQ(answer.code, 2) << forgery;
    EXPECT_EQ(answer.text, "throng: a.h5 is " + what + "\n") << forgery;
    std::ofstream(folder / "a.h5", std::ios::binary) << kept;
  };
  const std::pair<const char*, const char*> tables[] = {{"throng/shapes/outline", "outline of a shape"},
                                                        {"throng/shapes/rings", "outline of a shape"},
                                                        {"throng/shapes/vertices", "part of a shape"},
                                                        {"throng/shapes/part_radius", "part of a shape"},
                                                        {"throng/shapes/centre", "shape"},
                                                        {"throng/shapes/area", "shape"},
                                                        {"throng/shapes/gyration2", "shape"},
                                                        {"throng/shapes/radius", "shape"},
                                                        {"throng/walls/points", "wall"},
                                                        {"throng/walls/closed", "wall"},
                                                        {"throng/materials/density", "material"}};
  for (const auto& [table, what] : tables)
    expect_noticed("d = f['" + std::string(table) + "']; v = d[()]; v.flat[0] += 1; d[...] = v",
                   std::string("damaged: ") + what + " is not that of the scenario");
  expect_noticed("d = f['throng/walls/points']; d[1, 1] *= 1 + 2.0**-52",
                 "damaged: wall is not that of the scenario");
  expect_noticed("d = f['throng/shapes/name']; v = d[()]; v[1] = b'cowrt'; d[...] = v",
                 "damaged: shape is not that of the scenario");
  for (const char* attribute : {"name", "description"})
    expect_noticed(
        "f['throng'].attrs['" + std::string(attribute) + "'] = __import__('numpy').bytes_('other')",
        std::string("damaged: ") + attribute + " is not that of the scenario");
  expect_noticed("f['parameters'].attrs.modify('seed', 5)", "damaged: seed is not that of the scenario");
  expect_noticed("f['parameters'].attrs.modify('until', 0.06)", "damaged: end is not that of the scenario");
  expect_noticed("f['parameters'].attrs['engine'] = __import__('numpy').bytes_('box2d')",
                 "damaged: engine is not that of the scenario");
  expect_noticed("f['parameters'].attrs.modify('substeps', 5)",
                 "damaged: number of substeps is not that of the scenario");
}

/// Recordings of crowds say 4 that were made when 4 stood for "not given"; nothing depends on it.
TEST_F(Replay, VerifiesNoSubstepsWhereTheyDoNothing) {
  ASSERT_EQ(throng("run " THRONG_SOURCE_DIR "/scenarios/circle_swap.toml -o a.h5 --force --progress none "
                   "--until 0.5")
                .code,
            0);
  EXPECT_THAT(throng("info a.h5").text, HasSubstr(" a step, which do nothing here\n"));
  alter("f['parameters'].attrs.modify('substeps', 99)");
  EXPECT_THAT(throng("replay a.h5 --verify").text, testing::StartsWith("verified: "));
}

/// It happened: where the name had the word in it, the scenario was taken to say how many.
TEST_F(Replay, VerifiesWithTheSubstepsOfTheRunWhereTheScenarioSaysNone) {
  std::string text = kThreeDiscs;
  text.erase(text.find(", substeps = 2"), 14);
  std::ofstream(folder / "few.toml") << text.replace(text.find("three"), 5, "few substeps");
  ASSERT_EQ(throng("run few.toml -o b.h5 --progress none").code, 0);
  ASSERT_EQ(throng("run few.toml -o a.h5 --force --progress none --substeps 2").code, 0);
  give_scenario("b.h5", "a.h5");  // as earlier versions chose fewer
  EXPECT_THAT(throng("replay a.h5 --verify").text, testing::StartsWith("verified: "));
}

/// It happened: info called it native.
TEST_F(Replay, RefusesAnEngineThatNobodyKnows) {
  alter("f['parameters'].attrs['engine'] = __import__('numpy').bytes_('havok')");
  const Answer answer = throng("info a.h5");
  EXPECT_EQ(answer.code, 2);
  EXPECT_EQ(answer.text, "throng: a.h5 is damaged: engine is unknown\n");
}

TEST_F(Replay, NamesTheFirstStepAndBodyThatDiverge) {
  const Answer other = throng("run three.toml -o other.h5 --progress none --set gravity=[0.0,-9.8]");
  ASSERT_EQ(other.code, 0) << other.text;
  give_scenario("a.h5", "other.h5");
  const Answer answer = throng("replay other.h5 --verify");
  EXPECT_EQ(answer.code, 1);
  EXPECT_THAT(answer.text, HasSubstr("diverged: at step 1 "));
  EXPECT_THAT(answer.text, HasSubstr("position y of body 1 was recorded as"));
}

/// Angles of discs in the air don't know of gravity: here only the state's hash can tell.
TEST_F(Replay, ComparesHashesOfItsOwnKindOnly) {
  const std::string run = "run three.toml --progress none --until 0.1 --set 'record.fields=[\"angle\"]' ";
  ASSERT_EQ(throng(run + "--force -o a.h5").code, 0);
  ASSERT_EQ(throng(run + "-o b.h5 --set gravity=[0.0,-9.8]").code, 0);
  give_scenario("b.h5", "a.h5");
  const Answer now = throng("replay a.h5 --verify");
  EXPECT_EQ(now.code, 1);
  EXPECT_THAT(now.text, HasSubstr("in a field that the file does not hold"));
  alter("f['throng'].attrs.modify('version', [1, 0])");
  const Answer older = throng("replay a.h5 --verify");
  EXPECT_EQ(older.code, 0);
  EXPECT_THAT(older.text,
              AllOf(HasSubstr("state hashes of an older kind: the recorded fields alone are compared"),
                    HasSubstr("verified: 11 frames\n")));
}

/// It happened: a step of 9e15 in a crafted file ran for ever.
TEST_F(Replay, RefusesFramesBeyondTheEndOfTheirScenario) {
  ASSERT_EQ(throng("run three.toml -o b.h5 --progress none --until 0.1").code, 0);
  give_scenario("b.h5", "a.h5");
  const Answer answer = throng("replay a.h5 --verify");
  EXPECT_EQ(answer.code, 2);
  EXPECT_THAT(answer.text, HasSubstr("its scenario ends with step 10, its frames with step 20"));
}

TEST_F(Replay, RefusesAScenarioWithOtherSteps) {
  ASSERT_EQ(throng("run three.toml -o b.h5 --progress none --dt 0.005").code, 0);
  give_scenario("b.h5", "a.h5");
  const Answer answer = throng("replay a.h5 --verify");
  EXPECT_EQ(answer.code, 2);
  EXPECT_THAT(answer.text, HasSubstr("other steps"));
}

TEST_F(Replay, RefusesTimesOutsideTheRecording) {
  for (const std::string at : {"1e9", "0.21", "-0.01", "inf"}) {
    const Answer answer = throng("replay a.h5 --png a.png --at=" + at);
    EXPECT_EQ(answer.code, 2) << at;
    EXPECT_THAT(answer.text, HasSubstr("is outside the recording")) << at;
    EXPECT_FALSE(std::filesystem::exists(folder / "a.png")) << at;
  }
  for (const std::string at : {"0", "0.2", "0.1234"})
    EXPECT_EQ(throng("replay a.h5 --png a.png --at=" + at).code, 0) << at;
}

/// It happened: rounding made a picture of 720 x 1922.
TEST_F(Replay, DrawsNothingHigherThanItIsWideAtMost) {
  std::ofstream(folder / "high.toml") << "throng = 1\ntime = { dt = 0.01, until = 0.01 }\n"
                                         "domain = { periodic = [[0, 0], [1, 25]] }\n"
                                         "[shapes]\nball = { disc = { radius = 0.1 } }\n"
                                         "[[bodies]]\nshape = \"ball\"\nat = [0.5, 1]\n"
                                         "[[bodies]]\nshape = \"ball\"\nat = [0.5, 24]\n";
  ASSERT_EQ(throng("run high.toml -o high.h5 --progress none").code, 0);
  const Answer answer = throng("replay high.h5 --png high.png --width 1920");
  ASSERT_EQ(answer.code, 0) << answer.text;
  cairo_surface_t* picture = cairo_image_surface_create_from_png((folder / "high.png").c_str());
  EXPECT_EQ(cairo_image_surface_get_height(picture), 1920);
  cairo_surface_destroy(picture);
}

TEST_F(Replay, RefusesOptionsThatWouldDoNothing) {
  for (const std::string options : {"--at 0.1", "--width 300", "--threads 2", "--width 300 --html a.html",
                                    "--verify --at 0.1", "--png a.png --threads 2"}) {
    const Answer answer = throng("replay a.h5 " + options);
    EXPECT_EQ(answer.code, 2) << options;
    EXPECT_THAT(answer.text, HasSubstr("give both")) << options;
  }
  EXPECT_EQ(throng("replay a.h5 --verify --threads 2").code, 0);
}

/// It happened: a picture that could not be written took an empty folder of that name away.
TEST_F(Replay, LeavesWhatStoodThereWhereItCannotWrite) {
  std::filesystem::create_directory(folder / "empty");
  for (const std::string& option : kPictures) {
    const Answer answer = throng("replay a.h5 " + option + " empty");
    EXPECT_EQ(answer.code, 2);
    EXPECT_THAT(answer.text, HasSubstr("cannot write empty: it is a folder"));
    EXPECT_TRUE(std::filesystem::is_directory(folder / "empty"));
    const Answer full =
        shell("echo precious >old; trap '' XFSZ; ulimit -f 2; " THRONG_PROGRAM " replay a.h5 " + option +
              " old >/dev/null");
    EXPECT_EQ(full.code, 2) << full.text;
    EXPECT_EQ(content("old"), "precious\n") << option;
  }
  std::size_t entries = 0;  // nothing half-written stays
  for ([[maybe_unused]] const auto& entry : std::filesystem::directory_iterator(folder)) ++entries;
  EXPECT_EQ(entries, 4u);
}

TEST_F(Replay, NeverDrawsOverItsRecording) {
  shell("ln -s a.h5 link");
  for (const char* option : {"--png a.h5", "--html ./a.h5", "--png link"}) {
    const Answer answer = throng(std::string("replay a.h5 ") + option);
    EXPECT_EQ(answer.code, 2) << option;
    EXPECT_THAT(answer.text, HasSubstr("it is the recording")) << option;
  }
  EXPECT_THAT(throng("replay a.h5 --png z --html ./z").text, HasSubstr("name the same file"));
  EXPECT_EQ(throng("replay a.h5 --verify").code, 0);
}

TEST_F(Replay, RefusesNamesThatSayWhatIsNotWritten) {
  shell("mkdir folder folder.png");
  const auto text = [&](const std::string& options) {
    const Answer answer = throng("replay a.h5 " + options);
    EXPECT_EQ(answer.code, 2) << options;
    return answer.text;
  };
  EXPECT_EQ(text("--png a.jpg"), "throng: cannot write a.jpg: what is written ends in .png\n");
  EXPECT_EQ(text("--html a.png"), "throng: cannot write a.png: what is written ends in .html\n");
  EXPECT_EQ(text("--png folder.png"), "throng: cannot write folder.png: it is a folder\n");
  EXPECT_EQ(text("--html folder"), "throng: cannot write folder: it is a folder\n");
  EXPECT_THAT(text("--video folder"), HasSubstr("cannot write folder: "));
  EXPECT_EQ(throng("replay a.h5 --png picture --width 300").code, 0);
  EXPECT_EQ(throng("replay a.h5 --png /dev/null --width 300").code, 0);
}

TEST_F(Replay, ReplacesAnOlderPicture) {
  std::ofstream(folder / "a.png") << "old";
  EXPECT_EQ(throng("replay a.h5 --png a.png --width 300").code, 0);
  EXPECT_THAT(content("a.png"), testing::StartsWith("\x89PNG"));
}

TEST_F(Replay, DrawsThePictureOfTheFrameThatIsAskedFor) {
  const auto picture = [&](const std::string& options) {
    const Answer answer = throng("replay a.h5 --png a.png " + options);
    EXPECT_EQ(answer.code, 0) << answer.text;
    return content("a.png");
  };
  const std::string middle = picture("--at 0.1 --width 400"), last = picture("--width 400");
  EXPECT_THAT(middle, testing::StartsWith("\x89PNG"));
  EXPECT_GT(middle.size(), 3000u);
  EXPECT_EQ(middle.substr(16, 4), std::string("\0\0\x01\x90", 4));  // 400 pixels wide
  EXPECT_NE(middle, last);
  EXPECT_EQ(picture("--at 0.2 --width 400"), last);
  EXPECT_EQ(picture("--at 0.104 --width 400"), middle);
  EXPECT_EQ(picture("").substr(16, 4), std::string("\0\0\x06\x40", 4));  // 1600
}

/// A frame of 4 m by 4 m that stands, of 0.5 m where its hole is there, and a ball that flies about in it.
std::string framed(const std::string& holes) {
  return R"(throng = 1
time = { dt = 0.01, until = 0.5 }
[shapes]
frame = { polygon = [[-2, -2], [2, -2], [2, 2], [-2, 2]], holes = )" +
         holes + R"( }
ball = { disc = { radius = 0.1 } }
[materials.rubber]
restitution = 1.0
[[bodies]]
shape = "frame"
at = [0, 0]
kind = "static"
[[bodies]]
shape = "ball"
material = "rubber"
at = [0.5, 0.3]
velocity = [9, 7]
)";
}

constexpr const char* kHole = "[[[-1.5, -1.5], [1.5, -1.5], [1.5, 1.5], [-1.5, 1.5]]]";

/// The share of a picture that has the colour of bodies that stand.
double grey_share(const std::filesystem::path& file) {
  const Picture picture(file);
  int grey = 0;
  for (int y = 0; y < picture.height(); ++y)
    for (int x = 0; x < picture.width(); ++x) grey += picture.at(x, y) == std::array{158, 161, 166};
  return static_cast<double>(grey) / (picture.width() * picture.height());
}

/// The legend tells frames without velocities from recordings without any.
TEST_F(Replay, SaysWhyAPictureShowsNoSpeeds) {
  const std::string run = "run three.toml --progress none --set 'record.fields=[\"position\",\"angle\"]' ";
  ASSERT_EQ(throng(run + "-o none.h5").code, 0);
  ASSERT_EQ(throng(run + "--set 'record.also=[{ every = 7, fields = [\"velocity\"] }]' -o some.h5").code, 0);
  for (const std::string name : {"none", "some"})
    ASSERT_EQ(throng("replay " + name + ".h5 --png " + name + ".png --at 0.05").code, 0);
  EXPECT_NE(content("none.png"), content("some.png"));
}

constexpr const char* kFloor = R"TOML(throng = 1
name = "floor"
time = { dt = 0.05, until = 0.1 }
walkable = "POLYGON ((0 0, 10 0, 10 5, 0 5, 0 0))"
[areas]
start = [[1, 1], [2, 1], [2, 4], [1, 4]]
exit = "POLYGON ((8 1, 10 1, 10 4, 8 4, 8 1), (8.5 2, 9.5 2, 9.5 3, 8.5 3, 8.5 2))"
bench = [[4, 3], [6, 3], [6, 5], [4, 5]]
[queues]
till = { line = [[6, 1], [4, 1]], service = 1 }
[[measure]]
name = "door"
line = [[7, 0.5], [7, 2.5]]
[[agents]]
at = [3, 2.5]
model = "constant_velocity"
goal = [{ queue = "till" }, { wait = "bench", for = 1 }, "exit"]
)TOML";

/// Areas are tinted by what agents do there, but for their holes, queues are lines, and so is what is
/// measured, with an arrow to its right.
TEST_F(Replay, ShowsTheFloorOfACrowd) {
  std::ofstream(folder / "floor.toml") << kFloor;
  ASSERT_EQ(throng("run floor.toml -o floor.h5 --progress none").code, 0);
  ASSERT_EQ(throng("replay floor.h5 --png floor.png --width 1000").code, 0);
  const Picture picture(folder / "floor.png");
  const double left = 12.5 + 20, scale = (picture.width() - 2 * left) / 10;  // about: margins of 2 %
  const double bottom = picture.height() - 57.5 - 0.02 * 10 * scale;
  const auto at = [&](double x, double y) {
    return picture.at(static_cast<int>(left + x * scale), static_cast<int>(bottom - y * scale));
  };
  const auto tint = [](int red, int green, int blue) { return std::array{red, green, blue}; };
  EXPECT_EQ(at(7, 3), tint(255, 255, 255));
  EXPECT_EQ(at(9, 2.5), tint(255, 255, 255)) << "a hole";
  EXPECT_EQ(at(1.5, 2.5), tint(235, 244, 249));
  EXPECT_EQ(at(9, 3.5), tint(243, 229, 216));
  EXPECT_EQ(at(5.5, 3.5), tint(215, 233, 229));
  int line = 0;
  for (double x = 4; x < 6; x += 0.01) {
    const auto near = [&](double y) { return at(x, y)[0] < 150; };
    line += near(0.97) || near(0.98) || near(0.99) || near(1.0) || near(1.01) || near(1.02) || near(1.03);
  }
  EXPECT_TRUE(line > 60 && line < 190) << line << ": dashed";
  const auto arrow = [&](double pixels) {
    bool seen = false;
    for (double y = -3.0; y <= 3.0; ++y) seen |= at(7.0 + pixels / scale, 1.5 + y / scale)[1] < 160;
    return seen;
  };
  EXPECT_TRUE(arrow(5) && arrow(9));
  EXPECT_FALSE(arrow(-5) || arrow(-9) || arrow(25));
}

TEST_F(Replay, ShowsThroughTheHolesOfPolygons) {
  for (const std::string holes : {kHole, "[]"}) {
    std::ofstream(folder / "frame.toml") << framed(holes);
    EXPECT_EQ(throng("run frame.toml -o frame.h5 --force --progress none --set contact.model=none").code, 0);
    EXPECT_EQ(throng("replay frame.h5 --png " + std::string(holes == kHole ? "hole.png" : "full.png")).code,
              0);
  }
  const double hole = grey_share(folder / "hole.png"), full = grey_share(folder / "full.png");
  EXPECT_GT(full, 0.2);
  EXPECT_NEAR(hole / full, (16.0 - 9.0) / 16.0, 0.03);
}

/// Where the line on the one coloured disc between goal and legend points: right, up, left, down, or nowhere.
std::string line_on_disc(const std::filesystem::path& file) {
  const Picture picture(file);
  int left = picture.width(), right = 0, top = picture.height(), bottom = 0;
  for (int y = picture.height() / 4; y < 17 * picture.height() / 20; ++y)
    for (int x = 0; x < picture.width(); ++x) {
      const auto [least, most] = std::ranges::minmax(picture.at(x, y));
      if (most - least < 40) continue;
      left = std::min(left, x), right = std::max(right, x), top = std::min(top, y),
      bottom = std::max(bottom, y);
    }
  const int x = (left + right) / 2, y = (top + bottom) / 2, half = (right - left) / 4;
  const std::array spokes{picture.at(x + half, y), picture.at(x, y - half), picture.at(x - half, y),
                          picture.at(x, y + half)};
  const char* const names[] = {"right", "up", "left", "down"};
  for (std::size_t i = 0; i < 4; ++i)
    if (spokes[i] != spokes[(i + 1) % 4] && spokes[i] != spokes[(i + 2) % 4]) return names[i];
  return "nowhere";
}

// A line to the right once said that all of them look there.
TEST_F(Replay, ShowsWhereAgentsWalkAndNothingOfThoseWhoStand) {
  std::ofstream(folder / "walker.toml") << R"toml(throng = 1
name = "walker"
time = { dt = 0.02, until = 2 }
walkable = "POLYGON ((0 0, 3 0, 3 8, 0 8, 0 0))"
[areas]
end = "POLYGON ((0 7, 3 7, 3 8, 0 8, 0 7))"
[[agents]]
at = [1.5, 3.5]
radius = 0.3
model = "constant_velocity"
desired_speed = 1
goal = "end"
)toml";
  ASSERT_EQ(throng("run walker.toml -o walker.h5 --progress none").code, 0);
  for (const std::string time : {"0", "1"})
    EXPECT_EQ(throng("replay walker.h5 --png at" + time + ".png --at " + time).code, 0);
  EXPECT_EQ(line_on_disc(folder / "at0.png"), "nowhere");
  EXPECT_EQ(line_on_disc(folder / "at1.png"), "up");
}

// It can't get out, and loses no speed: every step is told again.
TEST_F(Replay, VerifiesARunInAHole) {
  std::ofstream(folder / "frame.toml") << framed(kHole);
  const Answer run = throng("run frame.toml -o frame.h5 --progress none");
  EXPECT_EQ(run.code, 0);
  EXPECT_THAT(run.text, testing::Not(HasSubstr("warning")));
  EXPECT_THAT(run.text, HasSubstr("\"max_overlap\": 0"));
  EXPECT_EQ(throng("replay frame.h5 --verify").text, "verified: 51 frames\n");
  EXPECT_EQ(throng("resume frame.h5 --until 1.5 --progress none").code, 0);
  EXPECT_EQ(throng("replay frame.h5 --verify").text, "verified: 151 frames\n");
  ASSERT_EQ(shell("/usr/bin/python3 -c \"import h5py; x = h5py.File('frame.h5')['particles/trajectory/"
                  "position/value'][:, 1]; assert abs(x).max() < 1.401 and (x.max(0) > 1.3).all()\"")
                .text,
            "");
}

TEST_F(Replay, RefusesAPictureThatCannotBeWritten) {
  const Answer answer = throng("replay a.h5 --png no/such/a.png");
  EXPECT_EQ(answer.code, 2);
  EXPECT_THAT(answer.text, HasSubstr("cannot write no/such/a.png"));
}

#ifdef THRONG_HAS_PAGE

/// The text between two others.
std::string between(const std::string& text, const std::string& before, const std::string& after) {
  const std::size_t from = text.find(before) + before.size();
  return text.substr(from, text.find(after, from) - from);
}

/// Observables carry no checksums: their frames' hashes tell.
TEST_F(Replay, WritesNoPageOfADamagedRecording) {
  ASSERT_EQ(
      throng("run three.toml -o a.h5 --force --progress none --every 4 --set record.observables=10").code, 0);
  EXPECT_EQ(throng("replay a.h5 --html whole.html").code, 0);
  alter("f['observables/kinetic_energy/value'][1] *= 2");
  const Answer answer = throng("replay a.h5 --html a.html");
  EXPECT_EQ(answer.code, 2);
  EXPECT_THAT(answer.text, HasSubstr("frame 3: it does not match its hash"));
  EXPECT_FALSE(std::filesystem::exists(folder / "a.html"));
}

TEST_F(Replay, WritesAPageThatHoldsTheRecordingByteForByte) {
  std::filesystem::rename(folder / "a.h5", folder / "a<script>.h5");
  const Answer answer = throng("replay 'a<script>.h5' --html a.html");
  EXPECT_EQ(answer.code, 0) << answer.text;
  const std::string page = content("a.html");
  EXPECT_THAT(page, testing::StartsWith("<!doctype html>"));
  EXPECT_THAT(page, testing::EndsWith("</html>\n"));
  EXPECT_EQ(throng("replay 'a<script>.h5' --html /dev/stdout | cat").text, page);
  EXPECT_EQ(between(page, "id=\"given\">", "</script>"), R"({"embedded":true,"name":"a\u003cscript>.h5"})");
  std::ofstream(folder / "a.base64") << between(page, "id=\"recording\">", "</script>");
  EXPECT_EQ(shell("base64 -d a.base64 | cmp - 'a<script>.h5'").text, "");
  EXPECT_THAT(between(page, "Content-Security-Policy\" content=\"", "\""), HasSubstr("default-src 'none'"));
}

#else

TEST_F(Replay, SaysThatItWasBuiltWithoutItsPage) {
  const Answer answer = throng("replay a.h5 --html a.html");
  EXPECT_EQ(answer.code, 2);
  EXPECT_THAT(answer.text, HasSubstr("built without its replay page: install nodejs and npm"));
  EXPECT_FALSE(std::filesystem::exists(folder / "a.html"));
}

#endif

TEST_F(Replay, ListsTheFramesWithoutOptions) {
  const Answer answer = throng("replay a.h5");
  EXPECT_EQ(answer.code, 0);
  EXPECT_EQ(std::count(answer.text.begin(), answer.text.end(), '\n'),
            22);  // a heading, twenty of the frames and how many there are
  EXPECT_THAT(answer.text, testing::ContainsRegex("\n +0 +0 +0 +1\\.118 +[0-9a-f]{16}\n"));
  EXPECT_THAT(answer.text,
              testing::ContainsRegex("\n +20 +20 +0\\.2 +[0-9.]+ +[0-9a-f]{16}\n20 of 21 frames; "));
}

TEST_F(Replay, SaysWhatIsWrongWithAFileThatIsNoRecording) {
  const Answer answer = throng("replay three.toml");
  EXPECT_EQ(answer.code, 2);
  EXPECT_EQ(answer.text, "throng: three.toml is no HDF5 file\n");
}

}  // namespace
}  // namespace throng
