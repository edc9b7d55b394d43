// SPDX-License-Identifier: MIT
// What a fuzzer, a broken disk or a malicious neighbour would feed us: refused, in seconds, without a crash.
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>

#include "scenarios/grammar.h"
#include "scenarios/limits.h"
#include "scenarios/report.h"
#include "tests/less_when_watched.h"
#include "tests/scenarios/scenario_texts.h"

namespace throng::scenarios {

using throng::testing::faults;
using throng::testing::kEverything;
using throng::testing::load_text;

namespace {

std::string repeated(const std::string& part, std::size_t times) {
  std::string result;
  result.reserve(part.size() * times);
  for (std::size_t i = 0; i < times; ++i) result += part;
  return result;
}

/// The paths of all fields of the grammar, as overrides of kEverything say them.
void collect(const Type& type, const std::string& path, std::vector<std::string>& paths) {
  paths.push_back(path);
  for (const Type& part : type.parts)
    if (type.kind == Type::Kind::either) collect(part, path, paths);
  if (type.kind == Type::Kind::tuple)
    for (std::size_t i = 0; i < type.parts.size(); ++i)
      collect(type.parts[i], path + "[" + std::to_string(i) + "]", paths);
  if (type.kind == Type::Kind::list) collect(type.parts[0], path + "[0]", paths);
  if (type.kind == Type::Kind::named)
    for (const char* name : {"ball", "grain", "brick", "robot", "ice"})
      collect(type.parts[0], path + "." + name, paths);
  if (!type.table) return;
  for (const Field& field : type.table->fields) {
    if (type.kind == Type::Kind::table) collect(field.type, path + "." + field.key, paths);
    for (int entry = 0; type.kind == Type::Kind::tables && entry < 4; ++entry)
      collect(field.type, path + "[" + std::to_string(entry) + "]." + field.key, paths);
  }
}

/// Every number that the scene holds is finite and in its bounds.
bool is_sound(const Scene& scene) {
  const auto near = [](const Vec& v) { return v.allFinite() && v.cwiseAbs().maxCoeff() <= 2e9; };
  bool sound = scene.time.dt > 0 && scene.time.until >= 0 && scene.time.until / scene.time.dt <= 1e12 &&
               near(scene.gravity);
  sound = sound && scene.time.substeps >= 1 && scene.record.every >= 1 && near(scene.domain.min) &&
          near(scene.domain.max);
  for (const Material& m : scene.materials)
    sound = sound && m.density > 0 && m.restitution >= 0 && m.restitution <= 1 && m.friction >= 0 &&
            m.rolling_resistance >= 0 && std::isfinite(m.density);
  for (std::size_t row = 0; row < scene.bodies.size(); ++row) {
    const Bodies& b = scene.bodies;
    sound = sound && near(b.position[row]) && near(b.velocity[row]) && b.radius[row] > 0 &&
            std::isfinite(b.radius[row]);
    sound = sound && std::isfinite(b.angle[row]) && std::isfinite(b.spin[row]) && mass(scene, row) > 0;
    sound = sound && std::isfinite(mass(scene, row)) && inertia(scene, row) > 0 &&
            std::isfinite(inertia(scene, row));
  }
  for (const Wall& wall : scene.walls)
    for (const Vec& p : wall.points) sound = sound && near(p);
  return sound;
}

}  // namespace

TEST(HostileInput, OfEveryKindInEveryFieldIsRefusedOrInRange) {
  std::vector<std::string> paths;
  Type root;
  root.kind = Type::Kind::table;
  root.table = std::make_shared<const Table>(grammar());
  collect(root, "", paths);
  ASSERT_GT(paths.size(), 300u);
  const std::vector<std::string> values = {"true",
                                           "\"\"",
                                           "[]",
                                           "{}",
                                           "[[]]",
                                           "[{}]",
                                           "nan",
                                           "inf",
                                           "-inf",
                                           "-1",
                                           "-1.0",
                                           "0",
                                           "0.0",
                                           "-0.0",
                                           "1e308",
                                           "-1e308",
                                           "5e-324",
                                           "9223372036854775807",
                                           "-9223372036854775808",
                                           "9007199254740993",
                                           "1979-05-27T07:32:00Z",
                                           "[nan, nan]",
                                           "[1, 2, 3]",
                                           "1.5",
                                           repeated("'", 1) + std::string(100'000, 'x') + "'",
                                           repeated("[", 30) + repeated("]", 30),
                                           "{ uniform = [nan, 1] }",
                                           "{ maxwell = inf }"};
  std::size_t accepted = 0, refused = 0, turn = 0;
  for (const std::string& path : paths) {
    if (path.empty() || path.find("count") != std::string::npos) continue;  // counts: below
    for (std::size_t i = turn++ % kStride; i < values.size(); i += kStride) {
      const std::string& value = values[i];
      const Loaded loaded = load_text(kEverything, {path.substr(1) + "=" + value});
      if (loaded.errors() > 0) {
        ++refused;
        continue;
      }
      ++accepted;
      ASSERT_TRUE(is_sound(loaded.scene)) << path << "=" << value;
    }
  }
  EXPECT_GT(refused, less_when_watched(5000));
  EXPECT_GT(accepted, less_when_watched(100));
}

TEST(HostileInput, OfDepthIsRefusedBeforeItIsParsed) {
  for (const std::string& open : {std::string("["), std::string("{a="), std::string("[ ")}) {
    const Loaded loaded = load_text("throng = 1\na = " + repeated(open, 1'000'000));
    EXPECT_EQ(loaded.errors(), 1);
    EXPECT_NE(faults(loaded).find("lists or tables more than 32 deep"), std::string::npos) << faults(loaded);
  }
}

TEST(HostileInput, OfLongDottedKeysIsRefusedBeforeItIsParsed) {
  for (const std::string& text :
       {repeated("a.", 1'000'000) + "a = 1", repeated("[", 1) + repeated("a . ", 1'000'000) + "a]",
        "x = {" + repeated("'a'.", 1'000'000) + "a = 1}", repeated("\"\".", 1'000'000) + "a = 1"})
    EXPECT_NE(faults(load_text(text)).find("a dotted key of more than 32 parts"), std::string::npos);
}

// TOML lets one or two more quotes stand before the closing three: taken for a new string, they hid what
// followed from the scan, and the parser recursed until the stack was gone.
TEST(HostileInput, IsSeenBehindStringsThatEndInQuotes) {
  for (const char* string : {"'''a''''", "'''a'''''", "\"\"\"a\"\"\"\"", "\"\"\"a\"\"\"\"\""}) {
    const Loaded loaded =
        load_text(std::string("throng = 1\nx = [") + string + ", {" + repeated("a.", 500) + "a = 1}]");
    EXPECT_NE(faults(loaded).find("a dotted key of more than 32 parts"), std::string::npos) << string;
    EXPECT_EQ(faults(load_text(std::string("throng = 1\nname = ") + string)), "") << string;
  }
}

TEST(HostileInput, OfManyNamesIsReadInSeconds) {
  std::string text = "throng = 1\nshapes.a.disc.radius = 1\n", bodies;
  for (int i = 0; i < 40'000; ++i) {
    text.append("materials.m").append(std::to_string(i)).append(".density = 1\n");
    bodies.append("[[bodies]]\nshape = 'a'\nkind = 'static'\nat = [0, 0]\nmaterial = 'm")
        .append(std::to_string(39'999 - i))
        .append("'\n");
  }
  const auto start = std::chrono::steady_clock::now();
  const Loaded loaded = load_text(text + bodies);
  const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - start;
  EXPECT_EQ(faults(loaded), "");
  EXPECT_LT(taken.count(), 20.0);
}

TEST(HostileInput, OfManyHugeShapesIsRefusedBeforeTheirGeometryIsDone) {
  std::string part = "[0, 0, 1]", text = "throng = 1\n";
  for (int i = 1; i < 1000; ++i) part.append(", [").append(std::to_string(i)).append("e-3, 0, 1]");
  for (int i = 0; i < 1001; ++i)
    text.append("shapes.s").append(std::to_string(i)).append(".discs = [").append(part).append("]\n");
  EXPECT_NE(faults(load_text(text)).find("more than 1000000 vertices and discs in all shapes"),
            std::string::npos);
}

TEST(HostileInput, OfManyKeysIsRefusedInSeconds) {
  std::string text = "throng = 1\n";
  const int keys = static_cast<int>(less_when_watched(200'000));
  for (int i = 0; i < keys; ++i) text.append("k").append(std::to_string(i)).append(" = 1\n");
  EXPECT_EQ(load_text(text).errors(), Report::kMostErrors);
}

TEST(HostileInput, OfManyValuesIsRefusedBeforeItIsParsed) {
  const Loaded loaded = load_text("a = [" + repeated("0,", kMostItems + 1) + "]");
  EXPECT_NE(faults(loaded).find("more than 10000000 values"), std::string::npos) << faults(loaded);
}

// Each is five datasets of a recording.
TEST(HostileInput, OfManyMeasuresIsRefused) {
  std::string text =
      "throng = 1\nwalkable = [[0, 0], [9, 0], [9, 9], [0, 9]]\nareas.exit = [[8, 0], [9, 0], [9, 9]]\n"
      "[[agents]]\nat = [1, 1]\nmodel = \"constant_velocity\"\ngoal = \"exit\"\n";
  const auto add = [&](int i) {
    text += "[[measure]]\nline = [[3, 0], [3, 9]]\nname = \"" + std::to_string(i) + "\"\n";
  };
  for (int i = 0; i < 1000; ++i) add(i);
  EXPECT_EQ(faults(load_text(text)), "");
  add(1000);
  EXPECT_NE(faults(load_text(text)).find("measure: must be at most 1000, and are 1001"), std::string::npos);
}

TEST(HostileInput, OfHugeShapesIsRefusedOrReadInSeconds) {
  const auto comb = [](int teeth) {
    std::string text = "throng = 1\nshapes.a.polygon = [[0, -1], [" + std::to_string(teeth) + ", -1]";
    for (int i = teeth; i > 0; --i)
      text.append(", [")
          .append(std::to_string(i))
          .append(", 0], [")
          .append(std::to_string(i))
          .append("e0, 5]");
    return text + "]\n";
  };
  const auto flower = [](int discs) {
    std::string text = "throng = 1\nshapes.a.discs = [[0, 0, 1]";
    for (int i = 1; i < discs; ++i) text.append(", [").append(std::to_string(i)).append("e-3, 0, 1]");
    return text + "]\n";
  };
  EXPECT_NE(faults(load_text(comb(6000))).find("must be a list of 3 to 10000 points"), std::string::npos);
  EXPECT_NE(faults(load_text(flower(1001))).find("must be a list of 1 to 1000 discs"), std::string::npos);
  EXPECT_EQ(faults(load_text(flower(1000))), "");
}

TEST(HostileInput, OfBinaryKindIsNamedAsSuch) {
  EXPECT_NE(faults(load_text(std::string("\x89HDF\r\n\x1a\n\0\0\0\0", 12))).find("s.toml:"),
            std::string::npos);
  EXPECT_NE(faults(load_text(std::string("a = 1\n\0\0", 8))).find("s.toml:2:1: error: a zero byte"),
            std::string::npos);
}

TEST(HostileInput, CutAnywhereEndsInAMessageOrAScene) {
  for (std::size_t end = 0; end < kEverything.size(); ++end) {
    const Loaded loaded = load_text(kEverything.substr(0, end));
    EXPECT_TRUE(loaded.errors() > 0 || is_sound(loaded.scene)) << end;
  }
}

TEST(HostileInput, OfTooManyBodiesIsRefused) {
  const Loaded loaded = load_text(kEverything, {"bodies[2].place.lattice.size=[10000000, 2]"});
  EXPECT_NE(faults(loaded).find("must make at most 10000000 sites"), std::string::npos) << faults(loaded);
  EXPECT_EQ(load_text(kEverything, {"bodies[1].count=9223372036854775807"}).errors(), 1);
  EXPECT_EQ(load_text(kEverything, {"bodies[1].count=9999999"}).errors(), 1);
}

TEST(HostileInput, IsNotSeenInBracketsOfStringsAndComments) {
  const std::string deep = repeated("[", 100);
  for (const char* quotes : {"'", "\"", "\"\\\"", "\"\"\"\\\"", "\"\"\"\n\"\" ", "'''\n' "}) {
    const std::string open = quotes, close = open[1] == open[0] ? open.substr(0, 3) : open.substr(0, 1);
    EXPECT_EQ(faults(load_text("throng = 1\nname = " + open + deep + close + " # " + deep + "\n")), "")
        << open;
  }
}

}  // namespace throng::scenarios
