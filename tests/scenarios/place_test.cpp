// SPDX-License-Identifier: MIT
#include "scenarios/place.h"

#include <gtest/gtest.h>

#include <chrono>
#include <ctime>

#include "scenarios/body_distance.h"
#include "tests/scenarios/scenario_texts.h"

namespace throng::scenarios {

using throng::testing::faults;
using throng::testing::load_text;

namespace {

/// The nearest image of `b` as seen from `a`.
Vec nearest(const Domain& domain, const Vec& a, const Vec& b) {
  if (domain.kind != DomainKind::periodic) return b;
  const Vec size = domain.max - domain.min;
  Vec image = b;
  for (int axis : {0, 1}) image[axis] -= size[axis] * std::round((b[axis] - a[axis]) / size[axis]);
  return image;
}

/// The least distance of any two bodies, by comparing all.
double least_distance(const Scene& scene) {
  double least = 1e300;
  const auto count = static_cast<std::uint32_t>(scene.bodies.size());
  for (std::uint32_t a = 0; a < count; ++a)
    for (std::uint32_t b = a + 1; b < count; ++b) {
      const Vec& p = scene.bodies.position[a];
      const Vec q = nearest(scene.domain, p, scene.bodies.position[b]);
      if ((q - p).norm() > scene.bodies.radius[a] + scene.bodies.radius[b] + least) continue;
      least = std::min(least, distance(scene, Placed{a, p}, Placed{b, q}));
    }
  return least;
}

double least_wall_distance(const Scene& scene) {
  double least = 1e300;
  for (std::uint32_t row = 0; row < scene.bodies.size(); ++row)
    for (const Wall& wall : scene.walls)
      for (std::size_t i = 0; i + (wall.closed ? 0 : 1) < wall.points.size(); ++i) {
        const WallGrid::Piece piece{wall.points[i], wall.points[(i + 1) % wall.points.size()], 0};
        const Vec middle = 0.5 * (piece.a + piece.b), &p = scene.bodies.position[row];
        least = std::min(least, distance(scene, Placed{row, p}, piece));
        least = std::min(least, distance(scene, Placed{row, nearest(scene.domain, middle, p)}, piece));
      }
  return least;
}

/// How far bodies reach out of the box, m; negative where all keep off its sides.
double farthest_out(const Scene& scene, const Eigen::AlignedBox2d& box) {
  double out = -1e300;
  for (std::uint32_t row = 0; row < scene.bodies.size(); ++row) {
    const Vec& p = scene.bodies.position[row];
    const Eigen::AlignedBox2d body = extent(scene, row);
    out = std::max(out, (box.min() - p - body.min()).cwiseMax(p + body.max() - box.max()).maxCoeff());
  }
  return out;
}

const std::string kMixed = R"toml(throng = 1
seed = 11
[shapes]
a.disc.radius.uniform = [0.05, 0.5]
b.disc.radius = 3
c.disc.radius.uniform = [0.4, 0.6]
[[bodies]]
shape = "a"
count = 600
place.random = { within = [[-20, -10], [20, 12]], gap = 0.05 }
[[bodies]]
shape = "b"
count = 5
place.random = { within = [[-20, -10], [20, 12]], gap = 0.05 }
[[bodies]]
shape = "c"
place.lattice = { origin = [-18, -9.3], spacing = [2, 20.5], size = [18, 2] }
[[walls]]
polyline = [[-20, -8], [0, 0], [20, -3]]
[[walls]]
polygon = [[-3, 4], [3, 4], [0, 8]]
)toml";

const std::string kShapes = R"toml(throng = 1
[shapes]
disc.disc.radius.uniform = [0.1, 0.5]
hook.polygon = [[0, 0], [1.5, 0], [1.5, 0.4], [0.4, 0.4], [0.4, 1.5], [0, 1.5]]
trio.discs = [[0, 0, 0.3], [0.7, 0, 0.2], [0, 0.9, 0.25]]
[[bodies]]
shape = "disc"
count = 150
place.random = { within = [[0, 0], [30, 20]], gap = 0.05 }
[[bodies]]
shape = "hook"
count = 120
angle.uniform = [0, 6.3]
place.random = { within = [[0, 0], [30, 20]], gap = 0.05 }
[[bodies]]
shape = "trio"
count = 120
angle.uniform = [0, 6.3]
place.random = { within = [[0, 0], [30, 20]], gap = 0.05 }
[[walls]]
polyline = [[4, 3], [14, 9], [26, 5]]
[[walls]]
segment = [[29.9, 12], [29.9, 18]]
)toml";

