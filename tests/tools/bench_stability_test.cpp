// SPDX-License-Identifier: MIT
// throng bench stability: the ordinary is stable, the absurd isn't.
#include <gmock/gmock.h>

#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "tests/tools/program.h"

namespace throng {
namespace {

class BenchStability : public Program {
 protected:
  /// By case and value.
  std::map<std::string, std::map<double, nlohmann::json>> rows_of(const std::string& arguments) {
    const Result result = throng("bench stability " + arguments + " --json " + path("rows.json"));
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_THAT(result.out, testing::HasSubstr("are stable"));
    std::map<std::string, std::map<double, nlohmann::json>> rows;
    for (const auto& row : nlohmann::json::parse(read(path("rows.json")))) {
      rows[row["case"]][row["error"]["x_value"]] = row["error"];
      rows[row["case"]][row["error"]["x_value"]]["steps"] = row["work"];
    }
    return rows;
  }
};

TEST_F(BenchStability, JudgesEachSceneUnderEachFactor) {
  auto rows = rows_of("--quick");
  EXPECT_EQ(rows.size(), 21u) << "seven factors, three scenes";
  const std::set<std::string> verdicts{"stable", "drifting", "exploded"};
  for (const auto& [name, cells] : rows) {
    EXPECT_EQ(cells.size(), 3u) << name;
    for (const auto& [value, cell] : cells) EXPECT_TRUE(verdicts.contains(cell["verdict"])) << name << cell;
  }
  for (const std::string scene : {"stack: ", "pile: ", "gas: "}) {
    EXPECT_EQ(rows[scene + "scale"][1.0]["verdict"], "stable") << rows[scene + "scale"][1.0];
    EXPECT_EQ(rows[scene + "dt (s)"][1.0 / 240]["verdict"], "stable") << rows[scene + "dt (s)"][1.0 / 240];
    EXPECT_EQ(rows[scene + "substeps"][16.0]["verdict"], "stable") << rows[scene + "substeps"][16.0];
    EXPECT_EQ(rows[scene + "substeps"][16.0]["steps"], 360) << "six seconds";
  }
  EXPECT_EQ(rows["stack: dt (s)"][0.1]["verdict"], "stable");
  EXPECT_NE(rows["stack: scale"][0.001]["verdict"], "stable") << "substeps are too long for millimetres";
}

TEST_F(BenchStability, ShowsEachRowWhenItIsThere) {
  const Result result =
      throng("bench stability --quick --only restitution --json " + path("rows.json") + " 2>&1 | cat");
  ASSERT_EQ(result.exit_code, 0);
  EXPECT_LT(result.out.find("stack: restitution"), result.out.find("\npile\n"))
      << "which is told as it begins";
  EXPECT_LT(result.out.find("\npile\n"), result.out.find("pile: restitution"));
  EXPECT_EQ(result.out.find("stack: restitution"), result.out.rfind("stack: restitution")) << "once";
}

TEST_F(BenchStability, SaysWhatItsColumnsAreIn) {
  EXPECT_THAT(throng("bench --help").out, testing::HasSubstr("overlap, the deepest at the end, in radii"));
}

}  // namespace
}  // namespace throng
