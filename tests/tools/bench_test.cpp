// SPDX-License-Identifier: MIT
// throng bench, as far as its rows go: times are for people.
#include <gmock/gmock.h>

#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "tests/full_length.h"
#include "tests/tools/program.h"

namespace throng {
namespace {

class BenchCommand : public Program {};

TEST_F(BenchCommand, WritesTheRowsOfTheContractForEveryEngineOfACase) {
  const Result result = throng("bench step --only cradle --blocks 1 --json " + path("rows.json"));
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const auto rows = nlohmann::json::parse(read(path("rows.json")));
  ASSERT_GE(rows.size(), 2u);  // a third where Chipmunk's library is there
  EXPECT_EQ(rows[0]["engine"], "native");
  EXPECT_EQ(rows[1]["engine"], "box2d");
  for (const auto& row : rows) {
    for (const char* key : {"bench", "case", "engine", "threads", "ms", "ms_min", "work", "check", "error"})
      EXPECT_TRUE(row.contains(key)) << key;
    EXPECT_EQ(row["check"], rows[0]["check"]);
    EXPECT_GT(row["ms_min"], 0.0);
    for (const char* key : {"mean_overlap", "max_overlap", "kinetic_energy", "escaped"})
      EXPECT_TRUE(row["error"].contains(key)) << key;
  }
}

/// It happened: Chipmunk, as Debian builds it, tells of itself where the rows stand.
TEST_F(BenchCommand, GivesRowsAloneOnTheStandardOutput) {
  const Result result = throng("bench step --only cradle --blocks 1 --json -");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_GE(nlohmann::json::parse(result.out).size(), 2u);
  const std::string table = throng("bench step --only cradle --blocks 1").out;
  EXPECT_EQ(table.substr(0, 5), "case ") << table;
}

TEST_F(BenchCommand, AddsOneFeatureAfterTheOther) {
  const Result result = throng("bench lean --quick --blocks 1 --json " + path("rows.json"));
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const auto rows = nlohmann::json::parse(read(path("rows.json")));
  ASSERT_EQ(rows.size(), 14u);
  double before = 0.0;
  for (const auto& row : rows) {
    EXPECT_NEAR(row["error"]["price_ms"], double(row["ms"]) - before, 1e-9) << row["engine"];
    before = row["ms"];
  }
  EXPECT_EQ(rows[0]["error"]["contacts"], 0);
  EXPECT_GT(rows[1]["error"]["contacts"], 10);
}

TEST_F(BenchCommand, RunsAPileWithAndWithoutSleep) {
  const Result result = throng("bench step --only asleep --quick --blocks 1 --json " + path("rows.json"));
  ASSERT_EQ(result.exit_code, 0) << result.err;
  std::set<std::string> engines;
  for (const auto& row : nlohmann::json::parse(read(path("rows.json")))) {
    engines.insert(row["engine"]);
    EXPECT_EQ(row["error"].contains("asleep"), row["engine"] == "native, sleeps");
  }
  EXPECT_TRUE(engines.contains("native") && engines.contains("native, sleeps"));
}

TEST_F(BenchCommand, TurnsEachKnobAndGetsTheSameBits) {
  const Result result = throng("bench knobs --quick --only pile --blocks 1 --json " + path("rows.json"));
  ASSERT_EQ(result.exit_code, 0) << result.err;
  std::map<std::string, std::set<std::string>> engines, checks;
  for (const auto& row : nlohmann::json::parse(read(path("rows.json")))) {
    engines[row["case"]].insert(row["engine"]);
    checks[row["case"]].insert(row["check"]);
  }
  EXPECT_TRUE(engines["pile, settled"].contains("2 threads"));
  EXPECT_GE(engines["pile, settled"].size(), 3u) << "and some vectors";
  EXPECT_EQ(checks["pile, settled"].size(), 1u) << "the same hash";
  EXPECT_FALSE(checks["pile, settled"].contains("")) << "all are held against each other";
  EXPECT_EQ(engines["pile, settled, at rest"], (std::set<std::string>{"as it is", "sleeps"}));
}

TEST_F(BenchCommand, TimesSoftBeds) {
  const Result result = throng("bench soft --quick --only n=10000$ --blocks 1 --json " + path("rows.json"),
                               "PATH=" + path("nothing") + " ");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  std::set<std::string> engines;
  for (const auto& row : nlohmann::json::parse(read(path("rows.json")))) {
    engines.insert(row["engine"]);
    if (row["engine"] == "lammps")
      EXPECT_EQ(row["error"]["note"], "not installed");
    else
      EXPECT_GT(row["error"]["us_per_disc_and_substep"], 0.0);
  }
  EXPECT_EQ(engines, (std::set<std::string>{"spring", "hertz", "lammps"}));
}

TEST_F(BenchCommand, AsksAllEnginesTheSameQuestions) {
  const Result result =
      throng("bench broadphase --quick --only radius --only nearest --blocks 1 --json " + path("rows.json"));
  ASSERT_EQ(result.exit_code, 0) << result.err;
  std::map<std::string, std::set<std::string>> engines;
  for (const auto& row : nlohmann::json::parse(read(path("rows.json")))) {
    engines[row["case"]].insert(row["engine"]);
    EXPECT_EQ(row["bench"], "broadphase");
  }
  EXPECT_EQ(engines.size(), 6u);
  EXPECT_EQ(engines["uniform n=10000 k=10 random radius"],
            (std::set<std::string>{"throng", "throng_tree", "nanoflann", "cgal", "pairs", "box2d_tree"}));
  EXPECT_EQ(engines["line n=10000 k=10 spatial nearest"],
            (std::set<std::string>{"throng", "nanoflann", "cgal"}));
}

TEST_F(BenchCommand, WalksCrowdsAsTheirPlainTwinsDo) {
  const Result result = throng("bench crowd --quick --blocks 1 --json " + path("rows.json"));
  ASSERT_EQ(result.exit_code, 0) << result.err;
  std::set<std::string> rows;
  for (const auto& row : nlohmann::json::parse(read(path("rows.json")))) {
    rows.insert(std::string(row["case"]) + " " + std::string(row["engine"]));
    const auto& error = row["error"];
    const bool steps = std::string(row["check"]).starts_with("agents=");
    EXPECT_TRUE(!steps || error.value("us_per_agent_step", 0.0) > 0.0);
    EXPECT_LT(error.value("worst_relative", 0.0), 0.03);
  }
  EXPECT_EQ(rows.size(), 12u);
  EXPECT_TRUE(rows.contains("stadium throng"));
  EXPECT_TRUE(rows.contains("social_force n=1000 two threads"));
  EXPECT_TRUE(rows.contains("distance field 300 x 300 throng"));
  EXPECT_TRUE(rows.contains("orca n=1000 plain"));
}

// IMO 4 of the other models, whose rooms take ten times as long as all the rest, is of the next test.
TEST_F(BenchCommand, JudgesEveryModelByTheCatalogues) {
  std::map<std::string, std::map<std::string, nlohmann::json>> cases;
  std::string out;
  for (const char* chosen : {"--only '^(IMO [^4]|[^I])'", "--only '^IMO 4' --engine constant_velocity"}) {
    const Result result =
        throng("bench validation --quick " + std::string(chosen) + " --json " + path("rows.json"));
    ASSERT_EQ(result.exit_code, 0) << result.err;
    out += result.out;
    for (const auto& row : nlohmann::json::parse(read(path("rows.json"))))
      cases[row["case"]][row["engine"]] = row["error"];
  }
  for (const char* model : {"constant_velocity", "social_force", "collision_free_speed", "orca"})
    for (const char* name :
         {"IMO 1, NIST 2.1: corridor", "RiMEA 1: corridor", "IMO 6, RiMEA 6: corner", "NIST 2.4: speeds"})
      EXPECT_EQ(cases[name][model]["verdict"], "pass") << name << ", " << model << cases[name][model];
  EXPECT_EQ(cases["IMO 5, RiMEA 5: response times"]["orca"]["verdict"], "pass");
  const auto& corridor = cases["IMO 1, NIST 2.1: corridor"]["social_force"];
  EXPECT_NEAR(corridor["value"].get<double>(), 40.0, 0.05) << "s: 40 m at 1 m/s";
  const auto& blind = cases["IMO 4, NIST 5.2: exit of a room"]["constant_velocity"];
  EXPECT_EQ(blind["verdict"], "fail") << "all pass the exit through one another";
  EXPECT_EQ(blind["by_nature"], true);
  EXPECT_EQ(cases["NIST 2.9: groups"]["orca"]["by_nature"], true);
  EXPECT_EQ(cases["NIST 4.1: an exit that closes"]["orca"]["verdict"], "pass");
  EXPECT_THAT(out, ::testing::HasSubstr("IMO 4, NIST 5.2: exit of a room"));
}

// What README promises of them: means with twice their standard error, and each of several draws of the
// crowd; but a line through flows of one draw is only as straight as 60 people are many. THRONG_FULL=1 runs
// all of it.
TEST_F(BenchCommand, FindsThatPresetsKeepWhatTheyAreFor) {
  const auto expect_passes = [&](const std::string& walker, const std::string& only, std::size_t count) {
    const Result result = throng("bench validation --engine '" + walker + "' --only '" + only + "' --json " +
                                 path("rows.json"));
    ASSERT_EQ(result.exit_code, 0) << result.err;
    const auto rows = nlohmann::json::parse(read(path("rows.json")));
    EXPECT_EQ(rows.size(), count);
    for (const auto& row : rows) {
      const auto& found = row["error"];
      EXPECT_EQ(found["verdict"], "pass") << walker << ": " << row["case"] << found;
      if (!found.contains("worst") || row["case"] == "Seyfried 2009, RiMEA 12d: flow over width") continue;
      const double worst = found["worst"];
      const double low = found["low"].is_null() ? worst : found["low"].get<double>(),
                   high = found["high"].is_null() ? worst : found["high"].get<double>();
      EXPECT_TRUE(worst >= low && worst <= high) << walker << ": " << row["case"] << found;
    }
  };
  expect_passes("social_force calibrated", "^IMO 4,", 1);
  expect_passes("collision_free_speed calibrated", "^IMO 4,", 1);
  if (!full_length()) return;
  expect_passes("social_force calibrated", "^IMO 8,", 1);
  expect_passes("social_force bottleneck", "^Seyfried", 2);
  expect_passes("collision_free_speed calibrated", "^IMO [89],", 2);
  expect_passes("collision_free_speed bottleneck", "^Seyfried|^Weidmann", 3);
}

/// By case, of both calibrated presets, social_force's first.
std::map<std::string, std::vector<std::string>> verdicts(const nlohmann::json& rows) {
  std::map<std::string, std::vector<std::string>> all;
  for (const auto& row : rows) {
    const auto& found = row["error"];
    const bool by_nature = found.value("by_nature", false);
    all[row["case"]].push_back(by_nature ? "by nature" : found["verdict"].get<std::string>());
  }
  return all;
}

// What else the catalogues ask of them, in the order of README's table. THRONG_FULL=1 runs all but RiMEA 15,
// which takes minutes.
TEST_F(BenchCommand, JudgesCalibratedPresetsByAllOtherCases) {
  const std::string engines =
      " --engine 'social_force calibrated' --engine 'collision_free_speed calibrated'";
  std::map<std::string, std::vector<std::string>> expected{
      {"NIST 2.3: corner", {"pass", "pass"}},
      {"IMO 7: speeds of men of 30 to 50", {"pass", "pass"}},
      {"RiMEA 7: speeds by age", {"pass", "pass"}},
      {"IMO 10, RiMEA 10, NIST 3.1: cabins", {"pass", "pass"}},
      {"NIST 2.10: one who is slow", {"by nature", "pass"}},
      {"RiMEA 12a: goal behind an exit", {"pass", "pass"}},
      {"RiMEA 12b: length of a bottleneck", {"fail", "pass"}},
      {"RiMEA 12c: two doors", {"fail", "pass"}},
      {"NIST 5.1: congestion", {"pass", "pass"}},
      {"RiMEA 14: choice of routes", {"documented", "documented"}},
      {"NIST 4.1: an exit that closes", {"pass", "pass"}},
      {"NIST 2.9: groups", {"by nature", "by nature"}}};
  std::string only = "^(NIST (2.3|2.10|5.1|4.1|2.9)|IMO (7|10)|RiMEA (7|12[abc]|14)";
  if (full_length()) {
    only += "|RiMEA 1[16]";
    expected["RiMEA 11: choice of exits"] = {"pass", "pass"};
    expected["RiMEA 16: single file in a ring"] = {"by nature", "pass"};
  }
  const Result result =
      throng("bench validation --only '" + only + ")' --json " + path("rows.json") + engines);
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(verdicts(nlohmann::json::parse(read(path("rows.json")))), expected) << result.out;
}

TEST_F(BenchCommand, JudgesAModelByFieldsOfOnesOwn) {
  const auto value = [&](const std::string& arguments) {
    const Result result = throng("bench validation --only 'NIST 2.1' --engine orca " + arguments +
                                 " --json " + path("rows.json"));
    EXPECT_EQ(result.exit_code, 0) << result.err;
    return nlohmann::json::parse(read(path("rows.json")))[0]["error"]["value"].get<double>();
  };
  EXPECT_NEAR(value("--set orca.top_speed=0.5"), 80.0, 0.1) << "s";
}

TEST_F(BenchCommand, TakesARegularExpressionForWhichCasesToRun) {
  const Result result = throng(
      "bench broadphase --quick --engine throng --blocks 1 --only '^uniform n=1000 k=.0 random$' --json " +
      path("rows.json"));
  ASSERT_EQ(result.exit_code, 0) << result.err;
  std::set<std::string> cases;
  for (const auto& row : nlohmann::json::parse(read(path("rows.json")))) cases.insert(row["case"]);
  EXPECT_EQ(cases, (std::set<std::string>{"uniform n=1000 k=10 random", "uniform n=1000 k=40 random"}));
}

TEST_F(BenchCommand, FindsTheSamePairsWithEveryEngine) {
  const Result result = throng("bench broadphase --quick --blocks 1 --json " + path("pairs.json"));
  ASSERT_EQ(result.exit_code, 0) << result.err;
  std::map<std::string, std::set<std::string>> checks, engines;
  for (const auto& row : nlohmann::json::parse(read(path("pairs.json")))) {
    checks[row["case"]].insert(row["check"]);
    engines[row["case"]].insert(row["engine"]);
  }
  for (const auto& [name, check] : checks) EXPECT_EQ(check.size(), 1u) << name;
  EXPECT_EQ(engines["boxes n=1000 k=10 random"],
            (std::set<std::string>{"throng", "throng_threads", "box2d_tree", "brute_force"}));
  for (const char* kind : {"uniform", "clustered", "line", "mixed"})
    for (const char* engine : {"throng", "plain", "nanoflann", "box2d_tree"})
      EXPECT_TRUE(engines[kind + std::string(" n=1000 k=10 random")].contains(engine))
          << kind << ", " << engine;
}

// The engines' answers are compared before any time is taken: exit code 0 says that they agree.
TEST_F(BenchCommand, ComparesTheNarrowphaseWithItsPeersBeforeItTimesThem) {
  const Result result = throng(
      "bench narrowphase --quick --blocks 1 --only '8 vertices 0.01 rad near' --only discs "
      "--json " +
      path("rows.json"));
  ASSERT_EQ(result.exit_code, 0) << result.err;
  std::set<std::string> engines;
  for (const auto& row : nlohmann::json::parse(read(path("rows.json")))) {
    engines.insert(row["engine"].get<std::string>());
    EXPECT_EQ(row["check"], "distances agree");
    EXPECT_TRUE(row["error"].contains("max_ulp"));
    EXPECT_DOUBLE_EQ(row["error"]["ns"], 1e6 * row["ms"].get<double>());
  }
  for (const char* engine : {"tracker", "gjk warm", "gjk cold", "separation", "sat", "exhaustive",
                             "box2d warm", "box2d cold", "cgal", "find_gaps"})
    EXPECT_TRUE(engines.contains(engine)) << engine;
}

TEST_F(BenchCommand, RefusesWhatWouldDoNothing) {
  for (const char* arguments :
       {"step --quick --large", "recording --engine throng", "step --quick --only nosuch",
        "step --quick --only '('", "broadphase --quick --only line --target nosuch",
        "step --quick --set model=orca", "validation --quick --set nosuch=1"})
    EXPECT_EQ(throng(std::string("bench ") + arguments).exit_code, 2) << arguments;
}

TEST_F(BenchCommand, NamesTheEngineThatPlaysNothing) {
  const Result result =
      throng("bench broadphase --quick --only '^uniform n=1000 k=10 random$' --engine nosuch");
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_THAT(result.err, ::testing::HasSubstr("--engine names none that plays: nosuch"));
}

/// A clone that was moved, or a copy of it, has its own gallery.
TEST_F(BenchCommand, FindsTheGalleryOfItsOwnClone) {
  namespace fs = std::filesystem;
  const std::string bench = path("clone/build/throng-bench"), pile = path("clone/scenarios/pile.toml");
  fs::create_directories(path("clone/build"));
  fs::create_directories(path("clone/scenarios"));
  fs::copy_file(fs::path(THRONG_PROGRAM).parent_path() / "throng-bench", bench);
  write("clone/scenarios/pile.toml", "throng = 0\n");
  EXPECT_THAT(run(bench + " step --quick --only pile").err, ::testing::HasSubstr(pile));
  fs::remove(pile);
  const Result none = run(bench + " step --quick --only pile --scenarios " + path("clone/scenarios"));
  EXPECT_EQ(none.exit_code, 2);
  EXPECT_THAT(none.err, ::testing::HasSubstr("--scenarios names the folder"));
}

TEST_F(BenchCommand, NamesTheCasesWhereNoneIsMeant) {
  const Result result = throng("bench step --quick --only xyzzy");
  EXPECT_EQ(result.exit_code, 2);
  for (const char* said : {"--only holds for no case's name; there are\n", "\n  cradle\n", "\n  mixed\n"})
    EXPECT_THAT(result.err, ::testing::HasSubstr(said));
}

TEST_F(BenchCommand, NamesTheModelsAndPresetsWhereNoneIsMeant) {
  const Result result = throng("bench validation --only Seyfried --engine 'collision_free_speed botleneck'");
  EXPECT_EQ(result.exit_code, 2);
  for (const char* said :
       {"there is no 'collision_free_speed botleneck'", "\n  collision_free_speed bottleneck\n"})
    EXPECT_THAT(result.err, ::testing::HasSubstr(said));
  EXPECT_THAT(result.err, ::testing::Not(::testing::HasSubstr("--only")));
}

TEST_F(BenchCommand, RecordsRunsAndRawFrames) {
  const Result result = throng("bench recording --quick --blocks 1 --json " + path("rows.json"));
  ASSERT_EQ(result.exit_code, 0) << result.err;
  std::set<std::string> seen;
  for (const auto& row : nlohmann::json::parse(read(path("rows.json")))) {
    seen.insert(std::string(row["case"]) + ", " + std::string(row["engine"]));
    if (row["engine"] != "quantized" || row["case"] != "crowd n=1000 quantize=0.001") continue;
    EXPECT_LE(row.at("error").at("bytes_a_body").get<double>(), 2.5);
    const double farthest_off = row.at("error").at("farthest_off");
    EXPECT_LE(farthest_off, 0.5e-3 * (1 + 1e-9)) << "m, half a quantum";
    EXPECT_GT(farthest_off, 0.4e-3) << "m: the sample is of many numbers";
  }
  EXPECT_EQ(seen, (std::set<std::string>{
                      "pile n=10000 every step, position and angle, unrecorded",
                      "pile n=10000 every step, position and angle, recorded", "write n=10000, plain",
                      "write n=10000, throng", "read n=10000, plain", "read n=10000, throng",
                      "crowd n=1000 quantize=0.001, float32", "crowd n=1000 quantize=0.001, quantized",
                      "crowd n=1000 quantize=0.001, read quantized", "seek n=1000, throng",
                      "seek n=1000, quantized"}));
}

TEST_F(BenchCommand, FindsTheSameInEveryHierarchyAndWithout) {
  const Result result = throng("bench bvh --quick --blocks 1 --json " + path("rows.json"));
  ASSERT_EQ(result.exit_code, 0) << result.err;
  std::map<std::string, std::set<std::string>> engines;
  for (const auto& row : nlohmann::json::parse(read(path("rows.json")))) {
    engines[row["case"]].insert(row["engine"]);
    EXPECT_TRUE(!std::string(row["case"]).starts_with("within a") || row["check"] == "1") << row;
  }
  EXPECT_EQ(engines["point coast n=256"],
            (std::set<std::string>{"aabb", "disc", "obb", "mixed", "cgal", "brute"}));
  EXPECT_EQ(engines["distance interlocked coast n=256"],
            (std::set<std::string>{"aabb", "disc", "obb", "mixed", "aabb cached", "disc cached", "obb cached",
                                   "mixed cached", "brute"}));
  EXPECT_EQ(engines["first hit touching coast n=256"].size(), 8u);
  EXPECT_EQ(engines["volume star n=256"], (std::set<std::string>{"aabb", "disc", "obb", "mixed"}));
  EXPECT_EQ(engines["parts gear n=64 near 0.01 rad"],
            (std::set<std::string>{"from nothing", "last parts", "last parts and features"}));
}

TEST_F(BenchCommand, RefusesABenchmarkThatDoesNotExist) {
  const Result result = throng("bench nonsense");
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_THAT(result.err, ::testing::HasSubstr("nonsense"));
}

}  // namespace
}  // namespace throng
