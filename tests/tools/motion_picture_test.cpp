// SPDX-License-Identifier: MIT
// What the pictures of throng motion show of what was proven.
#include <gmock/gmock.h>

#include <algorithm>
#include <array>

#include "tests/tools/motion_program.h"
#include "tests/tools/picture.h"

namespace throng {
namespace {

constexpr std::array<int, 3> kWhite{255, 255, 255};

/// As what is proven free is painted, between its ticks.
bool is_proven(const std::array<int, 3>& colour) {
  const auto [red, green, blue] = colour;
  return blue > green && green > red && red < 220 && red > 100;
}

bool is_dark(const std::array<int, 3>& colour) {
  return std::ranges::max(colour) < 110;
}

class MotionPicture : public MotionCommand {
 protected:
  Picture draw(const std::string& text) const {
    ask(text, "--png " + path("m.png"));
    return Picture(path("m.png"));
  }
};

/// A row of pixels through the lowest lane: above the lowest row with a pixel of what is proven; 0: there is
/// none.
int lowest_lane(const Picture& picture) {
  const int from = static_cast<int>(0.3 * picture.width()), to = static_cast<int>(0.95 * picture.width());
  for (int y = picture.height() - 1; y > 0; --y)
    for (int x = from; x < to; ++x)
      if (is_proven(picture.at(x, y))) return y - static_cast<int>(0.006 * picture.width());
  return 0;
}

/// The share of that row's pixels, from one fraction of the picture's width to another, of which something
/// holds.
template <class Holds>
double share(const Picture& picture, double from, double to, const Holds& holds) {
  const int y = lowest_lane(picture);
  const int first = static_cast<int>(from * picture.width()), last = static_cast<int>(to * picture.width());
  int count = 0;
  for (int x = first; x < last; ++x) count += holds(x, y);
  return static_cast<double>(count) / (last - first);
}

// It happened: each of thousands of segments was drawn with its borders and its ticks, black upon black.
TEST_F(MotionPicture, ShowsWhatIsProvenOfALongPath) {
  std::string waypoints;
  for (int i = 0; i < 3001; ++i) waypoints += "[" + std::to_string(0.001 * i) + ", 0],";
  const Picture picture = draw(
      "shapes.ball.disc.radius = 0.5\n[[obstacles]]\nshape = 'ball'\nat = [2, 3]\n"
      "[[bodies]]\nshape = 'ball'\nwaypoints = [" +
      waypoints + "]\n");
  const auto proven = [&](int x, int y) { return is_proven(picture.at(x, y)); };
  const auto dark = [&](int x, int y) { return is_dark(picture.at(x, y)); };
  EXPECT_GT(share(picture, 0.3, 0.95, proven), 0.5);
  EXPECT_LT(share(picture, 0.3, 0.95, dark), 0.4);
}

// It happened: a segment that hits showed no more than the few distances by which the hit was found.
TEST_F(MotionPicture, ShowsThatAllBeforeTheFirstContactIsProven) {
  const Picture picture = draw(R"(shapes.ball.disc.radius = 0.5
[[obstacles]]
shape = "ball"
at = [9, 0]
[[obstacles]]
shape = "ball"
at = [4, 1.1]
[[bodies]]
shape = "ball"
waypoints = [[0, 0], [10, 0]]
)");  // first contact at 0.8
  const auto proven = [&](int x, int y) { return is_proven(picture.at(x, y)); };
  const auto white = [&](int x, int y) { return picture.at(x, y) == kWhite; };
  EXPECT_GT(share(picture, 0.25, 0.75, proven), 0.9);
  EXPECT_GT(share(picture, 0.86, 0.95, white), 0.9);
}

}  // namespace
}  // namespace throng
