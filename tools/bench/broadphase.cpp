// SPDX-License-Identifier: MIT
// throng bench broadphase: all pairs of a cloud, built anew each time, against a plain grid and the peers.
#include <algorithm>
#include <cmath>
#include <thread>

#include "broadphase/all_pairs.h"
#include "broadphase/moving_pairs.h"
#include "tools/bench/benchmarks.h"
#include "tools/bench/clouds.h"
#include "tools/bench/pair_peers.h"
#include "tools/bench/pair_race.h"
#include "tools/bench/plain_grid.h"

namespace throng::bench {

namespace {

using broadphase::AllPairs;
using broadphase::Pair;
using broadphase::PairBuffer;
using broadphase::PairList;

void find(AllPairs& search, const Cloud& cloud, PairList& found) {
  if (cloud.radii.empty())
    search.find(cloud.points, cloud.reach, nullptr, found);
  else
    search.find_discs(cloud.points, cloud.radii, nullptr, found);
}

double widest_pair(const Cloud& cloud) {
  return cloud.radii.empty() ? cloud.reach : 2.0 * *std::max_element(cloud.radii.begin(), cloud.radii.end());
}

/// The same with a point so far away that no array holds all cells between.
Cloud with_stray(Cloud cloud) {
  cloud.points.push_back({1e9, -1e9});
  if (!cloud.radii.empty()) cloud.radii.push_back(cloud.radii[0]);
  return cloud;
}

void race_all_pairs(const Cloud& cloud, const Options& options, std::vector<Row>& rows) {
  const std::size_t n = cloud.points.size();
  const Cloud stray = with_stray(cloud);
  AllPairs search, search_stray, search_two(2);
  PairList found, found_stray, found_two;
  PlainGrid plain;
  PairBuffer plain_found;
  std::vector<Pair> kd_found, tree_found;
  PairRace race(cloud.name);
  race.add(
      "throng", [&] { find(search, cloud, found); }, [&] { return digest(found); });
  race.add(
      "plain", [&] { plain.find(cloud.points, widest_pair(cloud), cloud.radii, plain_found); },
      [&] { return digest(plain_found.all()); });
  if (n <= 1000000)
    race.add(
        "nanoflann", [&] { find_with_nanoflann(cloud, kd_found); }, [&] { return digest(kd_found); });
  if (n <= 100000)
    race.add(
        "box2d_tree", [&] { find_with_box2d_tree(cloud, tree_found); }, [&] { return digest(tree_found); });
  race.add(
      "throng_stray", [&] { find(search_stray, stray, found_stray); }, [&] { return digest(found_stray); });
  race.add(
      "throng_threads", [&] { find(search_two, cloud, found_two); }, [&] { return digest(found_two); }, 2);
  race.run(options, 1, rows);
}

/// Discs of sizes 1:1000 against as many of one size with about as many pairs, in turn.
void race_sizes(std::size_t n, const Options& options, std::vector<Row>& rows) {
  const auto name = [n](const char* ratio) {
    return "sizes " + std::string(ratio) + " n=" + std::to_string(n);
  };
  const Cloud equal = cloud(Kind::mixed, n, 10, false, 1.0), mixed = cloud(Kind::mixed, n, 10, false, 1000.0);
  AllPairs search_equal, search_mixed;
  PairList found_equal, found_mixed;
  PairRace race(name("1:1"));
  race.add(
      "throng", [&] { find(search_equal, equal, found_equal); }, [&] { return digest(found_equal); });
  race.begin_case(name("1:1000"));
  race.add(
      "throng", [&] { find(search_mixed, mixed, found_mixed); }, [&] { return digest(found_mixed); });
  race.run(options, 1, rows);
}

/// A cloud of which every point moves by a part of the reach a step, straight on.
class MovingCloud {
 public:
  MovingCloud(std::size_t n, bool spatial, double pace)
      : start_(cloud(Kind::uniform, n, 10, spatial)), now_(start_.points) {
    for (std::size_t i = 0; i < n; ++i) {
      const double angle = 2.0 * 3.141592653589793 * random_unit(9, i);
      step_.push_back(pace * start_.reach * broadphase::Point(std::cos(angle), std::sin(angle)));
    }
  }
  double reach() const { return start_.reach; }
  const std::vector<broadphase::Point>& points() const { return now_; }
  void step() {
    for (std::size_t i = 0; i < now_.size(); ++i) now_[i] += step_[i];
  }
  void restart() { now_ = start_.points; }

