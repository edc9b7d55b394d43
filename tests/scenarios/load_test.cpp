// SPDX-License-Identifier: MIT
#include "scenarios/load.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdio>
#include <filesystem>
#include <fstream>

#include "tests/scenarios/same_scene.h"
#include "tests/scenarios/scenario_texts.h"

namespace throng {

using testing::expect_same;
using testing::faults;
using testing::kEverything;
using testing::load_text;

TEST(Load, ReadsSettings) {
  const Loaded loaded = load_text(kEverything);
  ASSERT_EQ(faults(loaded), "");
  const Scene& scene = loaded.scene;
  EXPECT_EQ(scene.name, "everything");
  EXPECT_EQ(scene.description, "All fields of the grammar");
  EXPECT_EQ(scene.seed, 7u);
  EXPECT_EQ(scene.engine, Engine::native);
  EXPECT_EQ(scene.gravity, Vec(0.0, -9.81));
  EXPECT_EQ(scene.time.dt, 0.01);
  EXPECT_EQ(scene.time.until, 2.0);
  EXPECT_EQ(scene.time.substeps, 4);
  EXPECT_EQ(scene.domain.kind, DomainKind::box);
  EXPECT_EQ(scene.domain.max, Vec(20.0, 20.0));
  EXPECT_EQ(scene.record.every, 2);
  EXPECT_TRUE(scene.record.position && scene.record.spin && scene.record.single);
  EXPECT_FALSE(scene.record.angle || scene.record.velocity);
}

TEST(Load, PutsTheDefaultMaterialFirst) {
  const Scene scene = load_text(kEverything).scene;
  ASSERT_EQ(scene.materials.size(), 2u);
  EXPECT_EQ(scene.materials[0].name, "default");
  EXPECT_EQ(scene.materials[0].density, 1.0);
  EXPECT_EQ(scene.materials[1].name, "ice");
  EXPECT_EQ(scene.materials[1].density, 900.0);
  EXPECT_EQ(scene.materials[1].friction, 0.02);
  EXPECT_EQ(scene.materials[1].rolling_resistance, 0.01);
}

TEST(Load, WarnsOfMaterialsAndShapesThatNobodyIsOf) {
  const std::string text =
      "throng = 1\nmaterials.ice.friction = 0.1\nmaterials.default.friction = 0.2\nshapes.ball.disc.radius = "
      "1\nshapes.box.polygon = [[0, 0], [1, 0], [1, 1], [0, 1]]\n[[bodies]]\nshape = 'ball'\nat = [0, 0]\n";
  const std::string ice = "materials.ice: is of no body and no wall\n",
                    box = "s.toml:5:8: warning: shapes.box: is of no body\n",
                    other = "materials.default: is of no body and no wall\n";
  EXPECT_EQ(faults(load_text(text)), "s.toml:2:11: warning: " + ice + box);
  EXPECT_EQ(faults(load_text(text + "material = 'ice'\n")), "s.toml:3:11: warning: " + other + box);
  const std::string ice_alone = text + "material = 'ice'\n[[bodies]]\nshape = 'box'\nat = [5, 0]\n";
  EXPECT_EQ(faults(load_text(ice_alone)), "");
  const std::string all_ice = ice_alone + "material = 'ice'\n";
  EXPECT_EQ(faults(load_text(all_ice)), "s.toml:3:11: warning: " + other);
  EXPECT_EQ(faults(load_text(all_ice, {"domain.box = [[-9, -9], [9, 9]]"})), "") << "its walls";
  EXPECT_EQ(faults(load_text(all_ice + "[[walls]]\nsegment = [[0, 5], [1, 5]]\n")), "");
  EXPECT_EQ(faults(load_text(text +
                             "[[bodies]]\nshape = 'box'\nat = [5, 0]\n[[walls]]\nsegment = [[0, 5], [1, 5]]\n"
                             "material = 'ice'\n")),
            "");
}

TEST(Load, ReadsABodyThatStandsAlone) {
  const Bodies bodies = load_text(kEverything).scene.bodies;
  ASSERT_EQ(bodies.size(), 1u + 20u + 4u + 1u);
  EXPECT_EQ(bodies.position[0], Vec(2.0, 3.0));
  EXPECT_EQ(bodies.velocity[0], Vec(1.0, -1.0));
  EXPECT_EQ(bodies.angle[0], 0.5);
  EXPECT_EQ(bodies.spin[0], 0.25);
  EXPECT_EQ(bodies.radius[0], 0.4);
  EXPECT_EQ(bodies.material[0], 1u);
  EXPECT_EQ(bodies.kind[0], BodyKind::kinematic);
}

TEST(Load, FillsALatticeRowByRow) {
  const Bodies bodies = load_text(kEverything).scene.bodies;
  EXPECT_EQ(bodies.position[21], Vec(5.0, 5.0));
  EXPECT_EQ(bodies.position[22], Vec(6.5, 5.0));
  EXPECT_EQ(bodies.position[23], Vec(5.0, 7.0));
  EXPECT_EQ(bodies.position[24], Vec(6.5, 7.0));
}

TEST(Load, FillsAsMuchOfALatticeAsTheCountSays) {
  const Loaded loaded = load_text(kEverything, {"bodies[2].count=3"});
  ASSERT_EQ(faults(loaded), "");
  EXPECT_EQ(loaded.scene.bodies.size(), 25u);
  EXPECT_EQ(loaded.scene.bodies.position[23], Vec(5.0, 7.0));
}

TEST(Load, ReadsWallsOfAllForms) {
  const std::vector<Wall> walls = load_text(kEverything).scene.walls;
  ASSERT_EQ(walls.size(), 5u);
  EXPECT_EQ(walls[0].points, (std::vector<Vec>{{0, 1}, {5, 1}}));
  EXPECT_EQ(walls[0].material, 1u);
  EXPECT_EQ(walls[1].points.size(), 3u);
  EXPECT_FALSE(walls[1].closed);
  EXPECT_TRUE(walls[2].closed);
  EXPECT_EQ(walls[4].points, (std::vector<Vec>{{2, 19}, {3, 19}, {3, 19.5}}));
}

TEST(Load, RemovesTheMomentumOfMaxwellVelocities) {
  const Scene scene = load_text(kEverything).scene;
  Vec momentum(0.0, 0.0);
  double speed = 0.0;
  for (std::size_t row = 1; row < 21; ++row) {
    momentum += mass(scene, row) * scene.bodies.velocity[row];
    speed += scene.bodies.velocity[row].norm() / 20.0;
  }
  EXPECT_LT(momentum.norm(), 1e-15);
  EXPECT_GT(speed, 0.2);
  EXPECT_LT(speed, 1.5);
}

TEST(Load, DrawsRadiiAndAnglesWithinTheirBounds) {
  const Bodies bodies = load_text(kEverything).scene.bodies;
  double least = 1.0, most = 0.0;
  for (std::size_t row = 1; row < 21; ++row) {
    least = std::min(least, bodies.radius[row]);
    most = std::max(most, bodies.radius[row]);
    EXPECT_LE(std::abs(bodies.angle[row]), 1.0);
  }
  EXPECT_GE(least, 0.1);
  EXPECT_LE(most, 0.2);
  EXPECT_GT(most - least, 0.05);
}

TEST(Load, WrapsPositionsIntoAPeriodicDomain) {
  const Loaded loaded = load_text(
      "throng = 1\ndomain = { periodic = [[-1, 0], [3, 5]] }\nshapes.a.disc.radius = 0.1\n"
      "[[bodies]]\nshape = 'a'\nat = [3, -0.25]\n[[bodies]]\nshape = 'a'\nat = [-9.5, 17]\n");
  ASSERT_EQ(faults(loaded), "");
  EXPECT_EQ(loaded.scene.bodies.position[0], Vec(-1.0, 4.75));
  EXPECT_EQ(loaded.scene.bodies.position[1], Vec(2.5, 2.0));
}

TEST(Load, KnowsItsDefaults) {
  const Loaded loaded = load_text("throng = 1\n");
  ASSERT_EQ(faults(loaded), "");
  EXPECT_EQ(loaded.scene.domain.kind, DomainKind::unbounded);
  EXPECT_EQ(loaded.scene.time.dt, Time().dt);
  EXPECT_EQ(loaded.scene.bodies.size(), 0u);
}

TEST(Load, TakesLineEndsOfOtherSystemsAndAByteOrderMark) {
  std::string text = "\xEF\xBB\xBF";
  for (char c : kEverything) text += c == '\n' ? std::string("\r\n") : std::string(1, c);
  const Loaded loaded = load_text(text);
  ASSERT_EQ(faults(loaded), "");
  expect_same(loaded.scene, load_text(kEverything).scene);
}

TEST(Load, AppliesOverrides) {
  const Loaded loaded =
      load_text(kEverything, {"time.dt=0.005", "bodies.0.velocity=[3, 4]", "bodies[1].count=2",
                              "engine=box2d", "name=\"quoted\"", "materials.\"ice\".friction=0.5",
                              "materials.ice.rolling_resistance=0", "contact.model = impulse"});
  ASSERT_EQ(faults(loaded), "");
  EXPECT_EQ(loaded.scene.time.dt, 0.005);
  EXPECT_EQ(loaded.scene.bodies.velocity[0], Vec(3.0, 4.0));
  EXPECT_EQ(loaded.scene.bodies.size(), 8u);
  EXPECT_EQ(loaded.scene.engine, Engine::box2d);
  EXPECT_EQ(loaded.scene.name, "quoted");
  EXPECT_EQ(loaded.scene.materials[1].friction, 0.5);
  EXPECT_EQ(loaded.scene.contact, ContactModel::impulse);
  EXPECT_EQ(load_text(kEverything, {"contact.model = none"}).scene.contact, ContactModel::none);
}

TEST(Load, MakesTablesForAnOverride) {
  const Loaded loaded = load_text("throng = 1\n", {"time.until=3", "materials.wood.density=700"});
  ASSERT_EQ(faults(loaded), "");
  EXPECT_EQ(loaded.scene.time.until, 3.0);
  EXPECT_EQ(loaded.scene.materials.at(1).density, 700.0);
}

TEST(Load, ResolvesToATextOfTheSameScene) {
  const std::vector<std::string> overrides = {"time.dt=0.1", "gravity=[1e-300, 0.30000000000000004]",
                                              "seed=12"};
  const Loaded loaded = load_text(kEverything, overrides);
  const Loaded again = load_text(loaded.resolved);
  ASSERT_EQ(faults(again), "");
  expect_same(loaded.scene, again.scene);
  EXPECT_EQ(loaded.resolved, again.resolved);
  EXPECT_EQ(loaded.text, kEverything);
}

TEST(Load, ResolvesNamesThatNeedQuotes) {
  const Loaded loaded =
      load_text("throng = 1\nname = \"a\\\"b\\\\\\u0001\\n\"\nshapes.'my \"ball\"'.disc.radius = 1\n");
  ASSERT_EQ(faults(loaded), "");
  const Loaded again = load_text(loaded.resolved);
  ASSERT_EQ(faults(again), "");
  expect_same(loaded.scene, again.scene);
}

TEST(Load, ReadsAFile) {
  const std::string file = ::testing::TempDir() + "throng_load_test.toml";
  std::ofstream(file) << kEverything;
  const Loaded loaded = load_scenario(file);
  EXPECT_EQ(faults(loaded), "");
  EXPECT_EQ(loaded.text, kEverything);
  EXPECT_EQ(loaded.scene.bodies.size(), 26u);
  std::remove(file.c_str());
}

TEST(Load, SaysThatAFileIsNotThere) {
  EXPECT_EQ(faults(load_scenario("/no/such/file.toml")), "s.toml: error: there is no such file\n");
}

TEST(Load, SaysThatAFileIsAFolder) {
  EXPECT_EQ(faults(load_scenario("/")), "s.toml: error: is a folder; must be a file in TOML\n");
}

TEST(Load, RefusesAHugeFileBeforeItHasReadAllOfIt) {
  const std::string file = ::testing::TempDir() + "throng_huge_test.toml";
  std::ofstream(file) << "throng = 1\n";
  std::filesystem::resize_file(file, std::uintmax_t{1} << 40);
  EXPECT_EQ(faults(load_scenario(file)), "s.toml: error: is larger than 64 MB; must be at most that\n");
  std::remove(file.c_str());
}

/// It happened: a long one was said to be too large, a short one to be binary, and none to be a recording.
TEST(Load, SaysThatAFileIsARecording) {
  const std::string file = ::testing::TempDir() + "throng_recording_test.h5";
  std::ofstream(file, std::ios::binary) << "\x89HDF\r\n\x1a\n";
  for (const std::uintmax_t bytes : {std::uintmax_t{8}, std::uintmax_t{1} << 12, std::uintmax_t{1} << 40}) {
    std::filesystem::resize_file(file, bytes);
    EXPECT_EQ(
        faults(load_scenario(file)),
        "s.toml: error: is HDF5, as recordings are, and no TOML; throng replay shows one, throng resume "
        "goes on with it\n");
  }
  std::remove(file.c_str());
}

TEST(Load, GivesAStepSoManySubstepsThatTheyAreShort) {
  const auto substeps = [](const std::string& time) {
    return load_text("throng = 1\ntime = { until = 0, " + time + " }\n").scene.time.substeps;
  };
  EXPECT_EQ(substeps("dt = 0.0001"), 4);
  EXPECT_EQ(substeps("dt = 0.01"), 4);
  EXPECT_EQ(substeps("dt = 0.016666666666666666"), 7);
  EXPECT_EQ(substeps("dt = 0.05"), 20);
  EXPECT_EQ(substeps("dt = 0.1"), 40);
  EXPECT_EQ(substeps("dt = 10"), 40);
  EXPECT_EQ(substeps("dt = 0.1, substeps = 3"), 3) << "as the file says";
}

const std::string kSoft =
    "throng = 1\ncontact = { model = 'spring', stiffness = 1e6 }\nmaterials.default.restitution = 0.5\n"
    "shapes.b.disc.radius = 1\nbodies = [{ shape = 'b', at = [0, 0] }, { shape = 'b', at = [5, 0] }]\n";

TEST(Load, WarnsOfARecordedRegionOutsideOfTheDomain) {
  const auto said = [](const std::string& within) {
    return faults(load_text(
        "throng = 1\ndomain = { box = [[0, 0], [20, 60]] }\nrecord = { within = " + within + " }\n"));
  };
  EXPECT_EQ(
      said("[[21, 0], [22, 1]]"),
      "s.toml:3:21: warning: record.within: is wholly outside of the domain: nobody is recorded whom its "
      "border holds\n");
  EXPECT_EQ(said("[[19, 0], [22, 1]]"), "");
}

TEST(Load, WarnsOfARecordingOfNothing) {
  const auto said = [](const std::string& rest) {
    const Loaded loaded = load_text("throng = 1\nrecord = { fields = []" + rest);
    EXPECT_EQ(loaded.errors(), 0);
    return faults(loaded);
  };
  EXPECT_EQ(
      said(" }\n"),
      "s.toml:2:21: warning: record.fields: is empty, and nothing else is recorded: frames hold step, time "
      "and the state's hash, for replay --verify\n");
  EXPECT_EQ(said(", observables = 5 }\n"), "");
  EXPECT_EQ(said(", also = [{ every = 5, fields = ['contacts'] }] }\n"), "");
  EXPECT_EQ(said(" }\n[[sensors]]\nname = 'a'\nradius = 1\nrecord = true\n"), "");
}

TEST(Load, GivesSoftContactsFiftySubstepsInAnImpact) {
  // pi sqrt(m / 2 / k) with m = pi kg: 3.94 ms.
  EXPECT_EQ(load_text(kSoft).scene.time.substeps, 127);
  EXPECT_EQ(load_text(kSoft, {"time.dt = 1e-5"}).scene.time.substeps, 1);
  EXPECT_EQ(load_text(kSoft, {"time.dt = 0.1"}).scene.time.substeps, 1000);
  const Loaded hertz = load_text(kSoft, {"contact = { model = 'hertz', youngs_modulus = 1e8 }"});
  EXPECT_EQ(faults(hertz), "");
  EXPECT_EQ(hertz.scene.time.substeps, 1) << "nothing moves";
  // v = 4 m/s: 2.868 (m*^2 / (R* E*^2 v))^(1/5) = 6.02 ms.
  const std::vector<std::string> moving{"contact = { model = 'hertz', youngs_modulus = 1e7 }",
                                        "bodies[1].velocity = [-2, 0]"};
  EXPECT_EQ(load_text(kSoft, moving).scene.time.substeps, 84);
}

TEST(Load, ReadsWhatSoftContactsAre) {
  const Scene spring =
      load_text(kSoft, {"contact.tangential_stiffness = 0.5", "contact.tangential_damping = 0"}).scene;
  EXPECT_EQ(spring.contact, ContactModel::spring);
  EXPECT_EQ(spring.soft.stiffness, 1e6);
  EXPECT_EQ(spring.soft.tangential_stiffness, 0.5);
  EXPECT_EQ(spring.soft.tangential_damping, 0.0);
  const Scene hertz =
      load_text(kSoft, {"contact = { model = 'hertz', youngs_modulus = 1e7, poisson_ratio = 0.2 }"}).scene;
  EXPECT_EQ(hertz.contact, ContactModel::hertz);
  EXPECT_EQ(hertz.soft.youngs_modulus, 1e7);
  EXPECT_EQ(hertz.soft.poisson_ratio, 0.2);
}

const std::string kGrains =
    "throng = 1\ngravity = [0, -9.81]\nshapes.grain.disc.radius = 0.0025\nwalls = [{ segment = [[-1, 0], [1, "
    "0]] }]\nbodies = [{ shape = 'grain', at = [0, 1] }]\n";

// A stranger's grains fell through one another at the default step, and nothing was said.
TEST(Load, TakesSubstepsThatSmallBodiesNeed) {
  EXPECT_EQ(load_text(kGrains).scene.time.substeps, 18) << "0.025 √(0.005 / 9.81) s";
  EXPECT_EQ(load_text(kGrains, {"shapes.grain.disc.radius = 0.3"}).scene.time.substeps, 4);
  EXPECT_EQ(load_text(kGrains, {"gravity = [0, 0]"}).scene.time.substeps, 4);
  EXPECT_EQ(load_text(kGrains, {"walls = []"}).scene.time.substeps, 4) << "nothing to fall on";
  EXPECT_EQ(load_text(kGrains, {"time.dt = 0.1"}).scene.time.substeps, 40);
  EXPECT_EQ(load_text(kGrains, {"time.substeps = 9"}).scene.time.substeps, 9);
  EXPECT_EQ(load_text(kGrains, {"engine = 'box2d'"}).scene.time.substeps, 4);
}

TEST(Load, WarnsOfSubstepsInWhichSmallBodiesPassThroughOthers) {
  EXPECT_EQ(faults(load_text(kGrains)), "");
  EXPECT_EQ(faults(load_text(kGrains, {"time.substeps = 9"})), "");
  EXPECT_EQ(faults(load_text(kGrains, {"time.substeps = 8"})),
            "--set time.substeps = 8: warning: time.substeps: substeps of 0.00125 s are long for bodies as "
            "small as "
            "discs 0.005 m across that 9.81 m/s² press on others: from 0.00113 s on they overlap by a tenth "
            "of their radius, "
            "from four times that on they pass through one another and steps take ever longer; time.substeps "
            "should be at least 9\n");
  EXPECT_THAT(faults(load_text(kGrains, {"time.dt = 0.1"})),
              ::testing::HasSubstr("warning: time.dt: substeps of 0.0025 s are long"));
  // What whirls presses as gravity does: discs of 1 cm crept through the walls of a cage.
  const std::string whirl =
      "throng = 1\nshapes.cage = { polygon = [[-1, -1], [1, -1], [1, 1], [-1, 1]], holes = [[[-0.97, -0.97], "
      "[-0.97, 0.97], [0.97, 0.97], [0.97, -0.97]]] }\nshapes.s.disc.radius = 0.01\nbodies = [{ shape = "
      "'cage', at = [0, 0], kind = 'kinematic', spin = 10 }, { shape = 's', at = [0, 0] }]\n";
  EXPECT_EQ(load_text(whirl).scene.time.substeps, 34) << "141 m/s²";
  EXPECT_THAT(faults(load_text(whirl, {"time.substeps = 4"})),
              ::testing::HasSubstr("that 141 m/s² press on"));
}

/// It happened: a plate 0.05 m thick was said to be "0.1 m thick".
TEST(Load, NamesOfAPlateTheDiscThatIsAsSmall) {
  EXPECT_THAT(faults(load_text("throng = 1\ngravity = [0, -9.81]\ntime = { dt = 0.1, substeps = 1 }\n"
                               "shapes.p.polygon = [[0, 0], [10, 0], [10, 0.05], [0, 0.05]]\n"
                               "walls = [{ segment = [[-9, 0], [9, 0]] }]\n"
                               "bodies = [{ shape = 'p', at = [0, 1] }]\n")),
              ::testing::HasSubstr("are long for bodies as small as discs 0.0995 m across that"));
}

const std::string kHeavyOnLight =
    "throng = 1\ngravity = [0, -9.81]\ntime = { dt = 0.0125, substeps = 5 }\nmaterials.light.density = 1\n"
    "materials.heavy.density = 1000\nshapes.b.polygon = [[0, 0], [1, 0], [1, 1], [0, 1]]\n"
    "walls = [{ segment = [[-9, 0], [9, 0]] }]\nbodies = [{ shape = 'b', material = 'light', at = [0, 0.5] "
    "}, "
    "{ shape = 'b', material = 'heavy', at = [0, 1.5] }]\n";

/// It happened: a box of 1e5 kg pressed one of 1 kg through the floor, and nothing was said.
TEST(Load, WarnsOfSubstepsInWhichHeavyBodiesPressLightOnesThroughOthers) {
  EXPECT_EQ(
      faults(load_text(kHeavyOnLight)),
      "s.toml:3:34: warning: time.substeps: substeps of 0.0025 s are long should a body of 1e+03 kg come "
      "to lie on one of 1 kg, 1e+03 times lighter: from 0.00202 s on the light one overlaps what it lies "
      "on by a tenth of its radius, from four times that on it may be pressed through; time.substeps "
      "should be at least 7\n");
  EXPECT_EQ(faults(load_text(kHeavyOnLight, {"time.substeps = 7"})), "");
  EXPECT_EQ(faults(load_text(kHeavyOnLight, {"materials.heavy.density = 500"})), "");
  EXPECT_EQ(faults(load_text(kHeavyOnLight, {"materials.light.density = 1000"})), "");
  EXPECT_EQ(faults(load_text(kHeavyOnLight, {"gravity = [0, 0]"})), "");
  EXPECT_EQ(faults(load_text(kHeavyOnLight, {"walls = []"})), "") << "nothing to be pressed on";
  EXPECT_EQ(faults(load_text(kHeavyOnLight, {"bodies[1].kind = 'kinematic'"})), "") << "has no weight";
  EXPECT_EQ(faults(load_text(kHeavyOnLight, {"engine = 'box2d'"})), "");
}

TEST(Load, WarnsOfFewSubstepsInAnImpact) {
  EXPECT_EQ(faults(load_text(kSoft, {"time.substeps = 51"})), "");
  EXPECT_EQ(faults(load_text(kSoft, {"time.substeps = 50"})),
            "--set time.substeps = 50: warning: time.substeps: an impact lasts 0.00394 s, 19.7 substeps of "
            "0.0002 s: "
            "fewer than 20 are not accurate; time.substeps should be at least 51\n");
}

TEST(Load, WarnsOfFallsSoFastThatSoftContactsMayNotSeeThem) {
  const std::vector<std::string> few = {"time.dt = 0.01", "time.substeps = 17", "contact.stiffness = 1e5",
                                        "gravity = [0, -9.81]"};
  const auto said = [&](const std::string& floor) {
    auto settings = few;
    settings.push_back("walls = [{ segment = [[-1, " + floor + "], [1, " + floor + "]] }]");
    return faults(load_text(kSoft, settings));
  };
  EXPECT_EQ(said("-20"), "");
  EXPECT_THAT(said("-500000"),
              ::testing::HasSubstr("who falls as far as the scene is high may get to 3.13e+03 m/s, "
                                   "so 1.84 m in a substep, farther than the smallest disc's "
                                   "radius, 1 m"));
  EXPECT_EQ(faults(load_text(
                "throng = 1\ncontact = { model = 'spring', stiffness = 1e5 }\n"
                "shapes.b.disc.radius = 1\nbodies = [{ shape = 'b', at = [0, 0], velocity = [1e6, 0] }]\n")),
            "")
      << "nothing to meet";
}

/// Of the advice in a refusal to begin in a periodic domain, s; 0 where nothing is refused.
double advised(const std::string& fault) {
  const std::string before = "take time.dt at most ";
  const std::size_t at = fault.find(before);
  return at == std::string::npos ? 0.0 : std::stod(fault.substr(at + before.size()));
}

TEST(Load, RefusesTooFastAStartInAPeriodicDomainAndSaysWhatWouldDo) {
  const std::string periodic = "throng = 1\ndomain.periodic = [[0, 0], [9, 9]]\ntime.dt = 0.2\n";
  const std::string triangle = "shapes.b.polygon = [[1, 0], [-0.5, 0.866], [-0.5, -0.866]]\n";
  const std::string composite = "shapes.b.discs = [[0, 0, 0.2], [1.4, 0, 0.2], [0.7, 0, 0.1]]\n";
  const std::string disc = "shapes.b.disc.radius = 1\n";
  const auto two = [](const std::string& more) {
    return "bodies = [{ shape = 'b', at = [2, 2], " + more + " }, { shape = 'b', at = [6, 6] }]\n";
  };
  for (const std::string& text :
       {disc + two("velocity = [10, 0]"), "gravity = [0, -9.81]\n" + disc + two("velocity = [0, -10]"),
        triangle + two("velocity = [10, 0]"), triangle + two("velocity = [10, 0], spin = 30"),
        composite + two("spin = 300")}) {
    const std::string fault = faults(load_text(periodic + text));
    const double dt = advised(fault);
    EXPECT_THAT(fault, ::testing::HasSubstr("domain.periodic: step 1: body 1 may reach ")) << text;
    EXPECT_GT(dt, 0.0) << text;
    EXPECT_EQ(faults(load_text(periodic + text, {"time.dt = " + std::to_string(dt)})), "") << text;
  }
}

TEST(Load, LetsGoFastInAPeriodicDomainWhoMeetsNobody) {
  const std::string periodic = "throng = 1\ndomain.periodic = [[0, 0], [9, 9]]\nshapes.b.disc.radius = 1\n";
  const std::string fast = "{ shape = 'b', at = [2, 2], velocity = [1000, 0] }";
  const std::string still = "{ shape = 'b', at = [6, 6] }";
  EXPECT_EQ(faults(load_text(periodic + "bodies = [" + fast + "]\n")), "");
  EXPECT_EQ(faults(load_text(periodic + "contact.model = 'none'\nbodies = [" + fast + ", " + still + "]\n")),
            "");
  EXPECT_EQ(
      faults(load_text(periodic + "shapes.c.disc.radius = 3\nbodies = [{ shape = 'c', at = [5, 5], kind = "
                                  "'static' }, { shape = 'b', at = [0.5, 0.5], velocity = [1, 0] }]\n")),
      "");
}

}  // namespace throng
