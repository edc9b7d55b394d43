// SPDX-License-Identifier: MIT
// Elastic discs that nothing pulls, against closed forms and against all pairs looked at after each
// collision.
#include "sim/contact/flights.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

#include "sim/periodic.h"
#include "tests/sim/trial.h"

namespace throng {
namespace {

std::string elastic(double friction = 0.0) {
  return "time = { dt = 0.1, until = 1 }\n" + material(1, friction) + kDisc;
}

TEST(Flights, TwoDiscsMeetAtTheirTimeWithinTheStep) {
  Trial run(elastic() + ball(0, 0, 3, 0) + ball(1.1, 0, -1, 0));  // they meet after 0.025 s
  run.steps(1);
  EXPECT_NEAR(run.state.position[0].x(), 0.075 - 0.075, 1e-15);
  EXPECT_NEAR(run.state.position[1].x(), 1.075 + 0.225, 1e-15);
  EXPECT_EQ(run.state.velocity[0], Vec(-1, 0));
  EXPECT_EQ(run.state.velocity[1], Vec(3, 0));
}

TEST(Flights, AnObliqueHitTurnsOnlyTheSpeedAlongTheNormal) {
  // 0.6 beside each other, they touch with the normal (0.8, 0.6), after 0.2 m of way.
  Trial run(elastic() + ball(0, 0, 4, 0) + ball(1.0, 0.6, 0, 0));
  run.steps(1);
  EXPECT_NEAR((run.state.velocity[1] - 3.2 * Vec(0.8, 0.6)).norm(), 0.0, 1e-14);
  EXPECT_NEAR((run.state.velocity[0] - Vec(1.44, -1.92)).norm(), 0.0, 1e-14);
  EXPECT_NEAR((run.state.position[0] - (Vec(0.2, 0) + 0.05 * Vec(1.44, -1.92))).norm(), 0.0, 1e-14);
}

TEST(Flights, AChainOfCollisionsHappensWithinOneStep) {
  std::string text = elastic() + ball(0, 0, 20, 0);
  for (int i = 1; i < 5; ++i) text += ball(1.01 * i, 0, 0, 0);
  Trial run(text);
  run.steps(1);
  for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR(run.state.velocity[i].norm(), 0.0, 1e-13) << i;
  EXPECT_NEAR(run.state.position[4].x(), 4.04 + 2.0 - 0.04, 1e-13);
}

TEST(Flights, ARubbingHitFollowsCoulomb) {
  // Radius 0.5, solid: inertia m r^2 / 2, so what stops the slip of two equal discs is m / 6 of it.
  for (const double friction : {0.05, 0.9}) {
    Trial run(elastic(friction) + ball(0, 0, 4, 0) + ball(1.0, 0.6, 0, 0));
    const double m = mass(run.scene, 0), along = 3.2, slip = 4 * 0.6;
    run.steps(1);
    const double rub = std::min(m * slip / 6.0, friction * m * along);
    const Vec n(0.8, 0.6), across(0.6, -0.8);
    EXPECT_NEAR((run.state.velocity[1] - (along * n + rub / m * across)).norm(), 0.0, 1e-14) << friction;
    EXPECT_NEAR(std::abs(run.state.spin[1]), rub * 0.5 / (m * 0.125), 1e-13) << friction;
    EXPECT_EQ(run.state.spin[0], run.state.spin[1]);
  }
}

TEST(Flights, ADiscKeepsItsWayBetweenWallsAndCornersOfAllKinds) {
  // A wall seen from both sides, its end, a box's side, a triangle's corner, a static disc: the speed stays.
  Trial run(std::string("time = { dt = 0.05, until = 1 }\ndomain = { box = [[-5, -5], [5, 5]] }\n") +
            material(1, 0) +
            "[shapes]\nball = { disc = { radius = 0.5 } }\nwedge = { polygon = [[0, 0], [1, 0], [0, 1]] }\n" +
            "[[bodies]]\nshape = \"wedge\"\nat = [-2.5, 2.5]\nkind = \"static\"\n" +
            "[[bodies]]\nshape = \"ball\"\nat = [3, 3]\nkind = \"static\"\n" +
            "[[walls]]\nsegment = [[-1, -2], [1, -1]]\n" + ball(0, 0.3, 7, 3.3) + ball(-4, -4, 1, 9));
  for (int i = 0; i < 2000; ++i) {
    run.steps(1);
    ASSERT_LT(overlap(run.scene, run.state).max, 1e-12) << "step " << i;
  }
  EXPECT_NEAR(run.energy() / kinetic_energy(run.scene, initial_state(run.scene)), 1.0, 1e-12);
}

TEST(Flights, OverlapsOfTheSceneAreTheSolversMatter) {
  Trial run(elastic() + ball(0, 0, 0, 0) + ball(0.9, 0, 0, 0) + ball(9, 0, 1, 0));
  run.steps(100);
  EXPECT_LT(overlap(run.scene, run.state).max, 0.01);
  EXPECT_NEAR(run.state.position[2].x(), 19.0, 1e-9);
}

TEST(Flights, ADiscThatIsHitBeyondWhereItWasLookedForMissesNothing) {
  // The second stands; hit by the first it gets 20 m far within the step, through where the third stands.
  Trial run(elastic() + ball(0, 0, 300, 0) + ball(5, 0, 0, 0) + ball(15, 0, 0, 0));
  run.steps(1);
  EXPECT_NEAR(run.state.velocity[0].norm() + run.state.velocity[1].norm(), 0.0, 1e-9);
  EXPECT_NEAR(run.state.position[2].x(), 15.0 + 30.0 - 13.0, 1e-9);
}

/// What an event-driven run finds that looks at all pairs after each collision: the definition.
class AllPairs {
 public:
  using Real = long double;
  using RealVec = Eigen::Matrix<Real, 2, 1>;

