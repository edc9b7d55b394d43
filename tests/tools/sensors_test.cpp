// SPDX-License-Identifier: MIT
// Sensors, as users of the program meet them.
#include <gmock/gmock.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>

#include "sim/recording/recording.h"
#include "tests/tools/program.h"

namespace throng {
namespace {

using nlohmann::json;
using testing::AllOf;
using testing::HasSubstr;

const std::string kSensingCrowd = R"toml(throng = 1
time = { dt = 0.05, until = 6 }
walkable = "POLYGON ((0 0, 12 0, 12 6, 0 6, 0 0), (5 1, 5.5 1, 5.5 5, 5 5, 5 1))"
areas = { start = [[0, 0], [4, 0], [4, 6], [0, 6]], exit = [[11, 0], [12, 0], [12, 6], [11, 6]] }
record = { every = 10, fields = ["position", "velocity"] }
[[agents]]
count = 30
place = { random = { within = "start" } }
model = "collision_free_speed"
goal = "exit"
[[sensors]]
name = "eyes"
radius = 4
fov_degrees = 170
sight = true
every = 20
record = true
[[sensors]]
name = "ears"
radius = 2.5
of = { ids = [3, 4, 5, 29] }
every = 20
record = true
)toml";

const std::string kPile = R"(throng = 1
time = { dt = 0.01, until = 0.4 }
gravity = [0, -9.81]
domain = { box = [[0, 0], [6, 20]] }
[shapes]
ball = { disc = { radius = 0.2 } }
brick = { polygon = [[0, 0], [0.6, 0], [0.6, 0.3], [0, 0.3]] }
[[bodies]]
shape = "brick"
count = 40
angle = { uniform = [-3, 3] }
place = { random = { within = [[0, 0], [6, 6]] } }
[[bodies]]
shape = "ball"
count = 20
place = { random = { within = [[0, 6], [6, 9]] } }
[[walls]]
segment = [[3, 0], [3, 4]]
[[sensors]]
name = "ahead"
radius = 1.5
fov_degrees = 90
sight = "walls"
every = 20
record = true
)";

class Sensors : public Program {
 protected:
  void run(const std::string& scene, const std::string& file, const std::string& more = "") const {
    const Result result = throng("run " + write("s.toml", scene) + " -o " + path(file) + " " + more);
    ASSERT_EQ(result.exit_code, 0) << result.err;
  }

  /// Who finds whom, as `throng query` says of a recording at that time.
  std::map<std::uint32_t, std::vector<std::uint32_t>> queried(const std::string& file, double time,
                                                              const std::string& how) const {
    std::map<std::uint32_t, std::vector<std::uint32_t>> found;
    const Result result =
        throng("query " + path(file) + " --all --format json --at " + std::to_string(time) + " " + how);
    EXPECT_EQ(result.exit_code, 0) << result.err;
    for (const json& one : json::parse(result.out)) {
      std::vector<std::uint32_t>& whom = found[one["id"]];
      for (const json& other : one["neighbours"]) whom.push_back(other["id"]);
      std::ranges::sort(whom);
    }
    return found;
  }

  /// Holds what a sensor found in all frames against it. Those of `ids` who are there have it, all for none.
  /// Returns how many it found.
  std::size_t compare(const std::string& file, std::size_t sensor, const std::string& how,
                      const std::vector<std::uint32_t>& ids = {}) const {
    const Recording recording(path(file));
    std::size_t found = 0, looks = 0;
    for (std::size_t i = 0; i < recording.frames(); ++i) {
      const std::optional<Sensed> stored = recording.frame(i).sensed.at(sensor);
      EXPECT_EQ(recording.sensor_sample(sensor, i).has_value(), recording.steps()[i] % 20 == 0);
      if (!stored) continue;
      const Sensed& sensed = *stored;
      const auto expected = queried(file, recording.times()[i], how);
      std::vector<std::uint32_t> who;
      for (const auto& [id, whom] : expected)
        if (ids.empty() || std::ranges::find(ids, id) != ids.end()) who.push_back(id);
      EXPECT_EQ(sensed.who, who) << "frame " << i;
      std::size_t at = 0;
      for (std::size_t k = 0; k < sensed.who.size(); ++k) {
        const auto begin = sensed.whom.begin() + static_cast<std::ptrdiff_t>(at);
        EXPECT_EQ(std::vector(begin, begin + sensed.count[k]), expected.at(sensed.who[k]))
            << "frame " << i << ", id " << sensed.who[k];
        at += sensed.count[k];
      }
      found += at, ++looks;
    }
    EXPECT_GE(looks, 3u);
    return found;
  }

