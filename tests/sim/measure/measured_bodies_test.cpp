// SPDX-License-Identifier: MIT
// What scenes ask for of their bodies as a whole, by hand and against the theory of hard discs.
#include "sim/measure/measured_bodies.h"

#include <gmock/gmock.h>

#include <cmath>
#include <numbers>
#include <random>

#include "sim/gas.h"
#include "sim/measure/coordination_number.h"
#include "sim/measure/pair_correlation.h"
#include "sim/measure/speeds.h"
#include "sim/simulation.h"
#include "tests/sim/trial.h"

namespace throng {
namespace {

using std::numbers::pi;

TEST(CoordinationNumber, CountsWhoPressesOnWhom) {
  const Scene scene = scene_from(
      "[shapes]\nball = { disc = { radius = 1 } }\nbox = { polygon = [[0, 0], [1, 0], [1, 1], [0, 1]] }\n"
      "[[bodies]]\nshape = \"ball\"\nat = [0, 0]\n[[bodies]]\nshape = \"ball\"\nat = [3, 0]\n"
      "[[bodies]]\nshape = \"box\"\nat = [6, 0]\n[[bodies]]\nshape = \"box\"\nat = [9, 0]\n"
      "[[bodies]]\nshape = \"box\"\nat = [12, 0]\nkind = \"kinematic\"\n");
  // A disc on three walls and on the other; that one on a box; two points between the boxes, two on the
  // floor, one on the kinematic box.
  const std::vector<ContactRow> contacts{{1, 0, 1, {}}, {1, 0, 1, {}}, {1, 0, 1, {}}, {1, 2, 1, {}},
                                         {2, 3, 1, {}}, {3, 4, 1, {}}, {3, 4, 1, {}}, {3, 0, 1, {}},
                                         {3, 0, 1, {}}, {4, 5, 1, {}}};
  EXPECT_EQ(coordination_number(scene, contacts), (4 + 2 + 3 + 2) / 4.0);
  EXPECT_EQ(coordination_number(scene, {}), 0.0);
}

TEST(Speeds, AreADensity) {
  const Scene scene =
      scene_from(std::string(kDisc) + ball(0, 0, 0.3, 0.4) + ball(2, 0, 1.5, 0) + ball(4, 0, 0, -1.5) +
                 ball(6, 0, 9, 0) + "[[bodies]]\nshape = \"ball\"\nat = [8, 0]\nkind = \"static\"\n");
  std::vector<double> values{7.0};
  append_speeds(scene, initial_state(scene), {2.0, 4}, values);
  EXPECT_EQ(values, (std::vector<double>{7.0, 0.0, 0.5, 0.0, 1.0})) << "bins of 0.5 m/s; one is too fast";
}

// It happened: of points that fill a quarter of the domain it was 4.
TEST(PairCorrelation, IsOneOfWhatFillsTheBoxThatItIsTakenIn) {
  for (const std::string domain : {"", "domain = { periodic = [[0, 0], [40, 40]] }\n"}) {
    Scene scene = scene_from(domain + std::string(kDisc) +
                             "[[bodies]]\nshape = \"ball\"\ncount = 3000\nplace = { lattice = { origin = [0, "
                             "0], spacing = [1, 1], size = [60, 50] } }\n");
    scene.asked.correlation_within = Eigen::AlignedBox2d(Vec(2, 3), Vec(14, 9));
    std::vector<double> mean(10, 0.0);
    std::mt19937 random(7);
    std::uniform_real_distribution<double> any(0.0, 20.0);
    for (int run = 0; run < 20; ++run) {
      State state = initial_state(scene);
      for (Vec& p : state.position) p = Vec(any(random), any(random));
      std::vector<double> values;
      append_pair_correlation(scene, state, {3.0, 10}, values);
      for (std::size_t i = 0; i < mean.size(); ++i) mean[i] += values[i] / 20;
    }
    for (const double g : mean) EXPECT_NEAR(g, 1.0, 0.03);
  }
  const Scene alone =
      scene_from("domain = { box = [[0, 0], [9, 9]] }\n" + std::string(kDisc) + ball(3, 3, 0, 0));
  std::vector<double> none;
  append_pair_correlation(alone, initial_state(alone), {2.0, 2}, none);
  EXPECT_EQ(none, (std::vector<double>{0.0, 0.0})) << "no pair";
}

TEST(PairCorrelation, CountsPairsOverThoseToBeExpected) {
  const Scene scene = scene_from("domain = { periodic = [[0, 0], [10, 10]] }\n" + std::string(kDisc) +
                                 ball(0.2, 5, 0, 0) + ball(9.2, 5, 0, 0));  // 1 m, across the border
  std::vector<double> values;
  append_pair_correlation(scene, initial_state(scene), {2.0, 2}, values);
  ASSERT_EQ(values.size(), 2u);
  EXPECT_EQ(values[0], 0.0);
  EXPECT_NEAR(values[1], 100 / (3 * pi), 1e-12);
}

/// Points anywhere, in domains of other widths than heights.
TEST(PairCorrelation, IsOneWherePointsStandAnywhere) {
  for (const std::string domain : {"periodic", "box"}) {
    Scene scene = scene_from(
        "domain = { " + domain + " = [[-1, 2], [8, 8]] }\ncontact = { model = \"none\" }\n" +
        "[shapes]\nball = { disc = { radius = 0.5 } }\n[[bodies]]\nshape = \"ball\"\ncount = 2000\n"
        "place = { lattice = { origin = [1, 4], spacing = [0, 0], size = [2000, 1] } }\n");
    std::mt19937 random(5);
    const double off = domain == "box" ? 0.5 : 0.0;  // who has a radius keeps off the walls
    std::uniform_real_distribution<double> x(-1 + off, 8 - off), y(2 + off, 8 - off);
    State state = initial_state(scene);
    for (Vec& p : state.position) p = Vec(x(random), y(random));
    std::vector<double> values;
    append_pair_correlation(scene, state, {3.0, 10}, values);
    for (std::size_t i = 1; i < values.size(); ++i) {
      const double pairs = 2e6 * (values[i] > 0) * pi * 0.09 * (2.0 * double(i) + 1) / 54;
      EXPECT_NEAR(values[i], 1.0, 6 / std::sqrt(pairs)) << domain << ", bin " << i;
    }
  }
}

TEST(PairCorrelation, IsRefusedBeyondTheClosedForm) {
  Scene scene =
      scene_from("domain = { periodic = [[0, 0], [10, 6]] }\n" + std::string(kDisc) + ball(1, 1, 0, 0));
  EXPECT_EQ(correlation_refusal(scene, 3.0), "");
  EXPECT_EQ(correlation_refusal(scene, 3.1), "must be at most 3 m in this domain");
  scene.domain.kind = DomainKind::box;
  EXPECT_EQ(correlation_refusal(scene, 5.0), "");
  EXPECT_EQ(correlation_refusal(scene, 5.1), "must be at most 5 m in this domain");
  scene.domain.kind = DomainKind::unbounded;
  EXPECT_NE(correlation_refusal(scene, 0.1), "");
}

/// Two discs, m = pi / 4, that meet head on, 2 m/s against each other, once in 2 s: J = 2 m, virial 1 J,
/// E = m, and what they have in equilibrium by k T = E, as one of the two goes with their common motion.
TEST(CompressibilityFactor, OfTwoThatMeetOnce) {
  for (const char* engine : {"event_driven", "native"}) {
    const Scene scene =
        scene_from("engine = \"" + std::string(engine) + "\"\ntime = { dt = 0.5, until = 2 }\n" +
                   material(1, 0) + "[observe]\nquantities = [\"collisions\", \"compressibility_factor\"]\n" +
                   kDisc + ball(0, 0, 1, 0) + ball(3, 0, -1, 0));
    const auto run = simulation(scene);
    for (int i = 0; i < 4; ++i) run->step();
    const std::vector<double> found = measure_bodies(scene, run->state(), {});
    const double m = pi / 4, collision = std::sqrt(2 * pi * (m / 2)) * std::sqrt(m);
    ASSERT_EQ(found.size(), 4u);
    EXPECT_EQ(found[0], 1.0) << engine;
    EXPECT_EQ(found[1], 0.0);
    EXPECT_NEAR(found[2], 1 + 2 * m / (2 * m * 2), 1e-14);
    EXPECT_NEAR(found[3], 1 + collision / (2 * m * 2), 1e-14);
  }
}

/// Henderson (1975), 0.03 % off at this density; some 20,000 collisions.
TEST(CompressibilityFactor, OfAGasIsThatOfTheoryOnBothEngines) {
  const std::string gas =
      "seed = 4\ntime = { dt = 0.02, until = 1 }\ndomain = { periodic = [[0, 0], [32.36, 32.36]] }\n" +
      material(1, 0) +
      "[observe]\nquantities = [\"temperature\", \"collisions\", \"packing_fraction\", "
      "\"compressibility_factor\"]\n"
      "speeds = { up_to = 5, bins = 20 }\n[shapes]\nball = { disc = { radius = 0.5 } }\n"
      "[[bodies]]\nshape = \"ball\"\ncount = 400\nplace = { random = { within = [[0, 0], [32.36, 32.36]] } "
      "}\n"
      "velocity = { maxwell = 1.0 }\n";
  for (const std::string engine : {"event_driven", "native"}) {
    const Scene scene = scene_from("engine = \"" + engine + "\"\n" + gas);
    const auto run = simulation(scene);
    for (int i = 0; i < 2000; ++i) run->step();
    const std::vector<double> found = measure_bodies(scene, run->state(), {});
    const double eta = found[1], theory = (1 + eta * eta / 8) / std::pow(1 - eta, 2);
    EXPECT_NEAR(eta, 400 * pi / 4 / (32.36 * 32.36), 1e-12);
    EXPECT_GT(found[2], 15'000) << engine;
    EXPECT_NEAR(found[4] / theory, 1.0, 0.02) << engine;
    EXPECT_NEAR(found[5] / theory, 1.0, 0.02) << engine;
    double sum = 0.0, apart = 0.0;
    for (std::size_t i = 0; i < 20; ++i) {  // Maxwell's, k T / m = 1 less what 400 bodies happened to get
      const double v = 0.25 * (double(i) + 0.5), kt = found[0] / (pi / 4);
      sum += 0.25 * found[6 + i],
          apart += 0.25 * std::abs(found[6 + i] - v / kt * std::exp(-v * v / (2 * kt)));
    }
    EXPECT_NEAR(sum, 1.0, 1e-12) << "nobody is faster than 5 m/s";
    EXPECT_LT(apart, 0.35) << "by chance of 400 bodies in 20 bins, some 0.2";
  }
}

/// The first collisions, before chaos: the same.
TEST(CompressibilityFactor, OfBothEnginesIsTheSame) {
  const std::string gas =
      "seed = 4\ntime = { dt = 0.05, until = 1 }\ndomain = { box = [[0, 0], [20, 20]] }\n" + material(1, 0) +
      "[shapes]\nball = { disc = { radius = { uniform = [0.2, 0.5] } } }\n[[bodies]]\nshape = \"ball\"\n"
      "count = 200\nplace = { random = { within = [[0, 0], [20, 20]] } }\nvelocity = { maxwell = 1.0 }\n";
  const Scene event = scene_from("engine = \"event_driven\"\n" + gas), native = scene_from(gas);
  const auto a = simulation(event), b = simulation(native);
  for (int i = 0; i < 20; ++i) a->step(), b->step();
  const Collisions &one = *a->collisions(), &other = *b->collisions();
  EXPECT_GT(one.pairs, 50);
  EXPECT_GT(one.walls, 10);
  EXPECT_EQ(one.pairs, other.pairs);
  EXPECT_EQ(one.walls, other.walls);
  EXPECT_NEAR(one.virial, other.virial, 1e-9 * one.virial);
  EXPECT_NEAR(one.equilibrium, other.equilibrium, 1e-9 * one.equilibrium);
}

TEST(CompressibilityFactor, IsUnknownWhereDiscsWerePushedApart) {
  const Scene scene = scene_from("time = { dt = 0.5, until = 2 }\n" + material(1, 0) + kDisc +
                                 ball(0, 0, 1, 0) + ball(0.9, 0, 0, 0) + ball(5, 0, -1, 0));
  const auto run = simulation(scene);
  run->step();
  EXPECT_EQ(run->collisions()->pushed, 1);
  EXPECT_FALSE(compressibility_factor(scene, run->state(), *run->collisions()));
  EXPECT_FALSE(compressibility_by_rate(scene, run->state(), *run->collisions()));
}

/// 1.9 m apart, pushed by 0.5 N s in 2 ms: 475 J of virial over 2 E, E = pi / 2 * 3^2 / 2 * 2.
TEST(CompressibilityFactor, OfSoftDiscsIsThatOfTheirForces) {
  const Scene scene = scene_from(
      "contact = { model = \"spring\", stiffness = 1e3 }\ntime = { dt = 0.01, until = 1, substeps = 5 }\n"
      "domain = { periodic = [[0, 0], [8, 8]] }\n[shapes]\nball = { disc = { radius = 1 } }\n"
      "[[bodies]]\nshape = \"ball\"\nat = [0.9, 4]\nvelocity = [3, 0]\n"
      "[[bodies]]\nshape = \"ball\"\nat = [7, 4]\nvelocity = [-3, 0]\n");
  const std::vector<ContactRow> contacts{{1, 2, 2.5, Vec(0, 4)}, {1, 0, 9.0, Vec(1, 5)}};
  State state = initial_state(scene);
  EXPECT_FALSE(compressibility_now(scene, state, {})) << "nobody has looked for contacts yet";
  state.step = 1;
  const std::optional<double> z = compressibility_now(scene, state, contacts);
  EXPECT_NEAR(z.value_or(0), 1 + 475 / (2 * pi * 9), 1e-10);
}

TEST(CoordinationNumber, IsUnknownBeforeTheFirstStep) {
  const Scene scene = scene_from(
      "contact = { model = \"spring\", stiffness = 1e3 }\n[observe]\nquantities = "
      "[\"coordination_number\"]\n" +
      std::string(kDisc) + ball(0, 0, 0, 0) + ball(0.99, 0, 0, 0));
  const auto run = simulation(scene);
  EXPECT_TRUE(std::isnan(measure_bodies(scene, run->state(), {}).at(0)));
  run->step();
  std::vector<ContactRow> contacts;
  run->list_contacts(contacts);
  EXPECT_EQ(measure_bodies(scene, run->state(), contacts).at(0), 1.0);
}

/// Stiff springs that lose nothing: hard discs, but that an impact takes time.
TEST(CompressibilityFactor, OfAStiffSoftGasIsNearThatOfHardDiscs) {
  const Scene scene = scene_from(
      "seed = 6\ntime = { dt = 0.01, until = 1, substeps = 10 }\ndomain = { periodic = [[0, 0], [22, 22]] }\n"
      "contact = { model = \"spring\", stiffness = 2e4 }\n" +
      material(1, 0) + "[observe]\nquantities = [\"compressibility_factor\"]\n" + kDisc +
      "[[bodies]]\nshape = \"ball\"\ncount = 180\nplace = { random = { within = [[0, 0], [22, 22]] } }\n"
      "velocity = { maxwell = 1.0 }\n");
  const auto run = simulation(scene);
  std::vector<ContactRow> contacts;
  double sum = 0.0;
  for (int i = 0; i < 3000; ++i) {
    run->step();
    run->list_contacts(contacts);
    sum += measure_bodies(scene, run->state(), contacts).at(0) / 3000;
  }
  const double eta = 180 * pi / 4 / (22 * 22), theory = (1 + eta * eta / 8) / std::pow(1 - eta, 2);
  EXPECT_NEAR(sum / theory, 1.0, 0.04);
}

TEST(MeasuredBodies, AreNamedInTheOrderOfTheirNumbers) {
  const Scene scene = scene_from(
      "domain = { box = [[0, 0], [10, 10]] }\n[observe]\nquantities = [\"coordination_number\", "
      "\"temperature\"]\n"
      "pair_correlation = { up_to = 3, bins = 4 }\nspeeds = { up_to = 5, bins = 3 }\n" +
      std::string(kDisc) + ball(3, 3, 1, 0));
  std::vector<std::string> names;
  std::size_t numbers = 0;
  for (const AskedColumn& column : asked_columns(scene))
    names.push_back(column.name), numbers += column.numbers;
  EXPECT_EQ(names,
            (std::vector<std::string>{"temperature", "coordination_number", "speeds", "pair_correlation"}));
  EXPECT_EQ(measure_bodies(scene, initial_state(scene), {}).size(), numbers);
  EXPECT_EQ(numbers, 9u);
}

/// Of what a scene can't be asked, the key and the reason.
TEST(MeasuredBodies, AreRefusedWhereTheyHaveNoMeaning) {
  const auto refused = [](const std::string& asked, const std::string& scene) {
    const Loaded loaded = load_scenario_text(
        "throng = 1\n" + scene + "[observe]\n" + asked + "\n" + kDisc + ball(3, 3, 1, 0) + ball(5, 3, 0, 0),
        "a.toml");
    return to_string(loaded.diagnostics, "a.toml");
  };
  const std::string box = "domain = { box = [[0, 0], [10, 10]] }\n",
                    elastic = "materials.default.restitution = 1\n";
  const auto has = [](const std::string& said) { return testing::HasSubstr(said); };
  EXPECT_THAT(refused("quantities = ['collisions']", ""), has("observe.quantities: collisions are told"));
  EXPECT_EQ(refused("quantities = ['collisions', 'compressibility_factor']", elastic), "");
  EXPECT_THAT(refused("quantities = ['compressibility_factor']", ""), has("compressibility_factor needs"));
  EXPECT_THAT(refused("quantities = ['coordination_number']", elastic), has("contacts that last"));
  EXPECT_EQ(refused("quantities = ['coordination_number']", ""), "");
  EXPECT_THAT(refused("quantities = ['packing_fraction']", ""),
              has("needs a domain, or observe.packing_within"));
  EXPECT_EQ(refused("quantities = ['packing_fraction']\npacking_within = [[0, 0], [1, 1]]", ""), "");
  EXPECT_THAT(refused("packing_within = [[0, 0], [1, 1]]", ""), has("isn't asked for"));
  EXPECT_THAT(refused("quantities = ['packing_fraction']\npacking_within = [[0, 0], [0, 1]]", box),
              has("least x"));
  EXPECT_THAT(refused("pair_correlation.up_to = 9.1", box), has("must be at most 9 m in this domain"));
  EXPECT_EQ(refused("pair_correlation.up_to = 9", box), "");
  const std::string heap = "pair_correlation.up_to = 3\ncorrelation_within = [[0, 0], [5, 3]]\n";
  EXPECT_EQ(refused(heap, box), "");
  EXPECT_EQ(refused(heap, ""), "") << "in the open plane, too";
  EXPECT_THAT(refused("pair_correlation.up_to = 3", ""),
              has("needs a domain, or observe.correlation_within"));
  EXPECT_THAT(refused("correlation_within = [[0, 0], [5, 3]]", box), has("isn't asked for"));
  EXPECT_THAT(refused("pair_correlation.up_to = 3\ncorrelation_within = [[-1, 0], [5, 3]]", box),
              has("lies in the domain"));
  EXPECT_THAT(refused("pair_correlation.up_to = 3.1\ncorrelation_within = [[0, 0], [5, 3]]", box),
              has("must be at most 3 m in this box"));
}

}  // namespace
}  // namespace throng
