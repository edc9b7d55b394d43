// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "tests/scenarios/scenario_texts.h"

namespace throng {

using testing::faults;
using testing::load_text;

namespace {

/// A body with id 1, then guests 2 and 3, staff 4, guest 5, and 6, whom nobody has named.
const std::string kNamed =
    "throng = 1\nwalkable = [[0, 0], [20, 0], [20, 5], [0, 5]]\n"
    "areas = { start = [[0, 0], [9, 0], [9, 5], [0, 5]], exit = [[18, 0], [20, 0], [20, 5], [18, 5]] }\n"
    "[shapes]\npillar.disc.radius = 0.3\n[[bodies]]\nshape = 'pillar'\nat = [15, 1]\nkind = 'static'\n";

std::string agents(const std::string& more) {
  return "[[agents]]\nmodel = 'orca'\ngoal = 'exit'\nplace.random.within = 'start'\n" + more;
}

std::string crowd() {
  return kNamed + agents("name = 'guests'\ncount = 2\n") + agents("name = 'staff'\n") +
         agents("name = 'guests'\n") + agents("");
}

std::vector<std::uint32_t> who_senses(const std::string& of) {
  const Loaded loaded = load_text(crowd() + "[[sensors]]\nname = 'eyes'\nradius = 3\nof = " + of + "\n");
  EXPECT_EQ(loaded.errors(), 0) << faults(loaded);
  return loaded.errors() == 0 ? loaded.scene.sensors[0].ids : std::vector<std::uint32_t>();
}

}  // namespace

TEST(GroupNames, SayWhoHasASensorAndWhoIsRecorded) {
  EXPECT_EQ(who_senses("{ group = 'guests' }"), (std::vector<std::uint32_t>{2, 3, 5}));
  EXPECT_EQ(who_senses("{ group = ['staff', 'guests'] }"), (std::vector<std::uint32_t>{2, 3, 4, 5}));
  EXPECT_EQ(who_senses("{ group = 'guests', ids = [1, 3, 4, 5, 6] }"), (std::vector<std::uint32_t>{3, 5}));
  const Loaded loaded = load_text(crowd() + "[record]\nof.group = 'staff'\n");
  ASSERT_EQ(loaded.errors(), 0) << faults(loaded);
  EXPECT_EQ(loaded.scene.record.ids, (std::vector<std::uint32_t>{4}));
}

TEST(GroupNames, ThatNobodyHasAreRefused) {
  const auto fault = [](const std::string& of) {
    return faults(load_text(crowd() + "[[sensors]]\nname = 'eyes'\nradius = 3\nof = " + of + "\n"));
  };
  EXPECT_NE(fault("{ group = 'gests' }")
                .find("sensors[0].of.group: no [[agents]] are called \"gests\", did you mean "
                      "\"guests\"?"),
            std::string::npos)
      << fault("{ group = 'gests' }");
  EXPECT_NE(fault("{ group = ['staff', ''] }").find("no [[agents]] are called \"\""), std::string::npos);
  EXPECT_NE(fault("{ group = 'guests', kind = 'static' }").find("sensors[0].of: fits no body"),
            std::string::npos);
}

}  // namespace throng
