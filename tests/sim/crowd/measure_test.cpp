// SPDX-License-Identifier: MIT
#include "sim/crowd/measure.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/sim/crowd/box.h"
#include "tests/sim/trial.h"

namespace throng {
namespace {

const std::array<Vec, 2> kUp{Vec(2, 0), Vec(2, 1)};  // its left is where x < 2

TEST(Crossing, CountsWaysOverTheLineByTheirSense) {
  EXPECT_EQ(crossing(kUp, {1.9, 0.5}, {2.1, 0.5}), 1);
  EXPECT_EQ(crossing(kUp, {2.1, 0.5}, {1.9, 0.5}), -1);
  EXPECT_EQ(crossing({kUp[1], kUp[0]}, {1.9, 0.5}, {2.1, 0.5}), -1);
  EXPECT_EQ(crossing(kUp, {1.9, 0.5}, {1.95, 0.7}), 0);
  EXPECT_EQ(crossing(kUp, {1.9, 1.1}, {2.1, 1.1}), 0);  // past its end
  EXPECT_EQ(crossing(kUp, {1.9, -0.1}, {2.1, -0.1}), 0);
  EXPECT_EQ(crossing(kUp, {1, 0.9}, {3, 1.2}), 0);  // bends round the end: at x = 2 it is at y = 1.05
  EXPECT_EQ(crossing(kUp, {1, 0.7}, {3, 1.2}), 1);  // at y = 0.95
}

TEST(Crossing, CountsWhoStopsOnTheLineOnce) {
  EXPECT_EQ(crossing(kUp, {1.9, 0.5}, {2.0, 0.5}) + crossing(kUp, {2.0, 0.5}, {2.1, 0.5}), 1);
  EXPECT_EQ(crossing(kUp, {1.9, 0.5}, {2.0, 0.5}) + crossing(kUp, {2.0, 0.5}, {1.9, 0.5}), 0);
  EXPECT_EQ(crossing(kUp, {2.0, 0.2}, {2.0, 0.7}), 0);
}

/// Measures step by step, with what is remembered of those on the line.
struct Watch {
  void step(const Measure& of, std::span<const Stride> strides, std::int64_t number) {
    before.swap(on_line), on_line.clear();
    measure(of, strides, number, measured, {0, before, on_line});
  }

