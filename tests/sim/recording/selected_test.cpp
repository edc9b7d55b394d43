// SPDX-License-Identifier: MIT
// What record asks for beside all fields of all bodies in each frame.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sim/input_error.h"
#include "sim/recording/expected_bytes.h"
#include "sim/recording/observables.h"
#include "sim/recording/output_file.h"
#include "sim/recording/recording.h"
#include "tests/sim/recording/crowd.h"
#include "tests/sim/recording/scenes.h"
#include "tests/sim/scene_from.h"

namespace throng {
namespace {

using namespace testing_recordings;
using testing::HasSubstr;

TEST(Selected, FieldsAreInTheFramesOfTheirOwnRate) {
  const Folder folder;
  Scene scene = mixed_scene(20);
  scene.record.every = 4;
  own_every(scene, RecordField::velocity) = 6;
  own_every(scene, RecordField::spin) = 12;
  record_run(folder / "a.h5", scene, 30);
  const Recording recording(folder / "a.h5");
  EXPECT_EQ(every(recording.geometry().record, RecordField::velocity), 6);
  ASSERT_EQ(recording.frames(), 11u);
  for (std::size_t i = recording.frames(); i-- > 0;) {
    const Frame frame = recording.frame(i);
    const State state = state_at(scene, frame.step);
    EXPECT_EQ(frame.position, frame.step % 4 ? std::vector<Vec>{} : state.position) << frame.step;
    EXPECT_EQ(frame.angle, frame.step % 4 ? std::vector<double>{} : state.angle) << frame.step;
    EXPECT_EQ(frame.velocity, frame.step % 6 ? std::vector<Vec>{} : state.velocity) << frame.step;
    EXPECT_EQ(frame.spin, frame.step % 12 ? std::vector<double>{} : state.spin) << frame.step;
  }
}

TEST(Selected, FramesWithPositionsCanBeLookedAtAlone) {
  const Folder folder;
  Scene scene = mixed_scene(5);
  scene.record.every = 3;
  own_every(scene, RecordField::velocity) = 2;
  record_run(folder / "a.h5", scene, 12);
  const Recording recording(folder / "a.h5", FrameChoice::with_position);
  EXPECT_THAT(std::vector(recording.steps().begin(), recording.steps().end()),
              testing::ElementsAre(0, 3, 6, 9, 12));
  EXPECT_EQ(recording.frame(3).position, state_at(scene, 9).position);
  EXPECT_EQ(recording.sample(RecordField::velocity, 4), 6u);
  EXPECT_EQ(recording.sample(RecordField::velocity, 3), std::nullopt);
}

/// It happened: what had an angle in every third frame stood upright in the others.
TEST(Selected, FramesWithoutAnglesAreDrawnWithTheLast) {
  const Folder folder;
  Scene scene = mixed_scene(5);
  scene.record.every = 2;
  own_every(scene, RecordField::angle) = 3;
  record_run(folder / "a.h5", scene, 12);
  const Recording recording(folder / "a.h5", FrameChoice::with_position);
  for (std::size_t i = 0; i < recording.frames(); ++i) {
    Frame frame = recording.frame(i);
    EXPECT_EQ(frame.angle.empty(), frame.step % 3 != 0);
    recording.carry_angles(i, frame);
    EXPECT_EQ(frame.angle, state_at(scene, frame.step / 3 * 3).angle) << frame.step;
  }
}

TEST(Selected, BodiesThatWereAwayAreDrawnUpright) {
  const Folder folder;
  Scene scene = mixed_scene(700);
  scene.time.dt = 0.5;
  scene.record.within = Eigen::AlignedBox2d(Vec(3, -30), Vec(12.5, 20));
  own_every(scene, RecordField::angle) = 6;
  record_run(folder / "a.h5", scene, 5);
  const Recording recording(folder / "a.h5");
  Frame frame = recording.frame(5);
  const Frame last = recording.frame(0);
  recording.carry_angles(5, frame);
  std::size_t came = 0;
  for (std::size_t row = 0; row < 700; ++row) {
    EXPECT_EQ(frame.angle[row], last.has(row) ? last.angle[row] : 0.0);
    came += frame.has(row) && !last.has(row);
  }
  EXPECT_GT(came, 0u);
}

TEST(Selected, SomeBodiesKeepTheirIdsAndShapes) {
  const Folder folder;
  Scene scene = mixed_scene(20);
  scene.record.ids = {2, 3, 11, 20};
  record_run(folder / "a.h5", scene, 3);
  const Recording recording(folder / "a.h5");
  EXPECT_EQ(recording.bodies(), 4u);
  EXPECT_EQ(recording.bodies_of_run(), 20u);
  const Frame frame = recording.frame(2);
  const State state = state_at(scene, 2);
  EXPECT_EQ(frame.id, scene.record.ids);
  EXPECT_EQ(frame.state_hash, hash(state)) << "of all bodies";
  for (std::size_t row = 0; row < 4; ++row) {
    const std::size_t body = frame.id[row] - 1;
    EXPECT_EQ(frame.position[row], state.position[body]);
    EXPECT_EQ(frame.spin[row], state.spin[body]);
    EXPECT_EQ(recording.geometry().bodies.shape[row], scene.bodies.shape[body]);
    EXPECT_EQ(recording.geometry().bodies.radius[row], scene.bodies.radius[body]);
  }
}

/// Agents: the last of mixed_scene's bodies, of which every fifth leaves at each step.
State crowd_at(const Scene& scene, std::int64_t step) {
  State state = state_at(scene, step);
  const auto stays = [&](std::uint32_t id) {
    return id % 5 == 0 || id % 5 > static_cast<std::uint32_t>(step);
  };
  std::size_t kept = 0;
  for (std::size_t row = 0; row < state.id.size(); ++row) {
    if (!stays(state.id[row])) continue;
    state.id[kept] = state.id[row], state.position[kept] = state.position[row];
    state.angle[kept] = state.angle[row], state.velocity[kept] = state.velocity[row];
    state.spin[kept++] = state.spin[row];
  }
  state.id.resize(kept), state.position.resize(kept), state.angle.resize(kept);
  state.velocity.resize(kept), state.spin.resize(kept);
  return state;
}

Scene crowd_scene(std::size_t n) {
  Scene scene = mixed_scene(n);
  scene.bodies.kind.assign(n, BodyKind::agent);
  scene.crowd.walkable.rings = {{{0, 0}, {9, 0}, {9, 9}}, {{5, 1}, {6, 1}, {6, 2}, {5, 2}}};
  scene.crowd.group.assign(n, 0);
  scene.crowd.groups.resize(1);
  scene.crowd.groups[0].journey.resize(1);
  return scene;
}

TEST(Selected, AgentsAreThereUntilTheyLeave) {
  const Folder folder;
  const Scene scene = crowd_scene(300);
  {
    Recorder recorder(folder / "a.h5", scene, provenance());
    for (std::int64_t step = 0; step <= 4; ++step) recorder.record(crowd_at(scene, step));
    recorder.finish({});
  }
  const Recording recording(folder / "a.h5");
  EXPECT_EQ(recording.geometry().record.within, std::nullopt);
  EXPECT_EQ(recording.geometry().bodies.kind.back(), BodyKind::agent);
  EXPECT_EQ(recording.geometry().crowd.walkable.rings, scene.crowd.walkable.rings);
  for (std::size_t i = recording.frames(); i-- > 0;) {
    const Frame frame = recording.frame(i);
    const State state = crowd_at(scene, static_cast<std::int64_t>(i));
    EXPECT_EQ(frame.state_hash, hash(state));
    EXPECT_EQ(frame.bodies(), 60 * (5 - i));
    ASSERT_EQ(frame.bodies(), state.id.size());
    for (std::size_t row = 0; row < state.id.size(); ++row) {
      const std::size_t at = state.id[row] - std::size_t{1};
      ASSERT_TRUE(frame.has(at));
      EXPECT_EQ(frame.position[at], state.position[row]);
      EXPECT_EQ(frame.spin[at], state.spin[row]);
    }
  }
}

/// 700 bodies take three chunks; those of the drift enter and leave the region.
TEST(Selected, RegionsHoldWhoIsInThem) {
  const Folder folder;
  Scene scene = mixed_scene(700);
  scene.time.dt = 0.5;
  scene.record.within = Eigen::AlignedBox2d(Vec(3, -30), Vec(12.5, 20));
  own_every(scene, RecordField::angle) = 2;
  record_run(folder / "a.h5", scene, 6);
  const Recording recording(folder / "a.h5");
  std::size_t least = 700, most = 0;
  for (std::size_t i = recording.frames(); i-- > 0;) {
    const Frame frame = recording.frame(i);
    const State state = state_at(scene, static_cast<std::int64_t>(i));
    least = std::min(least, frame.bodies()), most = std::max(most, frame.bodies());
    for (std::size_t row = 0; row < 700; ++row) {
      ASSERT_EQ(frame.has(row), scene.record.within->contains(state.position[row]));
      if (frame.has(row)) {
        EXPECT_EQ(frame.position[row], state.position[row]);
        EXPECT_EQ(frame.angle.empty() ? state.angle[row] : frame.angle[row], state.angle[row]);
        EXPECT_EQ(frame.angle.empty(), i % 2 != 0);
      } else {
        EXPECT_TRUE(frame.position[row].hasNaN());
      }
    }
  }
  EXPECT_GT(least, 100u) << "some are in";
  EXPECT_LT(most, 600u) << "some are out";
  EXPECT_LT(least, most) << "some come or go";
}

/// Frames of observables alone say nothing of who is in the region, and go on from anywhere, too.
TEST(Selected, RegionsHoldNobodyWhereNothingOfBodiesIsDue) {
  const Folder folder;
  Scene scene = mixed_scene(30);
  scene.record.within = Eigen::AlignedBox2d(Vec(3, -30), Vec(12.5, 20));
  scene.record.every = 4;
  scene.record.observables = 6;
  own_every(scene, RecordField::velocity) = 8;
  record_run(folder / "a.h5", scene, 24);
  const Recording recording(folder / "a.h5");
  ASSERT_EQ(recording.frames(), 9u);
  for (std::size_t i = recording.frames(); i-- > 0;) {
    const Frame frame = recording.frame(i);
    EXPECT_EQ(frame.bodies() > 0, frame.step % 4 == 0) << frame.step;
    EXPECT_EQ(frame.position.empty(), frame.step % 4 != 0) << frame.step;
    EXPECT_EQ(frame.velocity.empty(), frame.step % 8 != 0) << frame.step;
    EXPECT_EQ(frame.observables.has_value(), frame.step % 6 == 0) << frame.step;
  }
}

TEST(Selected, EmptyRegionsAreFramesToo) {
  const Folder folder;
  Scene scene = mixed_scene(5);
  scene.record.within = Eigen::AlignedBox2d(Vec(100, 100), Vec(101, 101));
  record_run(folder / "a.h5", scene, 2);
  EXPECT_EQ(Recording(folder / "a.h5").frame(2).bodies(), 0u);
}

TEST(Selected, QuantizedPositionsComeBackWithinHalfAQuantumFromAnywhere) {
  const Folder folder;
  Scene scene = mixed_scene(300);
  scene.time.dt = 0.04;
  scene.record.quantum = 1e-3;
  record_run(folder / "a.h5", scene, 50);
  const Recording recording(folder / "a.h5");
  EXPECT_EQ(recording.geometry().record.quantum, 1e-3);
  for (std::size_t i : {0, 1, 2, 3, 15, 16, 17, 18, 50, 33, 32, 31, 47, 5, 5, 49}) {
    const Frame frame = recording.frame(i);
    const State state = state_at(scene, static_cast<std::int64_t>(i));
    EXPECT_EQ(frame.velocity, state.velocity);
    for (std::size_t row = 0; row < 300; ++row)
      ASSERT_LE((frame.position[row] - state.position[row]).cwiseAbs().maxCoeff(), 0.5e-3 * (1 + 1e-9)) << i;
  }
}

/// Who leaves comes back after no frame, one, two or more, across key frames, too.
TEST(Selected, QuantizedPositionsAreOfWhoIsInTheRegion) {
  const Folder folder;
  Scene scene = mixed_scene(300);
  scene.record.within = Eigen::AlignedBox2d(Vec(3, -30), Vec(12.5, 20));
  scene.record.quantum = 1e-3;
  const auto state_at_step = [&](std::int64_t step) {
    State state = state_at(scene, step);
    for (std::size_t row = 0; row < state.id.size(); ++row)
      if ((step * (static_cast<std::int64_t>(row) % 7) / 5) % 3 == 1) state.position[row].x() += 20.0;
    return state;
  };
  {
    Recorder recorder(folder / "a.h5", scene, provenance());
    for (std::int64_t step = 0; step < 40; ++step) recorder.record(state_at_step(step));
    recorder.finish({});
  }
  const Recording recording(folder / "a.h5");
  std::size_t here = 0, came = 0;
  std::vector<std::uint8_t> before;
  for (std::size_t i : {39, 0, 1, 2, 3, 4, 16, 15, 17, 18, 31, 32, 33, 34, 35, 36, 37, 38}) {
    const Frame frame = recording.frame(i);
    const State state = state_at_step(static_cast<std::int64_t>(i));
    for (std::size_t row = 0; row < 300; ++row) {
      ASSERT_EQ(frame.has(row), scene.record.within->contains(state.position[row])) << i;
      if (frame.has(row)) {
        ASSERT_LE((frame.position[row] - state.position[row]).cwiseAbs().maxCoeff(), 0.5e-3 * (1 + 1e-9))
            << i;
        EXPECT_EQ(frame.velocity[row], state.velocity[row]);
      } else {
        EXPECT_TRUE(frame.position[row].hasNaN());
      }
      here += frame.has(row);
      came += !before.empty() && frame.has(row) && !before[row];
    }
    before = frame.is_present;
  }
  EXPECT_GT(came, 200u);
  EXPECT_GT(here, 1000u);
  EXPECT_LT(here, 4500u);
}

TEST(Selected, QuantizedPositionsAreOfAgentsUntilTheyLeave) {
  const Folder folder;
  Scene scene = crowd_scene(300);
  scene.record.quantum = 0.5;
  {
    Recorder recorder(folder / "a.h5", scene, provenance());
    for (std::int64_t step = 0; step <= 4; ++step) recorder.record(crowd_at(scene, step));
    recorder.finish({});
  }
  const Recording recording(folder / "a.h5");
  for (std::size_t i = recording.frames(); i-- > 0;) {
    const Frame frame = recording.frame(i);
    const State state = crowd_at(scene, static_cast<std::int64_t>(i));
    ASSERT_EQ(frame.bodies(), state.id.size());
    for (std::size_t row = 0; row < state.id.size(); ++row) {
      const Vec whole = (state.position[row] / 0.5 + Vec(0.5, 0.5)).array().floor() * 0.5;
      EXPECT_EQ(frame.position[state.id[row] - std::size_t{1}], whole);
    }
  }
}

TEST(Selected, PositionsTooFarForTheirQuantumEndTheRecordingWithASentence) {
  const Folder folder;
  Scene scene = mixed_scene(3);
  scene.record.quantum = 1e-9;
  Recorder recorder(folder / "a.h5", scene, provenance());
  State state = state_at(scene, 0);
  for (Vec& position : state.position) position = {1.0, 1.0};
  recorder.record(state);
  state.step = 1, state.position[2].x() = 3.0;
  recorder.record(state);
  try {
    recorder.finish({});
    FAIL() << "finished";
  } catch (const std::runtime_error& error) {
    EXPECT_THAT(error.what(), HasSubstr("position of body 3 at step 1 is (3, 1) m, too far out for "
                                        "record.quantize = 1e-09: there it must be at least 1.4e-09"));
  }
  EXPECT_EQ(Recording(folder / "a.h5.part").frames(), 1u);
}

TEST(Selected, ContactsAreRowsOfTheirFrame) {
  const Folder folder;
  Scene scene = mixed_scene(9);
  scene.record.contacts = true;
  own_every(scene, RecordField::contacts) = 3;
  record_run(folder / "a.h5", scene, 30);
  const Recording recording(folder / "a.h5");
  std::size_t rows = 0;
  for (std::size_t i = recording.frames(); i-- > 0;) {
    const Frame frame = recording.frame(i);
    ASSERT_EQ(frame.contacts.has_value(), i % 3 == 0);
    if (!frame.contacts) continue;
    EXPECT_EQ(*frame.contacts, contacts_at(static_cast<std::int64_t>(i)));
    rows += frame.contacts->size();
  }
  EXPECT_GT(rows, 10u);
}

TEST(Selected, ContactsAreThoseOfTheRecordedBodies) {
  const Folder folder;
  Scene scene = mixed_scene(9);
  scene.record.contacts = true;
  scene.record.ids = {3, 9};
  record_run(folder / "a.h5", scene, 3);
  const std::vector<ContactRow> all = contacts_at(3);  // 1 with a wall, 2 with 3, 3 with 4
  EXPECT_EQ(Recording(folder / "a.h5").frame(3).contacts, (std::vector<ContactRow>{all[1], all[2]}));
}

/// A file may say anything; ids index.
TEST(Selected, ContactsOfBodiesThatThereAreNotAreRefused) {
  const Folder folder;
  Scene scene = mixed_scene(4);
  scene.record.contacts = true;
  for (const auto& [a, b, fits] :
       {std::tuple(4u, 0u, true), std::tuple(1u, 4u, true), std::tuple(0u, 1u, false),
        std::tuple(5u, 0u, false), std::tuple(1u, 5u, false), std::tuple(0xffffffffu, 0u, false),
        std::tuple(1u, 0xffffffffu, false)}) {
    const std::string path = folder / (std::to_string(a) + "_" + std::to_string(b) + ".h5");
    const ContactRow row{a, b, 1.0, {0.0, 0.0}};
    Recorder recorder(path, scene, provenance());
    recorder.record(state_at(scene, 0), std::span(&row, 1));
    recorder.finish({});
    const Recording recording(path);
    if (fits)
      EXPECT_EQ(recording.frame(0).contacts, std::vector{row});
    else
      EXPECT_THROW(recording.frame(0), InputError) << a << " " << b;
  }
}

TEST(Selected, SensedAreRowsOfTheirFrame) {
  const Folder folder;
  Scene scene = mixed_scene(9);
  scene.record.every = 4;
  add_sensor(scene, 3);
  record_run(folder / "a.h5", scene, 24);
  const Recording recording(folder / "a.h5");
  const Sensor& sensor = recording.geometry().sensors.at(0);
  EXPECT_EQ(sensor.name, scene.sensors[0].name);
  EXPECT_EQ(std::tuple(sensor.radius, sensor.fov, sensor.every), std::tuple(2.5, 120.0, 3));
  EXPECT_EQ(sensor.screens, Screens::walls);
  std::size_t found = 0;
  for (std::size_t i = recording.frames(); i-- > 0;) {
    const Frame frame = recording.frame(i);
    EXPECT_EQ(recording.sensor_sample(0, i).has_value(), frame.step % 3 == 0);
    ASSERT_EQ(frame.sensed.at(0).has_value(), frame.step % 3 == 0);
    if (!frame.sensed[0]) continue;
    EXPECT_EQ(frame.sensed[0], sensed_at(frame.step)) << frame.step;
    found += frame.sensed[0]->whom.size();
  }
  EXPECT_GT(found, 10u);
}

TEST(Selected, MeasuresOfACrowdAreReadAsTheyWere) {
  const Folder folder;
  const Scene scene = measured_crowd();
  record_simulation(folder / "a.h5", scene);
  const Recording recording(folder / "a.h5");
  const std::vector<Measure>&before = scene.crowd.measures, &after = recording.geometry().crowd.measures;
  ASSERT_EQ(after.size(), 2u);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(after[i].name, before[i].name);
    EXPECT_EQ(after[i].line, before[i].line);
    EXPECT_EQ(after[i].area.rings, before[i].area.rings);
    EXPECT_EQ(after[i].size, before[i].size);
  }
  EXPECT_EQ(after[1].size, 6.0);
  const Crowd& crowd = recording.geometry().crowd;
  ASSERT_EQ(crowd.areas.size(), 2u);
  EXPECT_EQ(crowd.areas[0].name, "exit");
  EXPECT_EQ(crowd.areas[0].use, AreaUse::goal);
  EXPECT_EQ(crowd.areas[1].use, AreaUse::none);
  EXPECT_EQ(crowd.areas[1].region.rings, scene.crowd.areas[1].region.rings);
  ASSERT_EQ(crowd.queues.size(), 1u);
  EXPECT_EQ(crowd.queues[0].line, (std::vector<Vec>{{6, 1}, {4, 1}}));
  const auto observed = [&](std::size_t i) { return recording.frame(i).observables.value().crowd.value(); };
  const CrowdObservables first = observed(0), last = observed(recording.frames() - 1);
  EXPECT_EQ(first.agents, 4.0);
  EXPECT_EQ(first, first) << "though nobody's flow is known";
  EXPECT_TRUE(std::isnan(first.measures[3]));
  EXPECT_EQ(last.arrived, 1.0);
  EXPECT_EQ((std::vector(last.measures.begin(), last.measures.begin() + 3)), (std::vector<double>{1, 1, 0}));
  EXPECT_EQ(last.measures[6], 1.0 / 6.0);
}

TEST(Selected, WhatIsSensedAndMeasuredIsExpectedToTakeRoom) {
  const Folder folder;
  const Scene scene = scene_from(
      "time = { dt = 0.01, until = 0.2 }\ncontact = { model = \"none\" }\n"
      "domain = { periodic = [[0, 0], [10, 10]] }\nrecord = { every = 20, observables = 20 }\n"
      "shapes = { ball = { disc = { radius = 0.01 } } }\n"
      "[[bodies]]\nshape = \"ball\"\ncount = 2000\nplace = { random = { within = [[0, 0], [10, 10]] } }\n"
      "[[sensors]]\nname = \"far\"\nradius = 1.5\nfov_degrees = 180\nrecord = true\n");
  record_simulation(folder / "a.h5", scene);
  const double takes = static_cast<double>(std::filesystem::file_size(folder / "a.h5"));
  EXPECT_GT(takes, 10e6);
  EXPECT_NEAR(recording::expected_bytes(scene) / takes, 1.0, 0.1);
  EXPECT_LT(recording::least_bytes(scene), 0.1 * takes);
}

TEST(Selected, ContactsOfFewTakeLittleRoom) {
  const Folder folder;
  const Scene scene = scene_from(
      "time = { dt = 0.01, until = 4 }\nsleep = false\nrecord = { every = 1, fields = [\"contacts\"] }\n"
      "gravity = [0, -9.81]\nshapes = { ball = { disc = { radius = 0.5 } } }\n"
      "[[bodies]]\nshape = \"ball\"\nat = [0, 0.5]\n[[walls]]\nsegment = [[-5, 0], [5, 0]]\n");
  record_simulation(folder / "a.h5", scene);
  EXPECT_LT(std::filesystem::file_size(folder / "a.h5"), 80'000u);
  EXPECT_LT(recording::expected_bytes(scene), 150'000.0) << "three a step";
}

TEST(Selected, WhoArrivesIsExpectedToTakeRoom) {
  const auto expected = [](int agents) {
    return recording::expected_bytes(scene_from(
        "time = { dt = 0.01, until = 0.2 }\nwalkable = 'POLYGON ((0 0, 90 0, 90 90, 0 90, 0 0))'\n"
        "areas.exit = [[80, 0], [90, 0], [90, 90], [80, 90]]\nrecord = { fields = [], of = { ids = [1] } }\n"
        "[[agents]]\nmodel = 'constant_velocity'\ngoal = 'exit'\nradius = 0.05\ncount = " +
        std::to_string(agents) + "\nplace = { random = { within = [[0, 0], [80, 90]] } }\n"));
  };
  EXPECT_NEAR(expected(9000) - expected(1000), 12.0 * 8000.0, 12.0 * 1000.0);
}

TEST(Selected, PathsHoldNamesThatCanBeToldAgain) {
  using recording::path_part;
  EXPECT_EQ(path_part("door"), "door");
  EXPECT_EQ(path_part("N/S"), "N%2FS");
  EXPECT_EQ(path_part("."), "%2E");
  EXPECT_EQ(path_part(".."), "..");
  EXPECT_EQ(path_part("50 % of it, or %4"), "50 % of it, or %4");
  EXPECT_EQ(path_part("%41"), "%2541");
  EXPECT_EQ(path_part("%/%2F"), "%%2F%252F");
}

/// A file may say anything; ids index.
TEST(Selected, SensedThatThereCannotBeAreRefused) {
  const Folder folder;
  Scene scene = mixed_scene(4);
  add_sensor(scene, 1);
  const std::tuple<Sensed, bool> cases[] = {{{{1, 4}, {1, 2}, {4, 1, 2}}, true},
                                            {{{}, {}, {}}, true},
                                            {{{1}, {0}, {}}, true},
                                            {{{4, 1}, {0, 0}, {}}, false},
                                            {{{1, 1}, {0, 0}, {}}, false},
                                            {{{0}, {0}, {}}, false},
                                            {{{5}, {0}, {}}, false},
                                            {{{1}, {2}, {3, 2}}, false},
                                            {{{1}, {1}, {5}}, false},
                                            {{{1}, {1}, {0}}, false},
                                            {{{1}, {2}, {3}}, false},
                                            {{{1}, {1}, {2, 3}}, false},
                                            {{{1, 2}, {0xffffffffu, 2}, {3, 4}}, false}};
  for (std::size_t i = 0; i < std::size(cases); ++i) {
    const auto& [sensed, fits] = cases[i];
    const std::string path = folder / (std::to_string(i) + ".h5");
    Recorder recorder(path, scene, provenance());
    recorder.record(state_at(scene, 0), {}, std::span(&sensed, 1));
    recorder.finish({});
    const Recording recording(path);
    if (fits)
      EXPECT_EQ(recording.frame(0).sensed.at(0), sensed) << i;
    else
      EXPECT_THROW(recording.frame(0), InputError) << i;
  }
}

TEST(Selected, ObservablesAreThoseOfTheState) {
  const Folder folder;
  Scene scene = mixed_scene(40);
  scene.gravity = {0.5, -9.81};
  scene.record.every = 5;
  scene.record.observables = 2;
  record_run(folder / "a.h5", scene, 10);
  const Recording recording(folder / "a.h5");
  EXPECT_EQ(recording.geometry().record.observables, 2);
  for (std::size_t i = recording.frames(); i-- > 0;) {
    const Frame frame = recording.frame(i);
    ASSERT_EQ(frame.observables.has_value(), frame.step % 2 == 0) << frame.step;
    if (!frame.observables) continue;
    EXPECT_EQ(*frame.observables,
              Observer(scene).observe(state_at(scene, frame.step), contacts_at(frame.step)));
  }
  EXPECT_GT(recording.frame(1).observables.value().kinetic_energy, 0.0);
}

/// Everything at once, cut at each frame and gone on with.
TEST(Selected, GoesOnFromAnyFrameAsIfNeverStopped) {
  const Folder folder;
  Scene scene = mixed_scene(60);
  scene.record.every = 2;
  scene.record.contacts = true;
  scene.record.observables = 3;
  own_every(scene, RecordField::velocity) = 5;
  add_sensor(scene, 7);
  for (const auto& [region, quantum] : {std::pair(false, 1e-3), {true, 0.0}, {true, 1e-3}}) {
    scene.record.quantum = quantum;
    if (region) scene.record.within = Eigen::AlignedBox2d(Vec(0, 0), Vec(9.2, 3));
    const std::string name = folder / (std::to_string(region) + std::to_string(quantum > 0.0) + ".h5");
    record_run(name, scene, 40);
    const Recording whole(name);
    for (std::size_t kept : {0u, 1u, 9u, 20u}) {
      const std::string path = folder / "again.h5";
      std::filesystem::copy_file(name, path + ".part", std::filesystem::copy_options::overwrite_existing);
      {
        const Recording before(path + ".part");
        Recorder recorder(path, scene, provenance(), before, kept);
        record_steps(recorder, scene, kept == 0 ? 0 : whole.steps()[kept - 1] + 1, 40);
        recorder.finish({});
      }
      const Recording again(path);
      EXPECT_TRUE(std::ranges::equal(again.frame_hashes(), whole.frame_hashes())) << kept;
      for (std::size_t i = 0; i < again.frames(); ++i) EXPECT_NO_THROW(again.frame(i));
    }
  }
}

/// The disk is a hundredth of what it would take if all stayed in the region.
TEST(Selected, RegionsAreNotRefusedForRoomThatTheyMayNotTake) {
  const Folder folder;
  Scene scene = mixed_scene(100'000);
  scene.time.until = scene.time.dt * std::ceil(100.0 * recording::free_bytes(folder / "a.h5") / 40.0 / 1e5);
  EXPECT_THROW(Recorder::expect_writable(folder / "a.h5", scene, provenance()), InputError);
  EXPECT_THROW(Recorder(folder / "a.h5", scene, provenance()), InputError);
  scene.record.within = Eigen::AlignedBox2d(Vec(0, 0), Vec(1, 1));
  EXPECT_NO_THROW(Recorder::expect_writable(folder / "a.h5", scene, provenance()));
  EXPECT_NO_THROW(Recorder(folder / "a.h5", scene, provenance()));
  EXPECT_THAT(Recorder::doubt(folder / "a.h5", scene, provenance()), HasSubstr("may need about"));
  scene.time.until = scene.time.dt;
  EXPECT_EQ(Recorder::doubt(folder / "a.h5", scene, provenance()), "");
}

/// What nobody asked for is not in the file.
TEST(Selected, LeavesOutWhatIsNotAskedFor) {
  const Folder folder;
  record_drift(folder / "a.h5", mixed_scene(5), 3);
  const Frame frame = Recording(folder / "a.h5").frame(1);
  EXPECT_FALSE(frame.contacts);
  EXPECT_FALSE(frame.observables);
  EXPECT_TRUE(frame.is_present.empty());
}

}  // namespace
}  // namespace throng