  explicit AllPairs(const Scene& scene) : scene_(scene) {
    for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
      at.push_back(scene.bodies.position[i].cast<Real>());
      velocity.push_back(scene.bodies.velocity[i].cast<Real>());
    }
  }
  void fly(Real left) {
    for (;;) {
      Hit first{left, 0, -1};
      for (std::size_t a = 0; a < at.size(); ++a) {
        for (int side = 0; side < 4; ++side) look_at_side(a, side, first);
        for (std::size_t b = a + 1; b < at.size(); ++b) look(a, b, first);
      }
      for (std::size_t i = 0; i < at.size(); ++i) at[i] += first.time * velocity[i];
      left -= first.time;
      if (first.with == -1) return;
      ++collisions;
      bounce(first);
    }
  }

  std::vector<RealVec> at, velocity;
  int collisions = 0;

 private:
  struct Hit {
    Real time;
    std::size_t a;
    int with;  // a body; below -1 a side
  };
  void look(std::size_t a, std::size_t b, Hit& first) const {
    const RealVec r = at[b] - at[a], v = velocity[b] - velocity[a];
    const Real reach = scene_.bodies.radius[a] + scene_.bodies.radius[b];
    const Real nearing = -r.dot(v), d = nearing * nearing - v.dot(v) * (r.dot(r) - reach * reach);
    if (nearing <= 0 || d < 0) return;
    const Real time = std::max<Real>(0, (nearing - std::sqrt(d)) / v.dot(v));
    if (time < first.time) first = {time, a, static_cast<int>(b)};
  }
  void look_at_side(std::size_t a, int side, Hit& first) const {
    const int axis = side / 2;
    const Real sign = side % 2 ? -1 : 1, radius = scene_.bodies.radius[a];
    const Real border = (side % 2 ? scene_.domain.max : scene_.domain.min)[axis];
    if (sign * velocity[a][axis] >= 0) return;
    const Real time =
        std::max<Real>(0, (sign * (at[a][axis] - border) - radius) / (-sign * velocity[a][axis]));
    if (time < first.time) first = {time, a, -2 - axis};
  }
  void bounce(const Hit& hit) {
    if (hit.with < 0) {
      velocity[hit.a][-2 - hit.with] *= -1;
      return;
    }
    const std::size_t b = static_cast<std::size_t>(hit.with);
    const RealVec n = (at[b] - at[hit.a]).normalized();
    const Real masses[] = {mass(scene_, hit.a), mass(scene_, b)};
    const Real impulse = -2 * (velocity[b] - velocity[hit.a]).dot(n) / (1 / masses[0] + 1 / masses[1]);
    velocity[hit.a] -= impulse / masses[0] * n;
    velocity[b] += impulse / masses[1] * n;
  }

  const Scene& scene_;
};

TEST(Flights, AgreeWithAllPairsLookedAtAfterEachCollision) {
  for (const double dt : {0.02, 0.3}) {
    Trial run(
        "seed = 5\ntime = { dt = " + std::to_string(dt) +
        ", until = 1 }\ndomain = { box = [[0, 0], [8, 8]] }\n" + material(1, 0) +
        "[shapes]\ngrain = { disc = { radius = { uniform = [0.2, 0.5] } } }\n"
        "[[bodies]]\nshape = \"grain\"\ncount = 40\nplace = { random = { within = [[0, 0], [8, 8]] } }\n"
        "velocity = { maxwell = 1.0 }\n");
    AllPairs all(run.scene);
    const double until = 1.2;
    run.steps(static_cast<int>(std::lround(until / dt)));
    all.fly(until);
    EXPECT_GT(all.collisions, 60);
    for (std::size_t i = 0; i < run.state.position.size(); ++i)
      EXPECT_NEAR((run.state.position[i] - all.at[i].cast<double>()).norm(), 0.0, 1e-9) << i << " dt " << dt;
  }
}

TEST(Flights, GoOnWithTheSameBitsFromAnyStep) {
  Trial whole(gallery_scene("gas"));
  whole.steps(43);
  Trial rest(whole.scene);
  rest.state = whole.state;
  whole.steps(50), rest.steps(50);
  EXPECT_EQ(hash(rest.state), hash(whole.state));
}

TEST(Flights, PairsServeSeveralStepsUntilSomebodyGetsFarther) {
  Trial run("time = { dt = 0.01, until = 1 }\n" + material(1, 0) + kDisc + ball(0, 0, 4, 0) +
            ball(3, 0, 0, 0));
  run.steps(1);
  const std::uint64_t finds = run.work.candidates.finds();
  run.steps(4);  // 0.2 m of the 0.25 m that was looked for
  EXPECT_EQ(run.work.candidates.finds(), finds);
  run.steps(4);
  EXPECT_EQ(run.work.candidates.finds(), finds + 1);
}

TEST(Flights, AGasRetracesItsWay) {
  Trial run(gallery_scene("gas"));
  run.steps(100);
  for (Vec& v : run.state.velocity) v = -v;
  run.steps(100);
  for (std::size_t i = 0; i < run.state.position.size(); ++i) {
    const Vec d = run.state.position[i] - run.scene.bodies.position[i];
    const Vec period = run.scene.domain.max - run.scene.domain.min;
    EXPECT_NEAR(nearest_image(d, period).norm(), 0.0, 1e-9) << i;
  }
}

}  // namespace
}  // namespace throng
