// SPDX-License-Identifier: MIT
// throng bench bvh: polygons of up to a million edges in hierarchies of discs, boxes and oriented boxes.
#include "tools/bench/benchmarks.h"
#include "tools/bench/bvh_built.h"
#include "tools/bench/bvh_case.h"
#include "tools/bench/bvh_rows.h"
#include "tools/bench/cgal_segments.h"

namespace throng::bench {

namespace {

using namespace narrowphase;

constexpr std::size_t kMostForBrutePairs = 1024;  // edges a side

using Brute = double (*)(const std::vector<OutlineEdge>&, const std::vector<OutlineEdge>&,
                         const std::pair<Pose, Pose>&);

/// All pairs at the time of a pair, measured over every so-maniest edge: what brute force would take. Its row
/// has the check of the row before, since it isn't run.
void add_extrapolated(const PolygonPair& pair, Brute brute, const Options& options, std::vector<Row>& rows) {
  const auto some = [](const std::vector<Ring>& rings) {
    const std::vector<OutlineEdge> all = outline_edges(rings);
    std::vector<OutlineEdge> result;
    for (std::size_t i = 0; i < all.size(); i += std::max<std::size_t>(1, all.size() / 256))
      result.push_back(all[i]);
    return result;
  };
  const auto a = some(pair.a), b = some(pair.b);
  double sink = 0.0;
  std::vector<Contestant> sample{{"brute", [&] { sink += brute(a, b, pair.places[0]); }}};
  interleave(sample, options.blocks, static_cast<double>(a.size()) * static_cast<double>(b.size()));
  const double pairs = static_cast<double>(pair.a[0].size()) * static_cast<double>(pair.b.back().size());
  rows.push_back({"bvh",
                  rows.back().name,
                  "brute, extrapolated",
                  1,
                  {pairs * median(sample[0].ms)},
                  kPlaces,
                  rows.back().check,
                  {{"ns_of_a_pair", 1e6 * median(sample[0].ms)}, {"finite", std::isfinite(sink)}}});
}

template <class... Volumes>
void collision_rows(const PolygonPair& pair, const Options& options, std::vector<Row>& rows,
                    const Built<Volumes>&... built) {
  Case first("first hit " + pair.name, kPlaces), full("all meetings " + pair.name, kPlaces);
  const auto add = [&](const auto& one) {
    for (const Order order : {Order::depth_first, Order::best_first}) {
      BvhCounters counters;
      one.collisions(pair, order, &counters);
      first.add(
          one.name + (order == Order::depth_first ? " depth" : " best"),
          [&, order] { return one.collisions(pair, order); }, counted(counters));
    }
    BvhCounters counters;
    one.meetings(pair, &counters);
    full.add(
        one.name, [&] { return one.meetings(pair); }, counted(counters));
  };
  (add(built), ...);
  if (chosen("first hit " + pair.name, options)) first.finish(options, rows);
  if (!chosen("all meetings " + pair.name, options)) return;
  const auto of_a = outline_edges(pair.a), of_b = outline_edges(pair.b);
  const bool brute = of_a.size() <= kMostForBrutePairs;
  if (brute)
    full.add("brute", [&] {
      double sum = 0.0;
      for (const auto& at : pair.places) sum += brute_meetings(of_a, of_b, at);
      return sum;
    });
  full.finish(options, rows);
  if (!brute) add_extrapolated(pair, brute_meetings, options, rows);
}

/// Exact and approximate, their true error beside; brute force where it takes less than a second.
template <class... Volumes>
void distance_rows(const PolygonPair& pair, const Options& options, std::vector<Row>& rows,
                   const Built<Volumes>&... built) {
  const std::string name = "distance " + pair.name;
  if (!chosen(name, options)) return;
  Case exact(name, kPlaces);
  std::vector<OutlineCache> caches(sizeof...(built));
  std::size_t next_cache = 0;
  const auto add = [&](const auto& one) {
    BvhCounters counters;
    one.distances(pair, 0.0, &counters);
    exact.add(
        one.name, [&] { return one.distances(pair, 0.0); }, counted(counters));
    OutlineCache& cache = caches[next_cache++];
    exact.add(one.name + " cached", [&] { return one.coherent_distances(pair, 0.0, cache); });
  };
  (add(built), ...);
  const auto of_a = outline_edges(pair.a), of_b = outline_edges(pair.b);
  const bool apart = pair.name.find("touching") == std::string::npos;
  const bool brute = of_a.size() <= kMostForBrutePairs;
  if (brute && apart)
    exact.add("brute", [&] {
      double sum = 0.0;
      for (const auto& at : pair.places) sum += brute_distance(of_a, of_b, at);
      return sum;
    });
  exact.finish(options, rows);
  if (!brute && apart) add_extrapolated(pair, brute_distance, options, rows);
}

/// Each engine's own errors, so no sums to agree on: the promise is checked instead.
template <class Volume>
void approximate_rows(const PolygonPair& pair, const Options& options, std::vector<Row>& rows,
                      const Built<Volume>& one) {
  const std::string name = "within a " + one.name + " " + pair.name;
  if (!chosen(name, options)) return;
  Case within(name, kPlaces);
  for (const double error : {0.0, 0.01, 0.1, 0.5, 1.0}) {
    BvhCounters counters;
    one.distances(pair, error, &counters);
    double worst = 0.0;
    bool kept = true;
    for (const auto& [at_a, at_b] : pair.places) {
      const double exact = proximity(one.a, at_a, one.b, at_b).upper;
      const OutlineProximity found = proximity(one.a, at_a, one.b, at_b, {error, nullptr, nullptr});
      worst = std::max(worst, found.upper / exact - 1.0);
      kept = kept && found.lower <= exact && exact <= found.upper && found.upper <= exact * (1.0 + error);
    }
    nlohmann::ordered_json figures = counted(counters);
    figures["worst"] = worst;
    within.add(
        "a=" + text(error), [&, error, kept] { return one.distances(pair, error) > 0.0 && kept ? 1.0 : 0.0; },
        figures);
    BvhCounters coherent;
    OutlineCache cache;
    one.coherent_distances(pair, error, cache, &coherent);
    within.add(
        "a=" + text(error) + " cached",
        [&, error, cache]() mutable { return one.coherent_distances(pair, error, cache) > 0.0 ? 1.0 : 0.0; },
        counted(coherent));
  }
  within.finish(options, rows);
}

template <class Volume>
void add_builder(Case& build, const std::string& name, const std::vector<Ring>& rings) {
  for (const Split how : {Split::sah, Split::middle})
    build.add(name + (how == Split::sah ? " sah" : " middle"), [&rings, how] {
      return static_cast<double>(outline<Volume>(rings, {how, 4}).edges.size());
    });
}

void build_rows(const PolygonPair& pair, const Options& options, std::vector<Row>& rows) {
  const std::string name = "build " + pair.name.substr(pair.name.find(' ') + 1);
  if (!chosen(name, options)) return;
  Case build(name, 1.0);
  add_builder<Ball<2>>(build, "disc", pair.a);
  add_builder<Box<2>>(build, "aabb", pair.a);
  add_builder<OrientedBox<2>>(build, "obb", pair.a);
  add_builder<BoxAndBall<2>>(build, "mixed", pair.a);
  Options few = options;
  few.blocks = std::min(options.blocks, pair.a[0].size() > 100000 ? 2 : 5);
  build.finish(few, rows);
}

/// All over the polygon and somewhat around it, or within about a hundredth of its outline.
std::vector<Vec> points_around(const Ring& ring, bool close) {
  std::vector<Vec> points;
  for (std::uint64_t i = 0; i < 2000; ++i) {
    const auto at = static_cast<std::size_t>(0.5 * (noise(9, i) + 1.0) * static_cast<double>(ring.size()));
    const Vec off(noise(7, i), noise(8, i));
    points.push_back(close ? Vec(ring[at] + 0.01 * off) : Vec(1.5 * off));
  }
  return points;
}

template <class... Volumes>
void point_rows(const PolygonPair& pair, bool close, const Options& options, std::vector<Row>& rows,
                const Built<Volumes>&... built) {
  const std::string name = (close ? "close point " : "point ") + pair.name.substr(pair.name.find(' ') + 1);
  if (!chosen(name, options)) return;
  const std::vector<Vec> points = points_around(pair.a[0], close);
  const auto sum = [&points](const auto& distance) {
    double total = 0.0;
    for (const Vec& p : points) total += distance(p);
    return total;
  };
  Case near(name, static_cast<double>(points.size()));
  const auto add = [&](const auto& one) {
    near.add(one.name, [&] { return sum([&](const Vec& p) { return nearest(one.a, p).distance; }); });
  };
  (add(built), ...);
  const CgalSegments cgal(pair.a[0]);
  near.add("cgal", [&] { return sum([&](const Vec& p) { return cgal.distance(p); }); });
  const auto edges = outline_edges(pair.a);
  if (edges.size() * points.size() <= kMostForBrutePairs * 2000)
    near.add("brute",
             [&] { return sum([&](const Vec& p) { return exhaustive_nearest(edges, p).distance; }); });
  near.finish(options, rows);
}

bool any_chosen(const PolygonPair& pair, const Options& options) {
  const std::string shape = pair.name.substr(pair.name.find(' ') + 1);
  for (const char* query : {"first hit ", "all meetings ", "distance ", "within a mixed ", "within a obb "})
    if (chosen(query + pair.name, options)) return true;
  return pair.name.starts_with("near") &&
         (chosen("build " + shape, options) || chosen("close point " + shape, options));
}

struct Size {
  const char* family;
  std::size_t n;
};

std::vector<Size> sizes(bool quick) {
  if (quick) return {{"coast", 256}};
  return {{"star", 256},   {"gear", 256},    {"star", 16384},   {"gear", 16384},   {"coast", 128},
          {"coast", 1024}, {"coast", 16384}, {"coast", 131072}, {"coast", 1048576}};
}

/// Fine teeth don't fit into a hole 1e-3 wider: they would cross.
bool fits(const Size& size, const std::string& situation) {
  return situation != "interlocked" || std::string(size.family) == "coast" || size.n <= 256;
}

}  // namespace

std::vector<Row> bench_bvh(const Options& options) {
  std::vector<Row> rows = bvh_volume_rows(options);
  for (Row& row : bvh_part_rows(options)) rows.push_back(std::move(row));
  for (const Size& size : sizes(options.quick))
    for (const char* situation : {"near", "touching", "interlocked"}) {
      if (!fits(size, situation)) continue;
      const PolygonPair pair = make_pair(size.family, situation, size.n);
      if (!any_chosen(pair, options)) continue;
      if (situation == std::string("near")) build_rows(pair, options, rows);
      options.show(rows);
      const Built<Ball<2>> discs("disc", pair);
      const Built<Box<2>> boxes("aabb", pair);
      const Built<OrientedBox<2>> oriented("obb", pair);
      const Built<BoxAndBall<2>> mixed("mixed", pair);
      if (situation == std::string("near"))
        for (const bool close : {false, true})
          point_rows(pair, close, options, rows, boxes, discs, oriented, mixed);
      collision_rows(pair, options, rows, boxes, discs, oriented, mixed);
      distance_rows(pair, options, rows, boxes, discs, oriented, mixed);
      if (situation == std::string("touching")) continue;
      approximate_rows(pair, options, rows, oriented);
      approximate_rows(pair, options, rows, mixed);
    }
  return rows;
}

}  // namespace throng::bench