 private:
  Cloud start_;
  std::vector<broadphase::Point> now_, step_;
};

/// How far points move a step, and how a case says so: the plain name is of a twentieth of the reach.
struct Pace {
  double part;
  const char* suffix;
};
constexpr Pace kPaces[] = {{0.05, ""}, {0.005, " 0.5%"}, {0.001, " 0.1%"}};

std::string moving_name(std::size_t n, bool spatial, const Pace& pace) {
  return "moving " + case_name(Kind::uniform, n, 10, spatial) + pace.suffix;
}

/// Each block is kSteps steps from the same start; the check is of the last one. The points are discs of half
/// the reach for throng: `throng` keeps a list, `rebuilt` is the same answer from scratch.
void race_moving(std::size_t n, bool spatial, const Pace& pace, const Options& options,
                 std::vector<Row>& rows) {
  constexpr int kSteps = 20;
  MovingCloud cloud(n, spatial, pace.part);
  AllPairs search;
  broadphase::DiscPairs anew;
  broadphase::Team alone(1);
  broadphase::MovingPairs moving(alone);
  PairList found;
  PlainGrid plain;
  PairBuffer plain_found;
  std::vector<Pair> sorted, kept;
  PairRace race(moving_name(n, spatial, pace));
  const auto add = [&](const char* engine, auto find, auto pairs) {
    race.add(
        engine,
        [&cloud, find] {
          cloud.restart();
          for (int i = 0; i < kSteps; ++i) {
            cloud.step();
            find();
          }
        },
        pairs);
  };
  const std::vector<double> half(n, 0.5 * cloud.reach());
  add(
      "throng", [&] { moving.find(cloud.points(), half, nullptr, kept); }, [&] { return digest(kept); });
  add(
      "rebuilt", [&] { anew.find(cloud.points(), half, nullptr, sorted); }, [&] { return digest(sorted); });
  add(
      "rebuilt_any_order", [&] { search.find_discs(cloud.points(), half, nullptr, found); },
      [&] { return digest(found); });
  add(
      "plain", [&] { plain.find(cloud.points(), cloud.reach(), {}, plain_found); },
      [&] { return digest(plain_found.all()); });
  race.run(options, kSteps, rows);
}

/// Whether the machine gives two cores right now: two loops at once should take as long as one.
void race_busy_loops(const Options& options, std::vector<Row>& rows) {
  const auto loop = [] {
    volatile std::uint64_t sum = 0;
    for (std::uint64_t i = 0; i < 20000000; ++i) sum = sum + i;
  };
  PairRace race("two busy loops");
  race.add("one", loop, [] { return Digest{1, 0}; });
  race.add(
      "two",
      [&] {
        std::thread other(loop);
        loop();
        other.join();
      },
      [] {
        return Digest{1, 0};
      },
      2);
  race.run(options, 1, rows);
}

}  // namespace

std::vector<Row> bench_broadphase(const Options& options) {
  std::vector<Row> rows;
  std::vector<std::size_t> sizes = {10000, 100000, 1000000};
  if (options.quick) sizes = {1000};
  if (options.large) sizes.push_back(10000000);
  for (const std::size_t n : sizes)
    for (const Kind kind : {Kind::uniform, Kind::clustered, Kind::line, Kind::mixed})
      for (const double k : {10.0, 40.0})
        for (const bool spatial : {false, true})
          if (chosen(case_name(kind, n, k, spatial), options)) {
            race_all_pairs(cloud(kind, n, k, spatial), options, rows);
            options.show(rows);
          }
  const std::size_t n = options.quick ? 1000 : 100000;
  if (chosen("sizes", options)) race_sizes(n, options, rows);
  for (const bool spatial : {false, true})
    for (const Pace& pace : kPaces)
      if (chosen(moving_name(n, spatial, pace), options)) {
        race_moving(n, spatial, pace, options, rows);
        options.show(rows);
      }
  for (Row& row : bench_broadphase_boxes(options)) rows.push_back(std::move(row));
  options.show(rows);
  if (chosen("two busy loops", options)) race_busy_loops(options, rows);
  for (Row& row : bench_broadphase_queries(options)) rows.push_back(std::move(row));
  return rows;
}

}  // namespace throng::bench
