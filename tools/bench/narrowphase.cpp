// SPDX-License-Identifier: MIT
// throng bench narrowphase: how far apart two convex polygons are, time against error.
#include <algorithm>
#include <cmath>

#include "narrowphase/core_separation.h"
#include "narrowphase/exhaustive.h"
#include "narrowphase/gjk.h"
#include "narrowphase/probe.h"
#include "narrowphase/tracker.h"
#include "tools/bench/benchmarks.h"
#include "tools/bench/convex_peers.h"
#include "tools/bench/interleave.h"

namespace throng::bench {

namespace {

using namespace narrowphase;

constexpr double kUlp = 4.0 * 0x1p-52;  // m: coordinates reach 4 m from the first shape's centre

/// How an engine's distances are to be read.
enum class Distances { with_depth, without_depth, single_without_depth };

struct DistanceEngine {
  std::string name;
  Distances answers;
  std::size_t queries;                   ///< of the case, from the first on
  std::function<void(bool back)> block;  ///< asks them all, from the last to the first if `back`
  std::function<double(std::size_t placement)> ask;
  SearchStatistics* statistics = nullptr;  ///< of `ask`
};

/// `ask(pair, placement)` is compiled into the loop that is timed.
template <class Ask>
DistanceEngine engine(std::string name, Distances answers, const ConvexPairs& c, std::size_t queries,
                      Ask ask) {
  const std::size_t pairs = c.pairs();
  const auto block = [pairs, queries, ask](bool back) {
    double sum = 0.0;
    std::size_t pair = back ? (queries - 1) % pairs : 0;
    for (std::size_t i = 0; i < queries; ++i) {
      sum += ask(pair, back ? queries - 1 - i : i);
      if (back)
        pair = (pair == 0 ? pairs : pair) - 1;
      else
        pair = pair + 1 == pairs ? 0 : pair + 1;
    }
    answer_sink = sum;
  };
  return {std::move(name), answers, queries, block,
          [pairs, ask](std::size_t i) { return ask(i % pairs, i); }};
}

/// `separation` by GJK from any features, which are replaced.
Separation by_gjk(const Placed& p, ClosestFeatures& f) {
  if (const auto found = gjk(p.a, p.b, relative(p.pose_a, p.pose_b), f)) {
    const narrowphase::Look look(p, *found);
    if (look.proves()) return f = *found, answer(look, found->vertex_of_b);
  }
  return separation(p.a, p.pose_a, p.b, p.pose_b);
}

Separation by_faces(const Placed& p) {
  const Pose b_in_a = relative(p.pose_a, p.pose_b);
  const Faces faces = widest_faces(p.a, p.b, b_in_a, inverse(b_in_a));
  return in_world(p.a, p.pose_a, p.b, polygon_polygon(p.a, p.b, b_in_a, faces));
}

/// What the engines of a case keep from query to query.
struct Kept {
  std::vector<ClosestFeatures> tracked, by_gjk;
  SearchStatistics statistics;
  std::unique_ptr<Box2dDistance> box2d_warm, box2d_cold;
};

/// As many of the queries as an engine that takes `each` ns answers in about 5 ms, but one at least.
std::size_t affordable(const ConvexPairs& c, double each) {
  return std::clamp<std::size_t>(static_cast<std::size_t>(5e6 / each), 1, c.placements.size());
}

std::vector<DistanceEngine> engines(const ConvexPairs& c, Kept& kept) {
  const auto placed = [&c](std::size_t pair, std::size_t i) {
    return Placed{c.shapes[c.a[pair]], c.placements[i].a, c.shapes[c.b[pair]], c.placements[i].b};
  };
  const std::size_t all = c.placements.size();
  const double vertices = static_cast<double>(c.shapes[0].vertices.size());
  std::vector<DistanceEngine> result;
  const auto add = [&](const char* name, Distances answers, std::size_t queries, auto ask) {
    result.push_back(engine(name, answers, c, queries, ask));
  };
  kept.tracked.resize(c.pairs()), kept.by_gjk.resize(c.pairs());
  if (c.coherent) {
    add("tracker", Distances::with_depth, all, [&kept, placed](std::size_t pair, std::size_t i) {
      const Placed p = placed(pair, i);
      return track(p.a, p.pose_a, p.b, p.pose_b, kept.tracked[pair]).distance;
    });
    result.back().ask = [&kept, &c, placed](std::size_t i) {
      const Placed p = placed(i % c.pairs(), i);
      return track(p.a, p.pose_a, p.b, p.pose_b, kept.tracked[i % c.pairs()], &kept.statistics).distance;
    };
    result.back().statistics = &kept.statistics;
    add("gjk warm", Distances::with_depth, all, [&kept, placed](std::size_t pair, std::size_t i) {
      return by_gjk(placed(pair, i), kept.by_gjk[pair]).distance;
    });
  }
  add("separation", Distances::with_depth, all, [placed](std::size_t pair, std::size_t i) {
    const Placed p = placed(pair, i);
    return separation(p.a, p.pose_a, p.b, p.pose_b).distance;
  });
  add("gjk cold", Distances::with_depth, all, [placed](std::size_t pair, std::size_t i) {
    ClosestFeatures anywhere;
    return by_gjk(placed(pair, i), anywhere).distance;
  });
  add("sat", Distances::with_depth, affordable(c, 20.0 * vertices),
      [placed](std::size_t pair, std::size_t i) { return by_faces(placed(pair, i)).distance; });
  if (vertices <= 400)
    add("exhaustive", Distances::with_depth, affordable(c, 60.0 * vertices * vertices),
        [placed](std::size_t pair, std::size_t i) {
          const Placed p = placed(pair, i);
          return exhaustive_separation(p.a, p.pose_a, p.b, p.pose_b).distance;
        });
  if (vertices <= Box2dDistance::kMostVertices) {
    kept.box2d_warm = std::make_unique<Box2dDistance>(c, true);
    kept.box2d_cold = std::make_unique<Box2dDistance>(c, false);
    if (c.coherent)
      add("box2d warm", Distances::single_without_depth, all,
          [&warm = *kept.box2d_warm](std::size_t pair, std::size_t i) { return warm.distance(pair, i); });
    add("box2d cold", Distances::single_without_depth, all,
        [&cold = *kept.box2d_cold](std::size_t pair, std::size_t i) { return cold.distance(pair, i); });
  }
  if (vertices <= 40)
    add("cgal", Distances::without_depth, 8, [placed, &c](std::size_t pair, std::size_t i) {
      const Placed p = placed(pair, i);
      return cgal_distance(p.a, p.b, c.placements[i]);
    });
  return result;
}

/// The exact distances of every `stride`th placement.
struct Oracle {
  std::size_t stride;
  std::vector<double> distance;

