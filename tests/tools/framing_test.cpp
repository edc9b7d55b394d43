// SPDX-License-Identifier: MIT
#include "tools/framing.h"

#include <gtest/gtest.h>

namespace throng::tools {
namespace {

Scene discs(std::size_t n) {
  Scene scene;
  scene.bodies.radius.assign(n, 0.5);
  scene.bodies.shape.assign(n, 0);
  return scene;
}

std::vector<Vec> square(int side) {
  std::vector<Vec> positions;
  for (int i = 0; i < side * side; ++i) positions.push_back({i % side, i / side});
  return positions;
}

TEST(Framing, ShowsAllBodiesWithLittleAround) {
  const Extent shown = framing(discs(400), square(20));
  EXPECT_LE(shown.min.x(), -0.5);
  EXPECT_GE(shown.max.y(), 19.5);
  EXPECT_LT(shown.size().maxCoeff(), 22);
}

TEST(Framing, LeavesOutAFewThatEscaped) {
  std::vector<Vec> positions = square(20);
  positions[7] = {1e7, -1e9};
  EXPECT_LT(framing(discs(400), positions).size().maxCoeff(), 22);
}

TEST(Framing, ShowsTheFloorAndTheSidesOfABoxButNotItsEmptyTop) {
  Scene scene = discs(400);
  scene.domain = {DomainKind::box, {-0.5, -0.5}, {19.5, 200}};
  const Extent shown = framing(scene, square(20));
  EXPECT_LE(shown.min.x(), -0.5);
  EXPECT_LE(shown.min.y(), -0.5);
  EXPECT_LT(shown.max.y(), 25);
}

TEST(Framing, ShowsAllOfABoxThatIsFull) {
  Scene scene = discs(400);
  scene.domain = {DomainKind::box, {-3, -3}, {22, 22}};
  const Extent shown = framing(scene, square(20));
  EXPECT_LE(shown.min.x(), -3);
  EXPECT_GE(shown.max.y(), 22);
}

// A goal that nobody has come near yet was once cut off.
TEST(Framing, ShowsAllOfTheFloorThatAgentsWalkOn) {
  Scene scene = discs(400);
  scene.bodies.kind.assign(400, BodyKind::agent);
  scene.walls = {{{{-1, -1}, {21, -1}, {21, 90}, {-1, 90}}, true, 0}};
  const Extent shown = framing(scene, square(20));
  EXPECT_LE(shown.min.y(), -1);
  EXPECT_GE(shown.max.y(), 90);
  EXPECT_LT(shown.size().maxCoeff(), 100);
}

// The floor of circle_swap, a domain's box without walls, was once shown a metre wide.
TEST(Framing, ShowsTheFloorThatIsABox) {
  Scene scene = discs(400);
  scene.bodies.kind.assign(400, BodyKind::agent);
  scene.domain = {DomainKind::box, {-10, -10}, {30, 30}};
  scene.crowd.walkable = {{{{-10, -10}, {30, -10}, {30, 30}, {-10, 30}}}};
  const Extent shown = framing(scene, square(20));
  EXPECT_LE(shown.min.x(), -10);
  EXPECT_GE(shown.max.y(), 30);
  EXPECT_LT(shown.size().maxCoeff(), 45);
}

TEST(Framing, ShowsTheWallsWhereTheCrowdIsAndNotThoseFarAway) {
  Scene scene = discs(400);
  scene.walls = {{{{-5, 0}, {-5, 30}}, false, 0}, {{{1000, 0}, {1000, 30}}, false, 0}};
  const Extent shown = framing(scene, square(20));
  EXPECT_LE(shown.min.x(), -5);
  EXPECT_GE(shown.max.y(), 30);
  EXPECT_LT(shown.size().maxCoeff(), 34);
}

TEST(Framing, ShowsAllOfAPeriodicDomain) {
  Scene scene = discs(400);
  scene.domain = {DomainKind::periodic, {0, 0}, {200, 100}};
  const Extent shown = framing(scene, square(20));
  EXPECT_LE(shown.min.x(), 0);
  EXPECT_GE(shown.max.x(), 200);
  EXPECT_GE(shown.max.y(), 100);
  EXPECT_LT(shown.size().maxCoeff(), 210);
}

TEST(Framing, ShowsTheDomainOrTheWallsWhereNobodyIs) {
  Scene scene;
  scene.walls = {{{{-5, 0}, {7, 3}}, false, 0}};
  const Extent walls = framing(scene, {});
  EXPECT_LE(walls.min.x(), -5);
  EXPECT_GE(walls.max.x(), 7);
  EXPECT_LT(walls.size().maxCoeff(), 13);
  scene.domain = {DomainKind::box, {-100, -100}, {100, 100}};
  EXPECT_LE(framing(scene, {}).min.x(), -100);
}

TEST(Framing, ShowsTheDomainWhereAllHaveLeftIt) {
  Scene scene = discs(400);
  scene.domain = {DomainKind::box, {100, 100}, {130, 130}};
  const Extent shown = framing(scene, square(20));
  EXPECT_LE(shown.min.x(), 100);
  EXPECT_GE(shown.max.x(), 130);
}

TEST(Framing, GivesALineSomeHeight) {
  std::vector<Vec> line;
  for (int i = 0; i < 400; ++i) line.push_back({i, 7});
  const Extent shown = framing(discs(400), line);
  EXPECT_GT(shown.size().y(), 50);
  EXPECT_NEAR((shown.min.y() + shown.max.y()) / 2, 7, 1e-9);
}

TEST(Framing, IsNeverEmpty) {
  Scene none;
  EXPECT_GT(framing(none, {}).size().minCoeff(), 0);
  const std::vector<Vec> one{{1e6, 1e6}};
  Scene point = discs(1);
  point.bodies.radius[0] = 1e-6;
  EXPECT_GT(framing(point, one).size().minCoeff(), 0);
  EXPECT_LT(framing(point, one).size().maxCoeff(), 1.0);
}

}  // namespace
}  // namespace throng::tools