  Measured measured;
  std::vector<OnLine> before, on_line;
};

Measure door() {
  Measure door;
  door.name = "door", door.line = kUp;
  return door;
}

TEST(Measure, GivesTheFlowOverALineFromItsFirstCrossingToItsLast) {
  Watch watch;
  Measured& measured = watch.measured;
  const Stride over{{1.9, 0.5}, {2.1, 0.5}, 1.5}, back{{2.1, 0.5}, {1.9, 0.5}, 0.5};
  watch.step(door(), {}, 1);
  EXPECT_FALSE(reading(door(), measured, 0.1).flow || reading(door(), measured, 0.1).speed);
  watch.step(door(), std::array{over}, 10);
  EXPECT_EQ(reading(door(), measured, 0.1).count, 1);
  EXPECT_FALSE(reading(door(), measured, 0.1).flow);
  watch.step(door(), std::array{over, back}, 20);
  watch.step(door(), std::array{over}, 50);
  const Reading all = reading(door(), measured, 0.1);
  EXPECT_EQ(measured.count, 3);
  EXPECT_EQ(measured.back, 1);
  EXPECT_EQ(all.count, 4);
  EXPECT_DOUBLE_EQ(*all.flow, 3 / 4.0);
  EXPECT_DOUBLE_EQ(*all.speed, (3 * 1.5 + 0.5) / 4);
  EXPECT_FALSE(all.density);
}

/// Where one person is over the line x = 2 after each step, who begins left of it, 0.4 m thick; then how
/// often he has crossed it there and back.
std::pair<std::int64_t, std::int64_t> crossings(const std::vector<double>& way, Watch& watch) {
  double x = 1.5;
  std::int64_t step = 0;
  for (const double next : way) {
    watch.step(door(), std::array{Stride{{x, 0.5}, {next, 0.5}, 1.0, 7, 0.2}}, ++step);
    x = next;
  }
  return {watch.measured.count, watch.measured.back};
}

// It happened: 70 people who waited on a line were counted 824 times.
TEST(Measure, CountsWhoSwaysOnTheLineOnce) {
  Watch watch;
  EXPECT_EQ(crossings({1.95, 2.05, 1.95, 2.1, 1.9, 2.15}, watch), std::pair(1l, 0l));
  EXPECT_EQ(watch.measured.last, 2) << "when he crossed it first";
  EXPECT_EQ(watch.on_line.size(), 1u);
  watch.step(door(), std::array{Stride{{2.15, 0.5}, {2.25, 0.5}, 1.0, 7, 0.2}}, 7);
  EXPECT_TRUE(watch.on_line.empty()) << "0.25 m behind it, he is done with it";
  EXPECT_EQ(watch.measured.count + watch.measured.back, 1);
  EXPECT_EQ(watch.measured.samples, 1);
}

TEST(Measure, CountsHimBackWhoTurnsBackOnTheLineOnceHeIsClearOfIt) {
  Watch watch;
  EXPECT_EQ(crossings({2.05, 1.9}, watch), std::pair(1l, 0l)) << "so far he sways";
  EXPECT_EQ(crossings({1.9, 1.7}, watch), std::pair(1l, 1l));
  Watch gone;
  EXPECT_EQ(crossings({2.05, 1.9}, gone), std::pair(1l, 0l));
  gone.step(door(), {}, 3);
  EXPECT_EQ(gone.measured.back, 1) << "who isn't there any more has done with it, too";
}

TEST(Measure, CountsEachPassageOfOneWhoComesAgain) {
  Watch watch;
  EXPECT_EQ(crossings({2.1, 2.5, 1.9, 1.5, 2.3, 1.7}, watch), std::pair(2l, 2l));
  Watch round;
  for (std::int64_t step = 1; step < 9; step += 2) {
    round.step(door(), std::array{Stride{{1.9, 0.5}, {2.1, 0.5}, 1.0, 7, 0.2}}, step);
    round.step(door(), std::array{Stride{{2.1, 0.5}, {2.5, 2.5}, 1.0, 7, 0.2}}, step + 1);
  }
  EXPECT_EQ(round.measured.count, 4) << "laps";
  EXPECT_EQ(round.measured.back, 0);
}

/// Two of three agents are in an area, of which 4 m² count.
TEST(MeasureColumns, OfAnAreaAreThoseOfTheInstant) {
  Measure area;
  area.area.rings = {{{0, 0}, {2, 0}, {2, 1}, {0, 1}}}, area.size = 4.0, area.after = 5;
  EXPECT_EQ((std::vector<std::string>{columns(area).begin(), columns(area).end()}),
            (std::vector<std::string>{"count", "density", "speed", "flow"}));
  const std::vector<Vec> position{{0.5, 0.5}, {1.5, 0.5}, {2.5, 0.5}}, velocity{{3, 4}, {0, -1}, {9, 9}};
  Measured measured;
  measured.count = 7;
  std::vector<double> row;
  append_columns(area, measured, {position, velocity, 6, 0.1, area.area}, row);
  EXPECT_EQ(row, (std::vector<double>{7, 0.5, 3.0, 1.5}));
  row.clear();
  append_columns(area, measured, {{}, {}, 6, 0.1, area.area}, row);
  EXPECT_EQ(row[1], 0.0);
  EXPECT_TRUE(std::isnan(row[2])) << "nobody's speed";
  EXPECT_EQ(row[3], 0.0);
  row.clear();
  append_columns(area, measured, {position, velocity, 5, 0.1, area.area}, row);
  EXPECT_EQ(row[0], 7.0);
  EXPECT_TRUE(std::isnan(row[1]) && std::isnan(row[2]) && std::isnan(row[3])) << "not measured yet";
}

/// Two stand 1 m apart in a hall of 4 m x 2 m, whose left half is the area: the border between their cells is
/// 1.5 m from the left, all of it is nearer than the cut-off to one of them.
TEST(MeasureColumns, OfAnAreaHaveItsDensityByVoronoiCellsWhereThatIsMeasured) {
  const Region floor{{{{0, 0}, {4, 0}, {4, 2}, {0, 2}}}};
  Measure left;
  left.area.rings = {{{0, 0}, {2, 0}, {2, 2}, {0, 2}}};
  left.ground = left.area, left.size = 4.0, left.cutoff = 5.0, left.after = 5;
  EXPECT_STREQ(columns(left).back(), "density_voronoi");
  EXPECT_EQ(columns(left).size(), 5u);
  const std::vector<Vec> position{{1, 1}, {2, 1}}, velocity{{1, 0}, {1, 0}};
  std::vector<double> row;
  append_columns(left, {}, {position, velocity, 6, 0.1, floor}, row);
  ASSERT_EQ(row.size(), 5u);
  EXPECT_NEAR(row[4], (1.0 + 1.0 / 5.0) / 4.0, 1e-12) << "3 m2 of the one, and 1 m2 of the other's 5 m2";
  append_columns(left, {}, {{}, {}, 6, 0.1, floor}, row);
  EXPECT_EQ(row[9], 0.0);
  append_columns(left, {}, {position, velocity, 5, 0.1, floor}, row);
  EXPECT_TRUE(std::isnan(row[14])) << "not measured yet";
}

TEST(MeasureColumns, OfALineAreThoseOfItsReading) {
  Measured measured;
  measured.count = 3, measured.back = 1, measured.first = 10, measured.last = 40;
  measured.samples = 4, measured.speed = 6.0;
  std::vector<double> row{-1.0};
  append_columns(door(), measured, {{}, {}, 50, 0.1, Region()}, row);
  EXPECT_EQ(row, (std::vector<double>{-1, 4, 3, 1, 1.0, 1.5}));
  append_columns(door(), {}, {{}, {}, 50, 0.1, Region()}, row);
  EXPECT_TRUE(std::isnan(row[9]) && std::isnan(row[10]));
  EXPECT_EQ(columns(door()).size(), 5u);
}

TEST(Measure, LooksBetweenItsTimesAlone) {
  Measure late = door();
  late.after = 9, late.last = 20;
  Watch watch;
  const Stride over{{1.9, 0.5}, {2.1, 0.5}, 1.5};
  for (int step : {9, 10, 20, 21}) watch.step(late, std::array{over}, step);
  EXPECT_EQ(watch.measured.count, 2);
  EXPECT_EQ(watch.measured.steps, 2);
}

TEST(Measure, GivesDensityAndSpeedInAnArea) {
  Measure hall;
  hall.name = "hall", hall.size = 20.0;
  hall.area = {{{{0, 0}, {4, 0}, {4, 5}, {0, 5}}}};
  Watch watch;
  const Stride in{{1, 1}, {1.1, 1}, 1.0}, enters{{-0.1, 1}, {0.1, 1}, 2.0}, leaves{{3.9, 1}, {4.1, 1}, 9.0};
  watch.step(hall, std::array{in, leaves}, 1);
  watch.step(hall, std::array{in, enters}, 2);
  const Reading read = reading(hall, watch.measured, 0.1);
  EXPECT_EQ(read.count, 2);
  EXPECT_DOUBLE_EQ(*read.density, 1.5 / 20);
  EXPECT_DOUBLE_EQ(*read.speed, 4.0 / 3);
  EXPECT_DOUBLE_EQ(*read.flow, 1.5 / 20 * 4 / 3);
}

// It happened: who waited on the border of an area entered it with each tremble.
TEST(Measure, CountsWhoSwaysOnTheBorderOfAnAreaOnce) {
  Measure hall;
  hall.name = "hall", hall.size = 20.0;
  hall.area = {{{{0, 0}, {4, 0}, {4, 5}, {0, 5}}}};
  Watch watch;
  double x = -1.0;
  std::int64_t step = 0;
  const auto entries = [&](const std::vector<double>& way) {
    for (const double next : way) {
      watch.step(hall, std::array{Stride{{x, 1}, {next, 1}, 1.0, 7, 0.2}}, ++step);
      x = next;
    }
    return watch.measured.count;
  };
  EXPECT_EQ(entries({-0.1, 0.1, -0.1, -0.15, 0.1, -0.1, 0.1}), 1);
  EXPECT_EQ(watch.measured.samples, 3) << "when he was in it";
  EXPECT_EQ(entries({-0.1, -0.25, -0.1}), 1);
  EXPECT_TRUE(watch.on_line.empty()) << "once 0.25 m off it he has left it";
  EXPECT_EQ(entries({0.1}), 2);
}

/// Three walk one after the other through the middle of a hall.
std::string column(const std::string& measures) {
  return "time = { dt = 0.02, until = 10 }\nwalkable = 'POLYGON ((0 0, 12 0, 12 2, 0 2, 0 0))'\n"
         "areas.exit = [[11, 0], [12, 0], [12, 2], [11, 2]]\nareas.hall = [[4, 0], [8, 0], [8, 9], [4, 9]]\n"
         "[[agents]]\ngoal = 'exit'\nmodel = 'constant_velocity'\ndesired_speed = 1\nat = [1, 1]\n"
         "[[agents]]\ngoal = 'exit'\nmodel = 'constant_velocity'\ndesired_speed = 1\nat = [2, 1]\n"
         "[[agents]]\ngoal = 'exit'\nmodel = 'constant_velocity'\ndesired_speed = 1\nat = [3, 1]\n" +
         measures;
}

TEST(Measure, CountsAWalkingColumn) {
  Trial run(
      column("[[measure]]\nname = 'door'\nline = [[6, 0], [6, 2]]\n"
             "[[measure]]\nname = 'hall'\narea = 'hall'\nfrom = 3\nuntil = 5\n"));
  run.steps(500);
  const auto& [door, hall] = std::tie(run.state.crowd.measured[0], run.state.crowd.measured[1]);
  EXPECT_EQ(door.count, 3);
  EXPECT_EQ(door.back, 0);
  const Reading line = reading(run.scene.crowd.measures[0], door, 0.02);
  EXPECT_NEAR(*line.flow, 1.0, 0.01);
  EXPECT_NEAR(*line.speed, 1.0, 1e-9);
  // From 3 to 5 s they are at 4 to 6, 5 to 7, 6 to 8 m.
  EXPECT_DOUBLE_EQ(run.scene.crowd.measures[1].size, 8.0);  // of 4 m by 9 m, 2 m are floor
  const Reading area = reading(run.scene.crowd.measures[1], hall, 0.02);
  EXPECT_NEAR(*area.density, 3.0 / 8, 0.01);
  EXPECT_NEAR(*area.speed, 1.0, 1e-9);
  EXPECT_EQ(hall.steps, 100);
}

TEST(Measure, CountsWhoAppearsInItsArea) {
  const std::string hall =
      "time = { dt = 0.02, until = 10 }\nwalkable = 'POLYGON ((0 0, 12 0, 12 2, 0 2, 0 0))'\n"
      "areas.exit = [[11, 0], [12, 0], [12, 2], [11, 2]]\nareas.start = [[0, 0], [2, 0], [2, 2], [0, 2]]\n"
      "[[agents]]\ngoal = 'exit'\nmodel = 'collision_free_speed'\ncount = 4\nappear.rate = 1\n"
      "place.random.within = 'start'\n[[agents]]\ngoal = 'exit'\nmodel = 'collision_free_speed'\nat = [1, "
      "1]\n"
      "[[measure]]\nname = 'start'\narea = 'start'\n";
  Trial run(hall);
  run.steps(200);
  EXPECT_EQ(run.state.crowd.measured[0].count, 5);
}

// It happened: an area thinner than a step saw one in ten of those who went through it.
TEST(Measure, CountsWhoStepsOverAThinArea) {
  Measure thin;
  thin.name = "thin", thin.area = box(2, 0, 2.01, 1), thin.size = 0.01;
  Watch watch;
  watch.step(thin, {}, 1);
  const auto go = [&](const Vec& from, const Vec& to, std::int64_t step) {
    watch.step(thin, std::array{Stride{from, to, 1.0, 7, 0.2}}, step);
    return watch.measured.count;
  };
  EXPECT_EQ(go({1.8, 0.5}, {1.9, 0.5}, 2), 0);
  EXPECT_EQ(go({1.9, 0.5}, {2.1, 0.5}, 3), 1);
  EXPECT_EQ(go({2.1, 0.5}, {1.9, 0.5}, 4), 1) << "he sways";
  EXPECT_EQ(go({1.9, 0.5}, {1.7, 0.5}, 5), 1);
  EXPECT_EQ(go({1.7, 0.5}, {2.3, 0.5}, 6), 2) << "and comes again";
  EXPECT_EQ(go({2.3, 0.5}, {2.3, 1.5}, 7), 2);
  EXPECT_EQ(go({2.3, 1.5}, {1.7, 1.5}, 8), 2) << "past its end";
  EXPECT_EQ(watch.measured.samples, 0) << "none of his steps ends in it: its density is a mean over steps";
}

}  // namespace
}  // namespace throng
