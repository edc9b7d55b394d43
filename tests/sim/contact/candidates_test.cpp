// SPDX-License-Identifier: MIT
// Candidates against the definition: all pairs of colliders whose discs may meet within the step.
#include "sim/contact/candidates.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "tests/sim/scene_from.h"

namespace throng {
namespace {

using broadphase::Pair;

/// Bodies of every kind and size, thrown together so that many touch.
std::string crowd(const std::string& domain) {
  return "seed = 3\ndomain = " + domain +
         "\n[shapes]\nball = { disc = { radius = { uniform = [0.1, 0.6] } } }\n"
         "brick = { polygon = [[0, 0], [1, 0], [1, 0.4], [0, 0.4]] }\n"
         "ell = { polygon = [[0, 0], [1, 0], [1, 0.3], [0.3, 0.3], [0.3, 1], [0, 1]] }\n"
         "pair = { discs = [[0, 0, 0.3], [0.5, 0, 0.2]] }\n"
         "[[bodies]]\nshape = \"ball\"\ncount = 150\nvelocity = { maxwell = 2 }\nplace = { random = { within "
         "= [[0, 0], [20, 20]] } }\n"
         "[[bodies]]\nshape = \"brick\"\ncount = 60\nplace = { random = { within = [[0, 0], [20, 20]] } }\n"
         "[[bodies]]\nshape = \"ell\"\ncount = 40\nplace = { random = { within = [[0, 0], [20, 20]] } }\n"
         "[[bodies]]\nshape = \"pair\"\ncount = 40\nspin = 3\nplace = { random = { within = [[0, 0], [20, "
         "20]] } }\n"
         "[[bodies]]\nshape = \"brick\"\ncount = 10\nkind = \"kinematic\"\nplace = { random = { within = "
         "[[0, 0], [20, 20]] } }\n"
         "[[bodies]]\nshape = \"brick\"\ncount = 10\nkind = \"static\"\nplace = { random = { within = [[0, "
         "0], [20, 20]] } }\n";
}

Vec part_centre(const Colliders& colliders, const State& state, std::uint32_t row) {
  const std::uint32_t body = colliders.body[row];
  return narrowphase::pose(state.position[body], state.angle[body]) * colliders.centre[row];
}

/// The pairs that must be there: discs as they stand overlap. Candidates may hold more, by their margins.
std::vector<Pair> overlapping(const Candidates& candidates, const State& state) {
  const Colliders& colliders = candidates.colliders();
  std::vector<Pair> pairs;
  for (std::uint32_t a = 0; a < colliders.size(); ++a)
    for (std::uint32_t b = a + 1; b < colliders.size(); ++b) {
      if (colliders.body[a] == colliders.body[b] || !(colliders.movable[a] || colliders.movable[b])) continue;
      const Vec between =
          part_centre(colliders, state, b) - part_centre(colliders, state, a) + candidates.shift({a, b});
      if (between.norm() < colliders.radius[a] + colliders.radius[b]) pairs.push_back({a, b});
    }
  return pairs;
}

class Domains : public ::testing::TestWithParam<const char*> {};

TEST_P(Domains, HoldAllPairsThatMayTouchEachOnceAndNoneThatCannot) {
  const Scene scene = scene_from(crowd(GetParam()));
  const Plan plan = plan_for(scene);
  Workers alone(1);
  Candidates candidates(scene, plan, alone);
  const State state = initial_state(scene);
  candidates.find(state, scene.time.dt);
  const std::vector<Pair> must = overlapping(candidates, state);
  const std::vector<Pair> found(candidates.pairs().begin(), candidates.pairs().end());
  EXPECT_GT(must.size(), 50u) << "a crowd too thin to test anything";
  EXPECT_TRUE(std::ranges::includes(found, must));
  EXPECT_EQ(std::ranges::adjacent_find(found, std::greater_equal<>()), found.end()) << "ascending, each once";
  const Colliders& colliders = candidates.colliders();
  for (const Pair& pair : found) {
    EXPECT_NE(colliders.body[pair.a], colliders.body[pair.b]);
    EXPECT_TRUE(colliders.movable[pair.a] || colliders.movable[pair.b]);
    const Vec between = part_centre(colliders, state, pair.b) - part_centre(colliders, state, pair.a) +
                        candidates.shift(pair);
    EXPECT_LT(between.norm(),
              colliders.radius[pair.a] + colliders.radius[pair.b] + candidates.reach(pair) + 1e-9);
  }
}

TEST_P(Domains, HoldTheObstaclesThatBodiesMayTouch) {
  const Scene scene = scene_from(crowd(GetParam()));
  const Plan plan = plan_for(scene);
  Workers alone(1);
  Candidates candidates(scene, plan, alone);
  const State state = initial_state(scene);
  candidates.find(state, scene.time.dt);
  const Obstacles& obstacles = candidates.obstacles();
  const std::size_t sides = obstacles.side.size();
  std::size_t must = 0;
  for (std::uint32_t i = 0; i < candidates.colliders().size(); ++i) {
    if (!candidates.colliders().movable[i]) continue;
    const Vec c = part_centre(candidates.colliders(), state, i);
    const double r = candidates.colliders().radius[i];
    const Eigen::AlignedBox2d box(c.array() - r, c.array() + r);
    for (std::uint32_t o = 0; o < obstacles.size(); ++o) {
      const bool near = o < sides ? obstacles.side[o].normal.dot(c - obstacles.side[o].point) < r
                                  : box.intersects(bounds(obstacles.part[o - sides]));
      if (!near) continue;
      ++must;
      EXPECT_TRUE(std::ranges::binary_search(candidates.obstacle_pairs(), Pair{i, o})) << i << ", " << o;
    }
  }
  EXPECT_GT(must, 5u);
}

/// Those of so few that each is compared with each, and those that a grid finds among one more, far away.
TEST(Candidates, AreTheSameWhoeverIsFarAway) {
  for (const std::string domain : {"", "domain = { periodic = [[0, 0], [60, 60]] }\n"}) {
    const std::string few =
        domain +
        "[shapes]\nball = { disc = { radius = { uniform = [0.1, 0.3] } } }\n"
        "[[bodies]]\nshape = \"ball\"\ncount = 22\nvelocity = { maxwell = 2 }\nplace = { random = { within = "
        "[[0, 0], [3, 3]] } }\n"
        "[[bodies]]\nshape = \"ball\"\ncount = 8\nkind = \"kinematic\"\nplace = { random = { within = "
        "[[0, 0], [3, 3]] } }\n"
        "[[bodies]]\nshape = \"ball\"\nkind = \"kinematic\"\nat = [30, 30]\n"
        "[[bodies]]\nshape = \"ball\"\nkind = \"kinematic\"\nat = [30.1, 30]\n";
    std::vector<std::size_t> sizes;
    const auto pairs_of = [&](const std::string& text) {
      const Scene scene = scene_from(text);
      const Plan plan = plan_for(scene);
      Workers alone(1);
      Candidates candidates(scene, plan, alone);
      candidates.find(initial_state(scene), 0.2);
      sizes.push_back(candidates.colliders().size());
      return std::vector<Pair>(candidates.pairs().begin(), candidates.pairs().end());
    };
    const std::vector<Pair> pairs = pairs_of(few);
    EXPECT_GT(pairs.size(), 10u);
    EXPECT_EQ(pairs, pairs_of(few + "[[bodies]]\nshape = \"ball\"\nkind = \"kinematic\"\nat = [40, 40]\n"));
    EXPECT_EQ(sizes, (std::vector<std::size_t>{32, 33}));
  }
}

/// Once only the middle of a bar counted: its ends were seen when they were in the wall already.
TEST(Candidates, ReachAsFarAsCornersTurn) {
  Scene scene = scene_from(crowd("{ box = [[0, 0], [20, 20]] }"));
  const Plan plan = plan_for(scene);
  Workers alone(1);
  Candidates candidates(scene, plan, alone);
  State state = initial_state(scene);
  for (std::size_t i = 0; i < state.spin.size(); ++i) {
    state.velocity[i] = Vec(0.0, 0.0);
    state.spin[i] = 100.0 * (static_cast<double>(i % 7) - 3.0);  // up to half a turn in a step
  }
  const double dt = scene.time.dt;
  candidates.find(state, dt);
  const Colliders& colliders = candidates.colliders();
  int turned = 0;
  for (std::uint32_t i = 0; i < colliders.size(); ++i) {
    if (is_disc(colliders, i)) continue;
    const std::uint32_t body = colliders.body[i];
    const double before = state.angle[body], after = before + dt * state.spin[body];
    for (const double direction : {0.0, 0.7, 1.4, 2.1, 2.8, 3.5, 4.2, 4.9, 5.6}) {
      const Vec side(std::cos(direction), std::sin(direction));
      const auto farthest = [&](double angle) {
        double most = -1e9;
        for (const Vec& v : colliders.shape[i]->vertices)
          most = std::max(most, side.dot(narrowphase::pose({0, 0}, angle).rotate(v)));
        return most;
      };
      const double nearer = farthest(after) - farthest(before);
      EXPECT_LE(nearer, candidates.reach(i) + 1e-12) << i;
      turned += nearer > 0.3;
    }
  }
  EXPECT_GT(turned, 50) << "nobody turned far";
}

INSTANTIATE_TEST_SUITE_P(Candidates, Domains,
                         ::testing::Values("{ box = [[0, 0], [20, 20]] }",
                                           "{ periodic = [[0, 0], [20, 20]] }"),
                         [](const auto& scene) { return scene.index == 0 ? "Box" : "Periodic"; });

}  // namespace
}  // namespace throng
