// SPDX-License-Identifier: MIT
#include "tools/ompl/problems.h"

#include <numbers>

namespace throng::ompl {

namespace {

using namespace narrowphase;

Convex box(const Vec& low, const Vec& high) {
  return convex({low, {high.x(), low.y()}, high, {low.x(), high.y()}});
}

const PartsBvh& add_shape(Problem& problem, std::vector<Convex> parts) {
  problem.parts.push_back(std::move(parts));
  problem.shapes.push_back(parts_bvh(problem.parts.back()));
  return problem.shapes.back();
}

/// Rooms of 1 m x 1 m. A letter opens a room's upper wall (u), its right one (r), or both (b).
constexpr int kRooms = 4;
constexpr const char* kDoors[kRooms] = {"rrru", "brr.", "rrru", "rrr."};

bool opens(char room, char wall) {
  return room == wall || room == 'b';
}

std::vector<Convex> walls() {
  constexpr double kThick = 0.01, kEnd = kRooms;
  std::vector<Convex> result{box({0, -kThick}, {kEnd, kThick}), box({-kThick, 0}, {kThick, kEnd})};
  for (int y = 0; y < kRooms; ++y)
    for (int x = 0; x < kRooms; ++x) {
      if (!opens(kDoors[y][x], 'u') || y + 1 == kRooms)
        result.push_back(box({x + 0.0, y + 1 - kThick}, {x + 1.0, y + 1 + kThick}));
      if (!opens(kDoors[y][x], 'r') || x + 1 == kRooms)
        result.push_back(box({x + 1 - kThick, y + 0.0}, {x + 1 + kThick, y + 1.0}));
    }
  return result;
}

}  // namespace

void make_maze(Problem& problem) {
  problem.name = "bracket in a maze";
  problem.in_se2 = true;
  problem.low = 0.0, problem.high = kRooms;
  problem.start = {0.5, 0.5, 0.0}, problem.goal = {0.5, kRooms - 0.5, 0.0};
  add_shape(problem, walls());
  const PartsBvh& bracket =
      add_shape(problem, {box({-0.25, -0.25}, {0.25, -0.15}), box({-0.25, -0.15}, {-0.15, 0.25})});
  problem.robot = free_body(bracket);
  problem.pairs = pairs_to_check(problem.robot, true);
}

void make_arm(Problem& problem) {
  constexpr int kLinks = 6;
  constexpr double kLength = 0.5;
  problem.name = "arm of 6 links";
  problem.in_se2 = false;
  problem.low = -2.8, problem.high = 2.8;
  problem.start.assign(kLinks, 0.0), problem.goal.assign(kLinks, 0.0);
  problem.goal[0] = 2.0;
  std::vector<Convex> posts;
  for (int ring = 3; ring <= 5; ++ring)
    for (int i = 0; i < 2 * ring; ++i) {
      const double angle = 2.0 * std::numbers::pi * (i + 0.5) / (2 * ring);
      const Vec at = pose({0.0, 0.0}, angle).rotate({0.55 * ring, 0.0});
      posts.push_back(box(at - Vec(0.005, 0.005), at + Vec(0.005, 0.005)));
    }
  add_shape(problem, std::move(posts));
  const PartsBvh& beam = add_shape(problem, {box({0.0, -0.02}, {kLength, 0.02})});
  for (int i = 0; i < kLinks; ++i) {
    Link link;
    link.shape = &beam, link.lower = problem.low, link.upper = problem.high;
    if (i > 0) link.parent = static_cast<std::uint32_t>(i - 1), link.at = {kLength, 0.0};
    problem.robot.push_back(link);
  }
  problem.pairs = pairs_to_check(problem.robot, true);
}

}  // namespace throng::ompl
