// SPDX-License-Identifier: MIT
// The questions of throng bench broadphase: everyone within a radius and the k nearest, of every point, built
// anew each time; beside it what all pairs at once cost.
#include <box2d/b2_dynamic_tree.h>

#include <algorithm>
#include <cmath>
#include <nanoflann.hpp>

#include "broadphase/all_lists.h"
#include "broadphase/all_pairs.h"
#include "broadphase/neighbours.h"
#include "tools/bench/benchmarks.h"
#include "tools/bench/cgal_points.h"
#include "tools/bench/clouds.h"
#include "tools/bench/dataset.h"
#include "tools/bench/interleave.h"

namespace throng::bench {

namespace {

using broadphase::Near;
using broadphase::NeighbourLists;
using broadphase::Point;
using PointList = std::vector<Point>;

constexpr std::size_t kMostForBox2d = 100000;

/// How many answers there are, and the sum of a hash of each: the same in any order.
struct Check {
  std::size_t count = 0;
  std::uint64_t sum = 0;

  void add(std::uint32_t place, std::uint32_t row) {
    ++count;
    sum += random_bits(place, row);
  }
  std::string text() const { return std::to_string(count) + ":" + std::to_string(sum); }
};

Check check_of(const NeighbourLists& lists) {
  Check result;
  for (std::uint32_t i = 0; i < lists.size(); ++i)
    for (std::size_t k = lists.begin[i]; k < lists.begin[i + 1]; ++k) result.add(i, lists.row[k]);
  return result;
}

/// Everyone within a radius, of all at once.
struct Throng {
  explicit Throng(int threads) : search(threads) {}

  broadphase::AllLists search;
  NeighbourLists lists;

  void find(const PointList& points, const Near& near) { search.find(points, near.radius, nullptr, lists); }
  Check check() const { return check_of(lists); }
};

/// The tree, which answers any question.
struct ThrongTree {
  broadphase::ProximityTree tree;
  broadphase::NeighbourSearch search;
  NeighbourLists lists;

  void find(const PointList& points, const Near& near, int threads) {
    tree.build(points);
    search.find(tree, {.at = points, .own = 0}, near, lists, threads);
  }
  Check check() const { return check_of(lists); }
};

/// The same lists for the peers.
class Lists {
 public:
  void clear() {
    lists_.begin.assign(1, 0);
    lists_.row.clear();
    lists_.distance.clear();
  }
  void add(std::uint32_t row, double distance) {
    lists_.row.push_back(row);
    lists_.distance.push_back(distance);
  }
  void end() { lists_.begin.push_back(lists_.row.size()); }
  Check check() const { return check_of(lists_); }

 private:
  NeighbourLists lists_;
};

/// All pairs, each of which answers two questions, without their distances.
struct Pairs {
  broadphase::AllPairs search;
  broadphase::PairList pairs;

  void find(const PointList& points, double radius) { search.find(points, radius, nullptr, pairs); }
  Check check() const {
    Check result;
    pairs.for_each([&](const broadphase::Pair& pair) {
      result.add(pair.a, pair.b);
      result.add(pair.b, pair.a);
    });
    return result;
  }
};

/// nanoflann's kd-tree of doubles, sorted as it does by itself.
class Nanoflann {
 public:
  void find(const PointList& points, const Near& near) {
    const Dataset cloud{points};
    Tree tree(2, cloud, nanoflann::KDTreeSingleIndexAdaptorParams(10));
    tree.buildIndex();
    lists_.clear();
    if (near.most < points.size())
      nearest(tree, points, near.most);
    else
      within(tree, points, near.radius);
  }
  Check check() const { return lists_.check(); }

 private:
  using Metric = nanoflann::L2_Simple_Adaptor<double, Dataset, double, std::uint32_t>;
  using Tree = nanoflann::KDTreeSingleIndexAdaptor<Metric, Dataset, 2, std::uint32_t>;

  void within(const Tree& tree, const PointList& points, double radius) {
    for (std::uint32_t i = 0; i < points.size(); ++i) {
      tree.radiusSearch(points[i].data(), radius * radius, found_, nanoflann::SearchParams());
      for (const auto& [row, squared] : found_)
        if (row != i) lists_.add(row, std::sqrt(squared));
      lists_.end();
    }
  }
  void nearest(const Tree& tree, const PointList& points, std::size_t most) {
    rows_.resize(most + 1);
    squared_.resize(most + 1);
    for (std::uint32_t i = 0; i < points.size(); ++i) {
      const std::size_t count = tree.knnSearch(points[i].data(), most + 1, rows_.data(), squared_.data());
      for (std::size_t k = 0; k < count; ++k)
        if (rows_[k] != i) lists_.add(rows_[k], std::sqrt(squared_[k]));
      lists_.end();
    }
  }

