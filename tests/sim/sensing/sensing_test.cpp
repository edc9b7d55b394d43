// SPDX-License-Identifier: MIT
#include "sim/sensing/sensing.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "broadphase/brute_force.h"
#include "narrowphase/distance.h"
#include "sim/sensing/heading.h"
#include "sim/sensing/sight.h"
#include "sim/simulation.h"
#include "tests/less_when_watched.h"
#include "tests/sim/scene_from.h"

namespace throng {
namespace {

using testing::ElementsAre;

const std::string kSmallBall = "[shapes]\nball = { disc = { radius = 0.1 } }\n";

/// Bodies at these places.
std::string balls(const std::vector<Vec>& places, const std::string& more = "") {
  std::string text;
  for (const Vec& p : places)
    text += "[[bodies]]\nshape = \"ball\"\nat = [" + std::to_string(p.x()) + ", " + std::to_string(p.y()) +
            "]\n" + more;
  return text;
}

std::string sensor(const std::string& fields) {
  return "[[sensors]]\nname = \"s\"\nrecord = true\n" + fields + "\n";
}

/// What the first sensor of a scene finds at its start.
Sensed sensed_at_start(const Scene& scene, int threads = 1) {
  Sensing sensing(scene, threads);
  sensing.look(initial_state(scene));
  return sensing.sensed()[0];
}

// 1, 2 and 3 stand 1 apart on a line, 4 is 2 above 3.
const std::vector<Vec> kFour{{0, 0}, {1, 0}, {2, 0}, {2, 2}};

TEST(Sensing, FindsWhoIsWithinTheRadiusItsEndIncluded) {
  const Sensed found = sensed_at_start(scene_from(kSmallBall + balls(kFour) + sensor("radius = 2")));
  EXPECT_THAT(found.who, ElementsAre(1, 2, 3, 4));
  EXPECT_THAT(found.count, ElementsAre(2, 2, 3, 1));
  EXPECT_THAT(found.whom, ElementsAre(2, 3, 1, 3, 1, 2, 4, 3));
}

TEST(Sensing, IsOfThoseWhoHaveIt) {
  const Sensed found =
      sensed_at_start(scene_from(kSmallBall + balls(kFour) + sensor("radius = 1\nof = { ids = [4, 2] }")));
  EXPECT_THAT(found.who, ElementsAre(2, 4));
  EXPECT_THAT(found.count, ElementsAre(2, 0));
  EXPECT_THAT(found.whom, ElementsAre(1, 3));
}

TEST(Sensing, LooksAlongABodysAngle) {
  const std::string turned = kSmallBall + balls(kFour, "angle = 1.5707963267948966\n");
  EXPECT_THAT(sensed_at_start(scene_from(turned + sensor("radius = 9\nfov_degrees = 50"))).whom,
              ElementsAre(4));
  const std::string ahead = kSmallBall + balls(kFour, "angle = 0\n");
  EXPECT_THAT(sensed_at_start(scene_from(ahead + sensor("radius = 9\nfov_degrees = 60"))).count,
              ElementsAre(2, 1, 0, 0));
  EXPECT_THAT(sensed_at_start(scene_from(ahead + sensor("radius = 9\nfov_degrees = 120"))).count,
              ElementsAre(3, 1, 0, 0))
      << "4 is 63.4 degrees to the left of 2, and 45 of 1";
}

const std::string kHall =
    "walkable = \"POLYGON ((0 0, 20 0, 20 10, 0 10, 0 0))\"\n"
    "areas.exit = [[19, 0], [20, 0], [20, 10], [19, 10]]\n";

std::string agent(const Vec& at, double speed) {
  return "[[agents]]\nat = [" + std::to_string(at.x()) + ", " + std::to_string(at.y()) +
         "]\nmodel = \"constant_velocity\"\ngoal = \"exit\"\ndesired_speed = " + std::to_string(speed) + "\n";
}

TEST(Sensing, LooksWhereAnAgentWalksAndAllAroundWhereOneStands) {
  const Scene scene = scene_from(kHall + agent({5, 5}, 1) + agent({3, 5}, 0) + agent({7, 5}, 1) +
                                 sensor("radius = 4.5\nfov_degrees = 90"));
  const auto run = simulation(scene);
  run->step();
  const Sensed& found = run->sensed()[0];
  EXPECT_THAT(found.who, ElementsAre(1, 2, 3));
  EXPECT_THAT(found.count, ElementsAre(1, 2, 0));
  EXPECT_THAT(found.whom, ElementsAre(3, 1, 3));
}

TEST(Sensing, FindsNobodyBehindAWall) {
  const std::string wall = "[[walls]]\nsegment = [[1.5, -1], [1.5, 0.5]]\n";
  const Sensed found =
      sensed_at_start(scene_from(kSmallBall + balls(kFour) + wall + sensor("radius = 9\nsight = true")));
  EXPECT_THAT(found.count, ElementsAre(2, 2, 1, 3));
  EXPECT_THAT(found.whom, ElementsAre(2, 4, 1, 4, 4, 1, 2, 3));
}

/// Those in the same place alone, whom a wall through it hides.
TEST(Sensing, SeesWithARadiusOfZero) {
  const std::string bodies = kSmallBall + balls({{0, 0}, {0, 0}, {1, 0}});
  const std::string wall = "[[walls]]\nsegment = [[0, -1], [0, 1]]\n";
  for (const std::string sight : {"true", "\"bodies\""}) {
    const std::string sees = sensor("radius = 0\nsight = " + sight);
    EXPECT_THAT(sensed_at_start(scene_from(bodies + sees)).count, ElementsAre(1, 1, 0)) << sight;
    EXPECT_THAT(sensed_at_start(scene_from(bodies + wall + sees)).count, ElementsAre(0, 0, 0)) << sight;
  }
}

TEST(Sensing, FindsNobodyBehindABodyThatTheLineTouches) {
  const std::string sight = sensor("radius = 9\nsight = \"bodies\"");
  const Sensed found = sensed_at_start(scene_from(kSmallBall + balls(kFour) + sight));
  EXPECT_THAT(found.count, ElementsAre(2, 3, 2, 3)) << "2 stands between 1 and 3";
  EXPECT_THAT(found.whom, ElementsAre(2, 4, 1, 3, 4, 2, 4, 1, 2, 3));
  const std::string touching = "[shapes]\nball = { disc = { radius = 0.25 } }\n";
  EXPECT_THAT(sensed_at_start(scene_from(touching + balls({{0, 0}, {2, 0}, {1, 0.25}}) + sight)).count,
              ElementsAre(1, 1, 2));
  EXPECT_THAT(sensed_at_start(scene_from(touching + balls({{0, 0}, {2, 0}, {1, 0.26}}) + sight)).count,
              ElementsAre(2, 2, 2));
}

/// A bar across hides, along it doesn't; in a disc round it, it does.
TEST(Sensing, ShapesHideWhatTheyCoverAlone) {
  const std::string bar =
      "[shapes]\nball = { disc = { radius = 0.1 } }\nbar = { polygon = [[-1, -0.1], [1, -0.1], [1, 0.1], "
      "[-1, "
      "0.1]] }\n" +
      balls({{-3, 0.5}, {3, 0.5}}) + "[[bodies]]\nshape = \"bar\"\nat = [0, 0]\n";
  const std::string sight = sensor("radius = 9\nsight = \"bodies\"");
  EXPECT_THAT(sensed_at_start(scene_from(bar + "angle = 0\n" + sight)).count, ElementsAre(2, 2, 2));
  EXPECT_THAT(sensed_at_start(scene_from(bar + "angle = 1.5707963267948966\n" + sight)).count,
              ElementsAre(1, 1, 2));
}

TEST(Sensing, LooksAtTheStepsThatAreDue) {
  const Scene scene = scene_from(kSmallBall + balls(kFour) + sensor("radius = 2\nevery = 3"));
  const auto run = simulation(scene);
  for (int step = 0; step < 7; ++step) {
    EXPECT_EQ(run->sensed()[0].who.size(), step % 3 == 0 ? 4u : 0u) << step;
    run->step();
  }
  EXPECT_EQ(run->state().sensed[0], (SensedSum{12, 24}));
}

TEST(Sensing, CountsWithoutListsWhatIsNotRecorded) {
  const std::string walls = "[[walls]]\nsegment = [[1.5, -1], [1.5, 0.5]]\n";
  for (const std::string more : {"", "sight = true\n", "sight = \"bodies\"\n", "of = { ids = [4, 2] }\n",
                                 "of = { ids = [4, 2] }\nsight = true\n"}) {
    std::string text = kSmallBall + balls(kFour) + walls + sensor("radius = 2\n" + more);
    const Scene recorded = scene_from(text);
    const Scene counted = scene_from(text.replace(text.find("record = true"), 13, "record = false"));
    State one = initial_state(recorded), other = initial_state(counted);
    Sensing first(recorded, 1), second(counted, 1);
    first.sense(one), second.sense(other);
    EXPECT_EQ(one.sensed, other.sensed) << more;
    EXPECT_EQ(static_cast<std::size_t>(one.sensed[0].sensed), first.sensed()[0].whom.size()) << more;
    EXPECT_GT(one.sensed[0].sensed, 0) << more;
    EXPECT_TRUE(second.sensed().empty());
  }
}

TEST(Sensing, ChangesNothingOfTheMotion) {
  const std::string text =
      "time = { dt = 0.01, until = 1 }\n" + kHall + agent({5, 5}, 1) + agent({5, 5.5}, 1.2);
  const Scene without = scene_from(text), with = scene_from(text + sensor("radius = 3\nfov_degrees = 100"));
  const auto one = simulation(without), other = simulation(with);
  for (int step = 0; step < 100; ++step) one->step(), other->step();
  EXPECT_EQ(hash(one->state()), hash(other->state()));
  EXPECT_TRUE(one->sensed().empty());
}

TEST(Sensing, GoesOnWithItsSumsWhereItWasRestored) {
  const Scene scene = scene_from(kHall + agent({5, 5}, 1) + agent({3, 5}, 1.5) + sensor("radius = 1.96"));
  const auto whole = simulation(scene), again = simulation(scene);
  for (int step = 0; step < 10; ++step) whole->step();
  ASSERT_NE(again->sensed()[0], whole->sensed()[0]) << "they come nearer";
  ASSERT_TRUE(again->restore(whole->state()));
  EXPECT_EQ(again->sensed()[0], whole->sensed()[0]);
  whole->step(), again->step();
  EXPECT_EQ(again->state().sensed[0], whole->state().sensed[0]);
  EXPECT_EQ(whole->state().sensed[0].looks, 24);
}

/// 400 bodies that move and look anywhere, between walls, in a period or not; rows in any order.
TEST(Sensing, IsWhatTheDefinitionSays) {
  const unsigned seed = std::random_device{}();
  SCOPED_TRACE("seed " + std::to_string(seed));
  std::mt19937 random(seed);
  std::string ids = "400";
  for (int id = 3; id < 400; id += 5) ids += ", " + std::to_string(id);
  for (const bool periodic : {false, true}) {
    const Scene scene = scene_from(
        "seed = " + std::to_string(seed % 1000) + "\n" +
        (periodic ? "domain = { periodic = [[0, 0], [10, 10]] }\n" : "") +
        "walls = [ { segment = [[2, 1], [3, 7]] }, { segment = [[6, 5], [9, 6]] } ]\n" + kSmallBall +
        "[[bodies]]\nshape = \"ball\"\ncount = 400\nplace = { random = { within = [[0, 0], [10, 10]] } }\n"
        "angle = { uniform = [-3, 3] }\nvelocity = { maxwell = 1.0 }\n" +
        sensor("radius = 2\nfov_degrees = 150\nsight = true\nof = { ids = [" + ids + "] }"));
    State state = initial_state(scene);
    std::vector<std::size_t> order(state.id.size());
    for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
    std::shuffle(order.begin(), order.end(), random);
    const State straight = state;
    for (std::size_t row = 0; row < order.size(); ++row) {
      state.id[row] = straight.id[order[row]], state.position[row] = straight.position[order[row]];
      state.angle[row] = straight.angle[order[row]];
    }
    const broadphase::Period period{{0, 0}, {10, 10}};
    const broadphase::Period* its_period = periodic ? &period : nullptr;
    const Sight sight(scene.walls, periodic ? std::optional(period) : std::nullopt, 2.0);
    Sensed expected;
    std::size_t hidden = 0;
    for (const std::uint32_t id : scene.sensors[0].ids) {
      std::vector<std::uint32_t> whom;
      const Vec at = straight.position[id - 1], to = direction_of_angle(straight.angle[id - 1]);
      for (const auto& n :
           broadphase::brute_force::near(straight.position, broadphase::Place{at, to, id - 1},
                                         {.radius = 2.0, .view = field_of_view(150.0)}, its_period)) {
        sight.sees(at, straight.position[n.row]) ? whom.push_back(n.row + 1) : void(++hidden);
      }
      std::ranges::sort(whom);
      expected.who.push_back(id);
      expected.count.push_back(static_cast<std::uint32_t>(whom.size()));
      expected.whom.insert(expected.whom.end(), whom.begin(), whom.end());
    }
    EXPECT_GT(expected.whom.size(), 500u);
    EXPECT_GT(hidden, 20u);
    for (const int threads : {1, 3}) {
      Sensing sensing(scene, threads);
      sensing.sense(state);
      EXPECT_EQ(sensing.sensed()[0], expected) << threads;
    }
  }
}

/// Bodies of all sizes and kinds, turned anyhow, in a period or not, against a plain loop over all of them
/// and their images.
TEST(Sensing, FindsNobodyBehindBodiesAsTheDefinitionSays) {
  const unsigned seed = std::random_device{}();
  SCOPED_TRACE("seed " + std::to_string(seed));
  const std::string balls = std::to_string(50 + less_when_watched(100));
  for (const bool periodic : {false, true}) {
    const Scene scene = scene_from(
        "seed = " + std::to_string(seed % 1000) + "\n" +
        (periodic ? "domain = { periodic = [[-4, 2], [6, 12]] }\n" : "") +
        "[shapes]\nball = { disc = { radius = { uniform = [0.02, 0.1] } } }\n"
        "huge = { disc = { radius = 1.1 } }\nbar = { polygon = [[-1, -0.05], [1, -0.05], [1, 0.05], [-1, "
        "0.05]] }\n"
        "robot = { discs = [[0, 0, 0.1], [0.4, 0, 0.1]] }\n"
        "[[bodies]]\nshape = \"huge\"\nat = [-3.5, 2.5]\n"
        "[[bodies]]\nshape = \"bar\"\ncount = 4\nangle = { uniform = [-3, 3] }\n"
        "place = { random = { within = [[-2, 4], [6, 12]] } }\n"
        "[[bodies]]\nshape = \"robot\"\ncount = 10\nangle = { uniform = [-3, 3] }\n"
        "place = { random = { within = [[-2, 4], [6, 12]] } }\n"
        "[[bodies]]\nshape = \"ball\"\ncount = " +
        balls + "\nplace = { random = { within = [[-4, 4], [6, 12]] } }\n" +
        sensor("radius = 3\nsight = \"bodies\""));
    const State state = initial_state(scene);
    const Vec size = periodic ? Vec(10, 10) : Vec(0, 0);
    const auto nearest = [&](const Vec& d) {
      Vec best = d;
      for (int x = -1; x <= 1; ++x)
        for (int y = -1; y <= 1; ++y)
          if (const Vec image = d + Vec(x * size.x(), y * size.y()); image.squaredNorm() < best.squaredNorm())
            best = image;
      return best;
    };
    const auto hides = [&](std::size_t row, const Vec& half, const Vec& middle) {
      const Vec centre = nearest(state.position[row] - middle);
      const Shape& shape = scene.shapes[scene.bodies.shape[row]];
      const narrowphase::Convex line = narrowphase::segment(-half, half);
      if (shape.kind == ShapeKind::disc)
        return narrowphase::separation(line, {}, narrowphase::disc(scene.bodies.radius[row]), {centre})
                   .distance <= 0.0;
      return std::ranges::any_of(shape.parts, [&](const narrowphase::Convex& part) {
        return narrowphase::separation(line, {}, part, narrowphase::pose(centre, state.angle[row]))
                   .distance <= 0.0;
      });
    };
    Sensed expected;
    std::size_t near = 0;
    for (std::uint32_t a = 0; a < state.id.size(); ++a) {
      expected.who.push_back(a + 1), expected.count.push_back(0);
      for (std::uint32_t b = 0; b < state.id.size(); ++b) {
        const Vec d = nearest(state.position[b] - state.position[a]);
        if (a == b || d.norm() > 3.0) continue;
        ++near;
        bool hidden = false;
        for (std::size_t row = 0; row < state.id.size() && !hidden; ++row)
          hidden = row != a && row != b && hides(row, 0.5 * d, state.position[a] + 0.5 * d);
        if (!hidden) expected.whom.push_back(b + 1), ++expected.count.back();
      }
    }
    EXPECT_GT(near - expected.whom.size(), near / 10) << "some are hidden";
    EXPECT_GT(expected.whom.size(), near / 10) << "and some are not";
    EXPECT_EQ(sensed_at_start(scene), expected) << periodic;
  }
}

/// Enough for parts of the work on each thread, of lists and of those who ask.
TEST(Sensing, FindsTheSameWithAnyNumberOfThreads) {
  const std::string bodies =
      "walls = [ { segment = [[10, 1], [12, 40]] } ]\n" + kSmallBall +
      "[[bodies]]\nshape = \"ball\"\ncount = 6000\nplace = { random = { within = [[0, 0], [50, 50]] } }\n"
      "angle = { uniform = [-3, 3] }\n";
  for (const std::string fields : {"radius = 1.5", "radius = 1.5\nfov_degrees = 150\nsight = \"bodies\""}) {
    const Scene scene = scene_from(bodies + sensor(fields));
    const Sensed expected = sensed_at_start(scene);
    EXPECT_EQ(expected.who.size(), 6000u);
    EXPECT_GT(expected.whom.size(), 20000u) << fields;
    for (const int threads : {2, 7})
      EXPECT_EQ(sensed_at_start(scene, threads), expected) << fields << threads;
  }
}

}  // namespace
}  // namespace throng
