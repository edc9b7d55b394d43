// SPDX-License-Identifier: MIT
#include "scenarios/difference.h"

#include <gtest/gtest.h>

namespace throng {
namespace {

std::string difference(const std::string& one, const std::string& other) {
  const auto found = scenario_difference(one, other);
  return found ? found->field + ": " + found->one + ", " + found->other : "";
}

TEST(Difference, IsNoneOfEqualScenariosWhateverTheirEnd) {
  EXPECT_EQ(difference("a = 1\n\n[time]\nuntil = 1.0\n", "a = 1\n"), "");
  EXPECT_EQ(difference("a = 1\n[time]\ndt = 1.0\nuntil = 1.0\n", "a = 1\n[time]\ndt = 1.0\nuntil = 2.0"), "");
}

TEST(Difference, NamesTheFieldAndBothValues) {
  EXPECT_EQ(difference("a = 1\nb = 2\n", "a = 1\nb = 3\n"), "b: 2, 3");
  EXPECT_EQ(difference("throng = 1\n", "sleep = false\nthrong = 1\n"), "sleep: absent, false");
  EXPECT_EQ(difference("[time]\ndt = 0.1\n", "[time]\ndt = 0.2\n"), "time.dt: 0.1, 0.2");
  EXPECT_EQ(difference("[[bodies]]\nat = [1, 2]\n", "[[bodies]]\nat = [1, 3]\n"),
            "bodies[0].at: [1, 2], [1, 3]");
}

TEST(Difference, NamesWholeTablesThatOneLacks) {
  const std::string ball = "[[bodies]]\nshape = \"ball\"\n";
  EXPECT_EQ(difference(ball, ball + ball), "bodies[1]: absent, given");
  EXPECT_EQ(difference("[materials.ice]\nfriction = 0.1\n", ""), "materials: given, absent");
  EXPECT_EQ(difference("[domain]\nbox = [[0, 0], [1, 1]]\n", "domain = \"none\"\n"),
            "domain: given, \"none\"");
}

TEST(Difference, TellsOfSimpleFieldsBeforeTables) {
  EXPECT_EQ(difference("name = \"a\"\n[domain]\nx = 1\n", "name = \"b\"\n"), "name: \"a\", \"b\"");
}

TEST(Difference, IsShortAndNeedsNoTOML) {
  EXPECT_EQ(difference("a = \"" + std::string(99, 'x') + "\"", "a = 1"), "a: given, 1");
  EXPECT_EQ(difference("a = [", "a = 1"), "the text: none, TOML");
}

}  // namespace
}  // namespace throng