  std::vector<std::pair<std::uint32_t, double>> found_;
  std::vector<std::uint32_t> rows_;
  std::vector<double> squared_;
  Lists lists_;
};

/// Box2D's tree of boxes in float, the points a hair larger; what it reports is tested in double, and left
/// unsorted.
class Box2dTree {
 public:
  void find(const PointList& points, double radius) {
    b2DynamicTree tree;
    points_ = &points;
    radius_ = radius;
    rows_.assign(points.size(), 0);
    for (std::uint32_t row = 0; row < points.size(); ++row) {
      const auto proxy =
          static_cast<std::size_t>(tree.CreateProxy(box(points[row], 0.001 * radius), nullptr));
      if (proxy >= rows_.size()) rows_.resize(2 * proxy + 1);
      rows_[proxy] = row;
    }
    lists_.clear();
    for (asking_ = 0; asking_ < points.size(); ++asking_) {
      tree.Query(this, box(points[asking_], 1.001 * radius));
      lists_.end();
    }
  }
  bool QueryCallback(int proxy) {
    const std::uint32_t row = rows_[static_cast<std::size_t>(proxy)];
    const double squared = broadphase::PlaneMetric{}((*points_)[asking_], (*points_)[row]);
    if (row != asking_ && squared <= radius_ * radius_) lists_.add(row, std::sqrt(squared));
    return true;
  }
  Check check() const { return lists_.check(); }

 private:
  static b2AABB box(const Point& p, double reach) {
    const auto x = static_cast<float>(p.x()), y = static_cast<float>(p.y()), r = static_cast<float>(reach);
    b2AABB box;
    box.lowerBound.Set(x - r, y - r);
    box.upperBound.Set(x + r, y + r);
    return box;
  }

  const PointList* points_ = nullptr;
  double radius_ = 0.0;
  std::uint32_t asking_ = 0;
  std::vector<std::uint32_t> rows_;  // per proxy
  Lists lists_;
};

struct CloudCase {
  Kind kind;
  std::size_t n;
  double k;
  bool spatial;
};

std::vector<CloudCase> cloud_cases(bool quick) {
  if (quick)
    return {{Kind::uniform, 10000, 10, false},
            {Kind::clustered, 10000, 10, false},
            {Kind::line, 10000, 10, true}};
  return {{Kind::uniform, 10000, 10, false},    {Kind::uniform, 100000, 10, false},
          {Kind::clustered, 100000, 10, false}, {Kind::line, 100000, 10, false},
          {Kind::uniform, 1000000, 10, false},  {Kind::clustered, 1000000, 10, false},
          {Kind::uniform, 1000000, 10, true},   {Kind::uniform, 1000000, 40, true}};
}

void add_rows(const std::string& name, const Cloud& cloud, const Near& near, bool pairs_too,
              const Options& options, std::vector<Row>& rows) {
  if (!chosen(name, options)) return;
  const PointList& points = cloud.points;
  Throng one(1), two(2);
  ThrongTree tree_one, tree_two;
  Pairs pairs;
  Nanoflann nanoflann;
  NeighbourLists cgal;
  Box2dTree box2d;
  std::vector<Contestant> contestants;
  std::vector<std::pair<int, std::function<Check()>>> checks;
  const auto add = [&](const char* engine, int threads, std::function<void()> find,
                       std::function<Check()> check) {
    if (!options.engines.empty() && std::ranges::find(options.engines, engine) == options.engines.end())
      return;
    contestants.push_back({engine, std::move(find)});
    checks.emplace_back(threads, std::move(check));
  };
  if (pairs_too) {
    add(
        "throng", 1, [&] { one.find(points, near); }, [&] { return one.check(); });
    add(
        "throng", 2, [&] { two.find(points, near); }, [&] { return two.check(); });
  }
  const char* tree = pairs_too ? "throng_tree" : "throng";
  add(
      tree, 1, [&] { tree_one.find(points, near, 1); }, [&] { return tree_one.check(); });
  add(
      tree, 2, [&] { tree_two.find(points, near, 2); }, [&] { return tree_two.check(); });
  add(
      "nanoflann", 1, [&] { nanoflann.find(points, near); }, [&] { return nanoflann.check(); });
  add(
      "cgal", 1, [&] { cgal_neighbours(points, near, cgal); }, [&] { return check_of(cgal); });
  if (pairs_too) {
    add(
        "pairs", 1, [&] { pairs.find(points, near.radius); }, [&] { return pairs.check(); });
    if (points.size() <= kMostForBox2d)
      add(
          "box2d_tree", 1, [&] { box2d.find(points, near.radius); }, [&] { return box2d.check(); });
  }
  interleave(contestants, options.blocks, 1.0);
  for (std::size_t i = 0; i < contestants.size(); ++i) {
    const double n = static_cast<double>(points.size());
    rows.push_back({"broadphase",
                    name,
                    contestants[i].engine,
                    checks[i].first,
                    contestants[i].ms,
                    n,
                    checks[i].second().text(),
                    {{"ns_per_query", 1e6 * median(contestants[i].ms) / n}}});
  }
}

}  // namespace

std::vector<Row> bench_broadphase_queries(const Options& options) {
  std::vector<Row> rows;
  for (const CloudCase& one : cloud_cases(options.quick)) {
    const Cloud points = cloud(one.kind, one.n, one.k, one.spatial);
    if (!chosen(points.name + " radius", options) && !chosen(points.name + " nearest", options)) continue;
    add_rows(points.name + " radius", points, {.radius = points.reach}, true, options, rows);
    add_rows(points.name + " nearest", points, {.most = static_cast<std::size_t>(one.k)}, false, options,
             rows);
  }
  return rows;
}

}  // namespace throng::bench
