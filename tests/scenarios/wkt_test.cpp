// SPDX-License-Identifier: MIT
#include "scenarios/wkt.h"

#include <gtest/gtest.h>

namespace throng::scenarios {

TEST(Wkt, ReadsLines) {
  const Wkt wkt = read_wkt("LineString(0 0,1.5 -2e1 , +3 4)");
  EXPECT_EQ(wkt.refusal, "must have a number from -1e+09 to 1e+09 here (character 27)")
      << "from_chars takes no plus";
  const Wkt good = read_wkt(" LineString ( 0 0 ,1.5 -2e1,\n3\t4 ) ");
  ASSERT_EQ(good.refusal, "");
  ASSERT_EQ(good.lines.size(), 1u);
  EXPECT_EQ(good.lines[0].points, (std::vector<Vec>{{0, 0}, {1.5, -20}, {3, 4}}));
  EXPECT_FALSE(good.lines[0].closed);
}

TEST(Wkt, ClosesALineThatEndsWhereItBegan) {
  const Wkt wkt = read_wkt("LINESTRING (0 0, 1 0, 1 1, 0 0)");
  ASSERT_EQ(wkt.refusal, "");
  EXPECT_TRUE(wkt.lines.at(0).closed);
  EXPECT_EQ(wkt.lines[0].points.size(), 3u);
}

TEST(Wkt, KeepsALineThatGoesOutAndBack) {
  const Wkt wkt = read_wkt("LINESTRING (0 0, 1 0, 0 0)");
  ASSERT_EQ(wkt.refusal, "");
  EXPECT_FALSE(wkt.lines.at(0).closed);
  EXPECT_EQ(wkt.lines[0].points, (std::vector<Vec>{{0, 0}, {1, 0}, {0, 0}}));
}

TEST(Wkt, ReadsEveryRingOfAPolygon) {
  const Wkt wkt = read_wkt("POLYGON ((0 0, 9 0, 9 9, 0 0), (5 2, 6 2, 6 3, 5 2))");
  ASSERT_EQ(wkt.refusal, "");
  ASSERT_EQ(wkt.lines.size(), 2u);
  EXPECT_TRUE(wkt.lines[0].closed && wkt.lines[1].closed);
  EXPECT_EQ(wkt.lines[1].points, (std::vector<Vec>{{5, 2}, {6, 2}, {6, 3}}));
}

TEST(Wkt, ReadsMultiForms) {
  EXPECT_EQ(read_wkt("MULTILINESTRING ((0 0, 1 0), (2 0, 3 0))").lines.size(), 2u);
  EXPECT_EQ(read_wkt("MULTIPOLYGON (((0 0, 1 0, 1 1, 0 0)), ((5 0, 6 0, 6 1, 5 0), (5 0, 6 0, 6 1, 5 0)))")
                .lines.size(),
            3u);
  EXPECT_EQ(read_wkt("LINEARRING (0 0, 1 0, 1 1, 0 0)").lines.size(), 1u);
}

TEST(Wkt, RefusesEveryTextCutShort) {
  const std::string whole = "MULTIPOLYGON (((0 0, 1 0, 1 1, 0 0)))";
  for (std::size_t end = 0; end < whole.size(); ++end)
    EXPECT_NE(read_wkt(whole.substr(0, end)).refusal, "") << whole.substr(0, end);
  EXPECT_EQ(read_wkt(whole).refusal, "");
}

TEST(Wkt, RefusesOtherDimensionsAndTypes) {
  for (const char* text :
       {"", "POINT (0 0)", "LINESTRING Z (0 0 0, 1 1 1)", "LINESTRING (0 0 0, 1 1 1)", "LINESTRING EMPTY",
        "SRID=4326;LINESTRING (0 0, 1 1)", "POLYGON (0 0, 1 0, 1 1, 0 0)", "LINESTRING (0,0 1,1)",
        "LINESTRING (inf 0, 1 1)", "LINESTRING (0 0, 1.5.5)", "LINESTRING (0 0, 1-5)", "LINESTRING (0 0)",
        "LINESTRING (0 0, 0 0)", "GEOMETRYCOLLECTION ()"})
    EXPECT_NE(read_wkt(text).refusal, "") << text;
}

}  // namespace throng::scenarios