  /// What --verify says of a recording whose embedded scenario has a sensor that reaches farther than the
  /// recorded one did.
  Result grafted(const std::string& scene, bool radius_as_well = true) const {
    run(scene, "a.h5");
    std::string far = scene;
    far.replace(far.find("radius = 1.5"), 12, "radius = 1.6");
    run(far, "b.h5");
    const std::string graft =
        "python3 -c \"import h5py\na, b = h5py.File('" + path("a.h5") + "', 'r+'), h5py.File('" +
        path("b.h5") +
        "')\ndel a['parameters/resolved']\nb.copy('parameters/resolved', a['parameters'])\n"
        "a['parameters'].attrs.modify('resolved_hash', "
        "b['parameters'].attrs['resolved_hash'])\n" +
        (radius_as_well ? "a['throng/sensors/0'].attrs.modify('radius', 1.6)\"" : "\"");
    EXPECT_EQ(std::system(("/usr/bin/" + graft).c_str()), 0);
    return throng("replay --verify " + path("a.h5"));
  }
};

TEST_F(Sensors, FindWhomQueryFinds) {
  run(kSensingCrowd, "crowd.h5");
  EXPECT_GT(compare("crowd.h5", 0, "--radius 4 --fov 170 --sight"), 500u);
  EXPECT_GT(compare("crowd.h5", 1, "--radius 2.5", {3, 4, 5, 29}), 40u);
  run(kPile, "pile.h5");
  EXPECT_GT(compare("pile.h5", 0, "--radius 1.5 --fov 90 --heading angle --sight"), 50u);
}

TEST_F(Sensors, FindNobodyWhomQueryFindsHiddenByBodies) {
  const auto hidden = [](std::string scene) {
    for (const std::string sight : {"sight = true", "sight = \"walls\""})
      if (const std::size_t at = scene.find(sight); at != scene.npos)
        scene.replace(at, sight.size(), "sight = \"bodies\"");
    return scene;
  };
  const std::string sight = " --sight --bodies-hide";
  run(hidden(kSensingCrowd), "crowd.h5");
  const std::size_t crowd = compare("crowd.h5", 0, "--radius 4 --fov 170" + sight);
  run(hidden(kPile), "pile.h5");
  const std::size_t pile = compare("pile.h5", 0, "--radius 1.5 --fov 90 --heading angle" + sight);
  EXPECT_GT(crowd, 300u);
  EXPECT_GT(pile, 30u);
  run(kSensingCrowd, "crowd.h5", "--force");
  run(kPile, "pile.h5", "--force");
  EXPECT_LT(crowd, compare("crowd.h5", 0, "--radius 4 --fov 170 --sight"));
  EXPECT_LT(pile, compare("pile.h5", 0, "--radius 1.5 --fov 90 --heading angle --sight"));
}

// Bodies that are recorded have rows of their own.
TEST_F(Sensors, BodiesHideWithoutAnglesWhereAllAreDiscs) {
  const std::string bare = "--force --set 'record.fields=[\"position\"]' --set record.of.ids=";
  const std::string ask = "query " + path("few.h5") + " --all --radius 20 --sight --bodies-hide";
  run(kPile, "few.h5", bare + "[1,50]");
  EXPECT_THAT(throng(ask).err, HasSubstr("--bodies-hide needs angles, which were not recorded"));
  run(kPile, "few.h5", bare + "[50,60]");
  EXPECT_EQ(throng(ask).exit_code, 0);
  EXPECT_THAT(throng("query " + path("few.h5") + " --all --radius 2 --bodies-hide").err,
              HasSubstr("--bodies-hide needs --sight"));
}

TEST_F(Sensors, AreSummedUpAndPlanned) {
  const std::string scene =
      write("s.toml", kPile + "[[sensors]]\nname = \"all\"\nradius = 100\nevery = 40\n");
  const json summary = json::parse(throng("run " + scene).out);
  EXPECT_EQ(summary["sensors"]["all"], json::parse(R"({"looks": 120, "mean": 59.0})"));
  EXPECT_EQ(summary["sensors"]["ahead"]["looks"], 180);
  EXPECT_TRUE(summary["stages"].contains("sense"));
  EXPECT_TRUE(json::parse(throng("run " + scene + " --engine box2d").out)["stages"].contains("sense"));
  EXPECT_THAT(throng("plan " + scene).out, HasSubstr("runs    sense          2 sensors"));
  const std::string without = write("w.toml", kPile.substr(0, kPile.find("[[sensors]]")));
  EXPECT_THAT(throng("plan " + without).out, HasSubstr("skipped sense          no sensors"));
  EXPECT_FALSE(json::parse(throng("run " + without).out).contains("sensors"));
}