std::string gas(int count, double side) {
  return "throng = 1\nshapes.a.disc.radius = 0.5\n[[bodies]]\nshape = 'a'\ncount = " + std::to_string(count) +
         "\nplace.random.within = [[0, 0], [" + std::to_string(side) + ", " + std::to_string(side) + "]]\n";
}

}  // namespace

TEST(Place, KeepsTheGapToBodiesAndWallsAndStaysWithin) {
  const Loaded loaded = load_text(kMixed);
  ASSERT_EQ(faults(loaded), "");
  ASSERT_EQ(loaded.scene.bodies.size(), 641u);
  EXPECT_GE(least_distance(loaded.scene), 0.05 - 1e-12);
  EXPECT_LT(least_distance(loaded.scene), 0.06) << "too thin to have tested anything";
  EXPECT_GE(least_wall_distance(loaded.scene), 0.05 - 1e-12);
  EXPECT_LT(least_wall_distance(loaded.scene), 0.2) << "too thin to have tested anything";
  EXPECT_LE(farthest_out(loaded.scene, {Vec(-20, -10), Vec(20, 12)}), 1e-12);
}

TEST(Place, GivesTheSamePlacesAgainAndOthersForAnotherSeed) {
  const Bodies a = load_text(kMixed).scene.bodies, b = load_text(kMixed).scene.bodies;
  const Bodies c = load_text(kMixed, {"seed=12"}).scene.bodies;
  EXPECT_EQ(a.position, b.position);
  EXPECT_NE(a.position[0], c.position[0]);
  EXPECT_NE(a.radius[0], c.radius[0]);
}

TEST(Place, AsksOnlyTheIdWhereThereIsRoom) {
  const Bodies few = load_text(gas(5, 1e6)).scene.bodies, many = load_text(gas(500, 1e6)).scene.bodies;
  for (std::size_t row = 0; row < few.size(); ++row) EXPECT_EQ(few.position[row], many.position[row]);
}

