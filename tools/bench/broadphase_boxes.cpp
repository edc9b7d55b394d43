// SPDX-License-Identifier: MIT
// The boxes of throng bench broadphase: a crowd of them moves, and after each step all that touch are found.
#include <cmath>
#include <numbers>

#include "broadphase/all_pairs.h"
#include "broadphase/brute_force.h"
#include "tools/bench/benchmarks.h"
#include "tools/bench/clouds.h"
#include "tools/bench/moved_tree.h"
#include "tools/bench/pair_race.h"

namespace throng::bench {

namespace {

using broadphase::Pair;
using broadphase::Point;
using Eigen::AlignedBox2d;

constexpr std::uint64_t kStart = 21, kSize = 22, kWidth = 23, kHeight = 24, kAngle = 25;
constexpr std::size_t kMostForBruteForce = 10000;

/// Boxes of 0.1 to 3 m, each with ten others on it in the mean; each goes straight on, by a twentieth of the
/// mean size a step.
class MovingBoxes {
 public:
  explicit MovingBoxes(std::size_t n) {
    Point sum(0.0, 0.0);
    double areas = 0.0;
    for (std::size_t i = 0; i < n; ++i) {
      const double size = 3.0 * std::pow(30.0, random_unit(kSize, i) - 1.0);
      const Point extent = size * Point(share(kWidth, i), share(kHeight, i));
      half_.push_back(0.5 * extent);
      sum += extent;
      areas += extent.prod();
    }
    const double count = static_cast<double>(n);
    const double side = std::sqrt(0.1 * 2.0 * (areas + sum.prod() / count));  // ten on each in the mean
    for (std::size_t i = 0; i < n; ++i) {
      start_.push_back(side * Point(random_unit(kStart, 2 * i), random_unit(kStart, 2 * i + 1)));
      const double angle = 2.0 * std::numbers::pi * random_unit(kAngle, i);
      step_.push_back(0.025 / count * sum.sum() * Point(std::cos(angle), std::sin(angle)));
    }
    restart();
  }
  std::span<const AlignedBox2d> boxes() const { return boxes_; }
  void restart() {
    boxes_.clear();
    for (std::size_t i = 0; i < start_.size(); ++i)
      boxes_.emplace_back(start_[i] - half_[i], start_[i] + half_[i]);
  }
  void step() {
    for (std::size_t i = 0; i < boxes_.size(); ++i) boxes_[i].translate(step_[i]);
  }

 private:
  static double share(std::uint64_t seed, std::uint64_t i) { return 0.5 + 0.5 * random_unit(seed, i); }

  std::vector<Point> half_, start_, step_;
  std::vector<AlignedBox2d> boxes_;
};

/// Each block is kSteps steps from the same start; the check is of the last one.
void race_boxes(const std::string& name, std::size_t n, const Options& options, std::vector<Row>& rows) {
  constexpr int kSteps = 10;
  MovingBoxes crowd(n);
  broadphase::AllPairs search, search_two(2);
  broadphase::PairList found, found_two;
  MovedTree tree(crowd.boxes());
  std::vector<Pair> tree_found, all_found;
  PairRace race(name);
  const auto add = [&](const char* engine, auto find, auto digest, int threads = 1) {
    const auto block = [&crowd, find] {
      crowd.restart();
      for (int i = 0; i < kSteps; ++i) {
        crowd.step();
        find();
      }
    };
    race.add(engine, block, digest, threads);
  };
  add(
      "throng", [&] { search.find_boxes(crowd.boxes(), found); }, [&] { return digest(found); });
  add(
      "throng_threads", [&] { search_two.find_boxes(crowd.boxes(), found_two); },
      [&] { return digest(found_two); }, 2);
  add(
      "box2d_tree", [&] { tree.find(crowd.boxes(), tree_found); }, [&] { return digest(tree_found); });
  const auto touch = [&](std::uint32_t a, std::uint32_t b) {
    return crowd.boxes()[a].intersects(crowd.boxes()[b]);
  };
  if (n <= kMostForBruteForce)
    add(
        "brute_force", [&] { all_found = broadphase::brute_force::pairs(n, touch); },
        [&] { return digest(all_found); });
  race.run(options, kSteps, rows);
}

}  // namespace

std::vector<Row> bench_broadphase_boxes(const Options& options) {
  std::vector<Row> rows;
  std::vector<std::size_t> sizes = {10000, 100000};
  if (options.quick) sizes = {1000};
  for (const std::size_t n : sizes) {
    const std::string name = "boxes n=" + std::to_string(n) + " k=10 random";
    if (chosen(name, options)) race_boxes(name, n, options, rows);
  }
  return rows;
}

}  // namespace throng::bench
