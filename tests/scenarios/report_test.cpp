// SPDX-License-Identifier: MIT
#include "scenarios/report.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/scenarios/scenario_texts.h"

namespace throng::scenarios {

using throng::testing::faults;
using throng::testing::kEverything;
using throng::testing::load_text;

namespace {

/// So many warnings, of lines from the 4th on.
std::string with_standers(int groups) {
  std::string text =
      "throng = 1\nwalkable = 'POLYGON ((0 0, 99 0, 99 9, 0 9, 0 0))'\nareas.exit = [[90, 0], [99, 0], [99, "
      "9]]\n";
  for (int i = 0; i < groups; ++i)
    text += "[[agents]]\nmodel = 'orca'\ngoal = 'exit'\ndesired_speed = 0\nat = [" + std::to_string(i + 1) +
            ", 2]\n";
  return text;
}

}  // namespace

TEST(Report, NamesAllFaultsInTheOrderOfTheText) {
  const Loaded loaded = load_text("nmae = 1\nthrong = 2\nengine = 'x'\ntime = { until = -1, dt = 0 }\n");
  EXPECT_EQ(
      faults(loaded),
      "s.toml:1:1: error: nmae: unknown key, did you mean \"name\"?\n"
      "s.toml:2:10: error: throng: must be 1, the version of this grammar, and is the integer 2\n"
      "s.toml:3:10: error: engine: must be one of \"native\", \"box2d\", \"event_driven\", and is \"x\"\n"
      "s.toml:4:18: error: time.until: must be a number from 0 to 1e+12 s, and is the integer -1\n"
      "s.toml:4:27: error: time.dt: must be a number from 1e-12 to 1e+06 s, and is the integer 0\n");
}

TEST(Report, FindsWhatTheGrammarCannotSayInTheSameGo) {
  const Loaded loaded = load_text(
      "throng = 1\nname = 1\n[shapes]\na.disc.radius.uniform = [2, 1]\n"
      "[[walls]]\nwkt = 'POINT (0 0)'\n[[bodies]]\nshape = 'a'\nat = [0, 0]\ncount = 2\n");
  EXPECT_EQ(loaded.errors(), 4) << faults(loaded);
}

TEST(Report, StopsAfterTwentyErrors) {
  std::string text = "throng = 1\n";
  for (int i = 0; i < 1000; ++i) text.append("x").append(std::to_string(i)).append(" = 1\n");
  EXPECT_EQ(load_text(text).errors(), 20);
}

// Once the report was full, what stood behind was read unchecked: a table that is none ended in a crash.
TEST(Report, ReadsNothingThatItDidNotCheck) {
  std::string text = "throng = 1\n";
  for (int i = 0; i < 30; ++i) text.append("a").append(std::to_string(i)).append(" = 1\n");
  for (const char* field : {"bodies = [1]", "contact = 1", "domain = 1", "gravity = 1", "materials = 1",
                            "record = 1", "seed = []", "shapes.a = 1", "time = 1", "walls = [1]"})
    EXPECT_EQ(load_text(text + field).errors(), 20) << field;
}

TEST(Report, NamesTheOverrideInsteadOfAPlace) {
  EXPECT_EQ(
      faults(load_text(kEverything, {"time.dt=-1"})),
      "--set time.dt=-1: error: time.dt: must be a number from 1e-12 to 1e+06 s, and is the integer -1\n");
  EXPECT_EQ(faults(load_text(kEverything, {"bodies[0].at=[1, nan]"})),
            "--set bodies[0].at=[1, nan]: error: bodies[0].at[1]: must be a number from -1e+09 to 1e+09 m, "
            "and is the "
            "number nan\n");
}

// A key's own place was the file's: "s.toml: error: foo", for a foo that no file held.
TEST(Report, NamesTheOverrideThatBroughtAnUnknownKey) {
  for (const char* override_ : {"foo=1", "domain.foo=1", "a.b.c=1", "areas.a=1", "materials.ice.foo=1"})
    for (const std::string& text : {std::string("throng = 1\n"), kEverything}) {
      const Loaded loaded = load_text(text, {override_});
      EXPECT_EQ(faults(loaded).rfind(std::string("--set ") + override_ + ": error: ", 0), 0u)
          << faults(loaded);
    }
}

TEST(Report, TakesTheLettersOfAllAlphabetsFromOverrides) {
  EXPECT_EQ(load_text(kEverything, {"name=M\u00fcller"}).scene.name, "M\u00fcller");
  EXPECT_GT(load_text(kEverything, {"name=M\xff"}).errors(), 0);
}

TEST(Report, WarnsOfBordersThatHoldNobody) {
  const Loaded loaded = load_text(
      "throng = 1\ncontact.model = 'none'\ndomain.box = [[0, 0], [9, 9]]\n[[walls]]\nsegment = [[0, 0], [1, "
      "0]]\n");
  EXPECT_EQ(
      faults(loaded),
      "s.toml:3:14: warning: domain.box: holds nobody: contact.model is \"none\", and the box is only drawn\n"
      "s.toml:4:1: warning: walls: hold nobody: contact.model is \"none\", and they are only drawn\n");
}

TEST(Report, WarnsOfRollingThatNobodyDoes) {
  const auto said = [](const std::string& shape) {
    return faults(load_text("throng = 1\nmaterials.m.rolling_resistance = 0.5\nshapes.s." + shape +
                            "\n[[bodies]]\nshape = 's'\nat = [0, 0]\nmaterial = 'm'\n"));
  };
  EXPECT_EQ(
      said("polygon = [[0, 0], [1, 0], [1, 1], [0, 1]]"),
      "s.toml:2:34: warning: materials.m.rolling_resistance: has no meaning: it holds back discs, and no "
      "body is one\n");
  EXPECT_EQ(said("disc.radius = 1"), "");
  EXPECT_EQ(said("discs = [[0, 0, 1], [1, 0, 1]]"), "");
  const std::string empty = "throng = 1\nmaterials.m.rolling_resistance = 0.5\n";
  EXPECT_EQ(faults(load_text(empty)), "") << "nobody is there yet";
}

TEST(Report, WarnsOfSurfacesAndSleepWhereNobodyTouches) {
  const std::string none =
      "throng = 1\ncontact.model = 'none'\nsleep = true\nmaterials.default = { density = 2, friction = 0.1, "
      "rolling_resistance = 0.2, restitution = 0.3 }\nshapes.s.disc.radius = 1\n[[bodies]]\nshape = 's'\n"
      "at = [0, 0]\n";
  const std::string because = " has no meaning: contact.model is \"none\"";
  EXPECT_EQ(faults(load_text(none)),
            "s.toml:3:9: warning: sleep:" + because + ", and there is nothing to rest on\n" +
                "s.toml:4:47: warning: materials.default.friction:" + because + "\n" +
                "s.toml:4:73: warning: materials.default.rolling_resistance:" + because + "\n" +
                "s.toml:4:92: warning: materials.default.restitution:" + because + "\n");
  EXPECT_EQ(faults(load_text(none, {"contact.model = impulse"})), "");
}

TEST(Report, WarnsOfSleepWhereNothingRests) {
  const std::string disc = "throng = 1\nshapes.s.disc.radius = 1\nbodies = [{ shape = 's', at = [0, 0] }]\n";
  EXPECT_EQ(faults(load_text(disc + "engine = 'event_driven'\nsleep = true\n")),
            "s.toml:5:9: warning: sleep: has no meaning: with engine event_driven nobody falls asleep\n");
  EXPECT_EQ(faults(load_text(disc + "engine = 'event_driven'\nsleep = false\n")), "");
  EXPECT_EQ(faults(load_text(disc + "sleep = true\n")), "");
  EXPECT_EQ(faults(load_text(disc + "sleep = true\ncontact = { model = 'spring', stiffness = 1e4 }\n")),
            "s.toml:4:9: warning: sleep: has no meaning: soft contacts keep bodies awake\n");
  EXPECT_EQ(faults(load_text(disc + "sleep = true\ngravity = [0, -9.81]\n")), "");
}

/// It happened: of a single body it gave 0, and nothing was said.
TEST(Report, WarnsOfARandomVelocityOfASingleBody) {
  const std::string disc =
      "throng = 1\nshapes.s.disc.radius = 1\n[[bodies]]\nshape = 's'\nvelocity = { maxwell = 1 }\n";
  EXPECT_EQ(
      faults(load_text(disc + "at = [0, 0]\n")),
      "s.toml:5:12: warning: bodies[0].velocity: leaves a single body at rest: the entry's momentum, all "
      "that it has, is removed\n");
  EXPECT_EQ(faults(load_text(disc + "at = [0, 0]\n", {"bodies[0].velocity.maxwell = 0"})), "");
  EXPECT_EQ(faults(load_text(disc + "count = 2\nplace.random.within = [[0, 0], [9, 9]]\n")), "");
}

// It happened: all behind the 20th were dropped without a word.
TEST(Report, SaysHowManyWarningsItKeepsToItself) {
  const auto last_line = [](const std::string& said) {
    return said.substr(said.rfind('\n', said.size() - 2) + 1);
  };
  const std::string twenty = faults(load_text(with_standers(20)));
  EXPECT_EQ(std::ranges::count(twenty, '\n'), 20) << twenty;
  EXPECT_EQ(last_line(twenty).rfind("s.toml:102:17: warning: agents[19].desired_speed: ", 0), 0u) << twenty;
  EXPECT_EQ(last_line(faults(load_text(with_standers(21)))), "s.toml: warning: there is 1 more warning\n");
  const std::string more = faults(load_text(with_standers(25)));
  EXPECT_EQ(std::ranges::count(more, '\n'), 21) << more;
  EXPECT_EQ(last_line(more), "s.toml: warning: there are 5 more warnings\n");
}

// It happened: 21 shapes that nothing is of left no room for what matters.
TEST(Report, WarnsOfUnusedNamesLastAndInOneLine) {
  const auto with = [](const std::string& text, int shapes, int from = 0) {
    std::string all = text + "[shapes]\n";
    for (int i = 0; i < shapes; ++i) all += "s" + std::to_string(from + i) + ".disc.radius = 1\n";
    return faults(load_text(all));
  };
  const std::string one = with_standers(1), is = "s.toml:10:1: warning: shapes";
  const auto behind_the_first = [](const std::string& said) { return said.substr(said.find('\n') + 1); };
  EXPECT_EQ(behind_the_first(with(one, 1)), is + ".s0: is of no body\n");
  EXPECT_EQ(behind_the_first(with(one, 2)), is + ": s0 and s1 are of no body\n");
  EXPECT_EQ(behind_the_first(with(one, 3, 9)), is + ": s9, s10 and s11 are of no body\n") << "as they stand";
  EXPECT_EQ(behind_the_first(with(one, 21)), is + ": s0, s1 and 19 more are of no body\n");
  EXPECT_NE(with(one, 21).find("agents[0].desired_speed: is 0"), std::string::npos);
  const std::string full = with("time.substeps = 3\n" + with_standers(19), 21);  // which is looked at late
  EXPECT_NE(full.find("time.substeps: has no meaning"), std::string::npos) << full;
  EXPECT_NE(full.find("there is 1 more warning"), std::string::npos) << full;
}

TEST(Report, RefusesOverridesThatLeadNowhere) {
  for (const char* bad :
       {"", "time.dt", "=1", "time..dt=1", ".time=1", "time.=1", "bodies[9].spin=1", "bodies[x].spin=1",
        "bodies[0=1", "name.first=1", "\"time=1", "bodies[-1].spin=1", "bodies[].spin=1", "time.dt.x=1"}) {
    const Loaded loaded = load_text(kEverything, {bad});
    EXPECT_EQ(loaded.errors(), 1) << bad << "\n" << faults(loaded);
    EXPECT_EQ(faults(loaded).rfind(std::string("--set ") + bad + ": error: ", 0), 0u) << faults(loaded);
  }
}

TEST(Report, LetsNoOverrideBringASecondKey) {
  const Loaded loaded = load_text(kEverything, {"name='a'\nseed=99"});
  EXPECT_EQ(loaded.scene.seed, 7u);
  EXPECT_EQ(loaded.scene.name, "'a'?seed=99");
}

TEST(Report, SuggestsOnlyWhatIsNear) {
  EXPECT_EQ(suggestion("radus", {"radius", "at"}), ", did you mean \"radius\"?");
  EXPECT_EQ(suggestion("gravtiy", {"record", "gravity"}), ", did you mean \"gravity\"?");
  EXPECT_EQ(suggestion("tmie", {"name", "time"}), ", did you mean \"time\"?") << "two letters swapped";
  EXPECT_EQ(suggestion("spin", {"open", "sleep", "time"}), "") << "half of it is another word";
  EXPECT_EQ(suggestion("zzzzzz", {"radius", "at"}), "");
  EXPECT_EQ(suggestion("x", {}), "");
}

TEST(Report, QuotesAStrangersTextSafely) {
  EXPECT_EQ(in_quotes("a\x1b[31m\n"), "\"a?[31m?\"");
  EXPECT_LT(in_quotes(std::string(1'000'000, 'x')).size(), 80u);
}

}  // namespace throng::scenarios