  explicit Oracle(const ConvexPairs& c) {
    const double vertices = static_cast<double>(c.shapes[0].vertices.size());
    const double each = 60.0 * vertices * vertices;  // ns
    stride = static_cast<std::size_t>(
        std::ceil(static_cast<double>(c.placements.size()) / std::max(2.0, 2e8 / each)));
    for (std::size_t i = 0; i < c.placements.size(); i += stride) {
      const std::size_t pair = i % c.pairs();
      distance.push_back(exhaustive_separation(c.shapes[c.a[pair]], c.placements[i].a, c.shapes[c.b[pair]],
                                               c.placements[i].b)
                             .distance);
    }
  }
};

struct DistanceErrors {
  double most = 0.0;  ///< m
  int false_overlaps = 0, false_separations = 0, compared = 0;
};

DistanceErrors errors(const DistanceEngine& e, const Oracle& oracle) {
  DistanceErrors result;
  for (std::size_t i = 0; i < e.queries; ++i) {
    const double found = e.ask(i);
    if (i % oracle.stride != 0) continue;
    const double exact = oracle.distance[i / oracle.stride];
    const bool depth = e.answers == Distances::with_depth;
    result.most = std::max(result.most, std::abs(found - (depth ? exact : std::max(0.0, exact))));
    result.false_overlaps += exact > 4.0 * kUlp && (depth ? found < 0.0 : found <= 0.0);
    result.false_separations += exact < -4.0 * kUlp && found > 0.0;
    ++result.compared;
  }
  return result;
}

std::string check(const DistanceEngine& e, const DistanceErrors& found) {
  const double allowed = e.answers == Distances::single_without_depth ? 1e-5 : 4.0 * kUlp;
  if (found.most <= allowed && found.false_overlaps + found.false_separations == 0) return "distances agree";
  return "error " + std::to_string(found.most / kUlp) + " ulp, " + std::to_string(found.false_overlaps) +
         " false overlaps, " + std::to_string(found.false_separations) + " false separations";
}

Row row(const ConvexPairs& c, const DistanceEngine& e, const Oracle& oracle) {
  const DistanceErrors found = errors(e, oracle);
  Row result{"narrowphase", c.name, e.name, 1, {}, static_cast<double>(e.queries), check(e, found)};
  result.error = {{"max_ulp", std::round(found.most / kUlp * 100.0) / 100.0},
                  {"false_overlap", found.false_overlaps},
                  {"false_separation", found.false_separations},
                  {"compared", found.compared}};
  if (e.statistics) {
    const double queries = static_cast<double>(e.queries);
    result.error["states"] = 1.0 + static_cast<double>(e.statistics->steps) / queries;
    result.error["cold_starts"] = e.statistics->cold_starts;
    result.error["fallbacks"] = e.statistics->fallbacks;
  }
  return result;
}

std::vector<Row> run(const ConvexPairs& c, int blocks) {
  Kept kept;
  const std::vector<DistanceEngine> all = engines(c, kept);
  const Oracle oracle(c);
  std::vector<Row> rows;
  std::vector<Contestant> contestants;
  for (const DistanceEngine& e : all) {
    rows.push_back(row(c, e, oracle));
    contestants.push_back({e.name, [&e, back = false]() mutable { e.block(back = !back); }});
  }
  expect_agreement(rows);
  interleave(contestants, blocks, 1.0);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    for (double ms : contestants[i].ms) rows[i].ms.push_back(ms / rows[i].work);
    rows[i].error["ns"] = 1e6 * median(rows[i].ms);
  }
  return rows;
}

}  // namespace

std::vector<Row> bench_narrowphase(const Options& options) {
  std::vector<Row> rows;
  if (chosen("discs, gap and witness", options)) rows = bench_disc_gaps(options);
  for (double step : {0.001, 0.01, 0.1, 0.0})
    for (Gap gap : {Gap::near, Gap::touching, Gap::overlapping})
      for (std::size_t vertices : {4, 8, 40, 400, 4000}) {
        if (!chosen(case_name(vertices, step, gap), options)) continue;
        for (Row& row : run(convex_pairs(vertices, step, gap, options.quick), options.blocks))
          rows.push_back(std::move(row));
        options.show(rows);
      }
  return rows;
}

}  // namespace throng::bench