TEST(Place, FillsHalfOfTheArea) {
  const Loaded loaded = load_text(gas(4'000, 79.2665));
  ASSERT_EQ(faults(loaded), "");
  EXPECT_GE(least_distance(loaded.scene), -1e-13);
}

TEST(Place, GivesUpWhereThereIsNoRoom) {
  const Loaded loaded = load_text(gas(10'000, 110.0));
  EXPECT_EQ(loaded.errors(), 1);
  EXPECT_NE(faults(loaded).find("bodies[0].place.random: body "), std::string::npos) << faults(loaded);
  EXPECT_NE(faults(loaded).find("found no free place"), std::string::npos) << faults(loaded);
}

TEST(Place, FillsAPeriodicDomainAcrossItsBorders) {
  const Loaded loaded = load_text("domain.periodic = [[-5, -5], [25, 15]]\n" + gas(330, 1.0),
                                  {"bodies[0].place.random.within=[[-5, -5], [25, 15]]"});
  ASSERT_EQ(faults(loaded), "");
  EXPECT_GE(least_distance(loaded.scene), -1e-13);
  EXPECT_LT(least_distance(loaded.scene), 0.05);
  EXPECT_GT(farthest_out(loaded.scene, {Vec(-5, -5), Vec(25, 15)}), 0.3) << "nobody stands across a border";
  EXPECT_LE(farthest_out(loaded.scene, {Vec(-5, -5), Vec(25, 15)}), 0.5);
}

// Two interlocking rings cost 22,500 pairs of discs a try: a budget that counted tries alone took
// far too long to say so.
TEST(Place, GivesUpInSecondsWhereEveryTryIsDear) {
  std::string ring;
  for (int i = 0; i < 150; ++i)
    ring += (i > 0 ? ", [" : "[") + std::to_string(5 * std::cos(i * 0.0419)) + ", " +
            std::to_string(5 * std::sin(i * 0.0419)) + ", 0.3]";
  const std::clock_t start = std::clock();
  const Loaded loaded =
      load_text("throng = 1\nshapes.a.discs = [" + ring +
                "]\n[[bodies]]\nshape = 'a'\ncount = 2\nplace.random.within = [[0, 0], [12, 12]]\n");
  const double taken = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
  EXPECT_NE(faults(loaded).find("found no free place"), std::string::npos) << faults(loaded);
  EXPECT_LT(taken, 30.0);
}

TEST(Place, KeepsTheGapBetweenShapesOfAllKinds) {
  for (const char* domain : {"box", "periodic"}) {
    const Loaded loaded = load_text(std::string("domain.") + domain + " = [[0, 0], [30, 20]]\n" + kShapes);
    ASSERT_EQ(faults(loaded), "");
    const Scene& scene = loaded.scene;
    EXPECT_GE(least_distance(scene), 0.05 - 1e-12) << domain;
    EXPECT_LT(least_distance(scene), 0.06) << "too thin to have tested anything";
    EXPECT_GE(least_wall_distance(scene), 0.05 - 1e-12) << domain;
    EXPECT_LT(least_wall_distance(scene), 0.2) << "too thin to have tested anything";
  }
}

TEST(Place, IsUniformWhereThereIsRoom) {
  const Bodies bodies = load_text(gas(20'000, 1e6)).scene.bodies;
  Vec mean(0, 0);
  for (const Vec& p : bodies.position) mean += p / 20'000.0;
  EXPECT_NEAR(mean.x(), 5e5, 4 * 1e6 / std::sqrt(12 * 20'000.0));
  EXPECT_NEAR(mean.y(), 5e5, 4 * 1e6 / std::sqrt(12 * 20'000.0));
}

TEST(Place, FitsABodyIntoABoxOfItsOwnSize) {
  const Loaded loaded = load_text(gas(1, 1.0));
  ASSERT_EQ(faults(loaded), "");
  EXPECT_EQ(loaded.scene.bodies.position[0], Vec(0.5, 0.5));
}

TEST(Overlaps, AreNamedByIdAndDepth) {
  const Loaded loaded = load_text(
      "throng = 1\nshapes.a.disc.radius = 0.5\n[[bodies]]\nshape = 'a'\nat = [0, 0]\n[[bodies]]\nshape = "
      "'a'\nat = [0.75, 0]\n"
      "[[bodies]]\nshape = 'a'\nat = [5, 0]\n[[walls]]\nsegment = [[4, 0.25], [6, 0.25]]\n");
  EXPECT_EQ(faults(loaded),
            "s.toml:3:1: warning: bodies: 2 overlaps at the start: body 1 and body 2 by 0.25 m, body 3 and "
            "walls[0] by 0.25 m\n");
}

TEST(Overlaps, AreRefusedWhereDiscsAreHard) {
  const Loaded loaded = load_text(
      "throng = 1\nengine = 'event_driven'\nshapes.a.disc.radius = 0.5\n[[bodies]]\nshape = 'a'\nat = [0, "
      "0]\n[[walls]]\nsegment = [[-1, 0.25], [1, 0.25]]\n");
  EXPECT_EQ(faults(loaded),
            "s.toml:4:1: error: bodies: 1 overlap at the start: body 1 and walls[0] by 0.25 m: hard discs "
            "can't\n");
}

TEST(Overlaps, AreCountedBeyondTheFirstTen) {
  const Loaded loaded = load_text(
      "throng = 1\nshapes.a.disc.radius = 0.5\n[[bodies]]\nshape = 'a'\n"
      "place.lattice = { origin = [0, 0], spacing = [0.75, 5], size = [21, 1] }\n");
  EXPECT_NE(faults(loaded).find("20 overlaps at the start: body 1 and body 2 by 0.25 m"), std::string::npos);
  EXPECT_NE(faults(loaded).find("body 10 and body 11 by 0.25 m, ...\n"), std::string::npos) << faults(loaded);
}

TEST(Overlaps, AreNoneWhereBodiesTouch) {
  for (const char* origin : {"[0, 0]", "[1000000.1, -77777.7]", "[0.1, 0.2]"}) {
    const Loaded loaded =
        load_text(std::string("throng = 1\nshapes.a.disc.radius = 0.05\n[[bodies]]\nshape = 'a'\n"
                              "place.lattice = { spacing = [0.1, 0.1], size = [40, 40], origin = ") +
                  origin + " }\n");
    EXPECT_EQ(faults(loaded), "") << origin;
  }
}

TEST(Overlaps, AreNoneWhereOnlyDigitsWereDropped) {
  const std::string pair =
      "throng = 1\nshapes.a.disc.radius = 0.5\n[[bodies]]\nshape = 'a'\nat = [0, 0]\n[[bodies]]\nshape = "
      "'a'\nat = ";
  EXPECT_EQ(faults(load_text(pair + "[0.5, 0.8660254037]")), "");
  EXPECT_NE(faults(load_text(pair + "[0.5, 0.8660]")), "");
}

TEST(Overlaps, AreNoMatterAmongWhatCannotMove) {
  const std::string pair =
      "throng = 1\nshapes.a.disc.radius = 0.5\n[[bodies]]\nshape = 'a'\nat = [0, 0]\nkind = 'static'\n"
      "[[bodies]]\nshape = 'a'\nat = [0.5, 0]\nkind = 'kinematic'\n";
  EXPECT_EQ(faults(load_text(pair)), "");
  EXPECT_NE(faults(load_text(pair, {"bodies[0].kind=dynamic"})), "");
  EXPECT_NE(faults(load_text(pair, {"bodies[1].kind=dynamic"})), "");
  EXPECT_EQ(faults(load_text(pair, {"bodies[1].kind=dynamic", "contact.model=none"})), "");
}

TEST(Overlaps, PointAtTheFirstEntryThatOverlaps) {
  const std::string disc = "[[bodies]]\nshape = 'a'\nat = ";
  const Loaded loaded = load_text("throng = 1\nshapes.a.disc.radius = 0.5\n" + disc + "[9, 0]\n" + disc +
                                  "[0, 0]\n" + disc + "[0.5, 0]\n");
  EXPECT_EQ(faults(loaded).rfind("s.toml:6:1: warning: bodies: 1 overlap at the start: body 2 and body 3", 0),
            0u)
      << faults(loaded);
}

TEST(Overlaps, NameAPairOnceHoweverManyOfItsImagesMeet) {
  const Loaded loaded = load_text(
      "throng = 1\ndomain.periodic = [[0, 0], [10, 10]]\nshapes.a.disc.radius = 0.5\n"
      "shapes.b.discs = [[-4.5, 0, 0.4], [4.5, 0, 0.4]]\n[[bodies]]\nshape = 'a'\nat = [0, 5]\n"
      "[[bodies]]\nshape = 'b'\nkind = 'static'\nat = [5, 5]\n");
  EXPECT_NE(faults(loaded).find(" 1 overlap at the start: body 1 and body 2 by 0.4"), std::string::npos)
      << faults(loaded);
}

TEST(Overlaps, OfWhatCannotMoveCostNothing) {
  const auto start = std::chrono::steady_clock::now();
  const Loaded loaded = load_text(
      "throng = 1\nshapes.a.disc.radius = 0.5\n[[bodies]]\nshape = 'a'\nkind = 'static'\n"
      "place.lattice = { origin = [0, 0], spacing = [0, 0], size = [1000, 200] }\n");
  const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - start;
  EXPECT_EQ(faults(loaded), "");
  EXPECT_LT(taken.count(), 20.0);
}

TEST(Overlaps, AreSeenAcrossPeriodicBorders) {
  const Loaded loaded = load_text(
      "throng = 1\ndomain.periodic = [[0, 0], [10, 10]]\nshapes.a.disc.radius = 0.5\n"
      "[[bodies]]\nshape = 'a'\nat = [0.25, 0.25]\n[[bodies]]\nshape = 'a'\nat = [9.75, 9.75]\n");
  EXPECT_NE(faults(loaded).find("body 1 and body 2 by 0.29"), std::string::npos) << faults(loaded);
}

TEST(Overlaps, EndSoonWhereEverybodyStandsInOnePlace) {
  const Loaded loaded = load_text(
      "throng = 1\nshapes.a.disc.radius = 0.5\n[[bodies]]\nshape = 'a'\n"
      "place.lattice = { origin = [0, 0], spacing = [0, 0], size = [1000, 100] }\n");
  EXPECT_NE(faults(loaded).find("at least 1000 overlaps"), std::string::npos) << faults(loaded);
}

}  // namespace throng::scenarios