TEST_F(Sensors, AreVerifiedAndToldOf) {
  for (const auto& [scene, engine] :
       {std::pair(kSensingCrowd, "native"), std::pair(kPile, "native"), std::pair(kPile, "box2d")}) {
    run(scene, "a.h5", std::string("--force --engine ") + engine);
    const Result verified = throng("replay --verify " + path("a.h5"));
    EXPECT_EQ(verified.exit_code, 0) << verified.out << verified.err;
  }
  EXPECT_THAT(throng("info " + path("a.h5")).out,
              HasSubstr("sensors       name ahead, radius 1.5, fov_degrees 90, sight walls, every 20\n"));
}

TEST_F(Sensors, ThatFoundOthersAreNamed) {
  const Result verified = grafted(kPile);
  EXPECT_EQ(verified.exit_code, 1);
  EXPECT_THAT(verified.out,
              HasSubstr("at step 0 (t = 0 s): those whom ahead senses were recorded otherwise"));
}

TEST_F(Sensors, OfAnotherScenarioAreRefused) {
  const Result verified = grafted(kPile, false);
  EXPECT_EQ(verified.exit_code, 2);
  EXPECT_THAT(verified.err, HasSubstr("its scenario has other sensors than its frames"));
}

/// A scenario of a stranger must not steer the terminal.
TEST_F(Sensors, ThatFoundOthersAreNamedInPrintableLetters) {
  std::string steers = kPile;
  steers.replace(steers.find("ahead"), 5, "\\u001b]0;ahead");
  EXPECT_THAT(grafted(steers).out, HasSubstr("those whom ?]0;ahead senses were recorded otherwise"));
}

TEST_F(Sensors, GoOnWhereARunWasStopped) {
  const std::string scene = write("s.toml", kSensingCrowd);
  const Result whole = throng("run " + scene + " -o " + path("whole.h5"));
  const Result half = throng("run " + scene + " --until 3 --checkpoint 1000 -o " + path("half.h5"));
  ASSERT_EQ(half.exit_code, 0) << half.err;
  const Result rest = throng("resume " + path("half.h5") + " --until 6");
  ASSERT_EQ(rest.exit_code, 0) << rest.err;
  EXPECT_THAT(rest.err, HasSubstr("going on from the checkpoint"));
  EXPECT_EQ(json::parse(rest.out)["sensors"], json::parse(whole.out)["sensors"]);
  const Recording a(path("whole.h5")), b(path("half.h5"));
  EXPECT_TRUE(std::ranges::equal(a.frame_hashes(), b.frame_hashes()));
}

TEST_F(Sensors, AreRefusedWithASentenceWhereTheyMakeNoSense) {
  const auto refused = [&](const std::string& fields, const std::string& why) {
    const Result result = throng("validate " + write("bad.toml", kPile + "[[sensors]]\n" + fields));
    EXPECT_EQ(result.exit_code, 2) << fields;
    EXPECT_THAT(result.err + result.out, HasSubstr(why)) << fields;
  };
  refused("name = \"x\"\n", "sensors[1].radius: is missing");
  refused("name = \"ahead\"\nradius = 1\n", "sensors[1].name: \"ahead\" is the name of another sensor too");
  refused("name = \"\"\nradius = 1\n", "sensors[1].name: must not be empty");
  refused("name = \"x\"\nradius = -1\n", "sensors[1].radius: must be a number from 0 to 1e+09 m");
  refused("name = \"x\"\nradius = 1\nfov_degrees = 361\n", "sensors[1].fov_degrees: must be a number");
  refused("name = \"x\"\nradius = 1\nsight = \"fog\"\n",
          "sensors[1].sight: must be true or false, or one of \"walls\", \"bodies\"");
  refused("name = \"x\"\nradius = 1\nof = { kind = \"agent\" }\n", "sensors[1].of: fits no body");
  refused("name = \"x\"\nradius = 1\nof = { ids = [61] }\n", "sensors[1].of.ids: there is no body 61");
  std::string many;
  for (int i = 0; i < 8; ++i) many += "name = \"x" + std::to_string(i) + "\"\nradius = 1\n[[sensors]]\n";
  refused(many + "name = \"y\"\nradius = 1\n", "sensors: must be at most 8, and are 10");
}

}  // namespace
}  // namespace throng
